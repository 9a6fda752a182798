# SPDX-License-Identifier: GPL-2.0-or-later
"""Two spheres and a beam, every pose prescribed: loads and energy against the stiffness matrix."""

from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import HEADER, Body, Liggghts, dump, numbers, read_dump, thermo

YOUNG, SHEAR = 3.5e12, 1.3e12
RADII = np.array([1.0e-3, 1.2e-3])
RATIO = 0.3
BEAM_RADIUS = RATIO * RADII.mean()
AREA = np.pi * BEAM_RADIUS**2
SECOND_MOMENT = np.pi * BEAM_RADIUS**4 / 4
START = np.array([[0.3e-3, -0.2e-3, 0.1e-3], [1.6e-3, 1.2e-3, 0.9e-3]])
LENGTH = np.linalg.norm(START[1] - START[0])
AXIAL = YOUNG * AREA / LENGTH
BENDING = 2 * YOUNG * SECOND_MOMENT / LENGTH
TORSION = SHEAR * 2 * SECOND_MOMENT / LENGTH


def frame(start: np.ndarray) -> np.ndarray:
    """Rows: beam axis from atom 1 to atom 2, and two directions across."""
    x = (start[1] - start[0]) / np.linalg.norm(start[1] - start[0])
    y = np.cross([0.0, 0.0, 1.0], x)
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def stiffness_times(motion: np.ndarray) -> np.ndarray:
    """The linear Euler-Bernoulli beam: end loads (F1, F2, M1, M2) of displacements and rotations
    (u1, u2, t1, t2), each (4, 3) in the beam's frame."""
    u1, u2, t1, t2 = motion
    chord = np.array([0.0, -(u2 - u1)[2], (u2 - u1)[1]]) / LENGTH
    a, b = t1 - chord, t2 - chord
    force = np.array(
        [
            AXIAL * (u2 - u1)[0],
            -3 * BENDING / LENGTH * (a[2] + b[2]),
            3 * BENDING / LENGTH * (a[1] + b[1]),
        ]
    )
    twist = TORSION * (t2 - t1)[0]
    moment1 = np.array([twist, -BENDING * (2 * a[1] + b[1]), -BENDING * (2 * a[2] + b[2])])
    moment2 = np.array([-twist, -BENDING * (a[1] + 2 * b[1]), -BENDING * (a[2] + 2 * b[2])])
    return np.array([force, -force, moment1, moment2])


def quaternion(rotation: np.ndarray) -> np.ndarray:
    """w, x, y, z of a rotation vector."""
    angle = np.linalg.norm(rotation)
    if angle == 0.0:
        return np.array([1.0, 0.0, 0.0, 0.0])
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * rotation / angle])


def rotate(rotation: np.ndarray, vector: np.ndarray) -> np.ndarray:
    q = quaternion(rotation)
    t = 2 * np.cross(q[1:], vector)
    return vector + q[0] * t + np.cross(q[1:], t)


def loads_in_poses(
    liggghts: Liggghts,
    folder: Path,
    poses: list[tuple[np.ndarray, np.ndarray]],
    start: np.ndarray = START,
    radii: np.ndarray = RADII,
    pair: tuple[int, int] = (0, 1),
    section: str = f"pair {RATIO}",
) -> tuple[np.ndarray, np.ndarray]:
    """Loads (F1, F2, M1, M2) and elastic energy when both atoms are put to positions and turned by
    rotation vectors from the stress-free start: (poses, 4, 3), (poses)."""
    box = np.full(3, 20e-3)
    Body(start, radii, np.array([pair]), -box, box).write(folder / "body.data")
    script = HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
        f"bond_style solidem/beam\nbond_coeff 1 {YOUNG} {SHEAR} {section}\n"
        "fix bonds all solidem/bonds\ncompute energy all pe bond\n"
        "thermo_style custom step atoms c_energy\nthermo_modify format float %.17g norm no\nrun 0\n"
    )
    for k, (position, rotation) in enumerate(poses):
        for atom in (0, 1):
            x, y, z = (f"{value:.17g}" for value in position[atom])
            script += f"set atom {atom + 1} x {x} y {y} z {z}\n"
            script += f"set atom {atom + 1} property/atom orientation "
            script += numbers(quaternion(rotation[atom])) + "\n"
        script += dump(f"pose{k}", 1, "fx", "fy", "fz", "tqx", "tqy", "tqz")
        script += f"run 0\nundump pose{k}\n"
    said = liggghts.run(folder, script)
    rows = [line.split() for line in said.splitlines() if line.split()[:2] == ["0", "2"]]
    energies = [float(row[2]) for row in rows]
    frames = [read_dump(folder / f"pose{k}.txt")[0] for k in range(len(poses))]
    loads = [np.array([f[0, :3], f[1, :3], f[0, 3:], f[1, 3:]]) for f in frames]
    return np.array(loads), np.array(energies[1:])


def extrapolated(values: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    """The limit at amplitude 0 of values with a series in amplitude squared."""
    squares = amplitudes**2
    limit = np.zeros_like(values[0])
    for k, value in enumerate(values):
        others = np.delete(squares, k)
        limit = limit + value * np.prod(others / (others - squares[k]))
    return limit


AMPLITUDES = np.array([0.005, 0.01, 0.02, 0.04])
MODES = {
    "tension": [[0, 0, 0], [1, 0, 0], [0, 0, 0], [0, 0, 0]],
    "shear y": [[0, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0]],
    "shear z": [[0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]],
    "bending of one end": [[0, 0, 0], [0, 0, 0], [0, 1, 0], [0, 0, 0]],
    "bending of the other end": [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 1]],
    "pure bending": [[0, 0, 0], [0, 0, 0], [0, 0, 1], [0, 0, -1]],
    "torsion": [[0, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]],
    "combined": [[0.3, -0.2, 0.5], [-0.4, 0.6, 0.1], [0.7, -0.3, 0.2], [-0.1, 0.4, -0.6]],
}


@pytest.mark.parametrize("mode", MODES)
def test_small_motion_is_the_stiffness_matrix(
    liggghts: Liggghts, tmp_path: Path, mode: str
) -> None:
    motion = np.array(MODES[mode], dtype=float)  # displacements in rest lengths, rotations in rad
    axes = frame(START)
    poses = []
    for amplitude in AMPLITUDES:
        for sign in (1, -1):
            world = sign * amplitude * motion @ axes
            poses.append((START + LENGTH * world[:2], world[2:]))
    loads, energies = loads_in_poses(liggghts, tmp_path, poses)

    slopes = (loads[0::2] - loads[1::2]) / (2 * AMPLITUDES[:, None, None])
    measured = extrapolated(slopes, AMPLITUDES) @ axes.T
    scaled = motion * np.array([[LENGTH], [LENGTH], [1], [1]])
    expected = stiffness_times(scaled)
    scale = np.abs(expected / np.array([[1], [1], [LENGTH], [LENGTH]])).max()
    error = np.abs(measured - expected) / np.array([[1], [1], [LENGTH], [LENGTH]]) / scale
    print(f"{mode}: largest error of the loads {error.max():.1e}")
    assert error.max() <= 1e-12

    curvature = (energies[0::2] + energies[1::2]) / (2 * AMPLITUDES**2)
    stored = extrapolated(curvature, AMPLITUDES)
    expected_energy = -0.5 * (scaled * expected).sum()
    print(f"{mode}: error of the energy {abs(stored / expected_energy - 1):.1e}")
    assert stored == pytest.approx(expected_energy, rel=1e-11)


def test_rigid_rotation_gives_no_load(liggghts: Liggghts, tmp_path: Path) -> None:
    random = np.random.default_rng(7)
    poses = []
    for angle in (0.1, 1.0, 2.0, 3.0):
        axis = random.normal(size=3)
        rotation = angle * axis / np.linalg.norm(axis)
        turned = np.array([rotate(rotation, x) for x in START]) + random.normal(size=3) * 1e-3
        poses.append((turned, np.array([rotation, rotation])))
    loads, energies = loads_in_poses(liggghts, tmp_path, poses)
    scale = YOUNG * AREA * np.array([[1], [1], [LENGTH], [LENGTH]])
    print(f"largest load after a rigid motion: {np.abs(loads / scale).max():.1e} E S")
    assert np.abs(loads / scale).max() <= 1e-12
    assert np.abs(energies).max() <= 1e-24 * YOUNG * AREA * LENGTH


def test_order_of_the_atoms_does_not_matter(liggghts: Liggghts, tmp_path: Path) -> None:
    random = np.random.default_rng(3)
    position = START + 0.05 * LENGTH * random.normal(size=(2, 3))
    rotation = 0.2 * random.normal(size=(2, 3))
    folders = [tmp_path / name for name in ("as_is", "bond_listed_backwards", "atoms_renumbered")]
    for folder in folders:
        folder.mkdir()
    loads, _ = loads_in_poses(liggghts, folders[0], [(position, rotation)])
    backwards, _ = loads_in_poses(liggghts, folders[1], [(position, rotation)], pair=(1, 0))
    renumbered, _ = loads_in_poses(
        liggghts, folders[2], [(position[::-1], rotation[::-1])], START[::-1], RADII[::-1]
    )
    assert (backwards == loads).all()
    scale = YOUNG * AREA * np.array([[1], [1], [LENGTH], [LENGTH]])
    assert np.abs((renumbered[0][[1, 0, 3, 2]] - loads[0]) / scale).max() <= 1e-15


def test_fixed_radius_equals_the_same_radius_from_the_pair(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    position = START + np.array([[0, 0, 0], [1e-5, 2e-5, -1e-5]])
    rotation = np.array([[0.01, 0, 0], [0, 0.02, 0]])
    loads, _ = loads_in_poses(liggghts, tmp_path, [(position, rotation)])
    fixed, _ = loads_in_poses(
        liggghts, tmp_path, [(position, rotation)], section=f"radius {BEAM_RADIUS:.17g}"
    )
    assert np.abs(fixed - loads).max() <= 1e-14 * np.abs(loads).max()


def test_virial_is_that_of_the_forces(liggghts: Liggghts, tmp_path: Path) -> None:
    box = np.full(3, 20e-3)
    Body(START, RADII, np.array([[0, 1]]), -box, box).write(tmp_path / "body.data")
    script = HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
        f"bond_style solidem/beam\nbond_coeff 1 {YOUNG} {SHEAR} pair {RATIO}\n"
        "fix bonds all solidem/bonds\ncompute p all pressure thermo_temp virial\n"
        "thermo_style custom step atoms vol c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6]\n"
        "thermo_modify format float %.17g norm no\nrun 0\n"
        "set atom 2 x 1.7e-3 y 1.0e-3\n"
        + dump("pose", 1, "x", "y", "z", "fx", "fy", "fz")
        + "run 0\n"
    )
    row = thermo(liggghts.run(tmp_path, script))[0]
    frame0 = read_dump(tmp_path / "pose.txt")[0]
    virial = np.einsum("ia,ib->ab", frame0[:, :3], frame0[:, 3:])
    virial = 0.5 * (virial + virial.T)
    expected = virial[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    assert np.abs(row[2] * row[3:] - expected).max() <= 1e-12 * np.abs(expected).max()
