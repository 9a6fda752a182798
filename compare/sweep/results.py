# SPDX-License-Identifier: GPL-2.0-or-later
"""Curves and measures of the points of a sweep, and what the checks say of them."""

from __future__ import annotations

import csv
import math
import statistics
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np
from compare.result import Floats
from compare.sweep.measures import Curve, measured
from compare.sweep.runner import Outcome
from compare.sweep.sweep import Axis, Check, Measure, Setting, Sweep


def read_history(path: Path) -> dict[str, Floats]:
    """The columns of a history.csv."""
    with path.open(encoding="utf-8", newline="") as file:
        names = next(csv.reader(file))
    rows = np.atleast_2d(np.loadtxt(path, delimiter=",", skiprows=1))
    return {name: rows[:, n] for n, name in enumerate(names)}


def _along(axis: Axis, columns: dict[str, Floats]) -> Floats:
    total = np.zeros(len(columns["time"]))
    for name, factor in axis.columns.items():
        total = total + factor * columns[name]
    return total


@dataclass(frozen=True)
class Reading:
    """A point that has run: its curve and its measures."""

    outcome: Outcome
    curve: Curve
    values: dict[str, float]


def read_point(sweep: Sweep, outcome: Outcome) -> Reading:
    """Curve and measures of a point; KeyError names a column that the history lacks."""
    assert outcome.folder is not None
    columns = read_history(outcome.folder / "run" / "history.csv")
    setting = outcome.point.setting
    curve = Curve(columns["time"], setting.x_factor * _along(sweep.x, columns),
                  setting.y_factor * _along(sweep.y, columns), columns)
    return Reading(outcome, curve,
                   {m.name: measured(m.kind, curve, m.options) for m in sweep.measures})


@dataclass(frozen=True)
class Group:
    """All specimens of one setting."""

    variation: str
    setting: Setting
    readings: tuple[Reading, ...]

    def values(self, measure: str) -> list[float]:
        """A measure of each specimen that has it."""
        found = [reading.values[measure] for reading in self.readings]
        return [value for value in found if math.isfinite(value)]

    def mean(self, measure: str) -> float:
        """Mean over the specimens; not a number when one lacks it."""
        values = self.values(measure)
        complete = values and len(values) == len(self.readings)
        return statistics.fmean(values) if complete else math.nan


def groups(sweep: Sweep, readings: Sequence[Reading]) -> list[Group]:
    """The readings by variation and setting, in the order of the sweep file."""
    return [Group(variation.name, setting,
                  tuple(r for r in readings if r.outcome.point.variation == variation.name and
                        r.outcome.point.setting is setting))
            for variation in sweep.variations for setting in variation.settings]


@dataclass(frozen=True)
class Verdict:
    """What came of a check."""

    check: Check
    passed: bool
    found: str


def _written(values: Sequence[float], measure: Measure) -> str:
    return ", ".join(f"{value / measure.scale:.4g}" for value in values) + f" {measure.unit}"


def judge(sweep: Sweep, check: Check, found: Sequence[Group]) -> Verdict:
    """Whether a measure does what is expected when the setting changes."""
    measure = next(m for m in sweep.measures if m.name == check.measure)
    own = [group for group in found if group.variation == check.variation]
    means = [group.mean(check.measure) for group in own]
    words, options = _written(means, measure), check.options
    if not own or not all(math.isfinite(value) for value in means):
        return Verdict(check, False, f"{words}: not everywhere there")
    pairs = list(zip(means, means[1:]))
    least = float(options.get("least", 0))  # relative change that counts
    if check.expects == "rises":
        return Verdict(check, bool(pairs) and all(b > a + least * abs(a) for a, b in pairs), words)
    if check.expects == "falls":
        return Verdict(check, bool(pairs) and all(b < a - least * abs(a) for a, b in pairs), words)
    spread = (max(means) - min(means)) / abs(statistics.fmean(means))
    if check.expects == "moves":
        return Verdict(check, spread > least, f"{words}: over {100 * spread:.3g} %")
    if check.expects == "hardly goes":
        # The exponent of the power of the parameter that the measure goes with.
        first, last = options["of"][0], options["of"][-1]
        power = (math.log(max(means) / min(means))) / abs(math.log(last / first))
        return Verdict(check, power <= options["power"],
                       f"{words}: power {power:.2g} (at most {options['power']:g})")
    if check.expects == "stays":
        within = float(options["within"])
        return Verdict(check, len(means) > 1 and spread <= within,
                       f"{words}: within {100 * spread:.3g} % (at most {100 * within:g} %)")
    values = [value for group in own for value in group.values(check.measure)]
    if check.expects == "above":
        return Verdict(check, min(values) > options["lower"] * measure.scale,
                       f"{words}; above {options['lower']:g}")
    if check.expects == "scatters less":
        return _scatters_less(check, own)
    if check.expects == "falls over":
        return _falls_over(sweep, check, own)
    if check.expects in ("between", "printed"):
        lower, upper = options["lower"] * measure.scale, options["upper"] * measure.scale
        text = (f"{min(values) / measure.scale:.4g} to {max(values) / measure.scale:.4g} "
                f"{measure.unit}; source {options['lower']:g} to {options['upper']:g}")
        return Verdict(check, check.expects == "printed" or
                       lower <= min(values) <= max(values) <= upper, text)
    if check.expects == "same curve":
        return _same_curve(check, own)
    raise ValueError(f"a check cannot expect {check.expects!r}")


def _scatters_less(check: Check, own: Sequence[Group]) -> Verdict:
    """Whether specimens differ less in a measure than in another, relative to the means."""
    def scatter(name: str) -> float:
        values = [value for group in own for value in group.values(name)]
        return statistics.stdev(values) / abs(statistics.fmean(values))
    other = check.options["than"]
    if any(len(group.values(name)) < 2 for group in own for name in (check.measure, other)):
        return Verdict(check, False, "fewer than two specimens have both")
    mine, theirs = scatter(check.measure), scatter(other)
    return Verdict(check, mine < theirs, f"{100 * mine:.2g} %; {other}: {100 * theirs:.2g} %")


def _falls_over(sweep: Sweep, check: Check, own: Sequence[Group]) -> Verdict:
    """Whether measures of one setting fall one after another."""
    names = [check.measure, *check.options["then"]]
    group = next(g for g in own if g.setting.label == check.options["setting"])
    values = [group.mean(name) for name in names]
    measure = next(m for m in sweep.measures if m.name == check.measure)
    return Verdict(check, all(b < a for a, b in zip(values, values[1:])),
                   _written(values, measure))


def _same_curve(check: Check, own: Sequence[Group]) -> Verdict:
    """Whether the curves of all settings agree with those of the first, specimen by specimen, up to
    a place on x; relative to the largest y there."""
    worst, until = 0.0, float(check.options["until"])
    for group in own[1:]:
        for first, other in zip(own[0].readings, group.readings):
            if len(first.curve.x) != len(other.curve.x):
                return Verdict(check, False, "the curves have different numbers of rows")
            part = first.curve.x <= until
            scale = np.abs(first.curve.y[part]).max()
            worst = max(worst, float(np.abs(first.curve.y - other.curve.y)[part].max() / scale),
                        float(np.abs(first.curve.x - other.curve.x)[part].max() / until))
    within = float(check.options["within"])
    return Verdict(check, len(own) > 1 and worst <= within,
                   f"largest difference {worst:.2e} (at most {within:g})")


def table(sweep: Sweep, found: Sequence[Group]) -> list[list[str]]:
    """Rows of the measures: mean, and least and largest where there are several specimens."""
    names = [f"{m.name}, {m.unit}" if m.unit else m.name for m in sweep.measures]
    rows = [["what varies", "", "specimens", *names]]
    for group in found:
        cells = []
        for m in sweep.measures:
            values = [v / m.scale for v in group.values(m.name)]
            if not values:
                cells.append("–")
            elif len(group.readings) == 1 or max(values) == min(values):
                cells.append(f"{values[0]:.4g}")
            else:
                missing = len(group.readings) - len(values)
                cells.append(f"{statistics.fmean(values):.4g} "
                             f"({min(values):.4g}–{max(values):.4g})"
                             + (f", {missing} none" if missing else ""))
        title = next(v.title for v in sweep.variations if v.name == group.variation)
        rows.append([title, group.setting.label, str(len(group.readings)), *cells])
    return rows
