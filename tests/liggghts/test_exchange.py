# SPDX-License-Identifier: GPL-2.0-or-later
"""Law voronoi, exchange with the outside and sources against explicit steps in numpy, on any ranks
and after a restart."""

from pathlib import Path

import numpy as np
import pytest

from heat_network import (
    ENERGY,
    LEFT,
    RIGHT,
    STEP,
    STEPS,
    VORONOI,
    Network,
    beginning,
    network,
    outside,
)
from liggghts_runs import HEADER, Liggghts, dump, read_dump, thermo

SCRIPT = VORONOI + LEFT + RIGHT + f"timestep {STEP}\n" + ENERGY


@pytest.fixture(scope="module")
def body() -> Network:
    return network()


@pytest.fixture(scope="module")
def expected(body: Network) -> np.ndarray:
    """(STEPS + 1, N) temperatures of explicit steps."""
    temperature = [np.full(len(body.volume), 298.0)]
    for step in range(STEPS):
        now = temperature[-1]
        temperature.append(now + STEP / body.capacity * body.power(now, outside(step)))
    assert (temperature[-1] > 320).all() and np.ptp(temperature[-1]) > 100
    return np.array(temperature)


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_faces_and_walls_exchange_what_the_file_says(
    liggghts: Liggghts,
    tmp_path: Path,
    body: Network,
    expected: np.ndarray,
    ranks: int,
    newton: str,
) -> None:
    body.write(tmp_path)
    script = beginning(newton) + SCRIPT + dump("state", 10, "x", "f_Temp", "f_cellVolume")
    rows = thermo(liggghts.run(tmp_path, script + f"run {STEPS}\n", ranks))
    frames = read_dump(tmp_path / "state.txt")
    if ranks > 1:
        middle = (body.body.lower[0] + body.body.upper[0]) / 2
        changed = (frames[0][:, 0] < middle) & (frames[STEPS][:, 0] > middle)
        assert changed.sum() > 10, "too few atoms changed processor"
    worst = max(np.abs(frame[:, 1] / expected[n] - 1).max() for n, frame in frames.items())
    print(f"{ranks} ranks, newton {newton}: {worst:.1e}")
    assert worst <= 1e-13
    assert frames[STEPS][:, 2] == pytest.approx(body.volume, rel=1e-15)

    assert rows[:, 2] == pytest.approx(expected[::10] @ body.capacity, rel=1e-13)
    elements, conductance = body.walls["left"]
    heat = STEP * ((798 - expected[:-1, elements]) @ conductance).sum()
    assert rows[-1, 3] == pytest.approx(heat, rel=1e-12)
    gained = rows[:, 2] - rows[0, 2]
    assert rows[:, 3] + rows[:, 4] == pytest.approx(gained, abs=1e-12 * rows[-1, 2])


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_restart_carries_cells_and_heat(
    liggghts: Liggghts, tmp_path: Path, body: Network, expected: np.ndarray, ranks: int
) -> None:
    body.write(tmp_path)
    half = STEPS // 2
    script = beginning() + SCRIPT + f"run {half}\nwrite_restart half.restart\n"
    first = thermo(liggghts.run(tmp_path, script, ranks))
    (tmp_path / "cells.txt").unlink()  # the bonds and atoms carry it now
    resume = (
        HEADER.replace("units           si\natom_style      hybrid granular molecular\n", "")
        + "read_restart half.restart\nneighbor 0.2e-3 bin\n"
        + "neigh_modify every 1 delay 0 check no\npair_style none\n"
        + "variable outside equal 300+2000*step*dt\n"
        + SCRIPT
        + dump("state", STEPS, "f_Temp")
    )
    second = thermo(liggghts.run(tmp_path, resume + f"run {STEPS - half}\n", ranks))
    found = read_dump(tmp_path / "state.txt")[STEPS][:, 0]
    assert np.abs(found / expected[STEPS] - 1).max() <= 1e-13
    assert second[0, 2:] == pytest.approx(first[-1, 2:], rel=1e-13)
    gained = expected[STEPS] @ body.capacity - expected[0] @ body.capacity
    assert second[-1, 3] + second[-1, 4] == pytest.approx(gained, rel=1e-11)


def test_runs_in_a_row_equal_one_run(
    liggghts: Liggghts, tmp_path: Path, body: Network, expected: np.ndarray
) -> None:
    body.write(tmp_path)
    runs = f"run {STEPS - 70}\nrun 0\nrun 30\nrun 40\n"
    liggghts.run(tmp_path, beginning() + SCRIPT + dump("state", STEPS, "f_Temp") + runs)
    found = read_dump(tmp_path / "state.txt")[STEPS][:, 0]
    assert np.abs(found / expected[STEPS] - 1).max() <= 1e-13


@pytest.mark.parametrize("ranks", [1, 2])
def test_stock_commands_see_and_set_what_conducts(
    liggghts: Liggghts, tmp_path: Path, body: Network, ranks: int
) -> None:
    """LIGGGHTS' own names: Temp, heatFlux, heatSource; its own set, compute, dump, fix."""
    body.write(tmp_path)
    count = len(body.volume)
    script = beginning() + VORONOI + LEFT + (
        f"timestep {STEP}\ngroup warm id 1:30\ngroup heated id 50:80\nrun 0\n"
        "set group warm property/atom Temp 400\nset group heated property/atom heatSource 2.5\n"
        "compute mean all reduce ave f_Temp\ncompute most all reduce max f_Temp\n"
        "compute power all reduce sum f_heatFlux\n"
        "thermo_style custom step atoms f_heat c_mean c_most c_power\n"
        "thermo_modify format float %.17g norm no\nthermo 1\n"
        + dump("state", 1, "f_Temp[0]", "f_heatFlux[0]", "f_heatSource[0]")
    )
    rows = thermo(liggghts.run(tmp_path, script + "run 5\n", ranks))
    frames = read_dump(tmp_path / "state.txt")
    temperature = np.full(count, 298.0)
    temperature[:30] = 400
    source = np.zeros(count)
    source[49:80] = 2.5
    for step in range(6):
        assert frames[step][:, 0] == pytest.approx(temperature, rel=1e-13)
        assert (frames[step][:, 2] == source).all()
        assert rows[step, 3:5] == pytest.approx([temperature.mean(), temperature.max()], rel=1e-13)
        power = body.power(temperature, {"left": 798.0})
        temperature = temperature + STEP / body.capacity * (power + source)
        if step < 5:
            assert frames[step + 1][:, 1] == pytest.approx(power, abs=1e-12 * np.abs(power).max())
            assert rows[step + 1, 5] == pytest.approx(power.sum(), rel=1e-10)


WRONG = {
    "cells that are not there": (
        "fix heat all solidem/conduction law voronoi file holes.txt conductivity 1 specific_heat 1 "
        "density 1 initial_temperature 1\nrun 0\n",
        "holes.txt cannot be read",
    ),
    "wall that is not there": (
        VORONOI + LEFT.replace("name left", "name top"),
        "walls.txt has no section 'top'; it has: left, right",
    ),
    "exchange without conduction": (LEFT + "run 0\n", "needs a 'fix ID all solidem/conduction'"),
    "exchange by no variable": (VORONOI + RIGHT.replace("v_o", "v_in") + "run 0\n", "no variable"),
    "exchange without temperature": (
        VORONOI + LEFT.replace(" temperature 798", ""),
        "needs all of: file, name, temperature",
    ),
    "misspelt keyword": (
        VORONOI + LEFT.replace("temperature", "temprature"),
        "repeated keyword 'temprature'",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_commands_are_told(
    liggghts: Liggghts, tmp_path: Path, body: Network, case: str
) -> None:
    lines, message = WRONG[case]
    body.write(tmp_path)
    with pytest.raises(AssertionError) as failure:
        liggghts.run(tmp_path, beginning() + lines)
    assert message in str(failure.value)


def break_file(path: Path, change: str) -> None:
    """Damages one row of a file."""
    lines = path.read_text().splitlines()
    row = 1 + next(k for k, line in enumerate(lines) if line.split()[:1] == ["faces"])
    if change == "face left out":
        lines[row - 1] = f"faces {len(lines) - row - 1}"
        del lines[row]
    elif change == "face twice":
        lines[row] = lines[row + 1]
    elif change == "volume left out":
        lines[1] = f"volumes {int(lines[1].split()[1]) - 1}"
        del lines[2]
    elif change == "negative area":
        words = lines[row].split()
        lines[row] = " ".join([*words[:2], "-1e-6", words[3]])
    elif change == "word":
        lines[row] = lines[row].replace(lines[row].split()[2], "large")
    elif change == "torn":
        lines = lines[:-3]
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(
    "change, message",
    [
        ("face left out", "no face for the bond of atoms"),
        ("face twice", "is there twice"),
        ("volume left out", "no volume of atom 1 in cells.txt"),
        ("negative area", "is no two atoms, positive area and distance"),
        ("word", "should have 4 numbers"),
        ("torn", "cells.txt ends after"),
    ],
)
def test_broken_files_are_told(
    liggghts: Liggghts, tmp_path: Path, body: Network, change: str, message: str
) -> None:
    body.write(tmp_path)
    break_file(tmp_path / "cells.txt", change)
    with pytest.raises(AssertionError) as failure:
        liggghts.run(tmp_path, beginning() + VORONOI + "run 0\n")
    assert message in str(failure.value)


def test_faces_without_bonds_are_told(liggghts: Liggghts, tmp_path: Path, body: Network) -> None:
    body.write(tmp_path)
    fewer = network()
    fewer.body.pairs = fewer.body.pairs[:-2]
    fewer.body.write(tmp_path / "body.data")
    with pytest.raises(AssertionError, match=r"has \d+ faces, the body \d+ bonds"):
        liggghts.run(tmp_path, beginning() + VORONOI + "run 0\n")


def test_atoms_of_a_wall_that_do_not_exist_are_told(
    liggghts: Liggghts, tmp_path: Path, body: Network
) -> None:
    body.write(tmp_path)
    (tmp_path / "walls.txt").write_text("left 2\n1 0.5\n500 0.5\n")
    with pytest.raises(AssertionError, match="has 1 atoms that do not exist here"):
        liggghts.run(tmp_path, beginning() + VORONOI + LEFT + "run 0\n")
