# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonded atoms that `fix move rotate` moves: their orientations turn with them."""

from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import HEADER, Body, Liggghts, dump, read_dump, simple_cubic

RADIUS, THICKNESS = 1e-3, 0.4e-3
YOUNG, SHEAR, DENSITY = 70e9, 27e9, 2790.0
STEPS, STEP = 250, 1e-8
BEGINNING = HEADER + (
    "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\nneigh_modify every 1 delay 0\n"
    f"pair_style none\nbond_style solidem/beam\nbond_coeff 1 {YOUNG} {SHEAR} radius {THICKNESS}\n"
    f"fix bonds all solidem/bonds\ntimestep {STEP}\n")
ATOMS = dump("atoms", STEPS, "fx", "fy", "fz", "tqx", "tqy", "tqz",
             *(f"f_orientation[{k}]" for k in (1, 2, 3, 4)))


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_body_that_is_turned_as_a_whole_bears_nothing(liggghts: Liggghts, tmp_path: Path,
                                                        ranks: int) -> None:
    body = simple_cubic((4, 3, 3), RADIUS)
    body.write(tmp_path / "body.data")
    middle = " ".join(f"{x:.17g}" for x in body.position.mean(axis=0))
    liggghts.run(tmp_path, BEGINNING + f"fix turn all move rotate {middle} 1 2 3 {4 * STEPS * STEP}\n"
                 + ATOMS + f"run {STEPS}\n", ranks)
    last = read_dump(tmp_path / "atoms.txt")[STEPS]
    quarter = np.array([1, *(np.array([1, 2, 3]) / np.sqrt(14))]) / np.sqrt(2)
    assert np.abs(last[:, 6:] - quarter).max() < 1e-12
    stiffness = YOUNG * np.pi * THICKNESS**2
    assert np.abs(last[:, :3]).max() < 1e-10 * stiffness
    assert np.abs(last[:, 3:6]).max() < 1e-10 * stiffness * RADIUS


def test_a_grip_that_turns_twists_the_bond(liggghts: Liggghts, tmp_path: Path) -> None:
    length, angle = 2 * RADIUS, 1e-4  # a finite turn twists by its sine
    Body(np.array([[0, 0, 0], [length, 0, 0]]), np.full(2, RADIUS), np.array([[0, 1]]),
         np.full(3, -10e-3), np.full(3, 10e-3), DENSITY, np.zeros((2, 6))).write(
        tmp_path / "body.data")
    period = 2 * np.pi / angle * STEPS * STEP
    liggghts.run(tmp_path, BEGINNING + "group held id 1\ngroup turned id 2\n"
                 "fix hold held move linear 0 0 0\n"
                 f"fix turn turned move rotate {length} 0 0 1 0 0 {period:.17g}\n"
                 + ATOMS + f"run {STEPS}\n")
    last = read_dump(tmp_path / "atoms.txt")[STEPS]
    torque = SHEAR * np.pi / 2 * THICKNESS**4 / length * angle
    assert last[:, 3] == pytest.approx([torque, -torque], rel=1e-9)
    assert (last[0, 6:] == [1, 0, 0, 0]).all()
