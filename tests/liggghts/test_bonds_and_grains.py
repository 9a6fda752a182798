# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonded atoms beside a granular pair style: who pushes whom, and when."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import CONTRIB, HEADER, Body, Liggghts, dump, read_dump, simple_cubic, thermo

RADIUS = 1e-3
CONTACT_STIFFNESS = 2e6
TANGENTIAL_STIFFNESS = 1e6
YOUNG = 70e9


def grains(friction: float) -> str:
    """Script lines of a granular pair style without viscous damping."""
    constants = [("kn", CONTACT_STIFFNESS), ("kt", TANGENTIAL_STIFFNESS), ("gamman", 0.0),
                 ("gammat", 0.0), ("coefficientFriction", friction)]
    return "".join(
        f"fix {name} all property/global {name} peratomtypepair 1 {value:.17g}\n"
        for name, value in constants
    ) + "pair_style gran model hooke/stiffness tangential history\npair_coeff * *\n"


GRAINS = grains(0.4)
BONDS = f"bond_style solidem/beam\nbond_coeff 1 {YOUNG} 27e9 radius 0.4e-3 "


def overlapping_pair(overlap: float, speed: float, sideways: float = 0.0) -> Body:
    """Two bonded spheres that overlap and leave each other along x."""
    gap = 2 * RADIUS - overlap
    velocity = np.zeros((2, 6))
    velocity[:, 0] = [-speed / 2, speed / 2]
    velocity[:, 1] = [-sideways / 2, sideways / 2]
    return Body(np.array([[0, 0, 0], [gap, 0, 0]]), np.full(2, RADIUS), np.array([[0, 1]]),
                np.full(3, -10e-3), np.full(3, 12e-3), velocity=velocity)


def run(liggghts: Liggghts, folder: Path, body: Body, pair: str, coefficients: str, steps: int,
        options: str = "", every: int = 1, extra: str = "", ranks: int = 1,
        last: str = "") -> dict[int, np.ndarray]:
    """Frames of position, force and torque by step."""
    folder.mkdir(exist_ok=True)
    body.write(folder / "body.data")
    script = HEADER + (
        f"boundary f f f\nnewton off\nread_data body.data\nneighbor 0.2e-3 bin\n"
        f"neigh_modify delay 0\n{pair}{BONDS}{coefficients}\n"
        f"fix bonds all solidem/bonds {options}\nfix motion all nve/solidem\n{extra}"
        "timestep 1e-8\n"
    )
    script += dump("atoms", every, "x", "y", "z", "fx", "fy", "fz", "tqx", "tqy", "tqz")
    liggghts.run(folder, script + f"{last or f'run {steps}'}\n", ranks)
    return read_dump(folder / "atoms.txt")


def gap(frame: np.ndarray) -> float:
    return float(np.linalg.norm(frame[1, :3] - frame[0, :3]))


def test_while_a_bond_holds_its_overlapping_atoms_feel_nothing_else(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """To the last digit, through rebuilds of the lists, whatever the two do."""
    body = overlapping_pair(0.05e-3, 1.0, sideways=2.0)
    both = run(liggghts, tmp_path / "both", body, GRAINS, "", 400)
    bond = run(liggghts, tmp_path / "bond", body, "pair_style none\n", "", 400)
    for step, frame in bond.items():
        assert (both[step] == frame).all()
    assert min(map(gap, bond.values())) < 2 * RADIUS - 0.05e-3
    asked_for = run(liggghts, tmp_path / "asked", body, GRAINS, "", 1, "bonded_contacts yes")
    push = asked_for[0][1, 3] - bond[0][1, 3]
    assert push == pytest.approx(CONTACT_STIFFNESS * 0.05e-3, rel=1e-12)


@pytest.mark.parametrize("split", ["run 20\nrun 0\nrun 130\nrun 0\nrun 250", "run 400",
                                   "run 150\nrun 250 pre no"])
def test_in_the_step_after_rupture_the_push_is_that_of_the_contact(
    liggghts: Liggghts, tmp_path: Path, split: str
) -> None:
    """The pair still overlaps when its bond breaks: exactly the bond's force before, exactly the
    contact's after, to which no rebuild of the lists has to lead."""
    body = overlapping_pair(0.1e-3, 40.0)
    frames = run(liggghts, tmp_path, body, GRAINS, "rupture_strain 0.005", 400, last=split)
    rest = 2 * RADIUS - 0.1e-3
    stiffness = YOUNG * np.pi * 0.4e-3**2 / rest
    broken = False
    pushed = 0
    for _, frame in sorted(frames.items()):
        length = gap(frame)
        pull = stiffness * (length - rest)
        push = CONTACT_STIFFNESS * max(0.0, 2 * RADIUS - length)
        force = push if broken else -pull
        assert frame[1, 3] == pytest.approx(force, rel=1e-9, abs=1e-9 * stiffness * rest)
        assert (frame[:, 3:6].sum(axis=0) == 0).all()
        pushed += broken and push > 0
        broken = broken or length > rest * 1.005
    assert broken and pushed > 50


def test_a_bond_with_contact_keeps_its_atoms_until_their_spheres_are_apart(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """Broken while they overlap they are not thrown apart; later on they are like any other two."""
    body = overlapping_pair(0.1e-3, 40.0)
    wall = (f"fix wall all wall/gran model hooke/stiffness tangential history primitive type 1 "
            "xplane {}\n")
    extra = wall.format(-2e-3) + wall.replace("wall all", "wall2 all").format(4e-3)
    frames = run(liggghts, tmp_path, body, GRAINS, "rupture_strain 0.005 contact 1", 60000,
                 extra=extra, every=5)
    lengths = np.array([gap(frame) for _, frame in sorted(frames.items())])
    forces = np.array([frame[1, 3] for _, frame in sorted(frames.items())])
    broke = int(np.argmax(lengths > 1.005 * lengths[0]))
    parted = int(np.argmax(lengths > 2 * RADIUS))
    assert 0 < broke < parted - 10
    assert (forces[broke + 1:parted] == 0).all()
    meet = parted + int(np.argmax(lengths[parted:] < 2 * RADIUS))
    assert meet > parted, "the walls send them back"
    push = CONTACT_STIFFNESS * (2 * RADIUS - lengths[meet])
    assert forces[meet] == pytest.approx(push, rel=1e-9)


def dropped_block(speed: float) -> Body:
    """A bonded block above a wall at z = 0, falling, shaken so that it breaks inside."""
    body = simple_cubic((4, 4, 4), RADIUS)
    body.position = body.position + [0, 0, 0.02e-3]
    body.velocity = np.zeros((len(body.position), 6))
    body.velocity[:, :3] = np.random.default_rng(1).normal(scale=8.0, size=(64, 3))
    body.velocity[:, 2] -= speed
    return body


FLOOR = ("fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 "
         "zplane 0.0\nfix weight all gravity 9.81 vector 0 0 -1\n")


def drop(liggghts: Liggghts, folder: Path, pair: str, steps: int, ranks: int = 1,
         rupture: str = "rupture_strain 0.004", speed: float = 20.0) -> tuple[np.ndarray, dict[int, np.ndarray]]:
    """Rows of thermo (step, energies of motion and bonds, taken by rupture, broken bonds) and frames
    of the block that falls on the floor."""
    folder.mkdir(exist_ok=True)
    body = dropped_block(speed)
    body.write(folder / "body.data")
    script = HEADER + (
        "boundary f f f\nnewton off\n" + ("processors 2 * *\n" if ranks > 1 else "") +
        "read_data body.data\nneighbor 0.3e-3 bin\nneigh_modify delay 0\n" + pair + BONDS + rupture +
        "\nfix bonds all solidem/bonds\nfix motion all nve/solidem\n" + FLOOR +
        "timestep 2e-8\ncompute elastic all pe bond\ncompute spin all erotate/sphere\n"
        "compute links all solidem/bond id1 id2 state\n"
        "dump links all local 50 links.txt c_links[1] c_links[2] c_links[3]\n"
        "thermo_style custom step ke c_spin c_elastic f_bonds[2] f_bonds[3]\nthermo 50\n"
        "thermo_modify format float %.17g norm no lost error\n"
        + dump("atoms", 50, "x", "y", "z", "vx", "vy", "vz")
    )
    said = liggghts.run(folder, script + f"run {steps}\n", ranks)
    return thermo(said), read_dump(folder / "atoms.txt")


def bonded_pairs(path: Path) -> dict[int, set[tuple[int, int]]]:
    """By step, the pairs that were whole."""
    frames: dict[int, set[tuple[int, int]]] = {}
    lines = path.read_text().splitlines()
    step = 0
    for n, line in enumerate(lines):
        if line == "ITEM: TIMESTEP":
            step = int(lines[n + 1])
            frames[step] = set()
        words = line.split()
        if len(words) == 3 and words[0].replace(".", "").isdigit() and float(words[2]) == 0:
            low, high = sorted(int(float(word)) - 1 for word in words[:2])
            frames[step].add((low, high))
    return frames


def contact_energy(position: np.ndarray, bonded: set[tuple[int, int]]) -> float:
    """Of all touching pairs that are not bonded, and of the floor."""
    low, high = np.triu_indices(len(position), 1)
    overlap = 2 * RADIUS - np.linalg.norm(position[high] - position[low], axis=1)
    free = np.array([(i, j) not in bonded for i, j in zip(low, high)])
    floor = np.maximum(0, RADIUS - position[:, 2])
    return 0.5 * CONTACT_STIFFNESS * float(
        (np.maximum(0, overlap[free]) ** 2).sum() + (floor**2).sum())


def test_a_block_that_breaks_on_the_floor_keeps_its_energy(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """Motion, bonds, contacts, weight and what rupture took: nothing else has any, with contacts
    that neither rub nor dissipate and bonds that break in tension, when the spheres are apart."""
    in_tension = "rupture mohr-coulomb tensile_strain 0.003 cohesion_strain 10 friction_coefficient 0"
    rows, frames = drop(liggghts, tmp_path, grains(0.0), 2500, rupture=in_tension, speed=20.0)
    whole = bonded_pairs(tmp_path / "links.txt")
    mass = 2790 * 4 / 3 * np.pi * RADIUS**3
    total = []
    for step, motion, spin, elastic, fracture, _ in rows:
        position = frames[int(step)][:, :3]
        height = mass * 9.81 * position[:, 2].sum()
        total.append(motion + spin + elastic + fracture + height
                     + contact_energy(position, whole[int(step)]))
    total = np.array(total)
    assert rows[-1, 5] > 20, "the block breaks"
    assert rows[:, 5].max() < 144
    assert total == pytest.approx(total[0], rel=2e-3)


def test_ranks_agree_while_a_block_breaks_among_its_grains(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    one = drop(liggghts, tmp_path / "one", GRAINS, 1200)
    for ranks in (2, 4):
        many = drop(liggghts, tmp_path / f"ranks{ranks}", GRAINS, 1200, ranks)
        assert (many[0][:, 5] == one[0][:, 5]).all() and one[0][-1, 5] > 5
        for step, frame in one[1].items():
            assert many[1][step][:, :3] == pytest.approx(frame[:, :3], rel=1e-9, abs=1e-12)


def test_a_bond_that_one_rank_alone_knows_is_refused_beside_contacts(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    overlapping_pair(0.1e-3, 1.0).write(tmp_path / "body.data")
    script = HEADER + ("boundary f f f\nnewton off on\nread_data body.data\nneighbor 0.2e-3 bin\n"
                       + GRAINS + BONDS + "\nfix bonds all solidem/bonds {}\n"
                       "fix motion all nve/solidem\ntimestep 1e-8\nrun 2\n")
    with pytest.raises(AssertionError) as refusal:
        liggghts.run(tmp_path, script.format(""))
    assert "newton_bond must be off" in str(refusal.value)
    liggghts.run(tmp_path, script.format("bonded_contacts yes"))


def test_the_page_and_its_example_run(
    liggghts: Liggghts, prebuilt: dict[str, Path], tmp_path: Path
) -> None:
    page = (CONTRIB / "bonds_and_grains.md").read_text()
    blocks = re.findall(r"```\n(.*?)```", page, re.S)
    body = simple_cubic((3, 3, 3), RADIUS)
    body.write(tmp_path / "block.data")
    text = (tmp_path / "block.data").read_text()
    (tmp_path / "block.data").write_text(
        text.replace("1 bond types\n", "1 bond types\n12 extra bond per atom\n"))
    glue = blocks[1].replace("step 20000", "step 100")
    liggghts.run(tmp_path, blocks[0].replace("run             1000\n", glue + "run 200\n"))
    done = subprocess.run([CONTRIB / "examples" / "bonds_and_grains" / "runscript"],
                          env={**os.environ, "LIGGGHTS": str(prebuilt["program"])},
                          capture_output=True, text=True, timeout=900)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    assert "limit" in done.stdout
