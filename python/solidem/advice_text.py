# SPDX-License-Identifier: GPL-2.0-or-later
"""Advice in words, for persons and for programs."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from .foretold import UNKNOWN_ORDERS

if TYPE_CHECKING:
    from .proposal import Advice, Proposal
    from .series import Series
    from .verdict import Verdict


def per_cent(value: float) -> str:
    """Two digits."""
    return f"{100 * value:.2g} %"


def seconds(value: float) -> str:
    """In a unit that suits."""
    if value < 120:
        return f"{value:.2g} s"
    return f"{value / 60:.2g} min" if value < 7200 else f"{value / 3600:.2g} h"


def _rows(rows: list[list[str]]) -> list[str]:
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return ["  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
            for row in rows]


def _pilots(advice: Advice) -> list[str]:
    rows = [["elements", advice.of, "scatter", "error", "time of one"]]
    model = advice.model
    assert model is not None
    for level, cost in zip(model.levels, advice.costs):
        count = len(level.figures)
        spread = per_cent(float(level.figures.std(ddof=1)) / advice.scale) if count > 1 else "-"
        rows.append([f"{level.value:.0f}, {count} packing{'s' * (count > 1)}", f"{level.mean:.6g}",
                     spread, per_cent(model.errors(level.value, count).bias), seconds(cost.seconds)])
    told = [f"  {model.strays} left out, far from all others: as of a sensor whose nearest element hangs on "
            "no bond"] if model.strays else []
    return [f"Small runs ({seconds(advice.pilot_seconds)} in all)", *_rows(rows), *told]


def _limit(advice: Advice) -> list[str]:
    model = advice.model
    assert model is not None
    middle, low, high = model.limit
    order, least, most = model.order
    if advice.study is None:
        least_order, most_order = UNKNOWN_ORDERS
        source = (f"there is no study of {advice.kind} scenes: any order from {least_order:g} to "
                  f"{most_order:g} was held to be possible, which widens what follows")
    else:
        source = (f"from these runs and from {advice.study.studies}, where it is "
                  f"{advice.study.order:.2g} ± {advice.study.spread:.1g}")
    return [f"Finer bodies tend to {middle:.6g}, between {low:.6g} and {high:.6g} (95 %)",
            f"Order {order:.2g}, between {least:.2g} and {most:.2g}: {source}"]


def _worth(advice: Advice) -> list[str]:
    if not advice.choices.worth:
        return []
    rows = [["choice", "taken", "in place of", "moves the figure", "steps take", "why"]]
    rows += [[one.choice, one.taken, one.instead, per_cent(one.moves), f"× {one.time:.2g}", one.why]
             for one in advice.choices.worth]
    return ["What each choice is worth, on a coarse body", *_rows(rows)]


def _proposal(advice: Advice, proposal: Proposal) -> list[str]:
    errors = proposal.errors
    count = f"the mean of {proposal.packings} packings of " if proposal.packings > 1 else ""
    of_bodies = [f"    of fineness  {per_cent(errors.bias)}, below {per_cent(errors.bias_upper)} (95 %)",
                 f"    of packings  {per_cent(errors.scatter)}, one standard deviation"]
    if advice.model is None:
        of_bodies = ["    of fineness  not known", "    of packings  not known"]
    lines = [f"  {count}{proposal.elements} elements",
             f"  error       {per_cent(errors.expected)} expected, below {per_cent(errors.promised)} "
             "with a probability of 95 %",
             *of_bodies,
             f"    of steps     {per_cent(advice.choices.step_error)}",
             f"  time        {seconds(proposal.packings * proposal.cost.seconds)} "
             f"({seconds(proposal.packings * proposal.cost.processor)} of the processor), of which "
             f"{seconds(proposal.packings * proposal.cost.steps)} for steps",
             f"  memory      {proposal.bytes / 1e6:.3g} MB"]
    lines += [f"  {'without ' + key if value is None else f'{key} = {value}'}"
              for key, value in proposal.changes.items()]
    return lines


def _half(advice: Advice, proposal: Proposal) -> list[str]:
    """What elements are worth."""
    if advice.model is None:
        return []
    half = advice.model.errors(proposal.elements / 2, proposal.packings)
    grown = advice.costs[-1].times(0.5, 4 / 3).seconds / max(advice.costs[-1].seconds, 1e-9)
    return [f"  half the elements: {per_cent(half.expected)} expected, below {per_cent(half.promised)}; "
            f"time × {grown:.2g}"]


def _series(series: Series) -> list[str]:
    rows = [["elements", "packings", "of them made", "time of one"]]
    rows += [[f"{part.elements:.0f}", str(part.packings), str(part.made), seconds(part.cost.seconds)]
             for part in series.asked()]
    return [*_rows(rows),
            f"  error       of their limit {per_cent(series.expected)} expected, below "
            f"{per_cent(series.promised)} with a probability of 95 %",
            f"  time        {seconds(series.seconds)} ({seconds(series.processor)} of the processor) "
            "besides the small runs" if series.seconds else "  time        none: these are the small runs"]


def _no_body(advice: Advice) -> list[str]:
    """What there is in place of a body that keeps the error."""
    least, series = advice.least, advice.series
    assert least is not None
    none = (f"No body of up to {least.elements} elements keeps {per_cent(advice.error)} with a "
            "probability of 95 %")
    if advice.proposed and series:
        return [f"{none} (that one {per_cent(least.errors.promised)}). To err by no more than that, a "
                "series, whose limit is taken (--run does so)", *_series(series)]
    if series and series.promised < least.errors.promised:
        return [f"{none} (that one {per_cent(least.errors.promised)}), nor does a series of what is "
                "allowed (--longest, --largest); nearest comes", *_series(series)]
    return [f"{none}; that one has", *_proposal(advice, least)]


def verdict_of(advice: Advice, verdict: Verdict) -> str:
    """For a person to read."""
    told = f", {per_cent(verdict.from_limit)} from the limit" if verdict.from_limit else ""
    if verdict.known is not None:
        told = f"; known to ± {per_cent(verdict.known)}"
    what = "of a finer run" if verdict.known is None else "with a finer level"
    return (f"{'held' if verdict.held else 'NOT held'}: {advice.of} = {verdict.figure:.6g}, {what} "
            f"{verdict.finer:.6g}: {per_cent(verdict.differs)} apart{told}; took "
            f"{verdict.seconds:.3g} s, foretold {verdict.foretold:.3g}")


def text_of(advice: Advice) -> str:
    """For a person to read."""
    magnitude = "change" if advice.of.endswith(".temperature") else "magnitude"
    when = {"end": "at the end", "peak": "at its peak"}.get(advice.at, f"at {advice.at} s")
    lines = [f"{advice.scene.title}: {advice.of} {when}, errors as shares of its largest {magnitude}, "
             f"{advice.scale:.4g}", ""]
    if advice.model is not None:
        lines += [*_pilots(advice), *_limit(advice), ""]
    else:
        lines += [f"The body stays as it is ({advice.why_not_finer}): what fineness errs by is not "
                  "known, errors are those of steps alone", ""]
    if worth := _worth(advice):
        lines += [*worth, ""]
    if advice.proposal:
        lines += [f"To err by no more than {per_cent(advice.error)}",
                  *_proposal(advice, advice.proposal), *_half(advice, advice.proposal)]
    else:
        lines += _no_body(advice)
    if advice.cheaper:
        total = advice.cheaper.packings * advice.cheaper.cost.seconds
        lines.append(f"  less time: --packings {advice.cheaper.packings}, the mean of so many bodies of "
                     f"{advice.cheaper.elements} elements takes {seconds(total)}")
    if advice.proposal and advice.series:
        lines += ["  less time: a series, whose limit is taken", *_series(advice.series)]
    if advice.model is not None:
        middle, low, high = advice.model.limit
        lines.append(f"  at no further cost: the limit of the small runs themselves, known to "
                     f"± {per_cent(max(high - middle, middle - low) / advice.scale)}")
    lines += [f"note: {note}" for note in advice.choices.notes]
    return "\n".join(lines)


def json_of(advice: Advice) -> dict[str, Any]:
    """For programs."""
    model = advice.model
    return {
        "scene": str(advice.scene.path), "of": advice.of, "at": advice.at, "error": advice.error,
        "kind": advice.kind, "study": asdict(advice.study) if advice.study else None,
        "scale": advice.scale, "pilot_seconds": advice.pilot_seconds,
        "levels": [{"elements": level.value, "figures": np.asarray(level.figures).tolist(),
                    "cost": asdict(cost)} for level, cost in zip(advice.levels, advice.costs)],
        "limit": model.limit if model else None, "order": model.order if model else None,
        "choices": [asdict(one) for one in advice.choices.worth],
        "step_error": advice.choices.step_error, "notes": advice.choices.notes,
        "proposal": asdict(advice.proposal) if advice.proposal else None,
        "cheaper": asdict(advice.cheaper) if advice.cheaper else None,
        "least": asdict(advice.least) if advice.least else None,
        "series": asdict(advice.series) if advice.series else None,
    }
