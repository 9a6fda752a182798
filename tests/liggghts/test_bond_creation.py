# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds that are made by distance at a step of the run."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import HEADER, Body, Liggghts, dump, read_dump, thermo
from test_bonds_and_grains import BONDS, GRAINS, RADIUS, bonded_pairs

STEP = 60


def grains(count: int = 60, moving: bool = True) -> Body:
    """Unbonded spheres of two sizes, loosely thrown together, drifting and turning."""
    random = np.random.default_rng(3)
    radius = RADIUS * np.where(np.arange(count) % 2, 1.0, 0.8)
    position = 1.8e-3 * np.array(list(itertools.product(range(4), repeat=3)))[:count]
    position = position + random.uniform(-0.1e-3, 0.1e-3, position.shape)
    velocity = np.zeros((count, 6))
    if moving:
        velocity[:, :3] = random.normal(scale=3.0, size=(count, 3))
        velocity[:, 3:] = random.normal(scale=2000.0, size=(count, 3))
    return Body(position, radius, np.empty((0, 2), int), np.full(3, -10e-3), np.full(3, 20e-3),
                velocity=velocity)


def write(body: Body, folder: Path, extra_bonds: int = 16) -> None:
    body.write(folder / "body.data")
    text = (folder / "body.data").read_text().replace("Bonds\n\n", "")
    text = text.replace("0 bonds\n", "0 bonds\n", 1).replace(
        "1 bond types\n", f"1 bond types\n{extra_bonds} extra bond per atom\n")
    (folder / "body.data").write_text(text)


def script(create: str, steps: str, newton: str = "off", pair: str = GRAINS,
           coefficients: str = "rupture_strain 0.2", ranks: int = 1) -> str:
    return HEADER + (
        f"boundary f f f\nnewton {newton}\n" + ("processors 2 * *\n" if ranks > 1 else "") +
        f"read_data body.data\nneighbor 0.2e-3 bin\nneigh_modify delay 0\n{pair}{BONDS}"
        f"{coefficients}\nfix bonds all solidem/bonds\nfix motion all nve/solidem\n"
        f"fix glue all solidem/bond/create {create}\ntimestep 1e-8\n"
        "compute links all solidem/bond id1 id2 state\ncompute elastic all pe bond\n"
        f"dump links all local {STEP} links.txt c_links[1] c_links[2] c_links[3]\n"
        "thermo_style custom step atoms f_glue c_elastic ke\n"
        f"thermo {STEP}\nthermo_modify format float %.17g norm no\n"
    ) + dump("atoms", STEP, "x", "y", "z", "fx", "fy", "fz") + steps


def near(position: np.ndarray, radius: np.ndarray, tolerance: float) -> set[tuple[int, int]]:
    low, high = np.triu_indices(len(position), 1)
    distance = np.linalg.norm(position[high] - position[low], axis=1)
    close = distance <= (1 + tolerance) * (radius[low] + radius[high])
    return {(int(i), int(j)) for i, j in zip(low[close], high[close])}


@pytest.mark.parametrize("ranks, newton", [(1, "off"), (2, "off"), (1, "off on")])
def test_who_is_near_at_the_step_is_bonded_and_free_of_load(
    liggghts: Liggghts, tmp_path: Path, ranks: int, newton: str
) -> None:
    body = grains()
    write(body, tmp_path)
    pair = GRAINS if newton == "off" else "pair_style none\n"
    said = liggghts.run(tmp_path, script(f"step {STEP} type 1 tolerance 0.05", f"run {2 * STEP}\n",
                                         newton, pair, ranks=ranks), ranks)
    rows = thermo(said)
    frames = read_dump(tmp_path / "atoms.txt")
    links = bonded_pairs(tmp_path / "links.txt")
    expected = near(frames[STEP][:, :3], body.radius, 0.05)
    assert links[0] == set() and links[STEP] == expected and links[2 * STEP] == expected
    assert rows[:, 2].tolist() == [0, len(expected), len(expected)]
    assert len(expected) > 70
    # All that touch are bonded, and bonds are free of load: nobody is pushed.
    assert rows[1, 3] == pytest.approx(0, abs=1e-20) and rows[2, 3] > 1e-9
    stiff = 70e9 * np.pi * 0.4e-3**2
    assert abs(frames[STEP][:, 3:]).max() < 1e-12 * stiff
    assert abs(frames[2 * STEP][:, 3:]).max() > 1e-6 * stiff


def test_a_restart_after_it_goes_on_alike_and_makes_no_bond_again(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    write(grains(), tmp_path)
    create = f"step {STEP} type 1 tolerance 0.05"
    liggghts.run(tmp_path, script(create, f"run {STEP}\nwrite_restart at.restart\nrun {STEP}\n"))
    straight = read_dump(tmp_path / "atoms.txt")[2 * STEP]
    links = bonded_pairs(tmp_path / "links.txt")[2 * STEP]
    resumed = script(create, f"run {STEP}\n").replace(
        "read_data body.data\n", "read_restart at.restart\n")
    for gone in ("units           si\natom_style      hybrid granular molecular\n", "boundary f f f\n"):
        assert gone in resumed
        resumed = resumed.replace(gone, "")
    liggghts.run(tmp_path, resumed)
    again = read_dump(tmp_path / "atoms.txt")[2 * STEP]
    assert bonded_pairs(tmp_path / "links.txt")[2 * STEP] == links
    assert again[:, :3] == pytest.approx(straight[:, :3], abs=1e-15)


@pytest.mark.parametrize("create, words, extra_bonds", [
    ("step 10 type 2 tolerance 0.1", "there is no bond type 2: 1 to 1", 16),
    ("step 10 type 1 tolerance 1.5", "tolerance must be 0 or more and less than 1, not 1.5", 16),
    ("step 10 type 1", "wants 'step N type BOND_TYPE tolerance T'", 16),
    ("step 10 type 1 tolerance 0.1", "reserve some by the header line 'N extra bond per atom'", 2),
])
def test_what_cannot_be_made_is_refused(
    liggghts: Liggghts, tmp_path: Path, create: str, words: str, extra_bonds: int
) -> None:
    write(grains(), tmp_path, extra_bonds)
    with pytest.raises(AssertionError) as refusal:
        liggghts.run(tmp_path, script(create, "run 20\n"))
    assert words in str(refusal.value)


def test_elastic_bonds_between_atoms_that_turned_are_for_new_bodies_alone(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """The first bonds of all may be elastic: orientations count from then on."""
    body = grains()
    write(body, tmp_path)
    create = f"step {STEP} type 1 tolerance 0.05"
    rows = thermo(liggghts.run(tmp_path, script(create, f"run {STEP}\n", coefficients="")))
    assert rows[-1, 2] > 70 and rows[-1, 3] == pytest.approx(0, abs=1e-20)
    second = script(create, f"fix more all solidem/bond/create step {2 * STEP} type 1 tolerance 0.4\n"
                    f"run {2 * STEP}\n", coefficients="")
    with pytest.raises(AssertionError) as refusal:
        liggghts.run(tmp_path, second)
    assert "have turned against each other since the first bonds were made" in str(refusal.value)
