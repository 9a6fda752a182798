# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages behind the front page that no study writes, and what the front page says of them: whether advice
keeps its word, and what each effect costs."""

from __future__ import annotations

from typing import Any, Sequence

from benchmarks.accuracy_cost.front_words import factor
from benchmarks.accuracy_cost.page import percent, seconds

Rows = Sequence[dict[str, str]]

OFF = "off again"  #: of effects.csv: the scene of a base once more
NEAR = 1.5  #: factor of a time that counts as foretold
ADVISE = "[`solidem advise`]({}command_line.md#how-fine-a-scene-has-to-be)"


def _span(rows: Rows, column: str) -> str:
    """Least and largest number of a column."""
    numbers = sorted({float(row[column]) for row in rows})
    return f"{numbers[0]:g}" if len(numbers) == 1 else f"{numbers[0]:g} to {numbers[-1]:g}"


def _count(rows: Rows) -> str:
    """Of promises that were kept."""
    # Where nothing that is allowed keeps either error, both may have the same that comes nearest.
    each = list({(row["scene"], row["promised"], row["error"]): row for row in rows}.values())
    kept, broken, open_ = (sum(row["verdict"] == verdict for row in each)
                           for verdict in ("kept", "broken", "not told"))
    near = sum(1 / NEAR <= float(row["time_ratio"]) <= NEAR for row in each)
    beyond = sum(row["reachable"] != "True" for row in rows)
    return (f"{kept} of {len(each)} promises were kept, {broken} broken"
            + (f"; of {open_} the reference is too coarse to tell" if open_ else "")
            + f". The time was within a factor {NEAR:g} of the forecast in {near} of {len(each)}. In {beyond} of "
            f"{len(rows)} rows nothing that was allowed ({_span(rows, 'largest')} elements, "
            f"{_span(rows, 'longest')} s) kept what was asked; there the promise is that of what comes nearest.")


def advice_words(rows: Rows) -> list[str]:
    """For the front page."""
    if not rows:
        return []
    return ["## Whether advice keeps its word", "",
            f"{ADVISE.format('')} on {len({row['scene'] for row in rows})} scenes that no study contains: "
            f"{_count(rows)} Each promise, and the orders that advice starts from: "
            "[advice.md](accuracy_cost/advice.md).", ""]


def advice_page(rows: Rows, orders: Sequence[dict[str, Any]]) -> str:
    """How advice keeps its word, and the orders that it starts from."""
    lines = ["# Whether advice keeps its word", "",
             f"{ADVISE.format('../')} on scenes that no study contains: what was asked for, what was proposed "
             "(elements of one body; or the packings × elements of a series, whose limit is taken) and promised, "
             "and the error against the limit of other packings, which errs itself (±, 95 %: where that is more "
             "than the promise, kept means that both limits agree as well as was promised). A promise holds with a "
             "probability of 95 %, so one of twenty is broken by the packing that is run. Times are those of the "
             f"processor; small runs, which take some 20 s, come before. {_count(rows) if rows else ''}", "",
             "| scene | asked | promised | proposed | error | reference | forecast | taken |",
             "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        promise = percent(float(row["promised"])) + ("" if row["reachable"] == "True" else ", all it can")
        proposed = row["elements"] if row["proposed"] == "body" else row["proposed"]
        lines.append(f"| {row['scene']} | {percent(float(row['asked']))} | {promise} | {proposed} | "
                     f"{percent(float(row['error']))}{'' if row['verdict'] == 'kept' else ', ' + row['verdict']} | "
                     f"± {percent(float(row['reference_known']))} | "
                     f"{seconds(float(row['foretold_seconds']))} | {seconds(float(row['taken_seconds']))} |")
    lines += ["", "Made by `python3 -m benchmarks.advice` and `python3 -m benchmarks.accuracy_cost.front_page` from "
              "[advice.csv](advice.csv).", "", "## At which order errors fall", "",
              "Over the size of elements, by the least error of each number of elements in the studies; advice takes "
              "these as what it knows of a kind of scene before its own runs.", "",
              "| kind | law of conduction | order | spread | least error | time, as elements to the power | "
              "studies |", "|---|---|---|---|---|---|---|"]
    lines += [f"| {row['kind']} | {row['law'] or '–'} | {row['order']} | {row['spread']} | "
              f"{percent(float(row['least_error']))} | {row['time_exponent']} | {row['studies']} |"
              for row in orders]
    return "\n".join(lines) + "\n"


def effects_words(rows: Rows) -> list[str]:
    """For the front page: what is off, what costs most."""
    if not rows:
        return []
    lines = ["## What each effect costs", ""]
    off = [float(row["time_ratio"]) for row in rows if row["effect"] == OFF]
    memory = {row["more_bytes_per_element"] for row in rows if row["effect"] == OFF
              and row["more_bytes_per_element"]}
    more = " and ".join(sorted(f"{float(m):.0f}" for m in memory))
    lines.append(f"The same scene once more takes {factor(min(off))} to {factor(max(off))} of its time (medians of "
                 f"runs in turn, all bases and codes) and {more} bytes more: what a scene does not name has no "
                 "column and no loop. On beams, time of a step over that without the effect, solidem (LIGGGHTS):")
    lines.append("")
    ratio = {(row["code"], row["base"], row["effect"]): float(row["time_ratio"]) for row in rows}
    for (code, base, effect), value in ratio.items():
        if code == "standalone" and base == "beams" and effect != OFF:
            other = ratio.get(("liggghts", base, effect))
            lines.append(f"- {effect}: {factor(value)}" + (f" ({factor(other)})" if other else ""))
    return [*lines, "", "Memory, beams that flow, central forces: [effects.md](accuracy_cost/effects.md). `solidem "
            "explain` tells columns and cost of your scene on your machine.", ""]


def effects_page(rows: Rows) -> str:
    """What each effect costs."""
    lines = ["# What each effect costs", "",
             "One scene, effects switched on one by one: time of a step over that without it (medians, and "
             "the range, of runs in turn; processor time, in LIGGGHTS wall time of the steps), bytes an element. "
             f"*{OFF}* is the same scene once more: how far such figures can be trusted on the machine that they "
             "were measured on. What a scene does not name has no column and no loop: 0 bytes. Made by "
             "`python3 -m benchmarks.effects` ([effects.csv](effects.csv)); `solidem explain` tells columns and "
             "cost of your scene on your machine.", "",
             "| code | of | effect | time of a step | from – to | bytes an element |", "|---|---|---|---|---|---|"]
    for row in rows:
        memory = row["more_bytes_per_element"]
        lines.append(f"| {row['code']} | {row['base']} | {row['effect']} | {factor(float(row['time_ratio']))} | "
                     f"{factor(float(row['least_ratio']))} – {factor(float(row['most_ratio']))} | "
                     f"{f'{float(memory):+.0f}' if memory else ''} |")
    return "\n".join(lines) + "\n"
