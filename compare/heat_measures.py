# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of heat conduction: profiles against exact fields, sensors over several specimens."""

from __future__ import annotations

from typing import Any

import numpy as np

from compare.measures import measure
from compare.references import MovingDisc, moving_disc_temperature
from compare.result import CodeFailure, Floats, Frame
from compare.row import Measured, Plot, Series
from compare.runs import View
from compare.solutions import Solution, solution

ZERO_CELSIUS = 273.15  #: K


def _frame(view: View, exact: Solution) -> Frame:
    """The frame nearest to the option `fourier` (α t / L²)."""
    target = float(view.option("fourier"))
    frame = min(view.tested.frames, key=lambda f: abs(f.time / exact.time_scale - target))
    if abs(frame.time / exact.time_scale - target) > 0.02 * target:
        raise CodeFailure(f"{view.tested.code} wrote no frame near α t / L² = {target}")
    if "temperature" not in frame.columns:
        raise CodeFailure(f"{view.tested.code} wrote no temperature")
    return frame


@measure
def profile_error(view: View) -> Measured:
    """Largest error of a temperature profile against the exact field, as part of its largest step.

    Profile: the mean over the elements in each of `bins` (40) equal parts of the coordinate; the
    exact field is taken at the same elements. Options: `fourier` (α t / L²), `bins`; for the plot
    `colour`, and `first` (true: of the lines of a variant, the one that the legend names).
    """
    exact = solution(view.case.options)
    frame, count = _frame(view, exact), int(view.check.options.get("bins", 40))
    position = view.job.specimen.position
    field = exact.temperature(position, frame.time)
    part = np.clip((exact.coordinate(position, frame.time) * count).astype(int), 0, count - 1)
    members = np.bincount(part, minlength=count)
    if (members == 0).any():
        raise CodeFailure("a bin of the profile has no element")
    found = np.bincount(part, frame.columns["temperature"], count) / members
    mean = np.bincount(part, field, count) / members
    middle = (np.arange(count) + 0.5) / count
    fourier = frame.time / exact.time_scale
    time, options = f"αt/L² = {view.option('fourier')}", view.check.options
    colour, mark = options.get("colour", "C0"), view.variant.values.get("mark", ".")
    # A label that begins with _ stays out of the legend.
    name = view.variant.name if options.get("first", True) else f"_{view.variant.name}, {time}"
    plot = Plot(options.get("title", "profile"), exact.label, "temperature, K",
                [Series(f"exact, {time}", middle, mean, f"{colour}-"),
                 Series(name, middle, found, f"{colour}{mark}")],
                below=[Series(f"_{view.variant.name}, {time}", middle,
                              100 * np.abs(found - mean) / exact.scale, f"{colour}{mark}-")],
                below_label="error, % of the step", below_log=True)
    return Measured(float(np.abs(found - mean).max() / exact.scale),
                    f"αt/L² = {fourier:.4f}, at least {members.min()} elements a bin", plot)


@measure
def field_error(view: View) -> Measured:
    """Root mean square error of the elements' temperatures, as part of the largest step.

    Options: `fourier` (α t / L²).
    """
    exact = solution(view.case.options)
    frame = _frame(view, exact)
    error = frame.columns["temperature"] - exact.temperature(view.job.specimen.position, frame.time)
    return Measured(float(np.sqrt(np.mean(error**2))) / exact.scale,
                    f"largest {np.abs(error).max() / exact.scale:.2g}")


def _history(view: View) -> tuple[Floats, Floats]:
    """Times and the column of option `column`."""
    result, name = view.tested, view.option("column")
    if name not in result.history:
        raise CodeFailure(f"{result.code} has no column {name} in its history")
    return result.history["time"], result.history[name]


def _histories(view: View) -> tuple[Floats, Floats]:
    """Times (T,) and the column of each specimen of the group (S, T), in °C when in K."""
    found = [_history(member) for member in view.members]
    time = found[0][0]
    if len(found) < 2:
        raise CodeFailure("a spread needs two specimens at least")
    # Time steps differ from specimen to specimen; rows are read at the first one's times.
    rows = [np.interp(time, t, v) for t, v in found]
    if any(t[-1] < time[-1] * (1 - 2 / len(time)) for t, _ in found):
        raise CodeFailure("a specimen's history ends early")
    return time, np.array(rows) - ZERO_CELSIUS


@measure
def dispersion(view: View) -> Measured:
    """δ of Terreros 2013, section 2.5.2: mean over time of (largest − least) / largest, in °C.

    Over the specimens of the group. Options: `column`; for the plot `against` (a value of the
    variants), `title`, `label` and `style` of the line, `limit` and `limit_label` (a line across).
    """
    _, rows = _histories(view)
    most, least = rows.max(axis=0), rows.min(axis=0)
    spread = float(np.mean((most - least) / most))
    options = view.check.options
    plot = None
    if "against" in options:
        values = [v.values[options["against"]] for v in view.case.variants
                  if options["against"] in v.values]
        plot = Plot(options.get("title", f"dispersion, {options['column']}"), options["against"],
                    "δ, %", [Series(options.get("label", view.check.quantity),
                                    np.array([view.variant.values[options["against"]]]),
                                    np.array([100 * spread]), options.get("style", "o-"),
                                    joined=True)], log_x=True, log_y=True)
        if "limit" in options:
            plot.series.append(Series(options.get("limit_label", "limit"),
                                      np.array([min(values), max(values)]),
                                      np.full(2, 100 * options["limit"]), "k-"))
    return Measured(spread, f"{len(rows)} specimens", plot)


def _disc(options: dict[str, Any]) -> MovingDisc:
    try:
        return MovingDisc(**options["plate"])
    except (KeyError, TypeError, ValueError) as error:
        raise CodeFailure(f"[options.plate]: {error}") from error


def _series_at(view: View, time: Floats) -> Floats:
    """The exact series, °C, at the point of option `point`; kept for other checks."""
    plate, point = _disc(view.case.options), tuple(view.option("point"))
    key = ("series", point, time.tobytes())
    if key not in view.runs.kept:
        view.runs.kept[key] = moving_disc_temperature(
            plate, np.minimum(time, plate.duration), np.array([point]))[:, 0] - ZERO_CELSIUS
    kept: Floats = view.runs.kept[key]
    return kept


def _reference_at(view: View, time: Floats) -> Floats:
    """What the check's reference says at these times, °C."""
    if view.check.reference == "exact series":
        return _series_at(view, time)
    result = view.runs.result(view.option("reference_variant"), view.check.reference)
    name = view.check.options.get("reference_column", view.option("column"))
    if name not in result.history:
        raise CodeFailure(f"{result.code} has no column {name} in its history")
    return np.interp(time, result.history["time"], result.history[name]) - ZERO_CELSIUS


def _largest(view: View, time: Floats, found: Floats, right: Floats) -> tuple[float, str]:
    """Relative error where the difference is largest (Terreros 2013, section 2.5.2), and words."""
    difference = np.abs(found - right)
    worst = int(difference.argmax())
    scale = right.max() if view.check.options.get("relative_to") == "largest" else right[worst]
    return (float(difference[worst] / scale),
            f"largest difference {difference[worst]:.3g} K at {time[worst]:.3g} s; mean "
            f"{difference.mean() / right.mean():.2g} of the mean temperature")


def _curves(view: View, label: str, time: Floats, found: Floats, right: Floats,
            rows: Floats | None = None) -> Plot:
    name = view.check.options.get("title", view.option("column"))
    ours = Series(label, time, found, "-")
    if rows is not None:
        ours.y, ours.band = rows.max(axis=0), rows.min(axis=0)
    return Plot(name, "time, s", "temperature, °C",
                [Series(view.check.reference, time, right, "k-"), ours],
                below=[Series(label, time, found - right, "-")],
                below_label=f"less {view.check.reference}, K")


@measure
def error_of_mean(view: View) -> Measured:
    """Relative error of the mean of several specimens where it differs most from the reference.

    Reference: "exact series" of the moving disc, or a code, run in `reference_variant`, its
    `reference_column`. Options: `column`, `point` (x, y in m), `label`, `title`; `relative_to` =
    "largest": to the reference's largest value instead.
    """
    time, rows = _histories(view)
    mean, right = rows.mean(axis=0), _reference_at(view, time)
    error, words = _largest(view, time, mean, right)
    label = view.check.options.get("label", view.check.quantity)
    return Measured(error, words, _curves(view, label, time, mean, right, rows))


@measure
def history_error(view: View) -> Measured:
    """As `error_of_mean`, of a single run."""
    time, values = _history(view)
    right = _reference_at(view, time)
    error, words = _largest(view, time, values - ZERO_CELSIUS, right)
    label = view.check.options.get("label", view.check.code)
    return Measured(error, words, _curves(view, label, time, values - ZERO_CELSIUS, right))


@measure
def disc_heat(view: View) -> Measured:
    """Relative error of the heat that the moving disc has given at the end (option `column`)."""
    time, heat = _history(view)
    plate = _disc(view.case.options)
    exact = plate.power_density * np.pi * plate.disc_radius**2 * plate.thickness * time[-1]
    return Measured(abs(float(heat[-1] / exact) - 1), f"{heat[-1]:.6g} J of {exact:.6g} J")


@measure
def heat_balance(view: View) -> Measured:
    """Largest difference between thermal energy and heat received, as part of the latter."""
    history = view.tested.history
    for name in ("thermal_energy", "heat_input"):
        if name not in history:
            raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
    energy, heat = history["thermal_energy"], history["heat_input"]
    scale = float(np.abs(heat).max())
    if not scale > 0:
        raise CodeFailure("no heat was received")
    error = np.abs(energy - energy[0] - (heat - heat[0]))
    return Measured(float(error.max()) / scale, f"heat received {scale:.3g} J")
