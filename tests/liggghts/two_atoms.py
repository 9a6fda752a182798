# SPDX-License-Identifier: GPL-2.0-or-later
"""Two spheres and a bond, led through poses: by the bond style, and by the laws themselves."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from liggghts_runs import CONTRIB, HEADER, Body, Liggghts, dump, numbers, read_dump

LAWS = CONTRIB.parents[1] / "standalone"
YOUNG, SHEAR, KAPPA = 3.5e12, 1.3e12, 0.85
RADII = np.array([1.0e-3, 1.2e-3])
BEAM_RADIUS = 0.3e-3
AREA = np.pi * BEAM_RADIUS**2
START = np.array([[0.3e-3, -0.2e-3, 0.1e-3], [1.6e-3, 1.2e-3, 0.9e-3]])
LENGTH = float(np.linalg.norm(START[1] - START[0]))
DIRECTION = (START[1] - START[0]) / LENGTH
AXIAL_STIFFNESS = YOUNG * AREA / LENGTH
COEFFICIENTS = f"{YOUNG} {SHEAR} radius {BEAM_RADIUS}"
UNTURNED = np.array([1.0, 0.0, 0.0, 0.0])
FIGURES = ("stress", "plastic_strain", "energy", "plastic_work", "state", "length", "force")


@dataclass
class Pose:
    """Both atoms: (2, 3) positions, m, and (2, 4) orientations w x y z."""

    position: np.ndarray
    orientation: np.ndarray


@dataclass
class Course:
    """What a bond does along a path: a row for each pose."""

    loads: np.ndarray  # (P, 12) forces on atom 1 and 2, moments on atom 1 and 2
    figures: dict[str, np.ndarray]  # of `compute solidem/bond`, by name
    totals: np.ndarray  # (P, 7) of `fix solidem/bonds`
    broken: np.ndarray  # (P, 2) bonds that either atom lost


def stretched(*extensions: float) -> list[Pose]:
    """Poses of a bond that changes its length only, by these shares of it."""
    return [Pose(START + np.array([[0.0], [e * LENGTH]]) * DIRECTION, np.tile(UNTURNED, (2, 1)))
            for e in extensions]


def quaternion(rotation: np.ndarray) -> np.ndarray:
    """w, x, y, z of a rotation vector."""
    angle = float(np.linalg.norm(rotation))
    return np.concatenate([[np.cos(angle / 2)], 0.5 * np.sinc(angle / 2 / np.pi) * rotation])


def wandering(count: int, amplitude: float, seed: int = 1) -> list[Pose]:
    """Poses on smooth loops through every mode, out to an amplitude and back several times."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(4, 3, 3))
    poses = []
    for t in np.linspace(0, 1, count + 1)[1:]:
        waves = np.array([np.sin(2 * np.pi * t), np.sin(6 * np.pi * t + 1) - np.sin(1),
                          t * np.cos(10 * np.pi * t)])
        motion = amplitude * np.einsum("eak,k->ea", directions, waves)
        poses.append(Pose(START + LENGTH * motion[:2],
                          np.array([quaternion(r) for r in motion[2:]])))
    return poses


def by_the_style(liggghts: Liggghts, folder: Path, coefficients: str, poses: list[Pose],
                 one_step: bool = False, options: str = "", start: np.ndarray = START,
                 looks: int = 1) -> Course:
    """The bond led by `set` and `run 0`, in each pose at step 0; or, with `one_step`, in each pose
    at a step of its own. `looks`: runs, and rows, for each pose."""
    box = np.full(3, 20e-3)
    Body(start, RADII, np.array([[0, 1]]), -box, box).write(folder / "body.data")
    totals = " ".join(f"f_bonds[{k}]" for k in range(1, 8))
    script = HEADER + (
        "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
        f"bond_style solidem/beam\nbond_coeff 1 {coefficients}\n"
        f"fix bonds all solidem/bonds {options}\n"
        f"compute bond all solidem/bond {' '.join(FIGURES)}\n"
        "compute broken all solidem/broken/atom\n"
        f"thermo_style custom step atoms {totals}\nthermo_modify format float %.17g norm no\n"
        "timestep 1e-9\nrun 0\n"
    )
    names = []
    for k, pose in enumerate(poses):
        for atom in (0, 1):
            script += "set atom {} x {:.17g} y {:.17g} z {:.17g}\n".format(
                atom + 1, *pose.position[atom])
            script += f"set atom {atom + 1} property/atom orientation "
            script += numbers(pose.orientation[atom]) + "\n"
        script += f"reset_timestep {k + 1}\n" if one_step else ""
        for look in range(looks):
            names.append(f"{k}_{look}")
            script += dump(f"atoms{k}_{look}", 1, "fx", "fy", "fz", "tqx", "tqy", "tqz", "c_broken")
            columns = " ".join(f"c_bond[{n + 1}]" for n in range(len(FIGURES)))
            script += f"dump bond all local 1 bond{k}_{look}.txt {columns}\n"
            script += f'dump_modify bond format "{" ".join(["%.17g"] * len(FIGURES))}"\n'
            script += f"run 0\nundump atoms{k}_{look}\nundump bond\n"
    said = liggghts.run(folder, script)
    words = [line.split() for line in said.splitlines()]
    rows = [row[2:] for row in words if len(row) == 9 and row[0].isdigit() and row[1] == "2"]
    atoms = [list(read_dump(folder / f"atoms{name}.txt").values())[-1] for name in names]
    table = np.array([last_row(folder / f"bond{name}.txt") for name in names])
    return Course(
        np.array([np.concatenate([a[0, :3], a[1, :3], a[0, 3:6], a[1, 3:6]]) for a in atoms]),
        {name: table[:, n] for n, name in enumerate(FIGURES)},
        np.array(rows[1:], dtype=float),
        np.array([a[:, 6] for a in atoms]),
    )


def last_row(file: Path) -> list[float]:
    """The last bond that was dumped; not numbers where there is none."""
    row = file.read_text().splitlines()[-1]
    if row.startswith("ITEM"):
        return [np.nan] * len(FIGURES)
    return [float(word) for word in row.split()]


def by_the_laws(program: Path, poses: list[Pose], law: str, plasticity: str = "radial-return",
                hardening: str = "linear", **parameters: float) -> Course:
    """The same by tests/liggghts/bond_path.cpp."""
    made = Pose(START, np.tile(UNTURNED, (2, 1)))
    lines = [f"{numbers(p.position[k])} {numbers(p.orientation[k])}"
             for p in [made, *poses] for k in (0, 1)]
    parameters = parameters or {"yield_strain": 1e300}
    words = [law, BEAM_RADIUS, KAPPA, YOUNG, SHEAR, plasticity, hardening]
    words += [word for pair in parameters.items() for word in pair]
    done = subprocess.run([program, *map(str, words)], input="\n".join(lines), text=True,
                          capture_output=True, check=True)
    rows = np.array([line.split() for line in done.stdout.splitlines()], dtype=float)
    loads = np.concatenate([rows[:, :3], -rows[:, :3], rows[:, 3:9]], axis=1)
    figures = {"stress": YOUNG * rows[:, 9], "plastic_strain": rows[:, 10],
               "energy": rows[:, 11], "plastic_work": rows[:, 12]}
    return Course(loads, figures, np.empty(0), np.empty(0))
