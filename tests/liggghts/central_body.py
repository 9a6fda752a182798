# SPDX-License-Identifier: GPL-2.0-or-later
"""Spheres under pair_style solidem/central: scripts, a body that rearranges, the laws."""

import subprocess
from pathlib import Path

import numpy as np

from liggghts_runs import CONTRIB, Body, Liggghts, dump, read_dump

STANDALONE = CONTRIB.parents[1] / "standalone"
RADIUS = 0.5e-3
#: One set of parameters for each law, of like stiffness: about 1e6 N/m at 1 mm.
LAWS = {
    "piecewise": {"stiffness": 1e6, "attraction": 25.0},
    "lennard-jones": {"energy": 0.0139},
    "shifted-lennard-jones": {"attraction": 25.0, "peak_separation": 1.15},
    "mie": {"energy": 0.03125, "repulsive_exponent": 8, "attractive_exponent": 4},
    "threshold": {
        "energy": 0.03125, "repulsive_exponent": 8, "attractive_exponent": 4,
        "beyond_energy": 0.002, "beyond_repulsive_exponent": 6, "beyond_attractive_exponent": 3,
        "threshold_strain": 0.01,
    },
}
COLUMNS = ["x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz"]
HEAD = """units si
atom_style granular
atom_modify map array sort 0 0
communicate single vel yes
"""


def words(law: str) -> str:
    """Name and parameters of a law, as pair_style wants them."""
    return " ".join([law, *(f"{name} {value:.17g}" for name, value in LAWS[law].items())])


def write(body: Body, path: Path) -> None:
    """A data file of atom style `granular`."""
    lines = ["body", "", f"{len(body.position)} atoms", "1 atom types", ""]
    lines += [f"{low:.17g} {high:.17g} {axis}lo {axis}hi"
              for axis, low, high in zip("xyz", body.lower, body.upper)]
    lines += ["", "Atoms", ""]
    for k, (x, r) in enumerate(zip(body.position, body.radius), 1):
        place = " ".join(f"{value:.17g}" for value in x)
        lines.append(f"{k} 1 {2 * r:.17g} {body.density:.17g} {place}")
    if body.velocity is not None:
        lines += ["", "Velocities", ""]
        lines += [f"{k} " + " ".join(f"{value:.17g}" for value in v)
                  for k, v in enumerate(body.velocity, 1)]
    path.write_text("\n".join(lines) + "\n")


def beginning(pair: str, boundary: str = "f f f", newton: str = "off", skin: float = 0.1e-3) -> str:
    """A script up to its integrator and first run; `pair`: what follows the style's name."""
    return HEAD + (
        f"boundary {boundary}\nnewton {newton}\nread_data body.data\nneighbor {skin:.17g} bin\n"
        f"neigh_modify every 1 delay 0 check yes\npair_style solidem/central {pair}\n"
        "pair_coeff * *\n"
    )


def by_the_law(program: Path, law: str, interpenetration: float, rows: np.ndarray) -> np.ndarray:
    """(n, 2) forces and potentials of (n, 3) distances, equilibria and ranges."""
    lines = "\n".join(" ".join(f"{value:.17g}" for value in row) for row in rows)
    done = subprocess.run([program, str(interpenetration), *words(law).split()], input=lines,
                          text=True, capture_output=True, check=True)
    return np.array([line.split() for line in done.stdout.splitlines()], dtype=float)


def shaken_block(cells: tuple[int, int, int] = (7, 4, 4), seed: int = 3) -> Body:
    """A face-centred block of spheres of unlike radii, torn apart along x while it flies: within a
    hundred steps neighbours part and meet, and atoms change processor."""
    corner = np.stack(np.meshgrid(*map(np.arange, cells), indexing="ij"), -1).reshape(-1, 3)
    basis = np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])
    position = (corner[:, None] + basis).reshape(-1, 3) * 2 * np.sqrt(2) * RADIUS
    random = np.random.default_rng(seed)
    position += 0.02 * RADIUS * random.normal(size=position.shape)
    size = position.max(axis=0)
    velocity = np.zeros((len(position), 6))
    velocity[:, :3] = random.normal(scale=40.0, size=position.shape) + [100.0, 60.0, -40.0]
    velocity[:, 0] += 1500.0 * (position[:, 0] / size[0] - 0.5) * (position[:, 1] / size[1])
    margin = 6e-3
    return Body(position, RADIUS * random.uniform(0.9, 1.1, len(position)), np.empty((0, 2)),
                np.full(3, -margin), size + margin, velocity=velocity)


def last_state(liggghts: Liggghts, folder: Path, script: str, ranks: int = 1) -> np.ndarray:
    """Runs a script that dumps `state`; the rows of the last frame."""
    folder.mkdir(exist_ok=True)
    liggghts.run(folder, script, ranks)
    return list(read_dump(folder / "state.txt").values())[-1]


def state(every: int, *more: str) -> str:
    return dump("state", every, *COLUMNS, *more)


def largest_difference(a: np.ndarray, b: np.ndarray) -> float:
    """Largest difference of two states, each quantity over its largest value."""
    scale = np.repeat([np.abs(a[:, k:k + 3]).max() for k in (0, 3, 6)], 3)
    return float((np.abs(a - b)[:, :9] / scale).max())
