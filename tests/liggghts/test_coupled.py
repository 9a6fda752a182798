# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat from work, work from heat: exported scenes against solidem, on ranks, through a restart."""

import csv
import json
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

from liggghts_runs import CONTRIB, HEADER, Body, Liggghts, dump, read_dump, thermo

PROGRAM = CONTRIB.parents[1] / "build" / "release" / "solidem"
STEPS = 120
INITIAL = 310.0

#: A bar that is pulled far beyond its yield stress while it is heated and cooled. Nothing is left out:
#: all of it depends on temperature or on the rate of flow.
BAR = f"""\
[specimen]
shape = "box"
size = ["3 mm", "1.5 mm", "1.5 mm"]
elements = 80
seed = 3

[material]
density = "2790 kg/m^3"
conductivity = "134 W/(m K)"
specific_heat_capacity = "880 J/(kg K)"
expansion_coefficient = {{ temperature = ["290 K", "400 K"], value = ["2.2e-5 1/K", "2.6e-5 1/K"] }}

[beams]
young_modulus = "3.6 TPa"
poisson_ratio = 0.3
radius_ratio = 0.25
law = "timoshenko"

[plasticity]
hardening = "johnson-cook"
yield_stress = "3 GPa"
hardening_stress = "2 GPa"
hardening_exponent = 0.25
rate_sensitivity = 0.025
reference_rate = "1 1/s"
rate_time = "1 us"
softening_exponent = 1.36
reference_temperature = "296 K"
melting_temperature = "855 K"

[conduction]
law = "platonic"
initial_temperature = "{INITIAL} K"

[plastic_heat]
fraction = 0.9

[expansion]
reference_temperature = "305 K"

[softening]
modulus_ratio = {{ temperature = ["296 K", "700 K"], value = [1, 0.6] }}

[[grips]]
name = "left"
region = {{ axis = "x", side = "low", depth = "0.3 mm" }}
velocity = ["0 m/s", "0 m/s", "0 m/s"]

[[grips]]
name = "right"
region = {{ axis = "x", side = "high", depth = "0.3 mm" }}
velocity = ["8 m/s", "0 m/s", "0 m/s"]
"""
OUTSIDE = """\
[[temperatures]]
name = "cold"
region = { axis = "x", side = "low", depth = "0.3 mm" }
value = "300 K"

[[convections]]
name = "air"
wall = "y_low"
coefficient = "1e8 W/(m^2 K)"
temperature = "290 K"
"""
LAMP = """\
[[heat_sources]]
name = "lamp"
region = { axis = "x", side = "high", depth = "0.3 mm" }
power = "30 kW"
"""
RUN = f"[run]\nsteps = {STEPS}\ntime_step_ratio = 0.3\nobserve_every = 30\n[output]\nframes = 1\n"
STATE = dump("state", STEPS, "x", "y", "z", "f_Temp", "f_waitingHeat")
FIGURES = ("thermo_style custom step f_bonds[1] f_heat c_waiting\n"
           "thermo_modify format float %.17g norm no\n")


def solidem(folder: Path, *words: str) -> str:
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def export(folder: Path, scene: str) -> subprocess.CompletedProcess:
    """Exports a scene to the folder itself."""
    (folder / "scene.toml").write_text(scene)
    solidem(folder, "prepare", "scene.toml", "--output", "prepared.h5", "--overwrite")
    (folder / "explained.json").write_text(
        solidem(folder, "explain", "scene.toml", "--json", "--quick"))
    return subprocess.run([CONTRIB / "export.py", "prepared.h5", "explained.json", "."], cwd=folder,
                          capture_output=True, text=True)


def script(folder: Path) -> str:
    """The exported script up to its run, with the figures of heat."""
    done = export(folder, BAR + RUN)
    assert done.returncode == 0, done.stderr
    text = (folder / "run.in").read_text()
    return (text[: text.index("dump ")] + "compute waiting all reduce sum f_waitingHeat\n" + FIGURES
            + STATE)


def frame(folder: Path, pattern: str) -> tuple[np.ndarray, np.ndarray]:
    """Positions and temperatures in the last frame that solidem wrote."""
    with h5py.File(sorted((folder / "results" / "trajectory").glob(pattern))[-1]) as file:
        return file["position"][:], file["temperature"][:]


@pytest.fixture(scope="module")
def closed(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    """The bar with nothing outside, on one rank."""
    folder = tmp_path_factory.mktemp("closed")
    liggghts.run(folder, script(folder) + f"run {STEPS}\n")
    return read_dump(folder / "state.txt")[STEPS]


def differences(a: np.ndarray, b: np.ndarray) -> tuple[float, float]:
    """Of positions over the way that the grip went, and of temperatures over their largest rise."""
    way = 8 * STEPS * 1e-8
    return (float(np.abs(a[:, :3] - b[:, :3]).max()) / way,
            float(np.abs(a[:, 3] - b[:, 3]).max() / np.abs(a[:, 3] - INITIAL).max()))


@pytest.mark.parametrize("source", ["", LAMP])
def test_a_bar_that_flows_expands_softens_and_conducts_is_that_of_solidem(
    liggghts: Liggghts, tmp_path: Path, source: str
) -> None:
    """What is imposed at the start is there before bonds first act, with a first `run 0` and without."""
    done = export(tmp_path, BAR + OUTSIDE + source + RUN)
    assert done.returncode == 0, done.stderr
    solidem(tmp_path, "run", "scene.toml", "--output", "results", "--threads", "1")
    text = (tmp_path / "run.in").read_text()
    heats = "f_temperature0 f_exchange0"
    liggghts.run(tmp_path, text[: text.index("dump ")] + STATE
                 + FIGURES.replace("c_waiting", heats) + f"thermo {STEPS}\nrun {STEPS}\n")
    found = read_dump(tmp_path / "state.txt")[STEPS]
    position, temperature = frame(tmp_path, "0*.h5")
    own = np.column_stack([position, temperature])
    way, rise = differences(found, own)
    print(f"position {way:.1e}, temperature {rise:.1e}")
    assert np.abs(temperature - INITIAL).max() > 5 and found[:, 4].max() > 0
    assert way <= 1e-9 and rise <= 1e-9
    with open(tmp_path / "results" / "history.csv") as file:
        last = list(csv.DictReader(file))[-1]
    assert found[:, 4].sum() == pytest.approx(float(last["waiting_heat"]), rel=1e-8)


@pytest.mark.parametrize("ranks, newton", [(4, "off"), (2, "off on")])
def test_ranks_differ_by_round_off(
    liggghts: Liggghts, tmp_path: Path, closed: np.ndarray, ranks: int, newton: str
) -> None:
    text = script(tmp_path).replace("newton          off", f"newton          {newton}")
    liggghts.run(tmp_path, text + f"run {STEPS}\n", ranks)
    found = differences(closed, read_dump(tmp_path / "state.txt")[STEPS])
    print(found)
    assert max(found) <= 1e-9


def test_a_restart_in_mid_flow_goes_on_as_one_run(
    liggghts: Liggghts, tmp_path: Path, closed: np.ndarray
) -> None:
    """Heat that waits, the memory of bonds and their temperatures come from the file."""
    text = script(tmp_path)
    half = STEPS // 2
    liggghts.run(tmp_path, text + f"run {half}\nwrite_restart half.restart\n", 2)
    in_the_file = ("units", "atom_style", "boundary", "newton", "bond_", "group")
    for name, words in (("beams.in", (tmp_path / "beams.in").read_text()),
                        ("heat.in", (tmp_path / "heat.in").read_text()), ("resumed", text)):
        kept = "".join(line for line in words.splitlines(keepends=True)
                       if not line.startswith(in_the_file))
        (tmp_path / name).write_text(kept.replace("read_data       body.data",
                                                  "read_restart    half.restart"))
    liggghts.run(tmp_path, (tmp_path / "resumed").read_text() + f"run {STEPS - half}\n")
    assert max(differences(closed, read_dump(tmp_path / "state.txt")[STEPS])) <= 1e-9


def test_the_books_of_heat_close(liggghts: Liggghts, tmp_path: Path) -> None:
    """What bodies hold and what waits is what they held and β times the plastic work."""
    rows = thermo(liggghts.run(tmp_path, script(tmp_path) + f"thermo 20\nrun {STEPS}\n"))
    work, heat, waiting = rows[:, 1], rows[:, 2], rows[:, 3]
    assert work[-1] > 1e-4 and waiting[-1] > 0
    assert heat + waiting - heat[0] == pytest.approx(0.9 * work, abs=1e-13 * heat[0])


TWO = Body(np.array([[0.0, 0.0, 0.0], [1e-3, 0.0, 0.0]]), np.full(2, 0.5e-3), np.array([[0, 1]]),
           np.full(3, -5e-3), np.full(3, 5e-3))
WARM = (HEADER + "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\n"
        "pair_style none\nbond_style solidem/beam\nbond_coeff 1 1e9 4e8 radius 2e-4 {words}\n"
        "fix bonds all solidem/bonds\nfix motion all nve/solidem\n"
        "fix heat all solidem/conduction law platonic conductivity 1 specific_heat 900 "
        "density 2700 initial_temperature 400\ntimestep 1e-9\n")


@pytest.mark.parametrize("words, strain, ratio", [
    ("expansion 2e-5 from 300", 2e-3, 1.0),
    ("expansion table 2 300 1e-5 400 3e-5 from 300", 2e-3, 1.0),
    ("expansion 2e-5 from 300 softening table 2 300 1 500 0.5", 2e-3, 0.75),
    ("expansion -1e-5 from 350 softening 0.5", -5e-4, 0.5),
])
def test_a_held_bond_bears_what_its_expansion_asks(
    liggghts: Liggghts, tmp_path: Path, words: str, strain: float, ratio: float
) -> None:
    """Its length free of load is l₀ (1 + ε), so it bears E(T) S ε / (1 + ε)."""
    TWO.write(tmp_path / "body.data")
    liggghts.run(tmp_path, WARM.format(words=words) + dump("state", 1, "fx") + "run 0\n")
    push = read_dump(tmp_path / "state.txt")[0][:, 0]
    expected = ratio * 1e9 * np.pi * 2e-4**2 * strain / (1 + strain)
    assert push == pytest.approx([-expected, expected], rel=1e-12)


def test_words_of_heat_survive_a_data_file(liggghts: Liggghts, tmp_path: Path) -> None:
    """What `write_data` says of them is read as the same."""
    TWO.write(tmp_path / "body.data")
    words = ("plasticity radial-return johnson-cook yield_strain 0.001 hardening_strain 0.001 "
             "hardening_exponent 0.5 rate_sensitivity 0.02 expansion table 2 300 1e-5 400 3e-5 "
             "from 290 softening 0.5 plastic_heat 0.75 rate_time 1e-6")
    liggghts.run(tmp_path, WARM.format(words=words) + "run 0\nwrite_data written.data\n")
    written = (tmp_path / "written.data").read_text()
    line = next(line for line in written.splitlines() if "johnson-cook" in line)
    TWO.write(tmp_path / "body.data")
    again = WARM.format(words="WORDS").replace("1e9 4e8 radius 2e-4 WORDS", line.split(" ", 1)[1])
    liggghts.run(tmp_path, again + "run 0\nwrite_data again.data\n")
    assert line in (tmp_path / "again.data").read_text()
    for word in ("expansion table 2 300", "from 290", "softening 0.5", "plastic_heat 0.75",
                 "rate_time"):
        assert word in line


@pytest.mark.parametrize("change, message", [
    (("rate_time = \"1 us\"\n", ""), "depends on the rate of flow needs rate_time"),
    (("[plastic_heat]", "[contact]\nyoung_modulus = \"5 GPa\"\n[friction_heat]\n[plastic_heat]"),
     "are of elements of"),
    (("[conduction]", "[conduction]\nlargest_change = \"1 K\""), "largest_change: heat that chooses"),
    (("seed = 3\n", "seed = 3\n[rupture]\nstrain = 0.1\n"), "bonds that break cannot conduct heat"),
])
def test_coupled_scenes_that_are_not_taken_are_told(
    tmp_path: Path, change: tuple[str, str], message: str
) -> None:
    done = export(tmp_path, BAR.replace(*change) + RUN)
    assert done.returncode != 0 and message in done.stderr, done.stderr


def test_two_materials_that_expand_are_told(tmp_path: Path) -> None:
    done = export(tmp_path, BAR + RUN)
    assert done.returncode == 0, done.stderr
    explained = json.loads((tmp_path / "explained.json").read_text())
    del explained["laws"]["expansion"]["expansion_coefficient"]
    (tmp_path / "explained.json").write_text(json.dumps(explained))
    done = subprocess.run([CONTRIB / "export.py", "prepared.h5", "explained.json", "."],
                          cwd=tmp_path, capture_output=True, text=True)
    assert "expansion_coefficient is None; only one for the whole body" in done.stderr
