# SPDX-License-Identifier: GPL-2.0-or-later
"""Where no body keeps an error, or only at a high price: several packings of several sizes, whose
limit (Richardson's extrapolation) keeps it. The small runs belong to them, and cost nothing more."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Sequence

import numpy as np

from .foretold import LIKELY, Cost, ErrorModel
from .level import Level
from .pilots import Pilot, Pilots

MORE = 0.3  #: share of the packings of a level that are thought of as more of them at once
MOST_PACKINGS = 150  #: of one level
FINER = 2  #: levels beyond the small runs that are thought of
MEDIAN = 0.5
AIM = 0.93  #: of the error: figures of runs to come are not known
MORE_TIME = 0.4  #: of that of a series, for packings more where the limit is known worse than foreseen
FINER_CHECK = 2.0  #: times the elements of the finest level, of a check
CHECKED = 2  #: packings of it


@dataclass(frozen=True)
class Part:
    """Packings of one size."""

    factor: float  #: times the scene's own elements
    elements: float
    packings: int  #: in all
    made: int  #: of them, by the small runs
    cost: Cost  #: of one
    changes: dict[str, Any]  #: of the scene besides, by dotted keys


@dataclass(frozen=True)
class Series:
    """Runs whose limit has an error."""

    parts: list[Part]
    expected: float  #: of the limit: stays below it in half of all cases, a share of the scale
    promised: float  #: below it with a probability of LIKELY

    @property
    def seconds(self) -> float:
        """Of what is not there yet, by the clock."""
        return _seconds(self.parts)

    @property
    def processor(self) -> float:
        """The same, of the processor."""
        return sum((part.packings - part.made) * part.cost.processor for part in self.parts)

    def asked(self) -> list[Part]:
        """Those with packings."""
        return [part for part in self.parts if part.packings]


def _foreseen(model: ErrorModel, parts: Sequence[Part], probability: float) -> float:
    """Share that the limit of these would be known to."""
    asked = [part for part in parts if part.packings]
    after = model.posterior.foreseen(np.array([model.size(part.elements) for part in asked]),
                                     np.array([float(part.packings) for part in asked]))
    return after.half_width(probability) / model.scale + model.step_error


def _seconds(parts: Sequence[Part]) -> float:
    """By the clock, of what is not there yet."""
    return sum((part.packings - part.made) * part.cost.seconds for part in parts)


def _with_more(part: Part) -> Part:
    """Some packings more."""
    more = max(1, int(MORE * part.packings)) if part.packings else 2
    return replace(part, packings=part.packings + more)


def series_for(model: ErrorModel, parts: Sequence[Part], error: float, longest: float) -> Series:
    """Adds packings, of that level each time which narrows the limit most for its time, until the
    error is kept, or the next would take longer than `longest` s. Levels of no packings yet are those
    that may be thought of."""
    found, promised = list(parts), _foreseen(model, parts, LIKELY)
    while promised > AIM * error:
        best, narrowest, most = found, promised, 0.0
        for number, part in enumerate(found):
            if part.packings >= MOST_PACKINGS:
                continue
            other = [*found[:number], _with_more(part), *found[number + 1:]]
            if _seconds(other) > longest:
                continue
            narrower = _foreseen(model, other, LIKELY)
            gained = np.log(promised / narrower) / max(_seconds(other) - _seconds(found), 1e-9)
            if gained > most:
                best, narrowest, most = other, narrower, gained
        if best is found:
            break
        found, promised = best, narrowest
    return Series(found, _foreseen(model, found, MEDIAN), promised)


def rarer_heat(changes: dict[str, Any], ratio: float) -> dict[str, Any]:
    """Steps of heat of so many times the elements: they shrink faster than steps of motion."""
    every = changes.get("conduction.every", 1)
    return {"conduction.every": max(1, int(every * ratio**(-1 / 3)))} if every > 1 and ratio > 1 else {}


def parts_of(factors: Sequence[float], changes: Sequence[dict[str, Any]], levels: Sequence[Level],
             costs: Sequence[Cost], exponent: float, largest: float, growth: float) -> list[Part]:
    """Those of the small runs, and finer ones up to `largest` elements that may be thought of."""
    parts = [Part(factor, level.value, len(level.figures), len(level.figures), cost, changed)
             for factor, level, cost, changed in zip(factors, levels, costs, changes)]
    last = parts[-1]
    for number in range(1, FINER + 1):
        ratio = growth**number
        if last.elements * ratio <= largest:
            parts.append(Part(last.factor * ratio, last.elements * ratio, 0, 0,
                              last.cost.times(ratio, exponent),
                              {**last.changes, **rarer_heat(last.changes, ratio)}))
    return parts


@dataclass(frozen=True)
class Told:
    """What a series gave."""

    model: ErrorModel
    figure: float  #: the limit
    known: float  #: half of its interval, a share of the scale
    seconds: float  #: of the runs that were not there, by the clock
    processor: float
    finer: float | None = None  #: limit with a finer level


def _levels(pilots: Pilots, parts: Sequence[Part],
            runs: dict[tuple[float, int], Pilot]) -> list[Level]:
    """Runs what is not there yet."""
    levels = []
    for part in parts:
        for packing in range(part.packings):
            if (part.factor, packing) not in runs:
                runs[part.factor, packing] = pilots.run(part.factor, part.changes, packing)
        made = [runs[part.factor, packing] for packing in range(part.packings)]
        elements = float(np.mean([run.elements for run in made]))
        levels.append(Level(elements, elements**(-1 / 3), np.array([run.figure for run in made]),
                            float(np.mean([run.cost.seconds for run in made]))))
    return levels


def run_series(pilots: Pilots, series: Series, model: ErrorModel, error: float,
               check: bool = False) -> Told:
    """Runs a series, more packings where the limit is known worse than was foreseen, and for a check
    one finer level."""
    runs: dict[tuple[float, int], Pilot] = {}
    there = {(part.factor, packing) for part in series.parts for packing in range(part.made)}
    parts = series.asked()
    levels = _levels(pilots, parts, runs)
    now = ErrorModel(levels, model.scale, model.study, model.step_error)
    known = now.posterior.half_width(LIKELY) / model.scale + model.step_error
    if known > error >= series.promised:
        before = [replace(part, elements=level.value, made=part.packings)
                  for part, level in zip(parts, levels)]
        parts = series_for(now, before, error, MORE_TIME * series.seconds).asked()
        levels = _levels(pilots, parts, runs)
        now = ErrorModel(levels, model.scale, model.study, model.step_error)
    known = now.posterior.half_width(LIKELY) / model.scale + model.step_error
    new = [run for key, run in runs.items() if key not in there]
    finer = None
    if check:
        last = parts[-1]
        fine = _levels(pilots, [replace(last, factor=FINER_CHECK * last.factor, packings=CHECKED, changes={
            **last.changes, **rarer_heat(last.changes, FINER_CHECK)})], {})
        finer = ErrorModel([*levels, *fine], model.scale, model.study).posterior.limit
    return Told(now, now.posterior.limit, known, sum(run.cost.seconds for run in new),
                sum(run.cost.processor for run in new), finer)
