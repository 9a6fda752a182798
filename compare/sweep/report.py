# SPDX-License-Identifier: GPL-2.0-or-later
"""What a sweep leaves behind: tables (Markdown, CSV), verdicts and a figure of all variations."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Sequence

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402

from compare.sweep.results import Group, Reading, Verdict, table  # noqa: E402
from compare.sweep.sweep import Sweep, Variation  # noqa: E402

PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]


def terminal(rows: Sequence[Sequence[str]]) -> str:
    """A table with columns as wide as they need."""
    widths = [max(len(row[n]) for row in rows) for n in range(len(rows[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()
                     for row in rows)


def markdown(rows: Sequence[Sequence[str]]) -> str:
    """The same as Markdown."""
    head, *rest = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([head, "|" + "---|" * len(rows[0]), *rest]) + "\n"


def verdict_rows(sweep: Sweep, verdicts: Sequence[Verdict]) -> list[list[str]]:
    """One row for each check."""
    titles = {v.name: v.title for v in sweep.variations}
    rows = [["what varies", "measure", "expected", "found", "", "why"]]
    for verdict in verdicts:
        check = verdict.check
        word = "" if check.expects == "printed" else "ok" if verdict.passed else "NOT"
        rows.append([titles[check.variation], check.measure, check.expects, verdict.found, word,
                     check.reason])
    return rows


def _draw_on(axes: Axes, sweep: Sweep, variation: Variation, found: Sequence[Group]) -> None:
    for band in sweep.bands:
        if band.get("vary", variation.name) == variation.name:
            axes.axvspan(band["from"], band["to"], color="#bbbbbb", alpha=0.4, lw=0,
                         label=band["label"])
    own = [group for group in found if group.variation == variation.name]
    for n, group in enumerate(own):
        for k, reading in enumerate(group.readings):
            alone = len(own) == 1 and len(group.readings) > 1
            colour = group.setting.colour or PALETTE[(k if alone else n) % len(PALETTE)]
            label = (f"specimen {reading.outcome.point.seed}" if alone else
                     group.setting.label if k == 0 else None)
            axes.plot(reading.curve.x / sweep.x.scale, reading.curve.y / sweep.y.scale,
                      color=colour, lw=1.2, label=label)
    axes.axhline(0, color="#888888", lw=0.6)
    axes.set(xlabel=sweep.x.label, ylabel=sweep.y.label, title=variation.title)
    if variation.top is not None:
        axes.set_ylim(top=variation.top)
    axes.grid(color="#e4e4e4", lw=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False, fontsize=9)


def draw(sweep: Sweep, found: Sequence[Group], path: Path) -> None:
    """The curves, a panel for each variation; specimens of one setting share a colour unless they
    are all that varies."""
    count = len(sweep.variations)
    columns = 1 if count == 1 else 2
    rows = (count + columns - 1) // columns
    figure, panels = plt.subplots(rows, columns, figsize=(7.2 if columns == 1 else 11, 4.2 * rows),
                                  layout="constrained", squeeze=False)
    for axes in panels.ravel()[count:]:
        axes.set_visible(False)
    for axes, variation in zip(panels.ravel(), sweep.variations):
        _draw_on(axes, sweep, variation, found)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    plt.close(figure)


def write(sweep: Sweep, found: Sequence[Group], verdicts: Sequence[Verdict],
          readings: Sequence[Reading], directory: Path) -> list[Path]:
    """Writes table.md, points.csv and the figures; returns what was written."""
    directory.mkdir(parents=True, exist_ok=True)
    page = directory / "table.md"
    page.write_text(f"# {sweep.title}\n\n{sweep.about}\n\n{markdown(table(sweep, found))}\n"
                    f"{markdown(verdict_rows(sweep, verdicts))}", encoding="utf-8")
    points = directory / "points.csv"
    with points.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["variation", "setting", "seed", *(m.name for m in sweep.measures)])
        for reading in readings:
            point = reading.outcome.point
            writer.writerow([point.variation, point.setting.label, point.seed,
                             *(reading.values[m.name] for m in sweep.measures)])
    picture = directory / f"{sweep.name}.png"
    draw(sweep, found, picture)
    return [page, points, picture]
