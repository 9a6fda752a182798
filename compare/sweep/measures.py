# SPDX-License-Identifier: GPL-2.0-or-later
"""What is read from the curve of a run: each measure is a function of time, x and y."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Callable

import numpy as np
from compare.result import Floats


@dataclass(frozen=True)
class Curve:
    """What a run has shown; for tests of materials x is strain and y stress, Pa."""

    time: Floats
    x: Floats
    y: Floats
    columns: dict[str, Floats]  #: all of the history

    def between(self, start: float, end: float) -> Curve:
        """The part between two times."""
        part = (self.time >= start - 1e-12 * end) & (self.time <= end * (1 + 1e-12))
        return Curve(self.time[part], self.x[part], self.y[part],
                     {name: column[part] for name, column in self.columns.items()})


def slope(curve: Curve, lower: float, upper: float) -> float:
    """Slope of the least-squares line where x lies between two values, before it first leaves."""
    past = np.nonzero(curve.x > upper)[0]
    part = slice(0, past[0] if len(past) else None)
    x, y = curve.x[part], curve.y[part]
    x, y = x[x >= lower], y[x >= lower]
    if len(x) < 3:
        return math.nan
    return float(np.polyfit(x, y, 1)[0])


def departure(curve: Curve, lower: float, upper: float, fraction: float) -> float:
    """x from which y stays further than a share below the line that fits it between two x."""
    part = (curve.x >= lower) & (curve.x <= upper)
    line = np.polyval(np.polyfit(curve.x[part], curve.y[part], 1), curve.x)
    near = np.nonzero((curve.y >= (1 - fraction) * line) & (curve.x > upper))[0]
    return float(curve.x[near[-1]]) if len(near) else math.nan


def peak(curve: Curve) -> float:
    """The largest y."""
    return float(curve.y.max())


def peak_place(curve: Curve) -> float:
    """x at the largest y."""
    return float(curve.x[curve.y.argmax()])


def fall_place(curve: Curve, fraction: float) -> float:
    """x at which y has fallen to a fraction of its peak, between the rows; not a number if never."""
    top = int(curve.y.argmax())
    level = fraction * curve.y[top]
    below = np.nonzero(curve.y[top:] < level)[0]
    if not len(below):
        return math.nan
    k = top + int(below[0])
    part = (curve.y[k - 1] - level) / (curve.y[k - 1] - curve.y[k])
    return float(curve.x[k - 1] + part * (curve.x[k] - curve.x[k - 1]))


def fall_length(curve: Curve, start: float, end: float) -> float:
    """Length in x of the fall from one fraction of the peak to another."""
    return fall_place(curve, end) - fall_place(curve, start)


def plateau(curve: Curve, fraction: float) -> float:
    """Length in x over which y is at least a fraction of its peak, from first to last."""
    high = curve.x[curve.y >= fraction * curve.y.max()]
    return float(high.max() - high.min())


def _cycle(curve: Curve, cycle: int, period: float) -> Curve:
    part = curve.between((cycle - 1) * period, cycle * period)
    whole = len(part.x) > 3 and curve.time[-1] >= cycle * period * (1 - 1e-6)
    return part if whole else Curve(part.time[:0], part.x[:0], part.y[:0], {})


def loop_area(curve: Curve, cycle: int, period: float) -> float:
    """∮ y dx of a cycle (from 1), by trapezes."""
    part = _cycle(curve, cycle, period)
    if not len(part.x):
        return math.nan
    return float(np.sum((part.y[1:] + part.y[:-1]) / 2 * np.diff(part.x)))


def loop_ratio(curve: Curve, cycle: int, before: int, period: float) -> float:
    """Area of a cycle over that of one before it."""
    return loop_area(curve, cycle, period) / loop_area(curve, before, period)


def loop_peak(curve: Curve, cycle: int, period: float) -> float:
    """The largest y of a cycle."""
    part = _cycle(curve, cycle, period)
    return float(part.y.max()) if len(part.y) else math.nan


def loop_slope(curve: Curve, cycle: int, period: float, fraction: float = 0.1) -> float:
    """Slope of y right after x has turned at its largest of a cycle: over a fraction of its span."""
    part = _cycle(curve, cycle, period)
    if not len(part.x):
        return math.nan
    top = int(part.x.argmax())
    span = part.x.max() - part.x.min()
    x, y = part.x[top:], part.y[top:]
    back = np.nonzero(x < part.x[top] - fraction * span)[0]
    end = int(back[0]) if len(back) else len(x)
    return float(np.polyfit(x[:end], y[:end], 1)[0]) if end >= 3 else math.nan


def value_at(curve: Curve, x: float) -> float:
    """y where x first reaches a value, between the rows; not a number if never."""
    past = np.nonzero(curve.x >= x)[0]
    if not len(past) or past[0] == 0:
        return math.nan
    k = int(past[0])
    part = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1])
    return float(curve.y[k - 1] + part * (curve.y[k] - curve.y[k - 1]))


def largest(curve: Curve, column: str) -> float:
    """The largest value of a column of the history; 0 where it is not there."""
    return float(curve.columns[column].max()) if column in curve.columns else 0.0


def ripple(curve: Curve, lower: float, upper: float) -> float:
    """Root mean square of y about a parabola through it, where x lies between two values."""
    part = (curve.x >= lower) & (curve.x <= upper)
    x, y = curve.x[part], curve.y[part]
    if len(x) < 6:
        return math.nan
    return float(np.sqrt(np.mean((y - np.polyval(np.polyfit(x, y, 2), x)) ** 2)))


MEASURES: dict[str, Callable[..., float]] = {
    "slope": slope, "departure": departure, "peak": peak, "peak_place": peak_place,
    "fall_place": fall_place, "fall_length": fall_length, "loop_ratio": loop_ratio,
    "plateau": plateau, "loop_area": loop_area, "loop_peak": loop_peak, "loop_slope": loop_slope,
    "value_at": value_at, "largest": largest, "ripple": ripple}


def measured(kind: str, curve: Curve, options: dict[str, Any]) -> float:
    """A measure of a curve."""
    return MEASURES[kind](curve, **options)
