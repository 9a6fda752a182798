# SPDX-License-Identifier: GPL-2.0-or-later
"""Bars that are pulled, pushed and torn: what their stress–strain curves say."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from compare.measures import measure
from compare.result import CodeFailure, Floats, Result
from compare.row import Measured, Plot, Series
from compare.runs import View
from compare.units import with_unit

#: Lasting strain at which a curve is said to yield (σ_0.2).
LASTING = 0.002
#: A bar is torn when this fraction of its largest stress is left.
LEFT_WHEN_TORN = 0.5
#: The elastic slope is fitted up to this fraction of the largest stress.
ELASTIC_SHARE = 0.2


def history_column(result: Result, name: str) -> Floats:
    """A column of the history; CodeFailure when it is not there or too short to tell anything."""
    if name not in result.history or len(result.history[name]) < 20:
        raise CodeFailure(f"{result.code} has no 20 rows of {name} in its history")
    return result.history[name]


@dataclass(frozen=True)
class Curve:
    """A tension test, row by row."""

    elongation: Floats  #: of the length between the grips
    strain: Floats  #: of the gauge section
    lateral: Floats  #: of the gauge section
    stress: Floats  #: engineering, Pa

    @property
    def young_modulus(self) -> float:
        """Slope of the beginning, Pa."""
        return float(np.polyfit(self.strain[self._elastic], self.stress[self._elastic], 1)[0])

    @property
    def poisson_ratio(self) -> float:
        """The section narrows by this for each unit it lengthens."""
        return -float(np.polyfit(self.strain[self._elastic], self.lateral[self._elastic], 1)[0])

    @property
    def _elastic(self) -> slice:
        end = int(np.argmax(self.stress > ELASTIC_SHARE * self.stress.max()))
        if end < 5:
            raise CodeFailure(f"{end} rows of the elastic beginning; 5 are needed")
        return slice(0, end)

    @property
    def yield_stress(self) -> float:
        """σ_0.2, Pa."""
        return crossing(self.strain, self.stress, self.young_modulus, 0.0, 0.0, 1)

    @property
    def peak_stress(self) -> float:
        """Largest stress, Pa."""
        return float(self.stress.max())

    @property
    def rupture_strain(self) -> float:
        """Elongation at which half of the largest stress is left."""
        peak = int(np.argmax(self.stress))
        torn = self.stress[peak:] < LEFT_WHEN_TORN * self.stress[peak]
        if not torn.any():
            raise CodeFailure(f"not torn at an elongation of {self.elongation[-1]:.3g}; "
                              f"{self.stress[-1] / self.stress[peak]:.3g} of the largest stress is "
                              "left")
        return float(self.elongation[peak + int(np.argmax(torn))])


def crossing(strain: Floats, stress: Floats, modulus: float, strain_0: float, stress_0: float,
              sign: int) -> float:
    """Stress where a curve has left the elastic line through a point by the lasting strain."""
    beyond = sign * (strain - strain_0 - (stress - stress_0) / modulus) - LASTING
    over = np.flatnonzero(beyond > 0)
    if not len(over) or over[0] == 0:
        raise CodeFailure("the curve does not leave the elastic line by 0.2 %")
    a, b = over[0] - 1, over[0]
    fraction = beyond[a] / (beyond[a] - beyond[b])
    return float(stress[a] + fraction * (stress[b] - stress[a]))


def curve_of(view: View) -> Curve:
    """The test in a history; options of the case: `grips` (names of the low and the high one) and
    `length` (m, of the bar; the grips are one mean diameter deep)."""
    result, options = view.tested, view.case.options
    between = options["length"] - 4 * float(view.job.specimen.radius.mean())
    low, high = (history_column(result, f"grip.{name}.displacement_x")
                 for name in options["grips"])
    return Curve((high - low) / between, history_column(result, "gauge.strain"),
                 history_column(result, "gauge.lateral_strain"),
                 history_column(result, "gauge.stress"))


FIGURES = {"young_modulus": ("E", 1e9, "GPa"), "poisson_ratio": ("ν", 1.0, ""),
           "yield_stress": ("σ_0.2", 1e6, "MPa"), "peak_stress": ("peak", 1e6, "MPa"),
           "rupture_strain": ("rupture", 1e-2, "%")}


@measure
def tension_figure(view: View) -> Measured:
    """Distance of a figure of a tension test from a target, of the mean over the group's specimens;
    of the worst of them with option `worst`.

    Options: `figure` of the test as `of` (young_modulus, poisson_ratio, yield_stress, peak_stress,
    rupture_strain), `target`; `place` and `half_width` put it into the plot, as parts of the target.
    """
    name, target = view.option("of"), float(view.option("target"))
    label, unit, words = FIGURES[name]
    values = np.array([getattr(curve_of(member), name) for member in view.members])
    options = view.check.options
    plot = None
    if "place" in options:
        place, half = float(options["place"]), float(options["half_width"]) / target
        across = np.array([place - 0.3, place + 0.3])
        low, high = np.full(2, 1 - half), np.full(2, 1 + half)
        seen = np.linspace(-0.12, 0.12, len(values)) if len(values) > 1 else np.zeros(1)
        plot = Plot(options.get("title", "tension test against its targets"), "",
                    "found / published",
                    [Series("wanted" if place == 1 else f"_{label}", across, high,
                            "0.75", band=low),
                     Series("mean", np.array([place]), values.mean(keepdims=True) / target, "kD",
                            joined=True),
                     Series(options.get("series", "specimens"), place + seen, values / target,
                            "C0o", joined=True)],
                    ticks={place: f"{label} {target / unit:.3g} {words}"})
    spread = f", from {values.min() / unit:.4g} to {values.max() / unit:.4g}" * (len(values) > 1)
    counted = values if options.get("worst") else values.mean(keepdims=True)
    return Measured(float(np.abs(counted - target).max()),
                    f"{label} = {values.mean() / unit:.4g} {words}{spread}", plot)


def _published(options: dict[str, Any]) -> list[Series]:
    """Marks of the published figures: yield and largest stress, the span of rupture strains."""
    given = options.get("published")
    if not given:
        return []
    modulus, low, high = given["young_modulus"], *given["rupture_strain"]
    top, bottom = given["peak_stress"] / 1e6, given["yield_stress"] / 1e6
    knee = 100 * given["yield_stress"] / modulus
    return [Series("table 3.7: E, as far as σ_y", np.array([0, knee]), np.array([0, bottom]), "k-",
                   wide=True),
            Series("table 3.7: σ_y", np.array([0, 100 * high]), np.full(2, bottom), "k:"),
            Series("table 3.7: σ_rupt, and rupture at 4 to 19 %",
                   np.array([100 * low, 100 * high]), np.full(2, top), "k|-")]


@measure
def tension_curve(view: View) -> Measured:
    """Spread of the group's stress–strain curves: mean of (largest − least) stress over the peak.

    Up to the first specimen's largest stress; drawn with the figures of the case's [options.published].
    """
    curves = [curve_of(member) for member in view.members]
    if len(curves) < 2:
        raise CodeFailure("a spread needs two specimens at least")
    last = min(float(c.elongation[np.argmax(c.stress)]) for c in curves)
    grid = np.linspace(0, last, 400)
    rows = np.array([np.interp(grid, c.elongation, c.stress) for c in curves])
    options = view.check.options
    plot = Plot(options.get("title", "tension to rupture"), "elongation, %", "stress, MPa",
                [*_published(view.case.options),
                 *(Series(f"{options.get('label', 'ours')}, {member.variant.name}",
                          100 * c.elongation, c.stress / 1e6, "-")
                   for member, c in zip(view.members, curves))])
    spread = float(np.mean(rows.max(axis=0) - rows.min(axis=0)) / rows.max())
    return Measured(spread, f"{len(curves)} specimens, to an elongation of {100 * last:.3g} %", plot)


def _first_rupture(result: Result) -> float:
    """The step of the last row before a bond broke."""
    broken = history_column(result, "broken_bonds")
    if not broken[-1] > 0:
        raise CodeFailure("no bond broke")
    return float(result.history["step"][int(np.argmax(broken > 0)) - 1])


def _shared(view: View) -> tuple[Floats, Floats, Floats]:
    """Steps that both codes have rows of, and the column of both there."""
    name = view.option("column")
    _, rows, others = np.intersect1d(view.tested.history["step"], view.other.history["step"],
                                     return_indices=True)
    a, b = history_column(view.tested, name)[rows], history_column(view.other, name)[others]
    return view.other.history["step"][others], a, b


@measure
def difference_before_rupture(view: View) -> Measured:
    """Largest difference of a column from the reference's before its first bond breaks, as part of
    the largest value. Option: `column`."""
    steps, a, b = _shared(view)
    until = steps <= _first_rupture(view.other)
    if until.sum() < 10:
        raise CodeFailure("fewer than ten rows before the first bond broke")
    scale = float(np.abs(b).max())
    name = view.option("column")
    plot = Plot(f"{name}, {view.variant.name}", "step", with_unit(name),
                [Series(view.check.reference, steps, b, wide=True),
                 Series(view.check.code, steps, a, "--")],
                below=[Series(view.check.code, steps[1:], np.abs(a - b)[1:] / scale + 1e-17)],
                below_label="difference / largest", below_log=True)
    return Measured(float(np.abs(a - b)[until].max()) / scale,
                    f"{int(until.sum())} rows, to step {steps[until][-1]:.0f}", plot)


@measure
def first_rupture_difference(view: View) -> Measured:
    """Steps between the last rows before a bond broke, in two codes."""
    found, wanted = _first_rupture(view.tested), _first_rupture(view.other)
    return Measured(abs(found - wanted), f"after step {found:.0f}")


@measure
def difference_after_rupture(view: View) -> Measured:
    """Mean difference of a column from the reference's after its first bond breaks, over the mean
    spread (largest less least) of the group's specimens there. Option: `column`."""
    name = view.option("column")
    own, rows = [], []
    fraction = np.linspace(0, 1, 400)
    for member in view.members:
        steps, a, b = _shared(member)
        grid = _first_rupture(member.other) + fraction * (
            steps[-1] - _first_rupture(member.other))
        own.append(np.abs(np.interp(grid, steps, a) - np.interp(grid, steps, b)).mean())
        rows.append(np.interp(fraction * steps[-1], steps, b))
    if len(rows) < 2:
        raise CodeFailure("a spread needs two specimens at least")
    spread = float(np.ptp(np.array(rows), axis=0).mean())
    return Measured(float(np.mean(own)) / spread,
                    f"mean difference {np.mean(own):.3g}, spread of {len(rows)} specimens "
                    f"{spread:.3g}")
