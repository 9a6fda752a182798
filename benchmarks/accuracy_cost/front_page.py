# SPDX-License-Identifier: GPL-2.0-or-later
"""The front page of accuracy and cost, from the tables of the studies:

    python3 -m benchmarks.accuracy_cost.front_page

reads every points.csv below docs/accuracy_cost/, effects.csv and advice.csv there, and writes
docs/accuracy_cost.md, a picture for each kind of problem, the pages of codes, effects and advice behind it,
and the table of orders that `solidem advise` reads (python/solidem/studies.csv). Every figure on these pages
is computed here.
"""

from __future__ import annotations

import csv
import math
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

from benchmarks.accuracy_cost import front_words as words
from benchmarks.accuracy_cost.front_behind import advice_page, advice_words, effects_page, effects_words
from benchmarks.accuracy_cost.front_plot import draw_kind
from benchmarks.accuracy_cost.front_words import Measured, link_to, median_of
from benchmarks.accuracy_cost.orders import Order, order_of, points_of, table, write_table
from benchmarks.accuracy_cost.page import percent
from benchmarks.accuracy_cost.results import Median, own
from benchmarks.accuracy_cost.study import Study, read_study

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs" / "accuracy_cost"
STUDIES = Path(__file__).with_name("studies")
KINDS = {
    "heat": "Heat",
    "elastic": "Elastic bodies",
    "plastic": "Plastic flow and rupture",
    "contact": "Contact",
    "coupled": "Heat and motion",
    "central forces": "Central forces",
}


def points_in_docs() -> dict[tuple[str, str], list[Median]]:
    """By study and reading."""
    found: dict[tuple[str, str], list[Median]] = defaultdict(list)
    for path in sorted(DOCS.rglob("points.csv")):
        for row in points_of(path):
            found[row["study"], row["reading"]].append(median_of(row))
    return found


def measured() -> dict[str, list[Measured]]:
    """Kind -> its studies, each with the points of its first reading."""
    rows = points_in_docs()
    found: dict[str, list[Measured]] = {kind: [] for kind in KINDS}
    for path in sorted(STUDIES.glob("*.toml")):
        study = read_study(path)
        points = rows.get((study.name, study.readings[0].name))
        if points and study.kind in found:
            found[study.kind].append((study, points))
    return {kind: studies for kind, studies in found.items() if studies}


def pages_of_studies() -> dict[str, Path]:
    """Study -> the page behind that tells of it."""
    return {row["study"]: path.with_name("page.md") for path in sorted(DOCS.rglob("points.csv"))
            for row in points_of(path)}


def csv_rows(path: Path) -> list[dict[str, str]]:
    """Empty where there is none."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def against(study: Study) -> str:
    """How far what the first reading is held against may be off itself; empty where it is exact."""
    reading = study.readings[0]
    if reading.reference in study.known:
        values = {options.get("value") for options in reading.options.values()}
        errors = [float(row["own_error"]) for path in sorted(DOCS.rglob("references.csv"))
                  for row in csv_rows(path) if row["study"] == study.name
                  and row["reference"] == reading.reference and row["value"] in values and row["own_error"]]
        return f" (± {percent(max(errors))})" if any(errors) else ""
    if reading.reference and not study.references[reading.reference].own_specimen:
        return " (a difference)"
    return ""


def orders(kinds: dict[str, list[Measured]]) -> dict[str, list[Order]]:
    """Of each kind; of heat for each law."""
    found: dict[str, list[Order]] = {}
    everything = points_in_docs()
    for kind, studies in kinds.items():
        for study, _ in studies:
            if not study.orders:
                continue  # errors of a law, of the scatter of packings, of steps and speeds alone
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


def _kind(kind: str, studies: list[Measured], pages: dict[str, Path]) -> list[str]:
    """Picture, costs, knobs."""
    picture = f"accuracy_cost/front_{kind.replace(' ', '_')}.png"
    links = {study.name: link_to(pages[study.name], DOCS.parent, study) for study, _ in studies}
    held = {study.name: against(study) for study, _ in studies}
    return [f"## {KINDS[kind]}", "", f"![error over time, {kind}]({picture})", "",
            *words.costs(studies, links, held), "", "The cheapest knob for less error, and where effort stops:", "",
            *words.knobs(studies), ""]


def _codes(kinds: dict[str, list[Measured]]) -> list[str]:
    """The page of other codes."""
    rows = words.codes([pair for studies in kinds.values() for pair in studies])
    return ["# The same cases in other codes", "",
            "Each row is a run of another code beside the same run of solidem, on one core (names that end in "
            "-2: on two): time of the steps over solidem's, time of the whole program over that of solidem's (from "
            "its start to its end: reading, setting up, stepping, writing; packing and calibration, which all "
            "codes share, apart), and the run of solidem that takes least time of those with as many elements, "
            "the same law and an error as small, whatever its other settings. Made by `python3 -m "
            "benchmarks.accuracy_cost.front_page` from the points of the studies.", "", *rows]


def text_of(kinds: dict[str, list[Measured]]) -> str:
    """The front page."""
    pages = pages_of_studies()
    behind = ", ".join(f"[{name}]({page.relative_to(DOCS.parent)})" for name, page in sorted(
        {page.parent.name.replace("_", " "): page for page in pages.values()}.items()))
    lines = ["# What accuracy costs", "",
             "What error a simulation has, for how much time. Each point is the median of real runs, several "
             "packings of each, set-up and steps on one core; *to get 5 %* stands the cheapest that kept it in "
             "every packing that was run, and in all finer bodies with the same settings (–: out of reach of "
             "what was run). Effort stops where four times the time no longer halve the error. Behind each name "
             "is its study, with reference, every point and every knob: "
             f"{behind}. For a scene of your own ask `solidem advise` "
             "([command_line.md](command_line.md#how-fine-a-scene-has-to-be)). `python3 -m "
             "benchmarks.accuracy_cost.front_page` makes this page from the tables beside those pages.", ""]
    for kind, studies in kinds.items():
        lines += _kind(kind, studies, pages)
        if kind == "heat" and (source := words.against_the_source(studies)):
            lines += ["Against the way of the thesis:", "", *source, ""]
    off = [line for studies in kinds.values() for line in words.at_any_price(studies)]
    lines += ["## What no effort gives", "",
              "What a law, or a model, errs by itself stays however fine bodies and steps are:", "", *off, ""]
    lines += ["## Other codes", "",
              "What the same runs take in LIGGGHTS and YADE, and what their errors take in solidem: "
              "[codes.md](accuracy_cost/codes.md).", ""]
    return "\n".join([*lines, *advice_words(csv_rows(DOCS / "advice.csv")),
                      *effects_words(csv_rows(DOCS / "effects.csv"))]).rstrip() + "\n"


def main() -> int:
    """2: there are no tables."""
    kinds = measured()
    if not kinds:
        print(f"error: no points.csv below {DOCS}; python3 -m benchmarks.accuracy_cost makes it",
              file=sys.stderr)
        return 2
    for kind, studies in kinds.items():
        draw_kind([(study.title, own(points)) for study, points in studies], KINDS[kind],
                  DOCS / f"front_{kind.replace(' ', '_')}.png")
    rows: list[dict[str, Any]] = table(orders(kinds))
    write_table(rows, ROOT / "python" / "solidem" / "studies.csv")
    written = {DOCS.parent / "accuracy_cost.md": text_of(kinds),
               DOCS / "codes.md": "\n".join(_codes(kinds)) + "\n",
               DOCS / "advice.md": advice_page(csv_rows(DOCS / "advice.csv"), rows),
               DOCS / "effects.md": effects_page(csv_rows(DOCS / "effects.csv"))}
    for path, text in written.items():
        path.write_text(text, encoding="utf-8")
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
