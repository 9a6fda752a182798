# SPDX-License-Identifier: GPL-2.0-or-later
"""The page in plain words: every figure in it is computed from the runs."""

from __future__ import annotations

import itertools
import math
import statistics
from collections import Counter
from pathlib import Path
from typing import Sequence

from benchmarks.accuracy_cost.document import Document
from benchmarks.accuracy_cost.known import Figure, Figures
from benchmarks.accuracy_cost.plot import LEVELS, draw
from benchmarks.accuracy_cost.results import SAME, Gain, Median, cheapest, gains, on_one_core
from benchmarks.accuracy_cost.runs import Omission
from benchmarks.accuracy_cost.study import Reading, Study


def percent(error: float) -> str:
    """An error with two digits."""
    return f"{100 * error:.2g} %"


def seconds(time: float | None) -> str:
    """A time with two digits."""
    return "not told" if time is None or not math.isfinite(time) else f"{float(f'{time:.2g}'):g} s"


def way(study: Study, m: Median, but: str = "") -> str:
    """How a point is computed, all `but` one axis; what is the rule, and the law of a study that has but
    one, goes without saying."""
    rule = {"code": "standalone", "instructions": "best", "precision": "double", "masses": "true masses"}
    if len(study.axes.get("law", [])) == 1:
        rule["law"] = m.labels["law"]
    shown = [axis for axis in study.axes if axis != but and axis in m.labels and m.labels[axis] != rule.get(axis)
             and not (axis == "speed" and m.labels.get("solver"))]  # a body at rest knows no speed
    words = [f"{m.labels[k]} element{'' if m.labels[k] == '1' else 's'}" if k == "elements" else m.labels[k]
             for k in shown]
    return ", ".join(words)


def _costs(study: Study, m: Median) -> list[str]:
    """A way, its error and its times."""
    return [way(study, m), percent(m.error), seconds(m.seconds), seconds(m.set_up_seconds),
            seconds(m.packing_seconds)]


def _levels(document: Document, study: Study, points: Sequence[Median]) -> None:
    """What each level of accuracy costs."""
    document.heading(3, f"What {', '.join(percent(e) for e in LEVELS[:-1])} and "
                        f"{percent(LEVELS[-1])} cost")
    rows = []
    for level in LEVELS:
        by_steps = cheapest(points, level, lambda m: m.seconds)
        by_whole = cheapest(points, level)
        if by_steps is None:
            best = min(points, key=lambda p: p.error)
            rows.append([percent(level), "not reached, nearest", *_costs(study, best)])
        elif by_whole is None or by_whole == by_steps:
            rows.append([percent(level), "steps", *_costs(study, by_steps)])
        else:
            rows.append([percent(level), "steps alone", *_costs(study, by_steps)])
            rows.append([percent(level), "set-up and steps", *_costs(study, by_whole)])
    document.table(["error at most", "least time of", "way", "error", "steps", "set-up",
                    "packing and calibration, once"], rows)
    laws = [v.labels["law"] for v in study.axes["law"]]
    table = []
    for law in laws:
        own = [m for m in points if m.labels["law"] == law]
        if not own:
            continue
        row, best = [law], min(own, key=lambda p: p.error)
        for level in LEVELS:
            m = cheapest(own, level)
            row.append("not reached" if m is None else
                       f"{seconds(m.whole_seconds)} ({way(study, m, but='law')})")
        table.append([*row, f"{percent(best.error)} ({best.labels['elements']} elements)"])
    document.paragraph("Each law by itself, set-up and steps:")
    document.table(["law", *(f"{percent(e)}" for e in LEVELS), "least error of all"], table)


def _factor(x: float) -> str:
    return f"× {float(f'{x:.2g}'):g}"


def _price(g: Gain) -> str:
    if not math.isfinite(g.price):
        return "–"
    return "none" if g.price == 1 else _factor(g.price)


def _knobs(document: Document, found: list[Gain]) -> None:
    """Which knob is cheapest."""
    document.heading(3, "Which knob is cheapest")
    better = [g for g in found if math.isfinite(g.price)]
    same = [g for g in found if 1 / SAME < g.error_factor <= SAME]
    worse = [g for g in found if g.error_factor > SAME]
    sentences = [
        f"{'For less error the cheapest is' if n == 0 else 'Next comes'} {g.words}: the error goes "
        f"{_factor(g.error_factor)}, the time {_factor(g.whole_factor)}."
        for n, g in enumerate(better[:3])]
    faster = sorted((g for g in same if g.whole_factor < 1 / SAME), key=lambda g: g.whole_factor)
    if faster:
        sentences.append(f"For less time at the same error: {faster[0].words}; the time goes "
                         f"{_factor(faster[0].whole_factor)}.")
    idle = [g.words for g in same if g.whole_factor > SAME]
    if idle:
        sentences.append("These cost time and move the error little, because it comes from "
                         f"elsewhere: {'; '.join(idle)}.")
    document.paragraph(" ".join(sentences))
    document.table(
        ["knob", "error", "from – to", "steps", "set-up and steps", "time for half the error",
         "pairs"],
        [[g.words, _factor(g.error_factor),
          f"{_factor(g.least_factor)} – {_factor(g.most_factor)}", _factor(g.steps_factor),
          _factor(g.whole_factor), _price(g), str(g.pairs)]
         for g in [*better, *same, *worse]])
    document.paragraph(
        "Medians over all pairs of points that differ in this knob alone; × 1 is no change, time "
        "for half the error counts the set-up. The range shows where a knob works: while the error "
        "comes from the law or the size of the elements, a finer step cannot help.")


def _codes(document: Document, study: Study, points: Sequence[Median]) -> None:
    """The same points in other codes."""
    def rest(m: Median) -> tuple[tuple[str, str], ...]:
        return tuple((k, v) for k, v in m.labels.items() if k != "code")
    own = {rest(m): m for m in points if m.labels.get("code") == "standalone"}
    rows = []
    for m in points:
        if m.labels.get("code", "standalone") == "standalone" or rest(m) not in own:
            continue
        base = own[rest(m)]
        rows.append([m.labels["code"], way(study, base), percent(m.error),
                     percent(base.error), seconds(m.seconds), seconds(base.seconds),
                     f"{m.seconds / base.seconds:.3g}"])
    if rows:
        document.heading(3, "The same in other codes")
        document.table(["code", "way", "error", "error of the standalone program",
                        "steps", "steps of the standalone program", "times as long"], rows)


def _reading(document: Document, study: Study, points: Sequence[Median], picture: Path) -> None:
    """What one reading of the runs says: picture, levels, knobs."""
    draw(study, points, picture)
    document.picture(picture, f"error against wall time, {study.title}, {points[0].reading}")
    _levels(document, study, on_one_core(points))
    _knobs(document, gains(study, points))


def _readings(document: Document, study: Study, points: Sequence[Median]) -> None:
    """What other readings of the same runs give, those without a picture of their own."""
    first = {tuple(m.labels.items()): m for m in points if m.reading == study.readings[0].name}
    for reading in study.readings[1:]:
        words = []
        for law in (v.labels["law"] for v in study.axes["law"]):
            factors = [m.error / first[tuple(m.labels.items())].error for m in points
                       if m.reading == reading.name and m.labels["law"] == law
                       and first[tuple(m.labels.items())].error > 0]
            if factors and not reading.panel:
                words.append(f"{_factor(statistics.median(factors))} ({law})")
        if words:
            document.paragraph(f"Read by “{reading.name}” in place of “{study.readings[0].name}”, "
                               f"the same runs have other errors, at no cost: {', '.join(words)}.")


def _panels(document: Document, study: Study, points: Sequence[Median], folder: Path) -> None:
    """Other readings that have a picture of their own."""
    for number, reading in enumerate(study.readings[1:], 2):
        own = [m for m in points if m.reading == reading.name]
        if reading.panel and own:
            document.heading(2, f"{study.title}: {reading.name}")
            _reading(document, study, own, folder / f"{study.name}_{number}.png")


def _front(document: Document, study: Study, points: Sequence[Median]) -> None:
    document.heading(3, "The Pareto front")
    document.paragraph("No other point is both faster and more accurate than these.")
    document.table(["steps", "error", "from – to", "way", "set-up", "front with set-up too"],
                   [[seconds(m.seconds), percent(m.error),
                     f"{percent(m.least_error)} – {percent(m.most_error)}", way(study, m),
                     seconds(m.set_up_seconds), "yes" if m.on_whole_front else ""]
                    for m in sorted(points, key=lambda m: m.seconds) if m.on_front])


def _left_out(document: Document, study: Study, omissions: list[Omission]) -> None:
    document.heading(3, "What is left out")
    items = []
    for rule, count in study.left_out():
        where = "; ".join(f"{key} {' | '.join(values)}" for key, values in rule.where.items())
        unless = "; ".join(f"{k} {' | '.join(v)}" for k, v in rule.unless.items())
        items.append(f"{where}{f' (but not {unless})' if unless else ''} "
                     f"({count} combinations): {rule.why.rstrip('.')}.")
    items += list(study.not_covered)
    items += [f"Run fewer times ({rule.repetitions}): "
              f"{'; '.join(f'{k} ' + ' | '.join(v) for k, v in rule.where.items())}: {rule.why.rstrip('.')}."
              for rule in study.rules if rule.repetitions]
    document.items(items)
    document.paragraph("Runs that failed or were refused:" if omissions
                       else "No run failed, none was refused.")
    if omissions:
        counted = Counter((", ".join(f"{k} {v}" for k, v in o.labels.items()), o.reason)
                          for o in omissions)
        document.items([f"{name} ({number} times): {reason}"
                        for (name, reason), number in counted.items()])


def own_error(figure: Figure) -> str:
    """In words."""
    if math.isnan(figure.error):
        return "its own error is not told"
    return f"own error {percent(figure.error)}" if figure.error else "as given"


def _known(study: Study, reading: Reading, figures: Figures) -> str:
    """Values in SI units and their own errors; where they come from once for those that follow each other."""
    names = [n for n in dict.fromkeys(str(options["value"]) for options in reading.options.values())
             if n in figures]
    words = []
    for source, group in itertools.groupby(names, lambda name: figures[name].source):
        found = ", ".join(f"{n} = {figures[n].value:.5g} ({own_error(figures[n])})" for n in group)
        words.append(f"{found}: {source}")
    return "; ".join(words) or "what could not be found out"


def reference_of(study: Study, reading: Reading, known: dict[str, Figures]) -> str:
    """What a reading is held against, and how far that may be off."""
    if reading.reference in study.known:
        return _known(study, reading, known.get(reading.reference, {}))
    if not reading.reference:
        return "what is exact"
    reference = study.references[reading.reference]
    solved = any(value.labels.get("solver") for axis, word in reference.labels.items()
                 for value in study.axes.get(axis, []) if value.labels[axis] == word)
    words = ", ".join(f"{value} elements" if key == "elements" else value
                      for key, value in reference.labels.items()
                      if value != "standalone" and not (solved and key == "speed"))
    if reference.own_specimen:
        return f"the same packing ({words}): what its elements err by is in both"
    return f"a run of one finer body ({words}), which errs itself: a difference, no error"


def _references(document: Document, study: Study, known: dict[str, Figures]) -> None:
    """What each reading is held against; values in SI units."""
    document.items([f"“{reading.name}” is held against {reference_of(study, reading, known)}."
                    for reading in study.readings])


def write_page(folder: Path, studies: list[Study], points: list[Median], omissions: list[Omission],
               machine: list[str], known: dict[str, dict[str, Figures]] | None = None) -> None:
    """Writes page.md, index.html and a picture for each study into a folder."""
    document = Document("What accuracy costs in time")
    document.paragraph(
        "Each point is the median of real runs, one at a time on one core (of codes whose name ends in -2 on two), "
        "in shuffled order; a repetition has a specimen of its own. Time is the wall time of the steps, as each run's "
        "summary tells it, without looking at results and writing them. Apart stand the set-up "
        "(reading, bonds or tessellation, stable step), and the packing of the specimen with the "
        "calibration of its bonds, if the solid is given: both are made once and shared by all runs. "
        "runs.csv has every run, points.csv the medians, references.csv what no run gave.")
    document.items(machine)
    for study in studies:
        own = [m for m in points if m.study == study.name]
        document.heading(2, study.title)
        document.paragraph(f"{study.about} Error: {study.error}.")
        _references(document, study, (known or {}).get(study.name, {}))
        main = [m for m in own if m.reading == study.readings[0].name]
        if main:
            _reading(document, study, main, folder / f"{study.name}.png")
            _readings(document, study, own)
            _codes(document, study, main)
            _front(document, study, main)
        _left_out(document, study, [o for o in omissions if o.study == study.name])
        _panels(document, study, own, folder)
    document.write(folder)
