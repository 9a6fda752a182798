# SPDX-License-Identifier: GPL-2.0-or-later
"""What the front page says of one kind of problem: costs of accuracies, knobs, limits, other codes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Sequence

from benchmarks.accuracy_cost.page import percent, seconds, way
from benchmarks.accuracy_cost.plot import LEVELS
from benchmarks.accuracy_cost.results import Gain, Median, cheapest, front, gains, own
from benchmarks.accuracy_cost.study import Study

#: Columns of points.csv that are no labels of a point.
MEASURED = {"study", "reading", "runs", "error", "least_error", "most_error", "seconds",
            "least_seconds", "most_seconds", "set_up_seconds", "packing_seconds", "program_seconds",
            "on_front", "on_whole_front"}
LEAST_OFF = 0.005  #: error that a law keeps at any fineness, from which on it is told
FAR_NEARER = 3.0  #: times the error of the best law, likewise
ALIKE = 1.05  #: codes that agree in a run differ by round-off and by when they look at it
#: Words of a law of conduction as the thesis has it.
THESIS_LAW, THESIS_INTEGRATOR = "platonic", "explicit"

Points = Sequence[Median]
Measured = tuple[Study, Points]


def median_of(row: dict[str, str]) -> Median:
    """A row of points.csv."""
    labels = {key: value for key, value in row.items() if key not in MEASURED and value}
    set_up = row.get("set_up_seconds")
    return Median(row["study"], row["reading"], labels, int(row["runs"]), int(row["elements"]),
                  float(row["error"]), float(row["least_error"]), float(row["most_error"]),
                  float(row["seconds"]), float(row["least_seconds"]), float(row["most_seconds"]),
                  float(set_up) if set_up else None, float(row["packing_seconds"]),
                  float(row.get("program_seconds") or 0))


def code_of(m: Median) -> str:
    """That made a point."""
    return m.labels.get("code", "standalone")


def dependable(points: Points, level: float) -> Median | None:
    """The point of least time that keeps an error in every packing that was run, as do all finer bodies
    with the same settings: no lucky ones."""
    kept = []
    for m in points:
        same = [other for other in points if other.elements >= m.elements and all(
            other.labels.get(key) == value for key, value in m.labels.items() if key != "elements")]
        if all(other.most_error <= level for other in same):
            kept.append(m)
    return cheapest(kept, level)


def costs(studies: Sequence[Measured], link: dict[str, str], against: dict[str, str]) -> list[str]:
    """What each accuracy takes and costs. `link`, `against`: by study, where its page is and what it is
    held against."""
    words = [percent(level) for level in LEVELS]
    lines = ["| | error | " + " | ".join(f"to get {word}" for word in words) + " | the best |",
             "|---|---|" + "---|" * (len(LEVELS) + 1)]
    for study, points in studies:
        ours, cells = own(points), []
        for level in LEVELS:
            best = dependable(ours, level)
            cells.append(f"{way(study, best)}: **{seconds(best.whole_seconds)}**" if best else "–")
        nearest = min(ours, key=lambda m: m.most_error)
        lines.append(f"| [{study.title}]({link[study.name]}) | {study.error}{against[study.name]} | "
                     + " | ".join(cells) + f" | {percent(nearest.most_error)} in "
                     f"{seconds(nearest.whole_seconds)} |")
    return lines


def factor(value: float) -> str:
    """Two digits."""
    return f"× {float(f'{value:.2g}'):g}"


def _cheapest_knob(study: Study, points: Points) -> str:
    """The best bargain; empty where no knob gives less error."""
    helpful: list[Gain] = [gain for gain in gains(study, own(points)) if math.isfinite(gain.price)]
    if not helpful:
        return ""
    best = helpful[0]
    return f"{best.words} (error {factor(best.error_factor)}, time {factor(best.whole_factor)})"


def _stops(study: Study, points: Points) -> str:
    """The front's last step that pays."""
    ours = own(points)
    flags = front([(m.whole_seconds, m.error) for m in ours])
    line = sorted((m for m, on in zip(ours, flags) if on), key=lambda m: m.whole_seconds)
    stop = next((before for before, after in zip(line, line[1:])
                 if after.error > before.error / 2
                 and after.whole_seconds > 4 * before.whole_seconds), None)
    return f"stops beyond {percent(stop.error)} in {seconds(stop.whole_seconds)}" if stop else ""


def knobs(studies: Sequence[Measured]) -> list[str]:
    """A line for each study: its cheapest knob, and where effort stops to help."""
    lines = []
    for study, points in studies:
        words = [word for word in (_cheapest_knob(study, points), _stops(study, points)) if word]
        if words:
            lines.append(f"- {study.title}: {'; '.join(words)}.")
    return lines


def at_any_price(studies: Sequence[Measured]) -> list[str]:
    """Laws that stay off however fine the body is, where another comes far nearer."""
    lines = []
    for study, points in studies:
        ours = own(points)
        floors: dict[str, float] = {}
        off: dict[str, float] = {}
        for law in dict.fromkeys(m.labels["law"] for m in ours):
            sizes = sorted({m.elements for m in ours if m.labels["law"] == law})
            least = [min(m.error for m in ours if m.labels["law"] == law and m.elements == size)
                     for size in sizes]
            floors[law] = min(least)
            # Two sizes or more whose errors no longer halve: what is left is the law's own.
            if len(sizes) > 1 and least[-1] > max(LEAST_OFF, 0.5 * least[-2]):
                off[law] = min(least)
        told = [f"{law} {percent(least)}" for law, least in sorted(off.items(), key=lambda pair: pair[1])
                if least > FAR_NEARER * min(floors.values())]
        if told:
            lines.append(f"- {study.title}, at least: {'; '.join(told)}.")
    return lines


def against_the_source(studies: Sequence[Measured]) -> list[str]:
    """What the thesis does, platonic areas and explicit steps, beside the cheapest way to 1 %."""
    lines = []
    for study, points in studies:
        ours = dependable(own(points), 0.01)
        theirs = [m for m in own(points) if m.labels["law"] == THESIS_LAW
                  and m.labels.get("integrator") == THESIS_INTEGRATOR]
        if ours is None or not theirs:
            continue
        best = min(theirs, key=lambda m: m.error)
        lines.append(f"- {study.title}: the way of the thesis ({way(study, best)}) errs by "
                     f"{percent(best.error)} at least, in {seconds(best.whole_seconds)}; less than 1 % takes "
                     f"{seconds(ours.whole_seconds)} ({way(study, ours)}): "
                     f"{float(f'{best.whole_seconds / ours.whole_seconds:.2g}'):g} times less.")
    return lines


def _alike(one: Median, other: Median, but: tuple[str, ...]) -> bool:
    """Whether the labels of two points agree, but for some."""
    names = (set(one.labels) | set(other.labels)) - set(but)
    return all(one.labels.get(name) == other.labels.get(name) for name in names)


def codes(studies: Sequence[Measured]) -> list[str]:
    """Other codes: the same run in solidem, and what an error as small takes there with as many elements
    under the same law. Of the settings of a code those alone that no other of them beats."""
    rows = []
    for study, points in studies:
        for m in points:
            if code_of(m) == "standalone":
                continue
            beaten = any(_alike(m, other, ("step", "speed", "method", "integrator"))
                         and other.seconds < m.seconds and other.error <= ALIKE * m.error for other in points)
            twins = [other for other in own(points) if _alike(m, other, ("code",))]
            as_good = cheapest([other for other in own(points) if (other.elements, other.labels["law"])
                                == (m.elements, m.labels["law"])], ALIKE * m.error, lambda point: point.seconds)
            if not beaten and twins and as_good is not None:
                rows.append((study, m, twins[0], as_good))
    if not rows:
        return []
    lines = ["| | code | of | error | its steps | over solidem's | whole program over solidem's | as good in "
             "solidem | over that |", "|---|---|---|---|---|---|---|---|---|"]
    for study, m, same, good in rows:
        whole = (factor(m.program_seconds / same.program_seconds)
                 if m.program_seconds and same.program_seconds else "–")
        lines.append(f"| {study.title} | {code_of(m)} | {way(study, m).replace(f', {code_of(m)}', '')} | "
                     f"{percent(m.error)} | {seconds(m.seconds)} | {factor(m.seconds / same.seconds)} | {whole} | "
                     f"{way(study, good)}: {seconds(good.seconds)} | {factor(m.seconds / good.seconds)} |")
    return lines


def anchor(title: str) -> str:
    """Of a heading, as pages that show Markdown make it."""
    kept = "".join(sign for sign in title.lower() if sign.isalnum() or sign in " -_")
    return kept.replace(" ", "-")


def link_to(page: Path, docs: Path, study: Study) -> str:
    """From a page in `docs`."""
    return f"{page.relative_to(docs)}#{anchor(study.title)}"
