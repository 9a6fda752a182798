# SPDX-License-Identifier: GPL-2.0-or-later
"""The front page of accuracy and cost, from the tables of the studies:

    python3 -m benchmarks.accuracy_cost.front_page

reads every points.csv below docs/accuracy_cost/, effects.csv and advice.csv beside it, and writes
docs/accuracy_cost.md, a picture for each kind of problem, and the table of orders that `solidem advise`
reads (python/solidem/studies.csv). Every figure on the page is computed here.
"""

from __future__ import annotations

import csv
import math
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

from benchmarks.accuracy_cost.front_plot import draw_kind
from benchmarks.accuracy_cost.orders import Order, order_of, points_of, table, write_table
from benchmarks.accuracy_cost.known import Figure
from benchmarks.accuracy_cost.page import percent, reference_of, seconds
from benchmarks.accuracy_cost.results import Gain, Median, cheapest, front, gains
from benchmarks.accuracy_cost.study import Study, read_study

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs" / "accuracy_cost"
STUDIES = Path(__file__).with_name("studies")
LEVELS = (0.05, 0.01, 0.001)
#: Columns of points.csv that are no labels of a point.
MEASURED = {"study", "reading", "runs", "error", "least_error", "most_error", "seconds",
            "least_seconds", "most_seconds", "set_up_seconds", "packing_seconds", "program_seconds",
            "on_front", "on_whole_front"}
KINDS = {
    "heat": ("Heat", "against exact solutions"),
    "elastic": ("Elastic bodies", "as each study says"),
    "plastic": ("Plastic flow and rupture", "as each study says"),
    "contact": ("Contact", "as each study says"),
    "coupled": ("Heat and motion", "as each study says"),
    "central forces": ("Central forces", "of the time step and of the speed of pulling: the same body "
                       "pulled slowly, in fine steps"),
}


def median_of(row: dict[str, str]) -> Median:
    """A row of points.csv."""
    labels = {key: value for key, value in row.items() if key not in MEASURED and value}
    set_up = row.get("set_up_seconds")
    return Median(row["study"], row["reading"], labels, int(row["runs"]), int(row["elements"]),
                  float(row["error"]), float(row["least_error"]), float(row["most_error"]),
                  float(row["seconds"]), float(row["least_seconds"]), float(row["most_seconds"]),
                  float(set_up) if set_up else None, float(row["packing_seconds"]),
                  float(row.get("program_seconds") or 0))


def points_in_docs() -> dict[tuple[str, str], list[Median]]:
    """By study and reading."""
    found: dict[tuple[str, str], list[Median]] = defaultdict(list)
    for path in sorted(DOCS.rglob("points.csv")):
        for row in points_of(path):
            found[row["study"], row["reading"]].append(median_of(row))
    return found


def measured() -> dict[str, list[tuple[Study, list[Median]]]]:
    """Kind -> its studies, each with the points of its first reading."""
    rows = points_in_docs()
    found: dict[str, list[tuple[Study, list[Median]]]] = {kind: [] for kind in KINDS}
    for path in sorted(STUDIES.glob("*.toml")):
        study = read_study(path)
        points = rows.get((study.name, study.readings[0].name))
        if points and study.kind in found:
            found[study.kind].append((study, points))
    return {kind: studies for kind, studies in found.items() if studies}


def reference(study: Study) -> str:
    """What the first reading is held against, and how far that may be off; empty where the study's own
    words say all."""
    reading = study.readings[0]
    if reading.reference in study.known:
        rows = [row for path in sorted(DOCS.rglob("references.csv")) for row in csv_rows(path)
                if row["study"] == study.name and row["reference"] == reading.reference]
        figures = {row["value"]: Figure(float(row["in_si_units"]), float(row["own_error"] or "nan"),
                                        row["source"]) for row in rows}
        return f" Reference: {reference_of(study, reading, {reading.reference: figures})}."
    if reading.reference and not study.references[reading.reference].own_specimen:
        return f" Reference: {reference_of(study, reading, {})}."
    return ""


def own(points: list[Median]) -> list[Median]:
    """Those of the standalone program."""
    return [m for m in points if m.labels.get("code", "standalone") == "standalone"]


def way(study: Study, m: Median) -> str:
    """How a point is computed."""
    rule = {"code": "standalone", "instructions": "best", "precision": "double"}
    words = [f"{value} element{'' if value == '1' else 's'}" if key == "elements" else value for key, value in m.labels.items()
             if key in study.axes and rule.get(key) != value
             and not (key == "speed" and m.labels.get("solver"))]
    return ", ".join(words)


def dependable(points: list[Median], level: float) -> Median | None:
    """The point of least time that keeps an error in every packing that was run, as do all finer bodies
    with the same settings: no lucky ones."""
    kept = []
    for m in points:
        same = [other for other in points if other.elements >= m.elements and all(
            other.labels[key] == value for key, value in m.labels.items() if key != "elements")]
        if all(other.most_error <= level for other in same):
            kept.append(m)
    return cheapest(kept, level)


def costs(studies: list[tuple[Study, list[Median]]]) -> list[str]:
    """To get … take … it costs …"""
    runs = {m.runs for _, points in studies for m in own(points)}
    several = f"{min(runs)} to {max(runs)}" if len(runs) > 1 else f"{min(runs)}"
    lines = [f"Kept in every packing that was run ({several} of each point), and by all finer bodies with "
             "the same settings:", "", "| | to get | take | which errs by | set-up and steps |",
             "|---|---|---|---|---|"]
    for study, points in studies:
        for level in LEVELS:
            best = dependable(own(points), level)
            if best is None:
                nearest = min(own(points), key=lambda m: m.most_error)
                lines.append(f"| {study.title} | {percent(level)} | out of reach of what was run; "
                             f"nearest: {way(study, nearest)} | {percent(nearest.error)} | "
                             f"{seconds(nearest.whole_seconds)} |")
            else:
                lines.append(f"| {study.title} | {percent(level)} | {way(study, best)} | "
                             f"{percent(best.most_error)} | {seconds(best.whole_seconds)} |")
    return lines


def factor(value: float) -> str:
    """Two digits."""
    return f"× {float(f'{value:.2g}'):g}"


def knobs(studies: list[tuple[Study, list[Median]]]) -> list[str]:
    """Which is cheapest, and which do not help."""
    lines = []
    for study, points in studies:
        found: list[Gain] = gains(study, own(points))
        helpful = [gain for gain in found if math.isfinite(gain.price)]
        idle = [gain for gain in found if not math.isfinite(gain.price)
                and gain.whole_factor > 1.05]
        words = []
        if helpful:
            best = helpful[0]
            words.append(f"cheapest for less error: {best.words} (error {factor(best.error_factor)}, "
                         f"time {factor(best.whole_factor)})")
            if len(helpful) > 1:
                last = helpful[-1]
                words.append(f"dearest: {last.words} (error {factor(last.error_factor)}, time "
                             f"{factor(last.whole_factor)})")
        faster = [gain for gain in found if gain.error_factor < 1.1 and gain.whole_factor < 0.9]
        if faster:
            most = min(faster, key=lambda gain: gain.whole_factor)
            words.append(f"for less time: {most.words} (time {factor(most.whole_factor)})")
        if idle:
            words.append("no help: " + ", ".join(dict.fromkeys(gain.words for gain in idle)))
        lines.append(f"- {study.title}: {'; '.join(words) or 'one setting of each knob was run'}.")
    return lines


def limits(studies: list[tuple[Study, list[Median]]]) -> list[str]:
    """Where effort stops to help: the front's last step that pays, and laws that stay off."""
    lines = []
    for study, points in studies:
        ours = own(points)
        flags = front([(m.whole_seconds, m.error) for m in ours])
        line = sorted((m for m, on in zip(ours, flags) if on), key=lambda m: m.whole_seconds)
        stop = next((before for before, after in zip(line, line[1:])
                     if after.error > before.error / 2
                     and after.whole_seconds > 4 * before.whole_seconds), line[-1])
        words = [f"the best that was reached is {percent(line[-1].error)} in "
                 f"{seconds(line[-1].whole_seconds)} ({way(study, line[-1])})"]
        if stop is not line[-1]:
            words.append(f"beyond {percent(stop.error)} in {seconds(stop.whole_seconds)} four times the "
                         "time no longer halve the error")
        laws = {m.labels["law"] for m in ours}
        if len(laws) > 1:
            floors = {law: min(m.error for m in ours if m.labels["law"] == law) for law in laws}
            off = {law: least for law, least in sorted(floors.items(), key=lambda pair: pair[1])
                   if least > 0.005}
            if off:
                words.append("at any fineness that was run these err by more: " + ", ".join(
                    f"{law} {percent(least)}" for law, least in off.items()))
        lines.append(f"- {study.title}: {'; '.join(words)}.")
    return lines


def against_the_source(studies: list[tuple[Study, list[Median]]]) -> list[str]:
    """What the thesis does, platonic areas and explicit steps, beside the cheapest way to 1 %."""
    lines = []
    for study, points in studies:
        ours = dependable(own(points), 0.01)
        theirs = [m for m in own(points) if m.labels["law"] == "platonic"
                  and m.labels.get("integrator") == "explicit"]
        if ours is None or not theirs:
            continue
        best = min(theirs, key=lambda m: m.error)
        lines.append(f"- {study.title}: as in the thesis ({way(study, best)}) the error is "
                     f"{percent(best.error)} at least, in {seconds(best.whole_seconds)}; less than 1 % takes "
                     f"{seconds(ours.whole_seconds)} ({way(study, ours)}): "
                     f"{float(f'{best.whole_seconds / ours.whole_seconds:.2g}'):g} times less.")
    return ["Against the way of the thesis:", "", *lines, ""] if lines else []


def csv_rows(path: Path) -> list[dict[str, str]]:
    """Empty where there is none."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def effects() -> list[str]:
    """What each effect costs."""
    rows = csv_rows(DOCS / "effects.csv")
    if not rows:
        return []
    lines = ["## What each effect costs", "",
             "One scene, effects switched on one by one: time of a step over that without it (medians, and "
             "the range, of runs in turn; processor time, in LIGGGHTS wall time of the steps), bytes an element. *off again* is the same "
             "scene once more: how far such figures can be trusted on the machine that they were measured "
             "on. What a scene does not name has no column and no loop: 0 bytes ([effects.csv]"
             "(accuracy_cost/effects.csv)). `solidem explain` tells columns and cost of your scene on "
             "your machine.", "",
             "| code | of | effect | time of a step | from – to | bytes an element |", "|---|---|---|---|---|---|"]
    for row in rows:
        memory = row["more_bytes_per_element"]
        lines.append(f"| {row['code']} | {row['base']} | {row['effect']} | {factor(float(row['time_ratio']))} | "
                     f"{factor(float(row['least_ratio']))} – {factor(float(row['most_ratio']))} | "
                     f"{f'{float(memory):+.0f}' if memory else ''} |")
    return [*lines, ""]


def _span(rows: list[dict[str, str]], column: str) -> str:
    """Least and largest number of a column."""
    numbers = sorted({float(row[column]) for row in rows})
    return f"{numbers[0]:g}" if len(numbers) == 1 else f"{numbers[0]:g} to {numbers[-1]:g}"


def advice() -> list[str]:
    """How advice keeps its word."""
    rows = csv_rows(DOCS / "advice.csv")
    if not rows:
        return []
    # Where nothing that is allowed keeps either error, both may have the same that comes nearest.
    each = list({(row["scene"], row["promised"], row["error"]): row for row in rows}.values())
    kept, broken, open_ = (sum(row["verdict"] == verdict for row in each)
                           for verdict in ("kept", "broken", "not told"))
    near = sum(1 / 1.5 <= float(row["time_ratio"]) <= 1.5 for row in each)
    beyond = sum(row["reachable"] != "True" for row in rows)
    lines = ["## Whether advice keeps its word", "",
             "`solidem advise` ([command_line.md](command_line.md#how-fine-a-scene-has-to-be)) on scenes "
             "that no study contains: what was asked for, what was proposed (elements of one body; or the "
             "packings × elements of a series, whose limit is taken) and promised, and the error against the "
             "limit of other packings, which errs itself (±, 95 %: where that is more than the promise, kept means "
             "that both limits agree as well as was promised). A promise holds with a probability of 95 %, so one "
             "of twenty is broken by the packing that is run. "
             f"{kept} of {len(each)} promises were kept, {broken} broken"
             + (f"; of {open_} the reference is too coarse to tell" if open_ else "")
             + f". The time was within a factor 1.5 of the forecast in {near} of {len(each)} (processor time; "
             f"small runs, which take some 20 s, come before). In {beyond} of {len(rows)} rows nothing that was "
             f"allowed ({_span(rows, 'largest')} elements, {_span(rows, 'longest')} s) kept what was asked; there "
             "the promise is that of what comes nearest ([advice.csv](accuracy_cost/advice.csv)).", "",
             "| scene | asked | promised | proposed | error | reference | forecast | taken |",
             "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        promise = percent(float(row["promised"])) + ("" if row["reachable"] == "True" else ", all it can")
        proposed = row["elements"] if row["proposed"] == "body" else row["proposed"]
        lines.append(f"| {row['scene']} | {percent(float(row['asked']))} | {promise} | {proposed} | "
                     f"{percent(float(row['error']))}{'' if row['verdict'] == 'kept' else ', ' + row['verdict']} | "
                     f"± {percent(float(row['reference_known']))} | "
                     f"{seconds(float(row['foretold_seconds']))} | "
                     f"{seconds(float(row['taken_seconds']))} |")
    return [*lines, ""]


def orders(kinds: dict[str, list[tuple[Study, list[Median]]]]) -> dict[str, list[Order]]:
    """Of each kind; of heat for each law."""
    found: dict[str, list[Order]] = {}
    everything = points_in_docs()
    for kind, studies in kinds.items():
        if kind == "central forces":
            continue  # its errors are those of steps and speeds, not of fineness
        for study, _ in studies:
            if not study.orders:
                continue  # nor are those of a law, or of the scatter of packings
            # Advice is about runs, not about bodies solved for at rest.
            points = [m for m in everything[study.name, study.orders] if not m.labels.get("solver")]
            reading = next(r for r in study.readings if r.name == study.orders)
            compared = study.references.get(reading.reference)
            finer = compared.labels.get("elements") if compared else None
            reference = float(finer) if finer else math.inf
            laws = {m.labels["law"] for m in points} if kind == "heat" else {""}
            for law in sorted(laws):
                rows = [{"code": m.labels.get("code", "standalone"), "elements": str(m.elements),
                         "error": str(m.error), "seconds": str(m.whole_seconds)}
                        for m in points if law in ("", m.labels["law"])]
                if (one := order_of(study.name, law, rows, reference)) is not None:
                    found.setdefault(kind, []).append(one)
    return found


def pages() -> list[str]:
    """Links to what stands behind."""
    return [f"[{path.relative_to(DOCS)}](accuracy_cost/{path.relative_to(DOCS)})"
            for path in sorted(DOCS.rglob("page.md"))]


def text_of(kinds: dict[str, list[tuple[Study, list[Median]]]], rows: list[dict[str, Any]]) -> str:
    """The page."""
    lines = ["# What accuracy costs", "",
             "What error a simulation has, for how much time: of each kind of problem a picture, what 5 %, "
             "1 % and .1 % cost, which knob is cheapest, and where effort stops helping. Each point is the "
             "median of real runs on one core. For a scene of your own ask `solidem advise` "
             "([command_line.md](command_line.md#how-fine-a-scene-has-to-be)). Made by `python3 -m "
             "benchmarks.accuracy_cost.front_page` from the tables beside the pages behind: "
             + ", ".join(pages()) + ".", ""]
    for kind, studies in kinds.items():
        title, against = KINDS[kind]
        picture = f"front_{kind.replace(' ', '_')}.png"
        about = " ".join(f"*{study.title}*: {study.about} Error: {study.error}.{reference(study)}"
                         for study, _ in studies)
        lines += [f"## {title}", "", f"Errors {against}. {about}", "",
                  f"![error over time, {kind}](accuracy_cost/{picture})", "", *costs(studies), "",
                  "Knobs:", "", *knobs(studies), "", "Where effort stops:", "", *limits(studies), ""]
        if kind == "heat":
            lines += against_the_source(studies)
    lines += ["## At which order errors fall", "",
              "Over the size of elements, by the least error of each number of elements; `solidem advise` "
              "takes these as what it knows of a kind of scene before its own runs.", "",
              "| kind | law of conduction | order | spread | least error | time, as elements to the power | "
              "studies |", "|---|---|---|---|---|---|---|"]
    lines += [f"| {row['kind']} | {row['law'] or '–'} | {row['order']} | {row['spread']} | "
              f"{percent(float(row['least_error']))} | {row['time_exponent']} | {row['studies']} |"
              for row in rows]
    return "\n".join([*lines, "", *advice(), *effects()]).rstrip() + "\n"


def main() -> int:
    """2: there are no tables."""
    kinds = measured()
    if not kinds:
        print(f"error: no points.csv below {DOCS}; python3 -m benchmarks.accuracy_cost makes it",
              file=sys.stderr)
        return 2
    for kind, studies in kinds.items():
        draw_kind([(study.title, own(points)) for study, points in studies], KINDS[kind][0],
                  DOCS / f"front_{kind.replace(' ', '_')}.png")
    rows = table(orders(kinds))
    write_table(rows, ROOT / "python" / "solidem" / "studies.csv")
    (ROOT / "docs" / "accuracy_cost.md").write_text(text_of(kinds, rows), encoding="utf-8")
    print(ROOT / "docs" / "accuracy_cost.md")
    return 0


if __name__ == "__main__":
    sys.exit(main())
