# SPDX-License-Identifier: GPL-2.0-or-later
"""Data files, runs and dumps of LIGGGHTS for tests."""

import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest
from compare.codes.open_mpi import ONE_MACHINE, one_process

CONTRIB = Path(__file__).resolve().parents[2] / "contrib" / "liggghts"

HEADER = """units           si
atom_style      hybrid granular molecular
atom_modify     map array sort 0 0
communicate     single vel yes
special_bonds   lj/coul 1 1 1
"""


def built_paths(script: str, *arguments: str) -> dict[str, Path]:
    """What a build script of contrib/liggghts says it built."""
    done = subprocess.run(
        [CONTRIB / script, *arguments], capture_output=True, text=True, timeout=7200
    )
    if done.returncode != 0:
        pytest.fail(f"contrib/liggghts/{script} failed:\n{done.stderr[-3000:]}", pytrace=False)
    return {
        name: Path(path) for name, path in (line.split(" ", 1) for line in done.stdout.splitlines())
    }


@dataclass
class Body:
    """Spheres and bonds; atom k of LIGGGHTS is row k-1."""

    position: np.ndarray  # (N, 3) m
    radius: np.ndarray  # (N) m
    pairs: np.ndarray  # (B, 2) zero-based
    lower: np.ndarray  # (3) corner of LIGGGHTS' box
    upper: np.ndarray
    density: float = 2790.0
    velocity: np.ndarray | None = field(default=None)  # (N, 6) m/s and rad/s

    def write(self, path: Path) -> None:
        """A data file of atom style `hybrid granular molecular`."""
        lines = ["body", "", f"{len(self.position)} atoms", f"{len(self.pairs)} bonds"]
        lines += ["1 atom types", "1 bond types", ""]
        for axis, low, high in zip("xyz", self.lower, self.upper):
            lines.append(f"{low:.17g} {high:.17g} {axis}lo {axis}hi")
        lines += ["", "Atoms", ""]
        for k, (x, r) in enumerate(zip(self.position, self.radius), 1):
            lines.append(f"{k} 1 {numbers(x)} {2 * r:.17g} {self.density:.17g} 1")
        if self.velocity is not None:
            lines += ["", "Velocities", ""]
            lines += [f"{k} {numbers(v)}" for k, v in enumerate(self.velocity, 1)]
        lines += ["", "Bonds", ""]
        lines += [f"{k} 1 {i + 1} {j + 1}" for k, (i, j) in enumerate(self.pairs, 1)]
        path.write_text("\n".join(lines) + "\n")


def numbers(values: np.ndarray) -> str:
    return " ".join(f"{value:.17g}" for value in np.atleast_1d(values))


def simple_cubic(cells: tuple[int, int, int], radius: float, periodic: bool = False) -> Body:
    """Touching equal spheres on a simple cubic lattice, bonded to their nearest neighbours."""
    index = np.stack(np.meshgrid(*map(np.arange, cells), indexing="ij"), axis=-1).reshape(-1, 3)
    pairs = []
    for axis in range(3):
        neighbour = index.copy()
        neighbour[:, axis] += 1
        keep = np.full(len(index), True) if periodic else neighbour[:, axis] < cells[axis]
        neighbour[:, axis] %= cells[axis]
        flat = np.ravel_multi_index(neighbour.T, cells)
        pairs.append(np.stack([np.arange(len(index))[keep], flat[keep]], axis=1))
    position = 2 * radius * (index + 0.5)
    size = 2 * radius * np.array(cells, dtype=float)
    margin = 0.0 if periodic else 10 * radius
    return Body(
        position=position,
        radius=np.full(len(index), radius),
        pairs=np.concatenate(pairs),
        lower=np.full(3, -margin),
        upper=size + margin,
    )


def dump(name: str, every: int, *columns: str) -> str:
    """Script lines that dump these columns of all atoms, by id, with all digits."""
    formats = " ".join(["%d"] + ["%.17g"] * len(columns))
    return (
        f"dump {name} all custom {every} {name}.txt id {' '.join(columns)}\n"
        f'dump_modify {name} sort id format "{formats}"\n'
    )


def read_dump(path: Path) -> dict[int, np.ndarray]:
    """Frames by time step: rows by id, the columns after the id."""
    frames = {}
    lines = path.read_text().splitlines()
    at = 0
    while at < len(lines):
        assert lines[at] == "ITEM: TIMESTEP", f"{path}:{at + 1}: no frame starts here"
        step, count = int(lines[at + 1]), int(lines[at + 3])
        rows = np.array([line.split() for line in lines[at + 9 : at + 9 + count]], dtype=float)
        assert (rows[:, 0] == np.arange(1, count + 1)).all(), f"{path}: atoms are missing"
        frames[step] = rows[:, 1:]
        at += 9 + count
    return frames


@dataclass
class Liggghts:
    """A LIGGGHTS program and how to start it."""

    program: Path | str
    environment: dict[str, str] = field(default_factory=dict)

    def run(self, folder: Path, script: str, ranks: int = 1) -> str:
        """Runs a script in a folder; what LIGGGHTS printed. A failing run fails the test."""
        (folder / "in.script").write_text(script)
        command = ["stdbuf", "-oL", str(self.program), "-in", "in.script", "-log", "none"]
        environment = one_process(folder)
        if ranks > 1:
            mpirun = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks)]
            command, environment = mpirun + command, ONE_MACHINE
        done = subprocess.run(
            command,
            cwd=folder,
            env={**os.environ, **environment, **self.environment},
            capture_output=True,
            text=True,
            errors="replace",  # LIGGGHTS ends some error lines with stray bytes
            timeout=900,
        )
        said = done.stdout + done.stderr
        assert done.returncode == 0 and "ERROR" not in said, f"{command}\n{said[-3000:]}"
        return said


def thermo(said: str) -> np.ndarray:
    """The rows of the last thermo table that LIGGGHTS printed; other words among them are not its."""
    tables: list[list[list[float]]] = []
    inside = False
    for line in said.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            tables.append([])
            inside = True
        elif line.startswith("Loop time"):
            inside = False
        elif inside and words:
            try:
                tables[-1].append([float(word) for word in words])
            except ValueError:  # the launcher of the ranks speaks at any time
                continue
    return np.array(tables[-1])
