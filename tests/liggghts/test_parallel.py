# SPDX-License-Identifier: GPL-2.0-or-later
"""The same results on any ranks, with neighbour rebuilds, newton on and off, periodic faces."""

import re
from pathlib import Path

import numpy as np
import pytest

import moving_bar
from liggghts_runs import HEADER, Liggghts, dump, read_dump, simple_cubic
from moving_bar import STEPS, beginning, largest_difference, state

ROUND_OFF = 1e-12


@pytest.fixture(scope="module")
def serial(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    """The last state on one rank without any rebuild."""
    folder = tmp_path_factory.mktemp("serial")
    script = beginning(rebuild=False) + state() + f"run {STEPS}\n"
    frame = moving_bar.run(liggghts, folder, script)[STEPS]
    moving_bar.check_it_moved(frame)
    return frame


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2, 4])
def test_ranks_and_rebuilds_change_nothing(
    liggghts: Liggghts, tmp_path: Path, serial: np.ndarray, ranks: int, newton: str
) -> None:
    moving_bar.write_body(tmp_path)
    said = liggghts.run(tmp_path, beginning(newton) + state() + f"run {STEPS}\n", ranks)
    low, high, grid = (
        re.search(pattern, said).group(1, 2, 3)
        for pattern in (
            r"orthogonal box = \((\S+) (\S+) (\S+)\) to",
            r"\) to \((\S+) (\S+) (\S+)\)",
            r"(\d+) by (\d+) by (\d+) MPI processor grid",
        )
    )
    assert int(grid[0]) * int(grid[1]) * int(grid[2]) == ranks
    frames = read_dump(tmp_path / "state.txt")
    if ranks > 1:
        assert int(grid[0]) % 2 == 0
        middle = (float(low[0]) + float(high[0])) / 2
        changed = (frames[0][:, 0] < middle) & (frames[STEPS][:, 0] > middle)
        assert changed.sum() > 10, "too few atoms changed processor"
    difference = largest_difference(serial, frames[STEPS])
    print(f"{ranks} ranks, newton {newton}: {difference:.1e}")
    assert difference <= ROUND_OFF


@pytest.mark.parametrize("ranks", [1, 4])
def test_sorting_atoms_changes_nothing(
    liggghts: Liggghts, tmp_path: Path, serial: np.ndarray, ranks: int
) -> None:
    script = beginning().replace("sort 0 0", "sort 1 1e-3") + state() + f"run {STEPS}\n"
    frames = moving_bar.run(liggghts, tmp_path, script, ranks)
    assert largest_difference(serial, frames[STEPS]) <= ROUND_OFF


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_periodic_bar_flies_through_its_own_faces(
    liggghts: Liggghts, tmp_path: Path, ranks: int
) -> None:
    """An endless bar vibrates alike at rest and in flight, while its bonds cross the periodic faces
    at other places."""
    frames = []
    for name, speed in (("rest", 0.0), ("flight", 400.0)):
        folder = tmp_path / name
        folder.mkdir()
        body = simple_cubic((6, 3, 3), moving_bar.RADIUS, periodic=True)
        body.velocity = np.zeros((len(body.position), 6))
        body.velocity[:, :3] = np.random.default_rng(2).normal(size=body.position.shape)
        body.velocity[:, 0] += speed
        body.write(folder / "body.data")
        script = HEADER + (
            "boundary p p p\nnewton off\nread_data body.data\nneighbor 0.3e-3 bin\n"
            "neigh_modify every 1 delay 0 check no\npair_style none\n"
            + moving_bar.SETTINGS
            + "fix bonds all solidem/bonds\nfix motion all nve/solidem\ntimestep 1e-7\n"
            + dump("state", STEPS, "ix", "fx", "fy", "fz", "tqx", "tqy", "tqz")
            + f"run {STEPS}\n"
        )
        liggghts.run(folder, script, ranks)
        frames.append(read_dump(folder / "state.txt")[STEPS])
    rest, flight = frames
    assert (flight[:, 0] != rest[:, 0]).sum() > 10, "no atom crossed the face"
    stiffness = moving_bar.AXIAL_STIFFNESS
    assert np.abs(rest[:, 1:4]).max() > 1e-4 * stiffness
    assert np.abs(flight[:, 1:4] - rest[:, 1:4]).max() <= ROUND_OFF * stiffness
    assert np.abs(flight[:, 4:] - rest[:, 4:]).max() <= ROUND_OFF * stiffness * moving_bar.RADIUS
