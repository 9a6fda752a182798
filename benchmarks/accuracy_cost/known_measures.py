# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors of a run against what is known without one: option `value` names the figure of [known.NAME]."""

from __future__ import annotations

import numpy as np

from benchmarks.accuracy_cost.known import swing
from benchmarks.accuracy_cost.measures import OneRun, mean_of, slope_of
from compare.measures import measure
from compare.result import CodeFailure, Floats
from compare.row import Measured
from compare.runs import View
from compare.slender_beams import peak_frequency
from compare.tension import curve_of

#: Bounds, over the frequency that is known, between which a peak of the spectrum is looked for.
LOWEST, HIGHEST = 0.75, 1.35


def _right(view: View) -> float:
    assert isinstance(view.runs, OneRun)
    return view.runs.known(view.option("value")).value


@measure
def slope_against(view: View) -> Measured:
    """Of the slope of a curve: stiffness, modulus, Poisson's ratio (with `sign = -1`).

    Options: as of slope_error.
    """
    found = view.check.options.get("sign", 1) * slope_of(view, view.tested)
    return Measured(abs(found / _right(view) - 1), f"{found:.6g}")


@measure
def mean_against(view: View) -> Measured:
    """Of the mean of `y` over a part of a curve.

    Options: as of curve_error.
    """
    found = mean_of(view, view.tested)
    return Measured(abs(found / _right(view) - 1), f"{found:.6g}")


@measure
def tension_against(view: View) -> Measured:
    """Of a figure of a tension test, option `of`: young_modulus, poisson_ratio, yield_stress, peak_stress,
    rupture_strain; the study's [options] as of tension_figure."""
    found = float(getattr(curve_of(view), view.option("of")))
    return Measured(abs(found / _right(view) - 1), f"{found:.6g}")


def _solved(view: View) -> Floats:
    """Frequencies of bending that were solved for, Hz; those along y and z are two."""
    history = view.tested.history
    aside = np.asarray(history["mode_y"] + history["mode_z"])
    found: Floats = history["frequency"][(aside > 0.2) & (aside > history["mode_x"])]
    return found


@measure
def frequency_against(view: View) -> Measured:
    """Of the frequency of bending number `mode` (1 is the lowest).

    Of a run from the spectrum of `column`, where it is strongest between .75 and 1.35 times what is known;
    of vibrations that were solved for the mean of those along y and z.
    """
    right, mode = _right(view), int(view.option("mode"))
    if len(view.tested.history.get("frequency", ())):
        solved = _solved(view)
        if len(solved) < 2 * mode:
            raise CodeFailure(f"{len(solved)} frequencies of bending were found; {2 * mode} are needed")
        found = float(solved[2 * mode - 2:2 * mode].mean())
    else:
        name = view.option("column")
        if name not in view.tested.history:
            raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
        found = peak_frequency(view.tested.history["time"], view.tested.history[name],
                               LOWEST * right, HIGHEST * right)
    return Measured(abs(found / right - 1), f"{found:.6g} Hz")


@measure
def swing_against(view: View) -> Measured:
    """Of the first swing of `column`: option `of` is "largest" or "back"."""
    name = view.option("column")
    if name not in view.tested.history:
        raise CodeFailure(f"{view.tested.code} has no column {name} in its history")
    found = swing(view.tested.history["time"], view.tested.history[name])[view.option("of")]
    return Measured(abs(found / _right(view) - 1), f"{found:.6g}")


@measure
def rise_against(view: View) -> Measured:
    """Of the rise of temperature of the section between `lower` and `upper` (m, along x) when its
    logarithmic strain has reached `strain`: mean by the volumes of its cells, which the prepared
    specimen tells."""
    result, history = view.tested, view.tested.history
    strain = np.abs(np.log1p(history["gauge.strain"]))
    if strain.max() < view.option("strain"):
        raise CodeFailure(f"a strain of {view.option('strain')} is not reached, only "
                          f"{strain.max():.4g}")
    x = view.job.specimen.position[:, 0]
    inside = (x > view.option("lower")) & (x < view.option("upper"))
    weight = view.job.specimen.column("conduction/volume")[inside]
    means = np.array([np.average(frame.columns["temperature"][inside], weights=weight)
                      for frame in result.frames])
    when = float(np.interp(view.option("strain"), strain, history["time"]))
    rise = float(np.interp(when, [frame.time for frame in result.frames], means)) - means[0]
    return Measured(abs(rise / _right(view) - 1), f"{rise:.5g} K")


@measure
def concentration_against(view: View) -> Measured:
    """Of the mean stress along x beside a hole over that of a section without one: elements count by
    volume, the section bears the force of a grip.

    Options: `grip`, `section` (m²), `middle` (x, y of the hole, m), `radius` (of the hole, m), `patch`
    (along x from the middle, along y from the hole, m).
    """
    frame, options = view.tested.frames[-1].columns, view.option
    if "stress" not in frame:
        raise CodeFailure(f"{view.tested.code} wrote no stress")
    x, y = np.abs(view.job.specimen.position[:, :2] - options("middle")).T
    along, across = options("patch")
    near = (x < along) & (y > options("radius")) & (y < options("radius") + across)
    if near.sum() < 3:
        raise CodeFailure(f"{near.sum()} elements lie beside the hole; 3 are needed")
    mean = float(np.average(frame["stress"][near, 0], weights=view.job.specimen.radius[near]**3))
    force = float(view.tested.history[f"grip.{options('grip')}.force_x"][-1])
    found = mean / (abs(force) / options("section"))
    return Measured(abs(found / _right(view) - 1), f"{found:.5g}, {near.sum()} elements")
