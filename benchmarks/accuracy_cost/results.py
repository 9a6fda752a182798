# SPDX-License-Identifier: GPL-2.0-or-later
"""Medians of repetitions, the Pareto front, and what each knob gives for its time."""

from __future__ import annotations

import math
import statistics
from collections import defaultdict
from dataclasses import dataclass, replace
from typing import Callable, Sequence

from benchmarks.accuracy_cost.runs import Run
from benchmarks.accuracy_cost.study import Move, Study

#: An error that changes by less than this factor counts as the same.
SAME = 1.1


@dataclass(frozen=True)
class Median:
    """All repetitions of one point, read in one way."""

    study: str
    reading: str
    labels: dict[str, str]
    runs: int
    elements: int
    error: float
    least_error: float
    most_error: float
    seconds: float  #: of the steps
    least_seconds: float
    most_seconds: float
    set_up_seconds: float | None
    packing_seconds: float
    program_seconds: float = 0.0  #: of the code from its start to its end
    on_front: bool = False  #: no other point of the reading is both as fast and as accurate
    on_whole_front: bool = False  #: the same with the set-up counted, among points that tell it

    @property
    def whole_seconds(self) -> float:
        """Steps and set-up; infinite when the set-up is not told."""
        return math.inf if self.set_up_seconds is None else self.seconds + self.set_up_seconds


@dataclass(frozen=True)
class Gain:
    """What a move of a knob does, over all pairs of points that differ in it alone."""

    words: str
    pairs: int
    error_factor: float  #: median of error after / before
    least_factor: float
    most_factor: float
    steps_factor: float  #: median of the time of the steps after / before
    whole_factor: float  #: the same with the set-up

    @property
    def price(self) -> float:
        """Factor in whole time for half the error; 1 when less error takes no more time; infinite
        when the error hardly falls."""
        if self.error_factor > 1 / SAME:
            return math.inf
        if self.whole_factor <= 1:
            return 1.0
        return float(self.whole_factor ** (math.log(2) / -math.log(self.error_factor)))


def own(points: Sequence[Median]) -> list[Median]:
    """Those of the standalone program on one core."""
    return [m for m in points if m.labels.get("code", "standalone") == "standalone"]


def on_one_core(points: Sequence[Median]) -> list[Median]:
    """Those of all codes that took no more."""
    return [m for m in points if not m.labels.get("code", "").endswith("-2")]


def front(points: Sequence[tuple[float, float]]) -> list[bool]:
    """For each (time, error): whether no other is at least as good in both and better in one.

    Points that are equal in both are on the front together.
    """
    best, flags = math.inf, [False] * len(points)
    last: tuple[float, float] | None = None
    for n in sorted(range(len(points)), key=lambda n: points[n]):
        if not math.isfinite(points[n][0]):
            continue
        if points[n][1] < best or points[n] == last:
            flags[n], best, last = True, points[n][1], points[n]
    return flags


def _median(runs: list[Run], reading: str) -> Median:
    error = [run.error(reading) for run in runs]
    seconds = [run.seconds for run in runs]
    set_up = [run.set_up_seconds for run in runs if run.set_up_seconds is not None]
    return Median(
        runs[0].study, reading, runs[0].labels, len(runs), runs[0].elements,
        statistics.median(error), min(error), max(error),
        statistics.median(seconds), min(seconds), max(seconds),
        statistics.median(set_up) if set_up else None,
        statistics.median(run.packing_seconds for run in runs),
        statistics.median(run.program_seconds for run in runs))


def medians(runs: list[Run]) -> list[Median]:
    """The median of each point and reading; the fronts of what took one core are marked within each study
    and reading."""
    groups: dict[tuple[str, str, tuple[tuple[str, str], ...]], list[Run]] = defaultdict(list)
    for run in runs:
        for reading in run.errors:
            groups[run.study, reading, tuple(run.labels.items())].append(run)
    found = [_median(group, reading) for (_, reading, _), group in sorted(groups.items())]
    marked = []
    for key in dict.fromkeys((m.study, m.reading) for m in found):
        members = [m for m in found if (m.study, m.reading) == key]
        single = on_one_core(members)
        steps = front([(m.seconds, m.error) for m in single])
        whole = front([(m.whole_seconds, m.error) for m in single])
        marked += [replace(m, on_front=a, on_whole_front=b) for m, a, b in zip(single, steps, whole)]
        marked += [m for m in members if m not in single]
    return marked


def cheapest(points: Sequence[Median], error: float,
             time: Callable[[Median], float] = lambda m: m.whole_seconds) -> Median | None:
    """The point of least time whose error is at most this; None when there is none."""
    reached = [m for m in points if m.error <= error and math.isfinite(time(m))]
    return min(reached, key=time, default=None)


def _pairs(study: Study, move: Move, points: Sequence[Median]) -> list[tuple[Median, Median]]:
    """Points before and after a move that agree in every other axis."""
    # The labels that an axis gives may be several; all of them change with its setting.
    moved = {key for value in study.axes[move.axis] for key in value.labels}
    others: dict[tuple[tuple[str, str], ...], dict[str, Median]] = defaultdict(dict)
    for m in points:
        # Tables of earlier runs may lack an axis.
        if move.axis in m.labels:
            others[tuple((k, v) for k, v in m.labels.items() if k not in moved)][m.labels[move.axis]] = m
    return [(group[a], group[b]) for group in others.values() for a, b in move.pairs
            if a in group and b in group]


def gains(study: Study, points: Sequence[Median]) -> list[Gain]:
    """What each knob of a study gives, the best bargain first; knobs without a pair are left out.

    `points`: those of one study and one reading; the standalone program on one core is what knobs are tried on,
    unless another code, or two threads, is the knob.
    """
    found = []
    for move in study.moves:
        # A point that is its own reference errs by nothing, which tells nothing.
        tried = points if move.axis == "code" else own(points)
        pairs = [(before, after) for before, after in _pairs(study, move, tried)
                 if before.error > 0 and after.error > 0]
        if not pairs:
            continue
        errors = [after.error / before.error for before, after in pairs]
        found.append(Gain(
            move.words, len(pairs), statistics.median(errors), min(errors), max(errors),
            statistics.median(after.seconds / before.seconds for before, after in pairs),
            statistics.median(after.whole_seconds / before.whole_seconds
                              for before, after in pairs)))
    # Prices that differ by some hundredths do not differ; then the larger effect comes first.
    return sorted(found, key=lambda g: (round(g.price, 1), g.error_factor, g.whole_factor))
