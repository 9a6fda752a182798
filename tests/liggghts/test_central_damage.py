# SPDX-License-Identifier: GPL-2.0-or-later
"""fix solidem/damage: crack faces, what opposite faces do to each other, isolated atoms, ranks, restarts."""

from pathlib import Path

import numpy as np
import pytest

from central_body import (
    HEAD,
    LAWS,
    RADIUS,
    beginning,
    largest_difference,
    last_state,
    shaken_block,
    state,
    words,
    write,
)
from liggghts_runs import Body, Liggghts, read_dump, thermo

ROUND_OFF = 1e-12
RANGE, THRESHOLD = 1.3, 0.4
STEPS = 100
STATE = [f"f_damage[{k}]" for k in range(1, 8)]
ON_FACE, NEIGHBOURS, REMOVED, SHOWN, AT_START = 0, 1, 2, slice(3, 6), 6
MOTION = "fix motion all nve\ntimestep 5e-8\n"


def seen_by_numpy(position: np.ndarray, radius: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(N, N) neighbours within range, and (N, 3) barycentres from the atoms: definition, no list."""
    chord = position[None] - position[:, None]
    distance = np.linalg.norm(chord, axis=2)
    near = (distance < RANGE * (radius[:, None] + radius[None])) & (distance > 0)
    count = near.sum(axis=1)
    return near, (near[:, :, None] * chord).sum(axis=1) / np.maximum(count, 1)[:, None]


def piecewise(distance: np.ndarray, rest: np.ndarray) -> np.ndarray:
    law = LAWS["piecewise"]
    return np.maximum(law["stiffness"] * (rest - distance), -law["attraction"])


def test_crack_faces_and_forces_are_those_of_the_definition(liggghts: Liggghts, tmp_path: Path) -> None:
    body = shaken_block()
    write(body, tmp_path / "body.data")
    script = beginning(words("piecewise") + f" range {RANGE}") + MOTION
    script += f"fix damage all solidem/damage crack_threshold {THRESHOLD}\n" + state(STEPS, *STATE)
    script += "thermo_style custom step atoms f_damage[1] f_damage[2]\n"
    script += "thermo_modify norm no format float %.17g\n"
    totals = thermo(liggghts.run(tmp_path, script + f"run {STEPS}\n"))[-1]
    frames = read_dump(tmp_path / "state.txt")
    start, frame = frames[0][:, :3], frames[STEPS]
    near, barycentre = seen_by_numpy(frame[:, :3], body.radius)
    on_face = np.linalg.norm(barycentre, axis=1) > THRESHOLD * body.radius
    found = frame[:, 9:]
    assert (found[:, ON_FACE] == on_face).all()
    assert (found[:, NEIGHBOURS] == near.sum(axis=1)).all()
    assert 20 < on_face.sum() < len(on_face) - 20
    assert totals[2:].tolist() == [on_face.sum(), 0]
    shown = np.where(on_face[:, None], barycentre, 0.0)
    assert np.abs(found[:, SHOWN] - shown).max() <= 1e-12 * RADIUS

    chord = frame[None, :, :3] - frame[:, None, :3]
    distance = np.linalg.norm(chord, axis=2) + np.eye(len(frame))
    radii = body.radius[:, None] + body.radius[None]
    made = np.linalg.norm(start[None] - start[:, None], axis=2)
    force = piecewise(distance, np.where(made <= RANGE * radii, made, radii))
    back = np.einsum("ijk,ik->ij", chord, shown) < 0
    opposite = back & back.T & (force < 0) & near
    assert opposite.sum() > 20, "too few pairs stand on opposite faces"
    force[opposite] = 0.0
    expected = -(np.where(near, force / distance, 0.0)[:, :, None] * chord).sum(axis=1)
    assert np.abs(frame[:, 6:9] - expected).max() <= 1e-11 * np.abs(expected).max()


@pytest.mark.parametrize("dissipation", [0.0, 0.3])
def test_opposite_faces_drag_but_do_not_pull(
    liggghts: Liggghts, tmp_path: Path, dissipation: float
) -> None:
    """Two triangles, tip to tip: of each tip's three neighbours two stand behind it. One triangle
    leaves at 2 m/s; across the gap there are attraction and drag, without crack faces."""
    left = np.array([[0.0, 0.0, 0.0], [-1.7, 0.9, 0.0], [-1.7, -0.9, 0.0]]) * RADIUS
    position = np.vstack([left, [2.3 * RADIUS, 0, 0] - left])
    body = Body(position, np.full(6, RADIUS), np.empty((0, 2)), np.full(3, -5e-3), np.full(3, 8e-3))
    body.velocity = np.repeat([[0.0] * 6, [2.0] + [0.0] * 5], 3, axis=0)
    write(body, tmp_path / "body.data")
    pair = words("piecewise") + f" range {RANGE} tolerance 0 dissipation {dissipation}"
    script = beginning(pair) + MOTION + "{}" + state(1) + "run 0\n"
    faces = "fix damage all solidem/damage crack_threshold 0.3\n"
    for damage, pull in (("", LAWS["piecewise"]["attraction"]), (faces, 0.0)):
        force = last_state(liggghts, tmp_path, script.format(damage))[:, 6]
        expected = np.array([1, 0, 0, -1, 0, 0]) * (pull + 2 * dissipation)
        assert force == pytest.approx(expected, abs=1e-9)


def test_crack_faces_are_looked_for_now_and_then(liggghts: Liggghts, tmp_path: Path) -> None:
    """Between looks what was shown stays, on any ranks and through rebuilds and removals."""
    write(shaken_block(), tmp_path / "body.data")
    frames = []
    for ranks in (1, 4):
        script = beginning(words("piecewise") + f" range {RANGE}") + MOTION
        script += f"fix damage all solidem/damage crack_threshold {THRESHOLD} every 40 minimal_neighbours 6 "
        script += "removal_every 50\n" + state(10, *STATE)
        liggghts.run(tmp_path, script + "run 100\n", ranks)
        frames.append(read_dump(tmp_path / "state.txt"))
    one, four = frames
    shown = [9 + ON_FACE, *range(9 + SHOWN.start, 9 + SHOWN.stop)]
    assert (one[70][:, shown] == one[40][:, shown]).all()
    assert (one[80][:, shown] != one[70][:, shown]).any()
    assert one[50][:, 9 + REMOVED].sum() > one[40][:, 9 + REMOVED].sum()
    assert largest_difference(one[100], four[100]) <= ROUND_OFF
    assert np.abs(one[100][:, 9:] - four[100][:, 9:]).max() <= 1e-12


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [2, 4])
def test_damage_does_not_see_ranks(
    liggghts: Liggghts, tmp_path: Path, ranks: int, newton: str
) -> None:
    write(shaken_block(), tmp_path / "body.data")
    frames = []
    for processors in (1, ranks):
        script = beginning(words("piecewise") + f" range {RANGE} dissipation 0.1", newton=newton)
        script += MOTION + f"fix damage all solidem/damage crack_threshold {THRESHOLD} minimal_neighbours 6 "
        script += "removal_every 20\n" + state(STEPS, *STATE)
        frames.append(last_state(liggghts, tmp_path, script + f"run {STEPS}\n", processors))
    difference = largest_difference(*frames)
    print(f"{ranks} ranks, newton {newton}: {difference:.1e}")
    assert difference <= ROUND_OFF
    assert np.abs(frames[0][:, 9:] - frames[1][:, 9:]).max() <= 1e-12
    assert 5 < frames[0][:, 9 + REMOVED].sum() < len(frames[0]) / 2
    assert 20 < frames[0][:, 9 + ON_FACE].sum()


def test_isolated_atoms_stand_still_and_are_nobodys_neighbours(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """By the definition: fewer neighbours than wanted, and fewer than at the start, at the steps of
    removal; corners that had so few from the start stay."""
    body = shaken_block()
    write(body, tmp_path / "body.data")
    script = beginning(words("piecewise") + f" range {RANGE}") + MOTION
    script += "fix damage all solidem/damage minimal_neighbours 6 removal_every 20\n"
    liggghts.run(tmp_path, script + state(20, *STATE) + "run 100\n")
    frames = read_dump(tmp_path / "state.txt")
    start = seen_by_numpy(frames[0][:, :3], body.radius)[0].sum(axis=1)
    assert (start < 6).any(), "the block has no corners"
    removed = np.zeros(len(start), dtype=bool)
    for step in range(20, 101, 20):
        frame, before = frames[step], frames[step - 20]
        near = seen_by_numpy(frame[:, :3], body.radius)[0] & ~removed
        count = np.where(removed, 0, near.sum(axis=1))
        assert (frame[removed, :3] == before[removed, :3]).all()
        assert (frame[removed, 3:9] == 0).all()
        removed |= (count < 6) & (count < start)
        assert (frame[:, 9 + REMOVED] == removed).all()
        assert (frame[:, 9 + AT_START] == start).all()
    assert 5 < removed.sum() < len(removed) / 2
    corners = (start < 6) & ~removed
    assert corners.any()


@pytest.mark.parametrize("before, after", [(1, 1), (2, 4)])
def test_a_restart_file_carries_the_damage(
    liggghts: Liggghts, tmp_path: Path, before: int, after: int
) -> None:
    """Written between two looks; runs in a row give the same, too."""
    damage = f"fix damage all solidem/damage crack_threshold {THRESHOLD} every 15 minimal_neighbours 6 "
    damage += "removal_every 20\n"
    write(shaken_block(), tmp_path / "body.data")
    begin = beginning(words("piecewise") + f" range {RANGE}") + MOTION + damage
    whole = last_state(liggghts, tmp_path, begin + state(STEPS, *STATE) + f"run {STEPS}\n")
    row = last_state(liggghts, tmp_path,
                     begin + state(STEPS, *STATE) + "run 40\nrun 0\nrun 60\n", before)
    assert largest_difference(whole, row) <= ROUND_OFF
    liggghts.run(tmp_path, begin + "run 50\nwrite_restart half.restart\n", before)
    resume = HEAD.partition("atom_style granular\n")[2] + (
        "read_restart half.restart\nneighbor 1e-4 bin\nneigh_modify every 1 delay 0 check yes\n"
        + MOTION + damage + state(50, *STATE) + "run 50\n"
    )
    resumed = last_state(liggghts, tmp_path, resume, after)
    assert largest_difference(whole, resumed) <= ROUND_OFF
    assert np.abs(whole[:, 9:] - resumed[:, 9:]).max() <= 1e-12
    assert whole[:, 9 + REMOVED].sum() > 5
