# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds and atoms that a user deletes between runs: what is left keeps its own memory."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import central_body
import heat_network
import moving_bar
from liggghts_runs import HEADER, Body, Liggghts, dump, read_dump, simple_cubic, thermo

FIGURES = ("length", "force", "stress", "plastic_strain", "energy")
BEAM = moving_bar.SETTINGS.replace("0.3\n", "0.3 plasticity radial-return 1.5e7 1e9\n")
DELETIONS = {
    "bonds": "delete_bonds cut bond 1 remove\n",
    "bonds of any atom": "delete_bonds cut multi any remove\n",
    "off, on, away": "delete_bonds cut bond 1\ndelete_bonds cut bond 1 undo\n"
    "delete_bonds cut bond 1 remove\n",
    "atoms": "delete_bonds cut multi any remove\ndelete_atoms group cut compress yes\n",
}


@dataclass
class Bonds:
    """What `compute solidem/bond` tells: rows by pairs of atoms."""

    pairs: list[tuple[int, int]]
    figures: np.ndarray


def bonds_of(file: Path) -> Bonds:
    rows = [line.split() for line in file.read_text().split("ITEM: ENTRIES")[-1].splitlines()[1:]]
    rows.sort(key=lambda row: (int(row[0]), int(row[1])))
    return Bonds([(int(row[0]), int(row[1])) for row in rows],
                 np.array([row[2:] for row in rows], dtype=float))


def look(name: str) -> str:
    """Script lines that dump the bonds as they are."""
    columns = " ".join(f"c_bond[{n}]" for n in range(1, 3 + len(FIGURES)))
    formats = " ".join(["%.0f"] * 2 + ["%.17g"] * len(FIGURES))
    return (f"dump look all local 1 {name}.txt {columns}\n"
            f'dump_modify look format "{formats}"\nrun 0\nundump look\n')


@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "on"), (2, "off")])
@pytest.mark.parametrize("deletion", DELETIONS)
def test_bonds_that_are_left_keep_their_history(
    liggghts: Liggghts, tmp_path: Path, deletion: str, ranks: int, newton: str
) -> None:
    """A bar vibrates and flows; every third atom and its neighbours lose bonds, in a data file whose
    bonds stand in any order. In the same pose the others bear what they bore, to the bit."""
    body = shuffled_bar(tmp_path)
    gone = set(range(1, len(body.position), 3)) | set(range(2, len(body.position), 6))
    script = moving_bar.beginning(newton, styles=BEAM + moving_bar.MOTION) + (
        f"compute bond all solidem/bond id1 id2 {' '.join(FIGURES)}\n"
        "thermo_style custom step f_bonds[1]\nthermo_modify format float %.17g norm no\n"
        f"group cut id {' '.join(map(str, sorted(gone)))}\nrun 50\n"
        + look("before") + DELETIONS[deletion] + look("after") + "run 20\n"
    )
    said = liggghts.run(tmp_path, script, ranks)
    before, after = bonds_of(tmp_path / "before.txt"), bonds_of(tmp_path / "after.txt")
    either = "any" in DELETIONS[deletion]
    hit = [(i in gone or j in gone) if either else (i in gone and j in gone)
           for i, j in before.pairs]
    kept = [not cut for cut in hit]
    assert 20 < sum(hit) and 20 < sum(kept)
    assert after.pairs == [pair for pair, keep in zip(before.pairs, kept) if keep]
    assert np.ptp(before.figures[kept], axis=0).min() > 0, "bonds that are all alike tell nothing"
    assert (after.figures == before.figures[kept]).all()
    work = thermo(said)[:, 1]
    assert work[-1] >= work[0] > 0, "the work of bonds that are gone was done all the same"


def shuffled_bar(folder: Path) -> Body:
    """The moving bar, with bonds and their ends in any order."""
    moving_bar.write_body(folder)
    text = (folder / "body.data").read_text()
    head, bonds = text.split("Bonds\n\n")
    rows = [line.split() for line in bonds.splitlines()]
    random = np.random.default_rng(4)
    lines = []
    for k in random.permutation(len(rows)):
        i, j = rows[k][2:][:: random.choice([1, -1])]
        lines.append(f"{len(lines) + 1} 1 {i} {j}")
    (folder / "body.data").write_text(head + "Bonds\n\n" + "\n".join(lines) + "\n")
    return simple_cubic(moving_bar.CELLS, moving_bar.RADIUS)


def test_four_atoms_at_rest_stay_at_rest(liggghts: Liggghts, tmp_path: Path) -> None:
    """Three bonds of unlike lengths, of which the first is deleted: a body without load has none."""
    position = np.array([[0, 0, 0], [1, 0, 0], [0, 1.5, 0], [0, 0, 2.0]]) * 1e-3
    box = np.full(3, 20e-3)
    Body(position, np.full(4, 0.6e-3), np.array([[0, 1], [0, 2], [0, 3]]), -box, box).write(
        tmp_path / "body.data")
    script = HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 0.5e-3 bin\npair_style none\n"
        "bond_style solidem/beam\nbond_coeff 1 1e9 0.4e9 pair 0.5\nfix bonds all solidem/bonds\n"
        "fix motion all nve/solidem\ntimestep 2e-7\ncompute elastic all pe bond\n"
        "thermo_style custom step ke c_elastic\nrun 10\ngroup cut id 1 2\n"
        "delete_bonds cut bond 1 remove\nrun 10\n"
    )
    assert (thermo(liggghts.run(tmp_path, script))[:, 1:] == 0).all()


def test_bonds_that_are_only_switched_off_are_refused(liggghts: Liggghts, tmp_path: Path) -> None:
    moving_bar.write_body(tmp_path)
    script = moving_bar.beginning() + "run 1\ndelete_bonds hot bond 1\nrun 1\n"
    with pytest.raises(AssertionError, match="is switched off: use delete_bonds with 'remove'"):
        liggghts.run(tmp_path, script)


@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "on")])
def test_faces_that_are_left_conduct_as_before(
    liggghts: Liggghts, tmp_path: Path, ranks: int, newton: str
) -> None:
    """Faces of unlike areas; some are deleted. Against explicit steps in numpy."""
    body = heat_network.network()
    body.write(tmp_path)
    cut = np.arange(0, len(body.volume), 3)
    half = heat_network.STEPS // 2
    script = heat_network.beginning(newton) + heat_network.VORONOI + heat_network.LEFT + (
        f"timestep {heat_network.STEP}\ngroup cut id {' '.join(str(k + 1) for k in cut)}\n"
        + dump("state", half, "f_Temp")
        + f"run {half}\ndelete_bonds cut multi remove\nrun {half}\n"
    )
    liggghts.run(tmp_path, script, ranks)
    found = read_dump(tmp_path / "state.txt")[2 * half][:, 0]

    temperature = np.full(len(body.volume), 298.0)
    hit = np.isin(body.body.pairs, cut).all(axis=1)
    assert 10 < hit.sum() < 0.5 * len(hit)
    for step in range(2 * half):
        if step == half:
            body.body.pairs = body.body.pairs[~hit]
            body.area, body.distance = body.area[~hit], body.distance[~hit]
        power = body.power(temperature, {"left": 798.0})
        temperature = temperature + heat_network.STEP * power / body.capacity
    assert temperature.max() > 350
    assert found == pytest.approx(temperature, rel=1e-12)


@pytest.mark.parametrize("ranks", [1, 2])
def test_initial_distances_follow_atoms_that_are_renumbered(
    liggghts: Liggghts, tmp_path: Path, ranks: int
) -> None:
    """Atoms are deleted, with and without new ids for the others: the same motion."""
    body = central_body.shaken_block()
    outcomes = []
    for compress in ("yes", "no"):
        folder = tmp_path / compress
        folder.mkdir()
        central_body.write(body, folder / "body.data")
        script = central_body.beginning(central_body.words("mie") + " range 1.3") + (
            "fix motion all nve\ntimestep 2e-8\ngroup cut id 3:400:7\nrun 20\n"
            f"delete_atoms group cut compress {compress}\n"
            + central_body.state(10) + "run 30\n"
        )
        liggghts.run(folder, script, ranks)
        frames = rows_of(folder / "state.txt")
        first, last = frames[min(frames)], frames[max(frames)]
        order = np.lexsort(first[:, :3].T)
        outcomes.append((first[order], last[order]))
    (first, last), (expected_first, expected_last) = outcomes
    assert len(first) < len(body.position)
    assert (first[:, :6] == expected_first[:, :6]).all()
    assert central_body.largest_difference(expected_last, last) <= 1e-9


def rows_of(file: Path) -> dict[int, np.ndarray]:
    """Frames of a dump whose ids may have gaps."""
    frames = {}
    for block in file.read_text().split("ITEM: TIMESTEP\n")[1:]:
        lines = block.splitlines()
        frames[int(lines[0])] = np.array([row.split()[1:] for row in lines[8:]], dtype=float)
    return frames
