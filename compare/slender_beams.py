# SPDX-License-Identifier: GPL-2.0-or-later
"""Chains of elements against the theory of long slender beams."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.measures import measure
from compare.references import (cantilever_frequencies, circular_second_moment, collapse_load,
                                tip_deflection)
from compare.result import CodeFailure, Floats
from compare.row import Measured, Plot, Series
from compare.runs import View


@dataclass(frozen=True)
class Chain:
    """A straight row of equal elements."""

    length: float  #: between the first and the last centre, m
    spacing: float  #: of the centres, m
    bending_stiffness: float  #: E I, N m²
    radius: float  #: of the beams, m
    young_modulus: float  #: Pa
    mass: float  #: of one element, kg


def chain_of(view: View) -> Chain:
    """The specimen as a chain; CodeFailure when it is none."""
    specimen, beams = view.job.specimen, view.job.parameters.beams
    if beams is None or len(specimen.pairs) != len(specimen.radius) - 1:
        raise CodeFailure("the specimen is no chain of beams")
    length, radius = specimen.rest_length, beams.radius(specimen)
    span = float(np.ptp(specimen.position, axis=0).max())
    if abs(length.sum() / span - 1) > 1e-9 or np.ptp(length) > 1e-9 * length[0]:
        raise CodeFailure("the chain is not straight and even")
    r = float(radius[0])
    return Chain(span, float(length[0]), beams.young_modulus * circular_second_moment(r), r,
                 beams.young_modulus, float(specimen.column("mechanics/mass")[0]))


def _column(view: View) -> tuple[Floats, Floats]:
    name, history = view.option("column"), view.tested.history
    if name not in history or len(history[name]) < 20:
        raise CodeFailure(f"{view.tested.code} has no 20 rows of {name} in its history")
    return history["time"], history[name]


def peak_frequency(time: Floats, values: Floats, low: float, high: float) -> float:
    """Frequency between two bounds at which a Hann-windowed record is strongest, Hz."""
    window = np.hanning(len(time)) * (values - values.mean())

    def strength(frequency: float) -> float:
        return float(np.abs(window @ np.exp(-2j * np.pi * frequency * time)))

    grid = np.linspace(low, high, 400)
    best = int(np.argmax([strength(f) for f in grid]))
    amplitude = 2 * strength(grid[best]) / np.hanning(len(time)).sum()
    if best in (0, len(grid) - 1) or amplitude < 1e-3 * np.abs(values - values.mean()).max():
        raise CodeFailure(f"no peak between {low:.6g} and {high:.6g} Hz")
    a, b = grid[best - 1], grid[best + 1]
    golden = 0.5 * (np.sqrt(5) - 1)
    for _ in range(60):
        c, d = b - golden * (b - a), a + golden * (b - a)
        a, b = (a, d) if strength(c) > strength(d) else (c, b)
    return float(0.5 * (a + b))


@measure
def cantilever_frequency(view: View) -> Measured:
    """Relative error of a frequency of a chain held at one end, from the spectrum of a column.

    Against the beam of Euler and Bernoulli between the first and the last centre, with the half
    element beyond at its tip. Options: `column`, `mode` (1 is the lowest).
    """
    chain, mode = chain_of(view), int(view.option("mode"))
    expected = cantilever_frequencies(mode, chain.length, chain.bending_stiffness,
                                      chain.mass / chain.spacing, chain.mass / 2)[mode - 1]
    time, values = _column(view)
    if time[-1] * expected < 8:
        raise CodeFailure("fewer than eight periods were seen")
    found = peak_frequency(time, values, 0.8 * expected, 1.25 * expected)
    return Measured(abs(found / expected - 1), f"{found:.7g} Hz, theory {expected:.7g} Hz")


@measure
def natural_frequency(view: View) -> Measured:
    """Relative error of a natural frequency (option `mode`, 1 is the lowest) that a code has solved
    for; as `cantilever_frequency`. A round beam has each of them twice."""
    chain, mode = chain_of(view), int(view.option("mode"))
    expected = cantilever_frequencies(mode, chain.length, chain.bending_stiffness,
                                      chain.mass / chain.spacing, chain.mass / 2)[mode - 1]
    found = np.sort(view.tested.history.get("frequency", np.zeros(0)))[2 * mode - 2:2 * mode]
    if len(found) < 2:
        raise CodeFailure(f"{view.tested.code} found no {2 * mode} frequencies")
    return Measured(float(np.abs(found / expected - 1).max()),
                    f"{found[0]:.7g} and {found[1]:.7g} Hz, theory {expected:.7g} Hz")


@measure
def tip_deflection_error(view: View) -> Measured:
    """Relative error of the tip's deflection under a force, against P L³ / 3 E I.

    Options: `column` (last row), `force` (N).
    """
    chain = chain_of(view)
    name, force = view.option("column"), float(view.option("force"))
    if name not in view.tested.history:
        raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
    found = float(view.tested.history[name][-1])
    expected = tip_deflection(force, chain.length, chain.bending_stiffness)
    return Measured(abs(found / expected - 1), f"{found:.9g} m, theory {expected:.9g} m")


@measure
def collapse_force(view: View) -> Measured:
    """Relative error of the load that a simply supported chain bears once it yields, against
    4 M_p / L, M_p = σ_y I / r.

    The mean over the last quarter of the run. Options: `column` (force), `against` (displacement),
    `between_hinges` (true: the law looks at the middle of a bond, so a hinge beside the loaded
    element lies half a spacing from it: 4 M_p / (L − spacing)).
    """
    chain, flow = chain_of(view), view.job.parameters.plasticity
    if flow is None:
        raise CodeFailure("nothing yields in this scene")
    moment = flow.yield_strain * chain.bending_stiffness / chain.radius
    less = chain.spacing if view.check.options.get("between_hinges") else 0.0
    expected = collapse_load(moment, chain.length - less)
    _, force = _column(view)
    last = np.abs(force[-len(force) // 4:])
    found, swing = float(last.mean()), float(np.ptp(last))
    if swing > 0.05 * expected:
        raise CodeFailure(f"the load still varies by {swing:.3g} N at the end")
    moved = np.abs(view.tested.history[view.option("against")])
    elastic = np.minimum(48 * chain.bending_stiffness / chain.length**3 * moved, expected)
    plot = Plot("chain loaded in its middle", "displacement, m", "load, N",
                [Series("beam theory, 4 M_p / L", moved, elastic, "k-", wide=True),
                 Series(view.check.code, moved, np.abs(force), "-")])
    return Measured(abs(found / expected - 1),
                    f"{found:.6g} N, theory {expected:.6g} N; varies by {swing:.2g} N", plot)
