# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat of friction: exported scenes against solidem, on ranks, through a restart; bad words.

All centres and velocities lie in a plane, so nothing spins about the normal of a contact: there
LIGGGHTS' friction would be another than solidem's.
"""

import csv
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

from liggghts_runs import CONTRIB, HEADER, Body, Liggghts, dump, read_dump, thermo
from test_coupled import solidem

STEPS = 600
IN_THE_FILE = ("units", "atom_style", "boundary", "bond_", "group")
INITIAL = 300.0
MATERIAL = """\
[material]
density = "2500 kg/m^3"
conductivity = "134 W/(m K)"
specific_heat_capacity = "880 J/(kg K)"

[beams]
young_modulus = "200 GPa"
poisson_ratio = 0.3
radius_ratio = 0.4
"""
SLIDER = """\
[[body]]
name = "bed"
shape = "crystal"
lattice = "simple_cubic"
cells = [8, 2, 1]
element_radius = "0.5 mm"

[[body]]
name = "slider"
shape = "crystal"
lattice = "simple_cubic"
cells = [3, 2, 1]
element_radius = "0.5 mm"
origin = ["2.3 mm", "1.96 mm", "0 mm"]

""" + MATERIAL + """
[contact]
normal_stiffness = "3e6 N/m"
friction = 0.3

[conduction]
law = "platonic"
initial_temperature = "300 K"

[friction_heat]
fraction = 0.8

[[grips]]
name = "foot"
region = { body = "bed", axis = "y", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]

[[initial_velocities]]
region = { body = "slider" }
velocity = ["5 m/s", "-5 m/s", "0 m/s"]
"""
COLD = """\
[[temperatures]]
name = "cold"
region = { body = "bed", axis = "y", side = "high", layers = 1 }
value = "300 K"
"""
RUN = f'[run]\nsteps = {STEPS}\ntime_step = "20 ns"\nobserve_every = 60\n[output]\nframes = 10\n'
FIGURES = ("compute waiting all reduce sum f_waitingHeat\n"
           "thermo_style custom step f_friction f_heat c_waiting {more}\n"
           "thermo_modify format float %.17g norm no\nthermo 60\n"
           + dump("state", 60, "x", "y", "z", "f_Temp"))


def export(folder: Path, scene: str, *options: str) -> subprocess.CompletedProcess:
    """Exports a scene to the folder itself."""
    (folder / "scene.toml").write_text(scene)
    solidem(folder, "prepare", "scene.toml", "--output", "prepared.h5", "--overwrite")
    (folder / "explained.json").write_text(
        solidem(folder, "explain", "scene.toml", "--json", "--quick"))
    return subprocess.run([CONTRIB / "export.py", "prepared.h5", "explained.json", ".", *options],
                          cwd=folder, capture_output=True, text=True)


def script(folder: Path, scene: str, more: str = "", run: str = RUN) -> str:
    """The exported script up to its run, with the figures of heat."""
    done = export(folder, scene + run, "--nearly")
    assert done.returncode == 0, done.stderr
    text = (folder / "run.in").read_text()
    return text[: text.index("thermo ")] + FIGURES.format(more=more)


def history(folder: Path) -> list[dict[str, float]]:
    """The rows of solidem's run of the scene in the folder."""
    solidem(folder, "run", "scene.toml", "--output", "results", "--quiet", "--overwrite")
    with (folder / "results" / "history.csv").open() as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def worst(found: np.ndarray, expected: np.ndarray, scale: float) -> float:
    return float(np.abs(found - expected).max()) / scale


@pytest.fixture(scope="module")
def whole(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> tuple:
    """The slider on one rank: frames by step, and rows of figures."""
    folder = tmp_path_factory.mktemp("whole")
    said = liggghts.run(folder, script(folder, SLIDER) + f"run {STEPS}\n")
    return read_dump(folder / "state.txt"), thermo(said)


@pytest.mark.parametrize("more", ["", COLD])
def test_bodies_that_rub_are_as_warm_as_in_solidem(
    liggghts: Liggghts, tmp_path: Path, more: str
) -> None:
    """One that slides on another, sticks, and flies off, in every frame of the run."""
    said = liggghts.run(tmp_path, script(tmp_path, SLIDER + more, "f_temperature0" if more else "")
                        + f"run {STEPS}\n")
    ours = history(tmp_path)
    rows, frames = thermo(said), read_dump(tmp_path / "state.txt")
    with h5py.File(tmp_path / "results" / "trajectory.h5") as file:
        kept = [(f["position"][:], f["temperature"][:]) for _, f in sorted(file["frames"].items())]
    assert len(kept) == len(frames) == len(ours) == len(rows) == 11
    way = np.abs(kept[-1][0] - kept[0][0]).max()
    rise = max(float(np.abs(temperature - INITIAL).max()) for _, temperature in kept)
    off = [(worst(frames[step][:, :3], position, way), worst(frames[step][:, 3], temperature, rise))
           for step, (position, temperature) in zip(sorted(frames), kept)]
    print(np.max(off, axis=0))
    assert rise > 1e-3 and np.max(off) <= 1e-9
    work = np.array([row["friction"] for row in ours])
    assert work[-1] > 1e-4 and rows[:, 1] == pytest.approx(work, rel=1e-9)
    heat = rows[:, 2] + rows[:, 3] - rows[0, 2] - (rows[:, 4] if more else 0)
    assert heat == pytest.approx(0.8 * work, abs=1e-14 * rows[0, 2])
    if more:
        supplied = np.array([row["temperature.cold.heat"] for row in ours])
        assert rows[:, 4] == pytest.approx(supplied, abs=1e-9 * np.abs(supplied).max())


def differences(whole: tuple, frames: dict[int, np.ndarray]) -> tuple[float, float]:
    """Of the last frames: of positions over the way, of temperatures over the rise."""
    start, end, other = whole[0][0], whole[0][STEPS], frames[STEPS]
    return (worst(other[:, :3], end[:, :3], np.abs(end - start)[:, :3].max()),
            worst(other[:, 3], end[:, 3], np.abs(end[:, 3] - INITIAL).max()))


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks_differ_by_round_off(
    liggghts: Liggghts, tmp_path: Path, whole: tuple, ranks: int
) -> None:
    said = liggghts.run(tmp_path, script(tmp_path, SLIDER) + f"run {STEPS}\n", ranks)
    found = differences(whole, read_dump(tmp_path / "state.txt"))
    print(found)
    assert max(found) <= 1e-9
    assert thermo(said)[-1, 1] == pytest.approx(whole[1][-1, 1], rel=1e-9)


def test_a_restart_while_they_rub_goes_on_as_one_run(
    liggghts: Liggghts, tmp_path: Path, whole: tuple
) -> None:
    text, half = script(tmp_path, SLIDER), 200
    liggghts.run(tmp_path, text + f"run {half}\nwrite_restart half.restart\n", 2)
    for name, words in (("beams.in", (tmp_path / "beams.in").read_text()),
                        ("heat.in", (tmp_path / "heat.in").read_text()), ("resumed", text)):
        kept = "".join(line for line in words.splitlines(keepends=True)
                       if not line.startswith(IN_THE_FILE))
        (tmp_path / name).write_text(kept.replace("read_data       body.data",
                                                  "read_restart    half.restart"))
    said = liggghts.run(tmp_path, (tmp_path / "resumed").read_text() + f"run {STEPS - half}\n")
    found = differences(whole, read_dump(tmp_path / "state.txt"))
    print(found)
    assert 0 < thermo(said)[0, 1] < 0.9 * whole[1][-1, 1]
    assert max(found) <= 1e-9
    assert thermo(said)[-1, 1] == pytest.approx(whole[1][-1, 1], rel=1e-9)


def test_beside_bonds_that_heat_it_comes_a_step_later(liggghts: Liggghts, tmp_path: Path) -> None:
    """The books close all the same, and the difference falls with the step."""
    warm = SLIDER + "[plasticity]\nyield_strain = 0.5\n[plastic_heat]\n"
    done = export(tmp_path, warm + RUN, "--nearly")
    assert "heat of friction comes to the elements one step later" in done.stderr
    said = liggghts.run(tmp_path, script(tmp_path, warm) + f"run {STEPS}\n")
    rows, frames, ours = thermo(said), read_dump(tmp_path / "state.txt"), history(tmp_path)
    assert rows[:, 1] == pytest.approx([row["friction"] for row in ours], rel=1e-9)
    assert rows[:, 2] + rows[:, 3] - rows[0, 2] == pytest.approx(0.8 * rows[:, 1],
                                                                 abs=1e-14 * rows[0, 2])
    assert rows[3, 3] > 1e-9  # waits
    with h5py.File(tmp_path / "results" / "trajectory.h5") as file:
        temperature = [f["temperature"][:] for _, f in sorted(file["frames"].items())][-1]
    rise = np.abs(temperature - INITIAL).max()
    assert worst(frames[STEPS][:, 3], temperature, rise) <= 1e-4


GRAINS = """\
[specimen]
file = "grains.txt"
volume = "1 mm^3"
[material]
density = "2500 kg/m^3"
[contact]
young_modulus = "5 GPa"
friction = 0.4
[[initial_velocities]]
region = { all = true }
velocity = ["3 m/s", "-2 m/s", "0 m/s"]
stretching = ["-3000 1/s", "-2500 1/s", "0 1/s"]
"""


def test_loose_grains_that_rub(liggghts: Liggghts, tmp_path: Path) -> None:
    """Of two sizes, in a plane, none joined to another: they meet, roll and part. LIGGGHTS' springs lose
    length as they turn with the normal: an error of first order in the step."""
    random = np.random.default_rng(5)
    place = np.stack(np.meshgrid(np.arange(4), np.arange(4), [0], indexing="ij"), -1).reshape(-1, 3)
    position = 2.05e-3 * place + random.uniform(-3e-5, 3e-5, (16, 3)) * [1, 1, 0]
    radius = np.where(np.arange(16) % 2 == 0, 1e-3, 0.9e-3)
    heat = ("fix heat all solidem/conduction law platonic conductivity 1 specific_heat 900 "
            "density 2500 initial_temperature 300\nfix friction all solidem/friction\n")
    found = []
    for steps, step, ranks in ((600, 50, 2), (3000, 10, 1)):
        folder = tmp_path / str(steps)
        folder.mkdir()
        (folder / "grains.txt").write_text("".join(
            " ".join(f"{x:.17g}" for x in row) + "\n" for row in np.column_stack([position, radius])))
        run = RUN.replace("20 ns", f"{step} ns").replace(str(STEPS), str(steps))
        done = export(folder, GRAINS + run, "--nearly")
        assert done.returncode == 0, done.stderr
        text = (folder / "run.in").read_text()
        said = liggghts.run(folder, text[: text.index("thermo ")] + heat + FIGURES.format(more="")
                            + f"run {steps}\n", ranks)
        rows, frames = thermo(said), read_dump(folder / "state.txt")
        work = history(folder)[-1]["friction"]
        assert work > 1e-5
        found.append(abs(rows[-1, 1] / work - 1))
        heat_gained = rows[:, 2] + rows[:, 3] - rows[0, 2]
        assert heat_gained == pytest.approx(rows[:, 1], abs=1e-13 * rows[0, 2])
        assert (frames[steps][:, 3] > 300).sum() >= 8
    print(found)
    assert found[0] / found[1] == pytest.approx(5, rel=0.3)
    assert found[1] < 1e-8


@pytest.mark.parametrize("change, words", [
    (("fraction = 0.8", "damping_fraction = 0.5"), "heat of dashpots is not understood"),
    (("[conduction]", "[rupture]\nstrain = 0.1\n[conduction]"), "beside [rupture]"),
    (("[friction_heat]", '[contact_conduction]\nconductance = "1 W/K"\n[friction_heat]'),
     "[contact_conduction] beside [contact]"),
])
def test_scenes_that_are_not_taken_are_told(
    tmp_path: Path, change: tuple[str, str], words: str
) -> None:
    done = export(tmp_path, SLIDER.replace(*change) + RUN, "--nearly")
    assert done.returncode != 0 and words in done.stderr, done.stderr


TWO = Body(np.array([[0.0, 0.0, 0.0], [2e-3, 0.0, 0.0]]), np.full(2, 0.5e-3), np.array([[0, 1]]),
           np.full(3, -5e-3), np.full(3, 5e-3))
CONDUCTION = ("fix heat all solidem/conduction law platonic conductivity 1 specific_heat 900 "
              "density 2500 initial_temperature 300\n")
CONSTANTS = "".join(f"fix {name} all property/global {name} peratomtypepair 1 {value}\n"
                    for name, value in (("kn", 1e6), ("kt", 1e6), ("gamman_abs", 0),
                                        ("gammat_abs", 0), ("coefficientFriction", 0.5),
                                        ("coefficientRollingFriction", 0.1)))
HISTORY = ("pair_style gran model hooke/stiffness tangential {}absolute_damping on "
           "tangential_damping off\npair_coeff * *\n")
FRICTION = "fix friction all solidem/friction\n"


@pytest.mark.parametrize("lines, message", [
    (HISTORY.format("history ") + CONDUCTION + "fix friction all solidem/friction fraction 1.1\n",
     "fraction must be from 0 to 1, but is 1.1"),
    (HISTORY.format("history ") + CONDUCTION + "fix friction all solidem/friction fraction\n",
     "keyword without value: fraction"),
    (HISTORY.format("history ") + CONDUCTION + "fix friction all solidem/friction part 1\n",
     "unknown keyword 'part': known are fraction, tool"),
    (HISTORY.format("history ") + "group one id 1\n" + CONDUCTION
     + "fix friction one solidem/friction\n", "must be used with group 'all'"),
    (HISTORY.format("history ") + FRICTION, "needs a 'fix ID all solidem/conduction'"),
    ("pair_style none\n" + CONDUCTION + FRICTION, "or a fix wall/gran of that model"),
    (HISTORY.format("no_history ") + CONDUCTION + FRICTION, "tangential history' without further"),
    (HISTORY.format("history rolling_friction epsd2 ") + CONDUCTION + FRICTION,
     "tangential history' without further models"),
    (HISTORY.format("history ") + CONDUCTION + FRICTION + "fix bonds all solidem/bonds\n",
     "must be defined after fix solidem/bonds"),
])
def test_what_the_fix_cannot_do_it_says(
    liggghts: Liggghts, tmp_path: Path, lines: str, message: str
) -> None:
    TWO.write(tmp_path / "body.data")
    bonds = "bond_style solidem/beam\nbond_coeff 1 1e9 4e8 radius 2e-4\n"
    text = (HEADER + "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 nsq\n" + bonds
            + CONSTANTS + lines + ("" if "solidem/bonds" in lines else "bond_style none\n"))
    with pytest.raises(AssertionError) as failure:
        liggghts.run(tmp_path, text + "timestep 1e-9\nrun 1\n")
    assert message in str(failure.value)
