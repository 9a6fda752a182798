# SPDX-License-Identifier: GPL-2.0-or-later
"""Bars under loads that turn back: hysteresis, yield in reverse, cycles."""

from __future__ import annotations

import numpy as np

from compare.measures import measure
from compare.result import CodeFailure, Floats
from compare.row import Measured, Plot, Series
from compare.runs import View
from compare.tension import ELASTIC_SHARE, crossing, history_column


def _loop(view: View) -> tuple[Floats, Floats]:
    """Strain and stress of the gauge section."""
    return (history_column(view.tested, "gauge.strain"),
            history_column(view.tested, "gauge.stress"))


def _plot(view: View, strain: Floats, stress: Floats, marks: list[Series]) -> Plot:
    return Plot(view.check.options.get("title", "stress–strain loop"), "strain, %", "stress, MPa",
                [*marks, Series(view.variant.name, 100 * strain, stress / 1e6, "-")])


def _line(label: str, strain: Floats, stress: float) -> Series:
    return Series(label, 100 * np.array([strain.min(), strain.max()]), np.full(2, stress / 1e6),
                  "k:")


@measure
def reverse_yield(view: View) -> Measured:
    """Distance from 1 of the ratio of flow stresses: backwards over forwards, at the same strain.

    Forwards: the stress at which the load turns back; backwards: that at the opposite strain. Option
    `at_least`: how much greater than 1 the ratio must be instead.
    """
    strain, stress = _loop(view)
    lowest = int(np.argmin(strain))
    turn = int(np.argmax(strain[:lowest])) if lowest else 0
    if lowest < 20 or not stress[turn] > 0 > stress[lowest]:
        raise CodeFailure("the bar is not pulled, then pushed")
    if -strain[lowest] < 0.95 * strain[turn]:
        raise CodeFailure(f"pulled to {strain[turn]:.4g}, pushed to {strain[lowest]:.4g} only")
    start = slice(0, int(np.argmax(stress > ELASTIC_SHARE * stress[turn])))
    modulus = float(np.polyfit(strain[start], stress[start], 1)[0])
    forward, level = float(stress[turn]), -min(strain[turn], -strain[lowest])
    back = float(stress[turn + int(np.argmax(strain[turn:] <= level))])
    if not forward < 0.9 * modulus * strain[turn]:
        raise CodeFailure("the bar did not flow")
    try:
        offset = crossing(strain[turn:lowest], stress[turn:lowest], modulus, float(strain[turn]),
                          forward, -1)
        words = f"0.2 % of flow backwards at {offset / 1e6:.4g} MPa"
    except CodeFailure:
        words = "less than 0.2 % of flow backwards"
    ratio, at_least = -back / forward, view.check.options.get("at_least")
    error = abs(ratio - 1) if at_least is None else max(0.0, 1 + at_least - ratio)
    marks = [_line("_largest stress forwards", strain, s * forward) for s in (1, -1)]
    return Measured(error, f"{forward / 1e6:.4g} MPa forwards at a strain of {strain[turn]:.3g}, "
                    f"{back / 1e6:.4g} MPa at the opposite; {words}",
                    _plot(view, strain, stress, marks))


@measure
def cycles(view: View) -> Measured:
    """How later cycles differ from the first: largest relative difference.

    Options: `of` ("stress": the largest of a cycle; "lasting strain": what is left at its end),
    `period` (s). For the plot `yield_stress` (Pa, published).
    """
    strain, stress = _loop(view)
    number = np.floor(view.tested.history["time"] / float(view.option("period")) + 1e-6).astype(int)
    count = int(number.max())
    if count < 3:
        raise CodeFailure(f"{count} cycles; three are needed")
    kind = view.option("of")
    if kind == "stress":
        values = np.array([stress[number == n].max() for n in range(count)])
        unit, words = 1e6, "MPa"
    elif kind == "lasting strain":
        values = np.array([strain[number == n][-1] for n in range(count)])
        unit, words = 1e-2, "%"
    else:
        raise CodeFailure(f"of = {kind!r}; allowed: stress, lasting strain")
    marks = []
    if "yield_stress" in view.check.options:
        marks = [_line("table 3.7: σ_y", strain, view.check.options["yield_stress"])]
    return Measured(float(np.abs(values[1:] / values[0] - 1).max()),
                    f"{count} cycles, " + ", ".join(f"{v / unit:.4g}" for v in values)
                    + f" {words}", _plot(view, strain, stress, marks))
