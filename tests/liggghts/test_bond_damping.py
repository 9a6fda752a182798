# SPDX-License-Identifier: GPL-2.0-or-later
"""Dashpots beside the modes of a bond: exact decay, energy, ranks, restarts; and solidem's own."""

import os
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

from liggghts_runs import CONTRIB, HEADER, Body, Liggghts, dump, read_dump, simple_cubic, thermo

RADIUS, LENGTH, THICKNESS = 1e-3, 2e-3, 0.4e-3
YOUNG, SHEAR, DENSITY = 70e9, 27e9, 2790.0
MASS = DENSITY * 4 / 3 * np.pi * RADIUS**3
INERTIA = 0.4 * MASS * RADIUS**2
SECOND_MOMENT = np.pi / 4 * THICKNESS**4
# Stiffness and mass of each mode, and how the two atoms move in it: velocity and spin of the second,
# those of the first are opposite, but for the shear's spins, which are alike.
MODES = {
    "axial": (YOUNG * np.pi * THICKNESS**2 / LENGTH, MASS / 2, [1, 0, 0], [0, 0, 0], -1),
    "twist": (SHEAR * 2 * SECOND_MOMENT / LENGTH, INERTIA / 2, [0, 0, 0], [1, 0, 0], -1),
    "opening": (YOUNG * SECOND_MOMENT / LENGTH, INERTIA / 2, [0, 0, 0], [0, 1, 0], -1),
    "shear": (12 * YOUNG * SECOND_MOMENT / LENGTH,
              1 / (0.5 / INERTIA + 2 / MASS / LENGTH**2), [0, 0, 0], [0, 0, 1], 1),
}


def coefficients(ratio: float) -> str:
    return f"bond_style solidem/beam\nbond_coeff 1 {YOUNG} {SHEAR} radius {THICKNESS} damping {ratio}\n"


def swing(liggghts: Liggghts, folder: Path, mode: str, ratio: float, steps_a_turn: int) -> float:
    """Largest departure of a mode's decay from e^(−ζωt) cos-and-sine, over its amplitude, in three
    turns."""
    folder.mkdir()
    stiffness, mass, velocity, spin, side = MODES[mode]
    omega = np.sqrt(stiffness / mass)
    turn = 2 * np.pi / omega
    speed = 1e-6 * omega * (LENGTH if mode == "axial" else 1.0)
    motion = np.zeros((2, 6))
    motion[1] = speed * np.array([*velocity, *spin])
    motion[0] = motion[1] * ([1] * 3 + [side] * 3 if mode == "shear" else -1)
    if mode == "shear":  # centres move so that neither mean force nor moment is left
        motion[1, 1] = -2 * INERTIA / (MASS * LENGTH) * motion[1, 5]
        motion[0, 1] = -motion[1, 1]
    Body(np.array([[0, 0, 0], [LENGTH, 0, 0]]), np.full(2, RADIUS), np.array([[0, 1]]),
         np.full(3, -10e-3), np.full(3, 10e-3), DENSITY, motion).write(folder / "body.data")
    steps = 3 * steps_a_turn
    script = HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
        + coefficients(ratio) + "fix bonds all solidem/bonds\nfix motion all nve/solidem\n"
        f"timestep {turn / steps_a_turn:.17g}\n"
        + dump("atoms", 1, "x", "f_orientation[2]", "f_orientation[3]", "f_orientation[4]")
        + f"run {steps}\n")
    liggghts.run(folder, script)
    frames = read_dump(folder / "atoms.txt")
    column = {"axial": 0, "twist": 1, "opening": 2, "shear": 3}[mode]
    way = np.array([frames[k][1, column] for k in range(steps + 1)])
    way = way - LENGTH if mode == "axial" else 2 * way
    time = np.arange(steps + 1) * turn / steps_a_turn
    damped = omega * np.sqrt(1 - ratio**2)
    exact = speed / damped * np.exp(-ratio * omega * time) * np.sin(damped * time)
    return float(abs(way - exact).max() / (speed / omega))


@pytest.mark.parametrize("mode", MODES)
def test_each_mode_of_two_atoms_decays_as_it_should_to_second_order(
    liggghts: Liggghts, tmp_path: Path, mode: str
) -> None:
    coarse, fine = (swing(liggghts, tmp_path / str(n), mode, 0.1, n) for n in (40, 80))
    print(f"{mode}: {coarse:.2e} {fine:.2e}")
    assert coarse < 0.05
    assert 3.5 < coarse / fine < 4.5


def shaken_bar(folder: Path) -> Body:
    body = simple_cubic((8, 3, 3), RADIUS)
    body.velocity = np.random.default_rng(5).normal(size=(72, 6)) * ([0.5] * 3 + [300.0] * 3)
    body.write(folder / "body.data")
    return body


def bar_script(runs: str, ratio: float = 0.1) -> str:
    return HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
        + coefficients(ratio) + "fix bonds all solidem/bonds\nfix motion all nve/solidem\n"
        "timestep 5e-8\ncompute elastic all pe bond\ncompute spin all erotate/sphere\n"
        "thermo_style custom step atoms ke c_spin c_elastic f_bonds[8]\nthermo 100\n"
        "thermo_modify format float %.17g norm no\n"
        + dump("atoms", 100, "x", "y", "z", "vx", "vy", "vz") + runs)


def test_a_damped_bar_loses_what_its_dashpots_take_and_neither_momentum_nor_spin(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    body = shaken_bar(tmp_path)
    rows = thermo(liggghts.run(tmp_path, bar_script("run 500\n")))
    total = rows[:, 2:].sum(axis=1)
    assert rows[-1, 5] > 0.5 * total[0] and (np.diff(rows[:, 5]) > 0).all()
    assert total == pytest.approx(total[0], rel=5e-3)
    assert body.velocity is not None
    last = read_dump(tmp_path / "atoms.txt")[500]
    assert last[:, 3:].sum(axis=0) == pytest.approx(body.velocity[:, :3].sum(axis=0), rel=1e-10)


def test_ranks_and_runs_in_a_row_agree(liggghts: Liggghts, tmp_path: Path) -> None:
    shaken_bar(tmp_path)
    one = thermo(liggghts.run(tmp_path, bar_script("run 100\n")))
    frame = read_dump(tmp_path / "atoms.txt")[100]
    two = thermo(liggghts.run(tmp_path, bar_script("run 100\n"), 2))
    assert two == pytest.approx(one, rel=1e-11)
    assert read_dump(tmp_path / "atoms.txt")[100] == pytest.approx(frame, rel=1e-11, abs=1e-13)
    liggghts.run(tmp_path, bar_script("run 50\nrun 50\n"))
    split = read_dump(tmp_path / "atoms.txt")[100]
    assert abs(split[:, :3] - frame[:, :3]).max() < 1e-4 * RADIUS


def test_the_ratio_must_be_positive(liggghts: Liggghts, tmp_path: Path) -> None:
    shaken_bar(tmp_path)
    with pytest.raises(AssertionError) as refusal:
        liggghts.run(tmp_path, bar_script("run 1\n", -0.1))
    assert "the critical ratio of damping must be positive, not -0.1" in str(refusal.value)


SCENE = """
[specimen]
shape = "box"
size = ["3 mm", "1 mm", "1 mm"]
elements = 150
seed = 2

[material]
density = "2700 kg/m^3"

[bonds]
tolerance = 0.0

[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5

[[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]

[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1 }
velocity = ["0.5 m/s", "free", "0.2 m/s"]

[damping]
bonds = 0.07

[run]
time_step = "2 ns"
steps = 1000

[output]
frames = 1
"""


def test_solidem_itself_damps_alike(liggghts: Liggghts, tmp_path: Path) -> None:
    """A bar pulled and sheared, a thousand steps in either code: positions, and what was taken."""
    solidem = os.environ.get("SOLIDEM_PROGRAM", CONTRIB.parents[1] / "build/release/solidem")
    (tmp_path / "scene.toml").write_text(SCENE)

    def call(*words: str) -> str:
        return subprocess.run([solidem, *words], cwd=tmp_path, check=True, text=True,
                              capture_output=True).stdout

    call("prepare", "scene.toml", "--output", "prepared.h5")
    (tmp_path / "explained.json").write_text(call("explain", "scene.toml", "--json"))
    call("run", "scene.toml", "--output", "run")
    subprocess.run([CONTRIB / "export.py", "prepared.h5", "explained.json", "out"], cwd=tmp_path,
                   check=True)
    script = HEADER + (
        "boundary s s s\nnewton off\nread_data body.data\nneighbor 1e-4 bin\npair_style none\n"
        "include beams.in\ntimestep 2e-9\nthermo_style custom step atoms f_bonds[8]\n"
        "thermo 1000\nthermo_modify format float %.17g norm no\n"
        + dump("atoms", 1000, "x", "y", "z") + "run 1000\n")
    said = liggghts.run(tmp_path / "out", script)
    frames = read_dump(tmp_path / "out" / "atoms.txt")
    with h5py.File(tmp_path / "run" / "trajectory.h5") as file:
        own = file[f"frames/{sorted(file['frames'])[-1]}/position"][:]
    moved = abs(frames[1000] - frames[0]).max()
    difference = abs(own - frames[1000]).max() / moved
    history = np.genfromtxt(tmp_path / "run" / "history.csv", delimiter=",", names=True)
    taken = history["bond_damping"]
    print(f"positions {difference:.1e}, energy {abs(taken[-1] / thermo(said)[-1, 2] - 1):.1e}")
    assert difference <= 1e-9
    assert thermo(said)[-1, 2] == pytest.approx(taken[-1], rel=1e-9)
    assert taken[-1] > 0
