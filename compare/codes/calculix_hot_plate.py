# SPDX-License-Identifier: GPL-2.0-or-later
"""CalculiX: steady temperature, and the stress that comes of it, of a free plate with a hot spot."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from compare.codes.base import Job, run_program
from compare.references import HotPlate
from compare.result import CodeFailure, Floats, Frame, Result

#: Of the twenty nodes of a brick: corners, then the middles of its edges, in halves of the brick.
PLACES = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0),
                   (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2),
                   (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0),
                   (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
                   (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)])


@dataclass(frozen=True)
class QuadraticMesh:
    """Bricks of twenty nodes, all of one size; nodes and bricks count from 1, x fastest."""

    cells: tuple[int, int, int]
    size: Floats  #: (3,) of a brick, m

    def node(self, place: Any) -> Any:
        """Numbers of the nodes at places (..., 3), in halves of a brick."""
        nx, ny, _ = self.cells
        place = np.asarray(place)
        return 1 + place[..., 0] + (2 * nx + 1) * (place[..., 1] + (2 * ny + 1) * place[..., 2])

    def bricks(self) -> Any:
        """(B, 3) index of each brick along x, y, z."""
        return np.stack([a.ravel(order="F") for a in np.meshgrid(
            *(np.arange(n) for n in self.cells), indexing="ij")], axis=1)

    @property
    def centres(self) -> Floats:
        """(B, 3) of the bricks, m."""
        found: Floats = (self.bricks() + 0.5) * self.size
        return found

    def lines(self) -> str:
        """*NODE and *ELEMENT."""
        places = 2 * self.bricks()[:, None, :] + PLACES
        numbers = self.node(places)
        once, first = np.unique(numbers, return_index=True)
        where = places.reshape(-1, 3)[first] * self.size / 2
        return "*NODE, NSET=ALL\n" + "".join(
            f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n" for n, (x, y, z) in zip(once, where)
        ) + "*ELEMENT, TYPE=C3D20R, ELSET=PLATE\n" + "".join(
            f"{n + 1}, {', '.join(map(str, row[:15]))},\n{', '.join(map(str, row[15:]))}\n"
            for n, row in enumerate(numbers))

    def supports(self) -> str:
        """Three corners held so that no rigid motion is left, and nothing more."""
        x, y, _ = (2 * n for n in self.cells)
        return "".join(f"{self.node(place)}, {axes}\n" for place, axes in
                       (((0, 0, 0), "1, 3"), ((x, 0, 0), "2, 3"), ((0, y, 0), "3, 3")))


JOB = """\
{mesh}*MATERIAL, NAME=METAL
*ELASTIC
{young_modulus:.12g}, {poisson_ratio:.12g}
*EXPANSION, ZERO={temperature:.12g}
{expansion_coefficient:.12g}
*CONDUCTIVITY
{conductivity:.12g}
*SOLID SECTION, ELSET=PLATE, MATERIAL=METAL
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {temperature:.12g}
*BOUNDARY
{supports}*STEP
*UNCOUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
*DFLUX
{heat}*FILM
{films}*EL PRINT, ELSET=PLATE
S
*END STEP
"""


def job_text(plate: HotPlate, mesh: QuadraticMesh) -> str:
    """Input of CalculiX."""
    bricks, number = mesh.bricks(), 1 + np.arange(int(np.prod(mesh.cells)))
    lower = bricks[:, :2] * mesh.size[:2]
    fraction = plate.fraction_heated(lower, lower + mesh.size[:2])
    heat = "".join(f"{number[b]}, BF, {plate.power_density * fraction[b]:.12g}\n"
                   for b in np.flatnonzero(fraction > 0))
    films = "".join(f"{n}, {face}, {plate.temperature:.12g}, {plate.coefficient:.12g}\n"
                    for face, layer in (("F1", 0), ("F2", mesh.cells[2] - 1))
                    for n in number[bricks[:, 2] == layer])
    return JOB.format(mesh=mesh.lines(), supports=mesh.supports(), heat=heat, films=films,
                      **vars(plate))


def read_stresses(path: Path, bricks: int) -> Floats:
    """(B, 6) mean stress of each brick, Pa: xx yy zz xy yz xz; CodeFailure.

    The eight points of a reduced brick count alike.
    """
    try:
        block = re.split(r"stresses \(elem.*\n", path.read_text())[1]
        rows = np.array([line.split() for line in block.splitlines() if line.strip()], dtype=float)
        points = rows[:, 2:].reshape(bricks, 8, 6)
    except (OSError, ValueError, IndexError) as error:
        raise CodeFailure(f"calculix wrote no usable stresses: {error!r}") from error
    mean: Floats = points.mean(axis=1)[:, [0, 1, 2, 3, 5, 4]]
    return mean


def hot_plate(options: dict[str, Any]) -> tuple[HotPlate, QuadraticMesh]:
    """The plate and its mesh, of the options of a case; CodeFailure says what is wrong."""
    try:
        plate = HotPlate(**options["hot_plate"])
        nx, ny, nz = (int(n) for n in options["calculix"]["cells"])
    except (KeyError, TypeError, ValueError) as error:
        raise CodeFailure(f"calculix needs [options.hot_plate] and [options.calculix] of the case: "
                          f"{error!r}") from error
    return plate, QuadraticMesh((nx, ny, nz), np.array(plate.size) / (nx, ny, nz))


def run_hot_plate(job: Job, directory: Path, program: str, name: str) -> Result:
    """The plate at rest: one frame with the centres of the bricks and their stress."""
    plate, mesh = hot_plate(job.options)
    (directory / "job.inp").write_text(job_text(plate, mesh))
    wall = run_program([program, "-i", "job"], directory, job.timeout, {"OMP_NUM_THREADS": "1"})
    bricks = int(np.prod(mesh.cells))
    frame = Frame(1, 1.0, {"position": mesh.centres,
                           "stress": read_stresses(directory / "job.dat", bricks)})
    return Result(name, bricks, 3 * bricks, 1, 1.0, wall, {}, [frame])
