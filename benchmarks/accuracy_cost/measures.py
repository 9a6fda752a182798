# SPDX-License-Identifier: GPL-2.0-or-later
"""The error of one run, read with the measures of compare/."""

from __future__ import annotations

from typing import Any

import numpy as np

import compare.heat_measures  # noqa: F401  (makes its measures known)
from benchmarks.accuracy_cost.known import Figure, Figures
from benchmarks.accuracy_cost.study import Reading, Study
from compare.case import Case, Check, Variant
from compare.codes.base import Job
from compare.measures import MEASURES, measure
from compare.references import MovingDisc, moving_disc_temperature
from compare.result import CodeFailure, Floats, Result
from compare.row import Measured
from compare.runs import CaseRuns, View

#: Times at which the series of the moving disc is summed, and its modes; between these times it is
#: read linearly. Both leave less than 1e-4 of the rise.
SERIES_TIMES, SERIES_MODES = 400, 400


class OneRun(CaseRuns):
    """One run that is over, in the form that measures look at."""

    def __init__(self, case: Case, job: Job, result: Result, kept: dict[Any, Any],
                 reference: Result | None = None, known: Figures | None = None):
        """`kept` is shared by all runs of a study; `known` is what no run gave."""
        self.case, self._job, self._result, self.kept = case, job, result, kept
        self._reference, self._known = reference, known or {}

    def known(self, name: str) -> Figure:
        """A figure that no run gave."""
        if name not in self._known:
            raise CodeFailure(f"no {name!r} is known; there are {', '.join(self._known) or 'none'}")
        return self._known[name]

    def job(self, variant: str) -> Job:
        """What the code was given."""
        return self._job

    def result(self, variant: str, code: str) -> Result:
        """What it brought back, or what the reference did."""
        if code == "reference":
            if self._reference is None:
                raise CodeFailure("the measure needs a reference; the study names none")
            return self._reference
        return self._result


def _series(view: View) -> tuple[Floats, Floats]:
    """Times and exact temperatures, K, at the point of option `point`."""
    plate, point = MovingDisc(**view.case.options["plate"]), tuple(view.option("point"))
    key = ("moving disc", repr(plate), point)
    if key not in view.runs.kept:
        time = np.linspace(0, plate.duration, SERIES_TIMES)
        view.runs.kept[key] = time, moving_disc_temperature(
            plate, time, np.array([point]), SERIES_MODES)[:, 0]
    found: tuple[Floats, Floats] = view.runs.kept[key]
    return found


@measure
def error_in_rise(view: View) -> Measured:
    """Largest difference of a sensor from the moving disc's series / largest rise at the point.

    Options: `column`, `point` (x, y in m).
    """
    name = view.option("column")
    if name not in view.tested.history:
        raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
    time, exact = _series(view)
    right = np.interp(view.tested.history["time"], time, exact)
    return Measured(float(np.abs(view.tested.history[name] - right).max() / np.ptp(exact)))


def _curve(view: View, result: Result) -> tuple[Floats, Floats]:
    """Columns `x` and `y` (options) of a history."""
    for name in (view.option("x"), view.option("y")):
        if name not in result.history:
            raise CodeFailure(f"{result.code} has no column {name} in its history")
    return result.history[view.option("x")], result.history[view.option("y")]


def _part(view: View, x: Floats) -> Floats:
    """Rows with x in [`from`, `to`] (options), as part of the largest |x|."""
    fraction = np.abs(x) / float(np.abs(x).max())
    rows: Floats = np.flatnonzero((fraction >= view.option("from")) & (fraction <= view.option("to")))
    if len(rows) < 5:
        raise CodeFailure(f"{len(rows)} rows of the history lie in the part to be measured; "
                          "5 are needed")
    return rows


@measure
def curve_error(view: View) -> Measured:
    """Largest difference of a curve from the reference's / the reference's largest value.

    Options: `x`, `y` (columns of the history), `from`, `to` (the part of x that counts). The
    reference is read between its rows.
    """
    x, y = _curve(view, view.tested)
    right_x, right_y = _curve(view, view.other)
    rows = _part(view, x)
    right = np.interp(x[rows], right_x, right_y)
    return Measured(float(np.abs(y[rows] - right).max() / np.abs(right_y).max()))


def slope_of(view: View, result: Result) -> float:
    """Of the straight line fitted to the part of a curve; of a body that was solved for at rest that
    through the origin."""
    x, y = _curve(view, result)
    if len(x) == 1:
        return float(y[0] / x[0])
    rows = _part(view, x)
    return float(np.polyfit(x[rows], y[rows], 1)[0])


@measure
def slope_error(view: View) -> Measured:
    """Relative difference of the slope of a curve from the reference's.

    Options as of curve_error; the slope is that of a straight line fitted to the part.
    """
    return Measured(abs(slope_of(view, view.tested) / slope_of(view, view.other) - 1))


def mean_of(view: View, result: Result) -> float:
    """Of `y` over a part of a curve."""
    x, y = _curve(view, result)
    return float(y[_part(view, x)].mean())


@measure
def mean_error(view: View) -> Measured:
    """Relative difference of the mean of `y` over a part of the curve; options as of curve_error.
    """
    return Measured(abs(mean_of(view, view.tested) / mean_of(view, view.other) - 1))


@measure
def end_error(view: View) -> Measured:
    """Relative difference of the last row of a column from its exact value.

    Options: `column`, `exact` (SI units; a multiple of the first row where `of_first` is true).
    """
    name = view.option("column")
    if name not in view.tested.history:
        raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
    values = view.tested.history[name]
    unit = values[0] if view.check.options.get("of_first") else 1.0
    return Measured(abs(float(values[-1] / unit) / view.option("exact") - 1))


def errors(study: Study, reading: Reading, job: Job, result: Result,
           kept: dict[Any, Any], reference: Result | None = None,
           known: Figures | None = None) -> dict[str, float]:
    """The reading's errors by name; CodeFailure when the result cannot be measured."""
    variant = Variant("run", (result.code,))
    case = Case(study.name, study.title, study.path, None, (variant,), (), options=study.options)
    runs = OneRun(case, job, result, kept, reference, known)
    found = {}
    for name, options in reading.options.items():
        check = Check(name, reading.measure, "A", result.code,
                      "reference" if reference else "exact", 1.0, "", options=options)
        found[name] = MEASURES[reading.measure](View(runs, check, variant)).error
        if not np.isfinite(found[name]):
            raise CodeFailure(f"{name} is {found[name]}")
    return found
