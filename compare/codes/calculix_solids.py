# SPDX-License-Identifier: GPL-2.0-or-later
"""CalculiX: elastic solids of a size, meshed by bricks of twenty nodes, as references for figures of
bodies of elements: a bar held at one end, a plate with a hole, and a cylinder that a pin is pressed on."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Sequence

import numpy as np

from compare.codes.base import run_program
from compare.codes.calculix_hot_plate import PLACES, QuadraticMesh
from compare.result import CodeFailure, Floats

MATERIAL = """\
*MATERIAL, NAME=METAL
*ELASTIC
{young_modulus:.12g}, {poisson_ratio:.12g}
*DENSITY
{density:.12g}
*SOLID SECTION, ELSET=PLATE, MATERIAL=METAL
"""


@dataclass(frozen=True)
class Solid:
    """An elastic box with a corner in the origin."""

    size: tuple[float, float, float]  #: m
    young_modulus: float  #: Pa
    poisson_ratio: float
    density: float = 1.0  #: kg/m³


def _run(text: str, directory: Path, timeout: float, program: str = "ccx") -> str:
    """The .dat file of a job; CodeFailure."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "job.inp").write_text(text)
    run_program([program, "-i", "job"], directory, timeout, {"OMP_NUM_THREADS": "1"})
    try:
        return (directory / "job.dat").read_text()
    except OSError as error:
        raise CodeFailure(f"calculix wrote no job.dat: {error}") from error


def _node_set(name: str, numbers: Any) -> str:
    return f"*NSET, NSET={name}\n" + "".join(f"{n},\n" for n in np.ravel(numbers))


def _ends(mesh: QuadraticMesh) -> str:
    """Sets LOW and HIGH: nodes of the faces across x."""
    places = np.unique((2 * mesh.bricks()[:, None, :] + PLACES).reshape(-1, 3), axis=0)
    return "".join(_node_set(name, mesh.node(places[places[:, 0] == x]))
                   for name, x in (("LOW", 0), ("HIGH", 2 * mesh.cells[0])))


def _mesh(solid: Solid, cells: tuple[int, int, int]) -> QuadraticMesh:
    return QuadraticMesh(cells, np.array(solid.size) / cells)


#: What the far end does under each load: axis of the displacement, and what is imposed.
LOADS = {"tension": (1, "HIGH, 1, 1, {u:.12g}\nHIGH, 2, 3\n"), "bending": (3, "HIGH, 3, 3, {u:.12g}\n")}


def bar_stiffness(solid: Solid, load: str, cells: tuple[int, int, int], directory: Path,
                  timeout: float = 600) -> float:
    """Force over displacement, N/m, of the far end of a bar whose other end is held.

    Under "tension" the far end is held as well and drawn along x; under "bending" all of it goes
    along z by the same amount, free along x and y.
    """
    mesh, moved = _mesh(solid, cells), 1e-4 * min(solid.size)
    axis, imposed = LOADS[load]
    text = (mesh.lines() + _ends(mesh) + MATERIAL.format(**vars(solid))
            + "*STEP\n*STATIC\n*BOUNDARY\nLOW, 1, 3\n" + imposed.format(u=moved)
            + "*NODE PRINT, NSET=HIGH, TOTALS=ONLY\nRF\n*END STEP\n")
    found = re.search(r"total force.*\n\s*\n((?:\s+\S+){3})", _run(text, directory, timeout))
    if not found:
        raise CodeFailure("calculix wrote no total force")
    return float(found.group(1).split()[axis - 1]) / moved


def warm_bar_growth(solid: Solid, expansion_coefficient: float, rise: Callable[[Floats], Floats],
                    cells: tuple[int, int, int], directory: Path, timeout: float = 600) -> float:
    """How far, m, the middle of the far face of a bar goes along x whose other end is held, at a `rise` of
    temperature, K, over the distance from that end, m. `cells` along y and z are even."""
    mesh = _mesh(solid, cells)
    places = np.unique((2 * mesh.bricks()[:, None, :] + PLACES).reshape(-1, 3), axis=0)
    warm = zip(mesh.node(places), rise(places[:, 0] * mesh.size[0] / 2))
    metal = MATERIAL.format(**vars(solid)).replace(
        "*DENSITY", f"*EXPANSION, ZERO=0\n{expansion_coefficient:.12g}\n*DENSITY")
    text = (mesh.lines() + _ends(mesh) + _node_set("TIP", mesh.node((2 * cells[0], *cells[1:]))) + metal
            + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 0\n*STEP\n*STATIC\n*BOUNDARY\nLOW, 1, 3\n*TEMPERATURE\n"
            + "".join(f"{n}, {kelvin:.12g}\n" for n, kelvin in warm)
            + "*NODE PRINT, NSET=TIP\nU\n*END STEP\n")
    return float(_numbers(_run(text, directory, timeout), "displacements (")[0, 1])


def bar_frequencies(solid: Solid, count: int, cells: tuple[int, int, int], directory: Path,
                    timeout: float = 600) -> Floats:
    """The first frequencies, Hz, at which a bar of square section, held at one end, is bent; each is
    there twice, along y and z, and counted once."""
    mesh = _mesh(solid, cells)
    text = (mesh.lines() + _ends(mesh) + MATERIAL.format(**vars(solid))
            + f"*BOUNDARY\nLOW, 1, 3\n*STEP\n*FREQUENCY\n{4 * count}\n*END STEP\n")
    said = _run(text, directory, timeout)
    try:
        values, shares = (_numbers(said, head) for head in (
            "E I G E N V A L U E   O U T P U T", "E F F E C T I V E   M O D A L   M A S S"))
    except (IndexError, ValueError) as error:
        raise CodeFailure(f"calculix wrote no usable frequencies: {error!r}") from error
    if len(values) != len(shares):
        raise CodeFailure(f"calculix wrote {len(values)} frequencies and {len(shares)} masses")
    # Bending moves mass sideways; twisting moves none, stretching along the bar.
    whole = solid.density * float(np.prod(solid.size))
    aside = shares[:, 2] + shares[:, 3]
    bent = (aside > 1e-3 * whole) & (aside > shares[:, 1])
    pairs = values[bent, 3]
    if len(pairs) < 2 * count:
        raise CodeFailure(f"{len(pairs)} of {2 * count} frequencies of bending found")
    mean: Floats = pairs[:2 * count].reshape(count, 2).mean(axis=1)
    return mean


#: Of the eight nodes of a ring's section: corners, then the middles of its edges, in halves of the section.
RING_PLACES = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)])


@dataclass(frozen=True)
class Cylinder:
    """An elastic cylinder, its axis upright."""

    length: float  #: m
    radius: float  #: m
    young_modulus: float  #: Pa
    poisson_ratio: float


@dataclass(frozen=True)
class HolePlate:
    """A plate with a round hole in its middle, the origin, pulled along x by ends that are held."""

    length: float  #: m, along x
    width: float  #: m, along y
    thickness: float  #: m
    hole_radius: float  #: m
    young_modulus: float  #: Pa
    poisson_ratio: float

    def place(self, out: Floats, around: Floats, up: Floats) -> Floats:
        """(..., 3) points, m, of an eighth of the plate: `out` 0 at the hole, 1 at the outer sides, denser at
        the hole; `around` 0 on the x axis, ½ at the corner, 1 on the y axis; `up` 0 to 1, half of the
        thickness."""
        x, y = self.length / 2, self.width / 2
        side = np.stack([np.where(around < 0.5, x, 2 * x * (1 - around)),
                         np.where(around < 0.5, 2 * y * around, y)], axis=-1)
        angle = around * np.pi / 2
        hole = self.hole_radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        part = (np.expm1(2 * out) / np.expm1(2.0))[..., None]
        flat = (1 - part) * hole + part * side
        return np.concatenate([flat, (up * self.thickness / 2)[..., None]], axis=-1)


@dataclass(frozen=True)
class StressField:
    """Stress along x of an eighth of a plate, over the mean of a section without a hole."""

    position: Floats  #: (P, 2) m, of points in the plane
    stress: Floats  #: (P,) means through the thickness

    def mean(self, lower: Sequence[float], upper: Sequence[float]) -> float:
        """Mean over a rectangle in the plane, m; read at the nearest points."""
        x, y = (np.linspace(a, b, 81)[:-1] + (b - a) / 160 for a, b in zip(lower, upper))
        at = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 1, 2)
        nearest = ((at - self.position) ** 2).sum(axis=2).argmin(axis=1)
        return float(self.stress[nearest].mean())


def hole_stress(plate: HolePlate, cells: tuple[int, int, int], directory: Path,
                timeout: float = 600) -> StressField:
    """Of a mesh of `cells` bricks outwards, around (an even number) and through half of the thickness."""
    mesh = QuadraticMesh(cells, np.ones(3))
    places = 2 * mesh.bricks()[:, None, :] + PLACES
    numbers, first = np.unique(mesh.node(places), return_index=True)
    spot = places.reshape(-1, 3)[first]
    where = plate.place(*(spot / (2 * np.array(cells))).T)
    lines = mesh.lines()
    text = ("*NODE, NSET=ALL\n" + "".join(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n"
                                         for n, (x, y, z) in zip(numbers, where))
            + lines[lines.index("*ELEMENT"):])
    far = np.abs(where[:, 0] - plate.length / 2) < 1e-9 * plate.length
    moved = 1e-4 * plate.length
    # Planes of symmetry.
    sets = {"ACROSS": (spot[:, 1] == 2 * cells[1], 1), "ALONG": (spot[:, 1] == 0, 2),
            "MIDDLE": (spot[:, 2] == 0, 3), "FAR": (far, 3)}
    text += "".join(_node_set(name, numbers[inside]) for name, (inside, _) in sets.items())
    text += MATERIAL.format(density=1.0, **vars(plate)) + "*STEP\n*STATIC\n*BOUNDARY\n"
    text += "".join(f"{name}, {axis}, {axis}\n" for name, (_, axis) in sets.items())
    text += f"FAR, 2, 2\nFAR, 1, 1, {moved:.12g}\n"
    said = _run(text + "*EL PRINT, ELSET=PLATE\nS, COORD\n*NODE PRINT, NSET=FAR, TOTALS=ONLY\nRF\n"
                "*END STEP\n", directory, timeout)
    try:
        stress, spots = _numbers(said, "stresses ("), _numbers(said, "global coordinates (")
        force = _numbers(said, "total force")[0][0]
        points = np.round(spots[:, 2:4] / plate.hole_radius, 7)
        once, index = np.unique(points, axis=0, return_inverse=True)
        mean = np.bincount(index, stress[:, 2]) / np.bincount(index)
    except (IndexError, ValueError) as error:
        raise CodeFailure(f"calculix wrote no usable stresses: {error!r}") from error
    section = plate.width * plate.thickness / 4
    return StressField(once * plate.hole_radius, mean / (force / section))


def ringing_bar(solid: Solid, rate: float, duration: float, cells: tuple[int, int, int], steps: int,
               directory: Path, timeout: float = 600) -> tuple[Floats, Floats]:
    """Times, s, and displacements, m, of the middle of an end of a free bar that starts in steady stretching
    at a `rate`, 1/s, and narrows accordingly.

    `solid`: an eighth of the bar, between three planes of symmetry. Implicit steps without damping.
    """
    mesh = _mesh(solid, cells)
    places = np.unique((2 * mesh.bricks()[:, None, :] + PLACES).reshape(-1, 3), axis=0)
    numbers = mesh.node(places)
    step = duration / steps
    text = mesh.lines() + "".join(
        _node_set(name, numbers[places[:, axis] == 0]) for axis, name in enumerate(("NEAR", "SIDE", "FLOOR")))
    text += _node_set("TIP", mesh.node((2 * cells[0], 0, 0))) + MATERIAL.format(**vars(solid))
    pace = rate * np.array([1, -solid.poisson_ratio, -solid.poisson_ratio])
    text += "*INITIAL CONDITIONS, TYPE=VELOCITY\n" + "".join(
        f"{n}, {axis + 1}, {v:.12g}\n" for n, row in zip(numbers, pace * places * mesh.size / 2)
        for axis, v in enumerate(row))
    text += (f"*STEP, INC={steps + 1}\n*DYNAMIC, DIRECT, ALPHA=0\n{step:.12g}, {duration:.12g}\n"
             "*BOUNDARY\nNEAR, 1, 1\nSIDE, 2, 2\nFLOOR, 3, 3\n"
             "*NODE PRINT, NSET=TIP\nU\n*END STEP\n")
    said = _run(text, directory, timeout)
    found = re.findall(r"displacements \(vx,vy,vz\) for set TIP and time +(\S+)\s+\d+ +(\S+)", said)
    if len(found) != steps:
        raise CodeFailure(f"calculix wrote {len(found)} of {steps} increments")
    rows = np.array([(0.0, 0.0), *found], dtype=float)
    return rows[:, 0], rows[:, 1]


def _finer_at_start(length: float, cells: int) -> Floats:
    """Ends and middles of cells along a length, of which the last is about twenty times as long as the first."""
    ends = length * np.expm1(3 * np.arange(cells + 1) / cells) / np.expm1(3.0)
    found = np.repeat(ends, 2)[:-1]
    found[1::2] = (ends[:-1] + ends[1:]) / 2
    return found


def _pressed_cylinder(cylinder: Cylinder, pin_radius: float, cells: tuple[int, int, int], metal: str) -> str:
    """Rings of eight nodes, smaller towards the pin, of a `metal`; sets LOW, AXIS and PIN, the nodes under it."""
    inside, beside, along = cells
    edges = np.r_[np.linspace(0, pin_radius, 2 * inside + 1)[:-1],
                  pin_radius + _finer_at_start(cylinder.radius - pin_radius, beside)]
    height = cylinder.length - _finer_at_start(cylinder.length, along)[::-1]
    i, j = (a.ravel() for a in np.meshgrid(np.arange(len(edges)), np.arange(len(height)), indexing="ij"))
    there = (i % 2 == 0) | (j % 2 == 0)  # no node in the middle of a ring's section
    i, j = i[there], j[there]

    def node(across: Any, up: Any) -> Any:
        return 1 + across * len(height) + up

    rings = np.stack([a.ravel() for a in np.meshgrid(np.arange(inside + beside), np.arange(along),
                                                    indexing="ij")], axis=1)
    corners = 2 * rings[:, None, :] + RING_PLACES
    text = "*NODE, NSET=ALL\n" + "".join(
        f"{n}, {x:.12g}, {y:.12g}\n" for n, x, y in zip(node(i, j), edges[i], height[j]))
    text += "*ELEMENT, TYPE=CAX8R, ELSET=PLATE\n" + "".join(
        f"{n}, {', '.join(map(str, row))}\n" for n, row in enumerate(node(*np.moveaxis(corners, 2, 0)), 1))
    for name, chosen in (("LOW", j == 0), ("AXIS", i == 0), ("PIN", (j == 2 * along) & (i <= 2 * inside))):
        text += _node_set(name, node(i, j)[chosen])
    return text + metal


#: How far the pin goes, and what is told of it; CalculiX bears forces on two degrees of a ring.
PRESSED = """\
*BOUNDARY
LOW, 1, 2
AXIS, 1, 1
PIN, 2, 2, {depth:.12g}
*NODE PRINT, NSET=PIN, TOTALS=ONLY
RF
*END STEP
"""
RING_SHARE = 180.0


def indentation_stiffness(cylinder: Cylinder, pin_radius: float, cells: tuple[int, int, int],
                          directory: Path, timeout: float = 600) -> float:
    """Force over depth, N/m, of a flat, smooth, round and rigid pin that is pressed on the middle of the upper
    face of a cylinder whose lower face is held. `cells`: under the pin and beside it, outwards, and along the axis.
    """
    moved = 1e-4 * cylinder.length
    text = (_pressed_cylinder(cylinder, pin_radius, cells, MATERIAL.format(density=1.0, **vars(cylinder)))
            + "*STEP\n*STATIC\n" + PRESSED.format(depth=-moved))
    return -RING_SHARE * float(_numbers(_run(text, directory, timeout), "total force")[0, 1]) / moved


def indentation_curve(cylinder: Cylinder, flow: Sequence[tuple[float, float]], pin_radius: float, depth: float,
                      cells: tuple[int, int, int], directory: Path, steps: int = 20,
                      timeout: float = 600) -> tuple[Floats, Floats]:
    """Depths, m, and forces, N, up to a `depth`, of a pin as of indentation_stiffness on a metal that flows by
    von Mises and hardens alike in all directions: `flow` has true stresses, Pa, over plastic strains, from 0 on.

    Large displacements and rotations count.
    """
    metal = MATERIAL.format(density=1.0, **vars(cylinder)).replace(
        "*DENSITY", "*PLASTIC\n" + "".join(f"{s:.12g}, {e:.12g}\n" for s, e in flow) + "*DENSITY")
    text = (_pressed_cylinder(cylinder, pin_radius, cells, metal)
            + f"*STEP, INC=1000, NLGEOM\n*STATIC\n{1 / steps:.6g}, 1, 1e-6, {1 / steps:.6g}\n"
            + PRESSED.format(depth=-depth))
    said = _run(text, directory, timeout)
    found = re.findall(r"total force \(fx,fy,fz\) for set PIN and time +(\S+)\s+\S+ +(\S+)", said)
    rows = np.array([(0.0, 0.0), *found], dtype=float)
    if rows[-1, 0] < 1 - 1e-6:
        raise CodeFailure(f"calculix came {100 * rows[-1, 0]:.0f} % of the way")
    return depth * rows[:, 0], -RING_SHARE * rows[:, 1]


def _numbers(text: str, head: str) -> Floats:
    """Rows of numbers of a table of a .dat file."""
    rows: list[list[float]] = []
    for line in text.split(head)[1].splitlines()[1:]:
        words = line.split()
        try:
            row = [float(word) for word in words]
        except ValueError:
            if rows:
                break
            continue
        if row:
            rows.append(row)
    return np.array(rows)
