# SPDX-License-Identifier: GPL-2.0-or-later
"""CalculiX: finite elements, on a mesh of its own, of the plate with the moving disc or hot spot."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from compare.codes.base import Job, TwoSpheres, run_program, said_version
from compare.codes.calculix_hot_plate import run_hot_plate
from compare.references import MovingDisc
from compare.result import CodeFailure, Floats, Frame, Result
from contrib.prepared import Parameters


@dataclass(frozen=True)
class Mesh:
    """Linear bricks of one size; nodes and bricks count from 1, x fastest, then y, then z."""

    cells: tuple[int, int, int]
    lower: Floats  #: (3,) m
    size: Floats  #: (3,) of a brick, m

    def node(self, i: Any, j: Any, k: Any) -> Any:
        """Number of the node at an index along x, y, z."""
        nx, ny, _ = self.cells
        return 1 + i + (nx + 1) * (j + (ny + 1) * k)

    def nearest_node(self, point: Floats) -> int:
        """Number of the node at a point, m; CodeFailure when there is none."""
        index = np.rint((point - self.lower) / self.size)
        if np.abs(self.lower + index * self.size - point).max() > 1e-6 * self.size.max():
            raise CodeFailure(f"the mesh has no node at {point} m")
        return int(self.node(*index.astype(int)))

    def lines(self) -> str:
        """*NODE and *ELEMENT."""
        nx, ny, nz = self.cells
        i, j, k = (a.ravel(order="F") for a in
                   np.meshgrid(*(np.arange(n + 1) for n in self.cells), indexing="ij"))
        place = self.lower + np.stack([i, j, k], axis=1) * self.size
        text = "*NODE, NSET=ALL\n" + "".join(
            f"{n + 1}, {x:.12g}, {y:.12g}, {z:.12g}\n" for n, (x, y, z) in enumerate(place))
        i, j, k = (a.ravel(order="F") for a in
                   np.meshgrid(*(np.arange(n) for n in self.cells), indexing="ij"))
        corners = [self.node(i + a, j + b, k + c)
                   for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        return text + "*ELEMENT, TYPE=C3D8, ELSET=PLATE\n" + "".join(
            f"{n + 1}, {', '.join(map(str, row))}\n"
            for n, row in enumerate(np.stack(corners, axis=1)))


def source_lines(plate: MovingDisc, mesh: Mesh, increment: float) -> tuple[str, str]:
    """Amplitudes, and the loads that use them: a body heat flux for each column of bricks.

    The value at the end of an increment is the mean over it of the fraction of the column that is
    inside the disc, so that the heat given is that of the disc.
    """
    nx, ny, nz = mesh.cells
    i, j = (a.ravel() for a in np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"))
    lower = mesh.lower[:2] + np.stack([i, j], axis=1) * mesh.size[:2]
    steps = round(plate.duration / increment)
    moments = [(s + f) * increment for s in range(steps) for f in (0.125, 0.375, 0.625, 0.875)]
    fraction = np.array([plate.fraction_heated(t, lower, lower + mesh.size[:2]) for t in moments])
    fraction = fraction.reshape(steps, 4, -1).mean(axis=1)
    amplitudes, loads = "", ""
    for column in np.flatnonzero(fraction.max(axis=0) > 0):
        values = np.r_[fraction[0, column], fraction[:, column]]
        pairs = [f"{s * increment:.12g}, {v:.9g}" for s, v in enumerate(values)]
        amplitudes += f"*AMPLITUDE, NAME=A{column}\n" + "".join(
            ", ".join(pairs[n:n + 4]) + ",\n" for n in range(0, len(pairs), 4))
        bricks = 1 + i[column] + nx * (j[column] + ny * np.arange(nz))
        loads += f"*DFLUX, AMPLITUDE=A{column}\n" + "".join(
            f"{b}, BF, {plate.power_density:.12g}\n" for b in bricks)
    return amplitudes, loads


JOB = """\
{mesh}*MATERIAL, NAME=METAL
*CONDUCTIVITY
{conductivity:.12g}
*SPECIFIC HEAT
{specific_heat:.12g}
*DENSITY
{density:.12g}
*SOLID SECTION, ELSET=PLATE, MATERIAL=METAL
*NSET, NSET=POINTS
{points}
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {initial:.12g}
{amplitudes}*STEP, INC={most}
*HEAT TRANSFER, DIRECT, SOLVER=ITERATIVE SCALING
{increment:.12g}, {duration:.12g}
{loads}*NODE PRINT, NSET=POINTS
NT
*END STEP
"""


def read_temperatures(path: Path, nodes: list[int]) -> tuple[Floats, Floats]:
    """(T,) times, s, and (T, P) temperatures, K, of nodes from a .dat file; CodeFailure."""
    try:
        blocks = re.split(r"temperatures for set \S+ and time +(\S+)", path.read_text())
        times = np.array(blocks[1::2], dtype=float)
        rows = []
        for block in blocks[2::2]:
            found = {int(a): float(b) for a, b in re.findall(r"^ +(\d+) +(\S+)$", block, re.M)}
            rows.append([found[node] for node in nodes])
    except (OSError, ValueError, KeyError) as error:
        raise CodeFailure(f"calculix wrote no usable temperatures: {error!r}") from error
    if not rows:
        raise CodeFailure("calculix wrote no temperatures")
    return times, np.array(rows)


def _plate_and_mesh(options: dict[str, Any]) -> tuple[MovingDisc, Mesh, dict[str, Any]]:
    """The plate, its mesh and [options.calculix] of a case; CodeFailure says what is wrong."""
    try:
        plate, own = MovingDisc(**options["plate"]), options["calculix"]
        cells = np.array(own["cells"], dtype=int)
        lower = np.array([0.0, -plate.width / 2, 0.0])
        size = np.array([plate.length, plate.width, plate.thickness]) / cells
    except (KeyError, TypeError, ValueError) as error:
        raise CodeFailure(f"calculix needs [options.plate] and [options.calculix] of the case: "
                          f"{error!r}") from error
    return plate, Mesh((int(cells[0]), int(cells[1]), int(cells[2])), lower, size), own


@dataclass
class Calculix:
    """CalculiX as Debian packages it.

    It reads nothing of the specimen: the plate, the source, the mesh ([options.calculix]: cells,
    increments) and the points ([options.points]) stand in the case. With [options.hot_plate] it
    is that plate's stress that is asked for.
    """

    name: str = "calculix"
    program: str = "ccx"

    def missing(self) -> str | None:
        """Why CalculiX cannot be used."""
        if shutil.which(self.program) is None:
            return f"no program {self.program!r} on the path (Debian package calculix-ccx)"
        return None

    def version(self) -> str:
        """What the program says it is."""
        return said_version([self.program, "-v"], r"Version (\S+)")

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """They are its own."""
        return False

    def run(self, job: Job, directory: Path) -> Result:
        """Temperatures at the points of the case against time, as sensors of these names.

        Of a hot plate: temperature and stress of its bricks at rest.
        """
        directory.mkdir(parents=True, exist_ok=True)
        if "hot_plate" in job.options:
            return run_hot_plate(job, directory, self.program, self.name)
        plate, mesh, own = _plate_and_mesh(job.options)
        points: dict[str, list[float]] = job.options.get("points", {})
        nodes = [mesh.nearest_node(np.array([x, y, mesh.lower[2] + plate.thickness / 2]))
                 for x, y in points.values()]
        steps = int(own["increments"])
        increment = plate.duration / steps
        amplitudes, loads = source_lines(plate, mesh, increment)
        (directory / "job.inp").write_text(JOB.format(
            mesh=mesh.lines(), conductivity=plate.conductivity,
            specific_heat=plate.specific_heat_capacity, density=plate.density,
            points=",\n".join(map(str, nodes)), initial=plate.initial_temperature,
            amplitudes=amplitudes, most=steps + 1, increment=increment, duration=plate.duration,
            loads=loads))
        wall = run_program([self.program, "-i", "job"], directory, job.timeout,
                           {"OMP_NUM_THREADS": "1"})
        times, rows = read_temperatures(directory / "job.dat", nodes)
        if len(times) != steps:
            raise CodeFailure(f"calculix wrote {len(times)} of {steps} increments")
        start = plate.initial_temperature
        history = {f"sensor.{name}.temperature": np.r_[start, rows[:, n]]
                   for n, name in enumerate(points)}
        history |= {"step": np.arange(steps + 1.0), "time": np.r_[0.0, times]}
        last = Frame(steps, float(times[-1]), {"temperature": rows[-1]})
        bricks = int(np.prod(mesh.cells))
        return Result(self.name, bricks, 3 * bricks, steps, increment, wall, history, [last])

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """It has no beams between spheres."""
        raise CodeFailure("calculix is given no beams between spheres")
