# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that readings are held against and that no run of solidem gave: finite elements (CalculiX), beam
theory, a law in one point, figures that are given. Each tells its own error."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Callable, Sequence

import numpy as np

from benchmarks.adiabatic_flow.law import TESTS, adiabatic
from compare.codes.calculix_solids import (Cylinder, HolePlate, Solid, bar_frequencies, bar_stiffness,
                                           hole_stress, indentation_curve, indentation_stiffness,
                                           ringing_bar, warm_bar_growth)
from compare.references import RectangularBeam, warming_rod
from compare.result import CodeFailure, Floats


@dataclass(frozen=True)
class Figure:
    """One value and how far it may be off."""

    value: float  #: SI units
    error: float  #: its own, relative; 0: exact, or given
    source: str  #: where it comes from, in words


Figures = dict[str, Figure]


def extrapolated(values: Sequence[float], meshes: str) -> Figure:
    """The limit of values on meshes each twice as fine as the one before (three of them); its error is how
    far the finest is from it."""
    coarse, middle, fine = values
    ratio = (coarse - middle) / (middle - fine) if middle != fine else math.inf
    # Where differences do not fall, there is nothing to extrapolate by.
    limit = fine + (fine - middle) / (ratio - 1) if ratio > 1.2 else fine
    off = max(abs(limit - fine), 0.0 if ratio > 1.2 else abs(fine - middle))
    return Figure(limit, off / abs(limit), f"CalculiX, extrapolated over {meshes}")


def _meshes(cells: Sequence[int]) -> tuple[list[tuple[int, int, int]], str]:
    x, y, z = cells
    found = [(n * x, n * y, n * z) for n in (1, 2, 4)]
    return found, "meshes of " + ", ".join("×".join(map(str, each)) for each in found) + \
        " bricks of twenty nodes"


def _bar(options: dict[str, Any], folder: Path) -> Figures:
    """Of a bar: `size` (m, what is free between what is held and its end), `young_modulus`,
    `poisson_ratio`, `density`, `cells` of the coarsest mesh, and `load` ("tension", "bending") for its
    stiffness or `frequencies` (how many)."""
    length, width, height = options["size"]
    solid = Solid((length, width, height), options["young_modulus"], options["poisson_ratio"],
                  options.get("density", 1.0))
    meshes, words = _meshes(options["cells"])
    beam = RectangularBeam(length, height, width, solid.young_modulus, solid.poisson_ratio,
                           solid.density)
    names: list[str] = []
    rows: list[list[float]] = []
    theory: list[float] = []
    if load := options.get("load"):
        names, rows = ["stiffness"], [[bar_stiffness(solid, load, mesh, folder)] for mesh in meshes]
        theory = [beam.tip_stiffness if load == "bending"
                  else solid.young_modulus * width * height / length]
    if count := options.get("frequencies"):
        names = [f"frequency {n + 1}" for n in range(count)]
        rows = [list(bar_frequencies(solid, count, mesh, folder)) for mesh in meshes]
        theory = list(beam.frequencies(count))
    found: Figures = {}
    for name, values, simple in zip(names, np.transpose(rows), theory):
        figure = found[name] = extrapolated([float(v) for v in values], words)
        found[f"{name}, beam theory"] = Figure(
            simple, abs(simple / figure.value - 1),
            "E S / l" if options.get("load") == "tension" else "a beam of Timoshenko, κ of Cowper")
    return found


def swing(time: Floats, moved: Floats) -> dict[str, float]:
    """Of a displacement that starts at zero: the `largest` (m) of its first swing, and the time, s, at which
    it is `back`."""
    down = np.flatnonzero((moved[:-1] > 0) & (moved[1:] <= 0))
    if not len(down):
        raise CodeFailure("the displacement does not come back within the time of the run")
    n = down[0]
    back = time[n] + (time[n + 1] - time[n]) * moved[n] / (moved[n] - moved[n + 1])
    top = int(np.argmax(moved[:n + 1]))
    # A parabola through the largest and its neighbours: their spacing does not matter.
    a, b, c = np.polyfit(time[top - 1:top + 2] - time[top], moved[top - 1:top + 2], 2)
    return {"largest": float(c - b * b / (4 * a)), "back": float(back)}


def _ringing_bar(options: dict[str, Any], folder: Path) -> Figures:
    """Of a free bar, `size` (m), that starts in steady stretching at `rate` (1/s): how its end swings within
    `duration` (s). `cells` and `steps` of the coarsest mesh, of an eighth of the bar."""
    x, y, z = (length / 2 for length in options["size"])
    solid = Solid((x, y, z), options["young_modulus"], options["poisson_ratio"], options["density"])
    meshes, words = _meshes(options["cells"])
    swings = [swing(*ringing_bar(solid, options["rate"], options["duration"], mesh,
                                 options["steps"] * 2**n, folder)) for n, mesh in enumerate(meshes)]
    found = {name: extrapolated([each[name] for each in swings],
                                f"{words}, of an eighth of the bar, each with half the step")
             for name in swings[0]}
    speed = math.sqrt(solid.young_modulus / solid.density)
    for name, simple in (("largest", options["rate"] * x**2 / (2 * speed)), ("back", 2 * x / speed)):
        found[f"{name}, rod theory"] = Figure(simple, abs(simple / found[name].value - 1),
                                              "waves at √(E/ρ) in a slender rod")
    return found


def _hole(options: dict[str, Any], folder: Path) -> Figures:
    """Of a plate with a hole in its middle, pulled along its length: mean stress along x over `patch` =
    [along x from the middle, along y from the hole] (m), over that of a section without a hole. `plate`: of
    HolePlate; `cells` of the coarsest mesh."""
    plate = HolePlate(**options["plate"])
    meshes, words = _meshes(options["cells"])
    along, across = options["patch"]
    edge = plate.hole_radius
    fields = [hole_stress(plate, mesh, folder) for mesh in meshes]
    return {"concentration": extrapolated(
                [f.mean((0, edge), (along, edge + across)) for f in fields], words),
            "largest": Figure(float(fields[-1].stress.max()), 0.02,
                              "CalculiX, at the innermost point of the finest mesh")}


def _warm_rod(options: dict[str, Any], folder: Path) -> Figures:
    """Of a rod of `size` (m, what is free of it) that is warmed at the end that is held by `rise` (K) within
    `ramp` (s): how far the middle of its other end has gone, in the mean over each of `windows` (name -> [from,
    to], s). At rest at every time; temperatures by a series."""
    length, width, height = options["size"]
    solid = Solid((length, width, height), options["young_modulus"], options["poisson_ratio"],
                  options["density"])
    expansion = options["expansion_coefficient"]
    diffusivity = options["conductivity"] / (solid.density * options["specific_heat_capacity"])
    meshes, words = _meshes(options["cells"])
    found: Figures = {}
    for name, window in options["windows"].items():
        def rise(distance: Floats, window: Sequence[float] = window) -> Floats:
            return warming_rod(distance, length, diffusivity, options["rise"], options["ramp"],
                               (window[0], window[1]))
        figure = found[name] = extrapolated(
            [warm_bar_growth(solid, expansion, rise, mesh, folder) for mesh in meshes],
            f"{words}, temperatures by Fourier's series")
        middles = (np.arange(1000) + 0.5) * length / 1000
        free = expansion * length * float(rise(middles).mean())
        found[f"{name}, free sideways"] = Figure(free, abs(free / figure.value - 1),
                                                 "α times the integral of the rise")
    return found


def _pressed_cylinder(options: dict[str, Any]) -> tuple[Cylinder, float, list[tuple[int, int, int]], str]:
    """Body, radius of the pin, meshes and their name."""
    cylinder = Cylinder(options["length"], options["radius"], options["young_modulus"],
                        options["poisson_ratio"])
    inside, beside, along = options["cells"]
    meshes = [(n * inside, n * beside, n * along) for n in (1, 2, 4)]
    words = "meshes of " + ", ".join(f"{a + b}×{c}" for a, b, c in meshes) + " rings of eight nodes"
    return cylinder, options["pin_radius"], meshes, words


def _indentation(options: dict[str, Any], folder: Path) -> Figures:
    """Of a cylinder of `length` (m, what is free of it) and `radius` (m) on a bed that holds it: force over depth
    of a flat, smooth pin of `pin_radius` (m). `cells` of the coarsest mesh: under the pin, beside it, along
    the axis."""
    cylinder, pin, meshes, words = _pressed_cylinder(options)
    figure = extrapolated([indentation_stiffness(cylinder, pin, mesh, folder) for mesh in meshes], words)
    half_space = 2 * pin * cylinder.young_modulus / (1 - cylinder.poisson_ratio**2)
    return {"stiffness": figure,
            "stiffness, half-space": Figure(half_space, abs(half_space / figure.value - 1),
                                            "2 a E / (1 − ν²), Sneddon 1965")}


def _plunge(options: dict[str, Any], folder: Path) -> Figures:
    """Of a cylinder as of an indentation whose metal flows by Ludwik's law (`yield_stress`, `hardening_stress`,
    Pa, `hardening_exponent`): mean force on the pin between the depths of `from` and `to` (m)."""
    cylinder, pin, meshes, words = _pressed_cylinder(options)
    start, end = options["from"], options["to"]
    # Between its points the curve is taken as straight: beyond the first a thousandth of the stress is left at most.
    strains = [0.0, *np.geomspace(1e-5, 2.0, 60)]
    flow = [(options["yield_stress"] + options["hardening_stress"] * e**options["hardening_exponent"], e)
            for e in strains]
    depths, forces = np.linspace(start, end, 101), []
    for mesh in meshes:
        curve = indentation_curve(cylinder, flow, pin, end, mesh, folder)
        forces.append(float(np.interp(depths, *curve).mean()))
    return {"force": extrapolated(forces, f"{words}; von Mises, isotropic hardening")}


def _given(options: dict[str, Any], folder: Path) -> Figures:
    """What the table says: `source`, `values` (name -> number), `errors` (of some of them)."""
    errors = options.get("errors", {})
    return {name: Figure(float(value), float(errors.get(name, 0)), options["source"])
            for name, value in options["values"].items()}


def _adiabatic_flow(options: dict[str, Any], folder: Path) -> Figures:
    """Rises of table 4.1 of Terreros 2013: `start` (K) and `rate` (1/s) choose the test; by the law alone in
    one point ("rise at .026"), and measured ("rise at .026, measured")."""
    test = next((t for t in TESTS if (t.start, t.rate) == (options["start"], options["rate"])), None)
    if test is None:
        raise CodeFailure(f"no test starts at {options['start']} K and {options['rate']} /s")
    fine, coarse = (np.interp(test.strain, *np.array(adiabatic(test, n))[[0, 2]])
                    for n in (20000, 10000))
    found: Figures = {}
    for n, strain in enumerate(test.strain):
        name = f"rise at {strain:g}"
        found[name] = Figure(float(fine[n]), abs(float(fine[n] / coarse[n] - 1)),
                             "Johnson and Cook's law alone, in one adiabatic point")
        found[f"{name}, measured"] = Figure(test.measured[n], math.nan, "measured, table 4.1 of "
                                            "Terreros 2013, which tells no error")
    return found


KINDS: dict[str, Callable[[dict[str, Any], Path], Figures]] = {
    "bar": _bar, "ringing_bar": _ringing_bar, "hole": _hole, "warm_rod": _warm_rod,
    "indentation": _indentation, "plunge": _plunge, "given": _given, "adiabatic_flow": _adiabatic_flow}


def figures(options: dict[str, Any], folder: Path) -> Figures:
    """What [known.NAME] of a study asks for, worked out once and kept in a file; CodeFailure."""
    name = hashlib.sha256(json.dumps(options, sort_keys=True).encode()).hexdigest()[:16]
    kept = folder / f"{name}.json"
    if kept.exists():
        return {name: Figure(**row) for name, row in json.loads(kept.read_text()).items()}
    kind = options.get("kind")
    if kind not in KINDS:
        raise CodeFailure(f"kind = {kind!r} of what is known; there are {', '.join(KINDS)}")
    try:
        found = KINDS[kind](options, folder / "work")
    except KeyError as error:
        raise CodeFailure(f"[known], kind {kind!r}: {error} is missing") from error
    folder.mkdir(parents=True, exist_ok=True)
    kept.write_text(json.dumps({name: asdict(figure) for name, figure in found.items()}))
    return found
