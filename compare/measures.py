# SPDX-License-Identifier: GPL-2.0-or-later
"""What can be measured between a code's result and a reference; cases name these functions.

A measure takes the view of one variant and returns an error, to be held against the tolerance.
"""

from __future__ import annotations

from typing import Callable

import numpy as np

from compare.references import finite_difference_step
from compare.result import CodeFailure, Floats, Result
from compare.row import Measured, Plot, Series
from compare.runs import View
from compare.units import with_unit


MEASURES: dict[str, Callable[[View], Measured]] = {}


def measure(function: Callable[[View], Measured]) -> Callable[[View], Measured]:
    """Makes a function known to cases by its name."""
    MEASURES[function.__name__] = function
    return function


def _column(result: Result, step: int, name: str) -> Floats:
    columns = result.frame(step).columns
    if name not in columns:
        raise CodeFailure(f"{result.code} wrote no {name}")
    return columns[name]


@measure
def field_difference(view: View) -> Measured:
    """Largest difference of a field (option `field`) over all elements in the last frame.

    Relative to option `scale` (a number), or for positions to the largest displacement so far.
    """
    tested, other, name = view.tested, view.other, view.option("field")
    if tested.steps != other.steps or tested.time_step != other.time_step:
        raise CodeFailure(
            f"{tested.steps} steps of {tested.time_step} s in {tested.code}, "
            f"{other.steps} of {other.time_step} s in {other.code}")
    steps = sorted({f.step for f in tested.frames} & {f.step for f in other.frames})
    if tested.steps not in steps:
        raise CodeFailure(f"{tested.code} and {other.code} share no last frame")
    errors = []
    for step in steps:
        a, b = _column(tested, step, name), _column(other, step, name)
        if a.shape != b.shape:
            raise CodeFailure(f"{name} is {a.shape} in {tested.code}, {b.shape} in {other.code}")
        errors.append(float(np.abs(a - b).max()))
    scale = view.check.options.get("scale")
    if scale is None:
        last = _column(other, tested.steps, name)
        scale = float(np.linalg.norm(last - view.job.specimen.position, axis=1).max())
    if not scale > 0:
        raise CodeFailure("nothing moved, so there is no scale for the error")
    plot = Plot(f"difference of {name} from {other.code}", "step", "largest difference / scale",
                [Series(f"{tested.code}, {view.variant.name}", np.array(steps[1:]),
                        np.array(errors[1:]) / scale, "o-")], log_y=True)
    return Measured(errors[-1] / scale, f"scale {scale:.3g}", plot)


@measure
def history_difference(view: View) -> Measured:
    """Largest difference of a column of the history (option `column`) over the run.

    Relative to the reference's largest value; rows are matched by step number.
    """
    tested, other, name = view.tested, view.other, view.option("column")
    for result in (tested, other):
        if name not in result.history:
            raise CodeFailure(f"{result.code} has no column {name} in its history")
    _, rows, rows_other = np.intersect1d(tested.history["step"], other.history["step"],
                                         return_indices=True)
    if len(rows) < 2 or tested.history["step"][rows[-1]] != tested.steps:
        raise CodeFailure(f"{tested.code} and {other.code} share no rows to the end of the history")
    a, b = tested.history[name][rows], other.history[name][rows_other]
    scale = float(np.abs(b).max())
    if not scale > 0:
        raise CodeFailure(f"{name} is zero throughout in {other.code}")
    across = view.check.options.get("against", "step")
    plot = Plot(f"{name}, {view.variant.name}", with_unit(across), with_unit(name),
                [Series(other.code, other.history[across], other.history[name], wide=True),
                 Series(tested.code, tested.history[across], tested.history[name], "--")])
    return Measured(float(np.abs(a - b).max()) / scale, f"scale {scale:.3g}", plot)


def _value_name(view: View) -> str:
    return str(view.check.options.get("value", view.check.over[0]))


def _abscissa(view: View) -> float:
    """The value that a slope is taken over; "mean_radius" is the specimen's."""
    name = _value_name(view)
    if name == "mean_radius":
        return float(view.job.specimen.radius.mean())
    return float(view.variant.values[name])


@measure
def slope(view: View) -> Measured:
    """Distance of the slope of log(error) against log(value), over the group, from an order.

    Options: `of` (a measure, with its own options), `order` (1), `at_least` (true: a steeper slope
    is no error), `value` (another than the group's; "mean_radius" is the specimen's).
    """
    inner = MEASURES[view.option("of")]
    target = float(view.check.options.get("order", 1))
    points = [(_abscissa(member), inner(member).error) for member in view.members]
    x, y = np.array(sorted(points)).T
    if len(x) < 3 or not (y > 0).all():
        raise CodeFailure(f"a slope needs three variants with an error above 0; errors {y}")
    order = float(np.polyfit(np.log(x), np.log(y), 1)[0])
    short = target - order
    error = max(0.0, short) if view.check.options.get("at_least") else abs(short)
    plot = Plot(view.check.quantity, with_unit(_value_name(view)), "error, relative",
                [Series(view.check.code, x, y, "o"),
                 Series(f"order {target:g}", x, y[-1] * (x / x[-1]) ** target, ":")],
                log_x=True, log_y=True)
    return Measured(error, f"slope {order:.3f}; errors {', '.join(f'{e:.2g}' for e in y)}", plot)


def _history(view: View) -> tuple[Floats, Floats]:
    """Times, and a column (option `column`) or the sum of several ("a + b")."""
    result, names = view.tested, view.option("column").split(" + ")
    for name in names:
        if name not in result.history or len(result.history[name]) < 20:
            raise CodeFailure(f"{result.code} has no 20 rows of {name} in its history")
    values = np.sum([result.history[name] for name in names], axis=0)
    return result.history["time"], values


@measure
def history_swing(view: View) -> Measured:
    """Root mean square of a column of the history (option `column`), from its start on."""
    _, values = _history(view)
    return Measured(float(np.sqrt(np.mean((values - values[0])**2))))


@measure
def history_trend(view: View) -> Measured:
    """Rise of a straight line through a column (option `column`), from its start on, over the run /
    largest value."""
    time, values = _history(view)
    values = values - values[0]
    largest = float(np.abs(values).max())
    if not largest > 0:
        raise CodeFailure(f"{view.option('column')} is zero throughout")
    rise = float(np.polyfit(time / time[-1], values, 1)[0])
    plot = Plot(view.variant.name, "time, s", with_unit(view.option("column")),
                [Series(view.check.code, time, values, "-")])
    return Measured(abs(rise) / largest, f"largest value {largest:.3g}", plot)


@measure
def history_remainder(view: View) -> Measured:
    """What is left of a column at the end (option `column`) / largest value of another (`over`)."""
    _, values = _history(view)
    name = view.option("over")
    if name not in view.tested.history:
        raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
    largest = float(np.abs(view.tested.history[name]).max())
    if not largest > 0:
        raise CodeFailure(f"{name} is zero throughout")
    return Measured(abs(float(values[-1])) / largest, f"largest {name} {largest:.3g}")


@measure
def history_last(view: View) -> Measured:
    """Size of a column's last value (option `column`)."""
    return Measured(abs(float(_history(view)[1][-1])))


@measure
def history_drift(view: View) -> Measured:
    """Largest change of a column (option `column`) from its value at a time (option `after`, s) on,
    as part of that value. Needs option `steps` time steps from then on at least."""
    time, values = _history(view)
    held = time >= float(view.option("after"))
    steps = int(held.sum() and np.ptp(view.tested.history["step"][held]))
    if steps < int(view.option("steps")):
        raise CodeFailure(f"{steps} steps after {view.option('after')} s; {view.option('steps')} "
                          "are needed")
    first = float(values[held][0])
    if not abs(first) > 0.01 * np.abs(values).max():
        raise CodeFailure(f"{view.option('column')} is hardly anything there")
    return Measured(float(np.abs(values[held] - first).max()) / abs(first),
                    f"{steps} steps, value {first:.4g}")


@measure
def history_fall(view: View) -> Measured:
    """Largest fall of a column (option `column`) that must never fall / its largest value."""
    time, values = _history(view)
    largest = float(np.abs(values).max())
    if not largest > 0:
        raise CodeFailure(f"{view.option('column')} is zero throughout")
    plot = Plot(view.variant.name, "time, s", with_unit(view.option("column")),
                [Series(view.check.code, time, values, "-")])
    return Measured(max(0.0, -float(np.diff(values).min())) / largest,
                    f"rises to {largest:.3g}", plot)


@measure
def finite_differences(view: View) -> Measured:
    """Largest relative difference, per step, from central finite differences on the same lattice.

    Each frame is stepped once by finite differences and compared with the next, at elements whose
    neighbours all have six neighbours (elsewhere the lattice ends).
    """
    specimen, result = view.job.specimen, view.tested
    spacing = float(np.median(specimen.rest_length))
    index = np.rint((specimen.position - specimen.position.min(axis=0)) / spacing).astype(int)
    shape = tuple(index.max(axis=0) + 1)
    if np.prod(shape) != len(index):
        raise CodeFailure("the specimen is not a full cubic lattice")
    number = view.diffusivity * result.time_step / spacing**2
    imposed = np.zeros(shape, dtype=bool)
    for name in view.job.parameters.temperatures:
        imposed[tuple(index[specimen.sets[f"temperature.{name}"]].T)] = True
    where = ~imposed
    for axis in range(3):
        np.moveaxis(where, axis, 0)[[0, 1, -2, -1]] = False
    worst = 0.0
    stepped = 0
    for before, after in zip(result.frames, result.frames[1:]):
        if after.step != before.step + 1:
            continue
        grids = []
        for frame in (before, after):
            grid = np.empty(shape)
            grid[tuple(index.T)] = frame.columns["temperature"]
            grids.append(grid)
        expected = finite_difference_step(grids[0], number)
        worst = max(worst, float((np.abs(grids[1] - expected) / np.abs(expected))[where].max()))
        stepped += 1
    if stepped < 10:
        raise CodeFailure(f"{result.code} wrote {stepped} pairs of frames one step apart; need 10")
    inside = grids[1][where]
    if float(np.ptp(inside)) < 1.0:
        raise CodeFailure("no heat reached the compared elements, so nothing is tested")
    return Measured(worst, f"{stepped} steps, {int(where.sum())} elements")
