# SPDX-License-Identifier: GPL-2.0-or-later
"""The verification table as one HTML file, plots inside."""

from __future__ import annotations

import io
from collections import defaultdict
from dataclasses import replace
from html import escape
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.figure import Figure, SubFigure  # noqa: E402

from compare.provenance import Provenance  # noqa: E402
from compare.row import Plot, Row, RunLine, Series  # noqa: E402
from compare.table import (CLASSES, HEADER, LAW, RUN_HEADER, cells, matrix,  # noqa: E402
                           run_cells, verdict)

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 78em; padding: 0 1em;
       color: #1c2733; }
h1, h2 { font-weight: 600; }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th, td { padding: .3em .6em; text-align: left; border-bottom: 1px solid #dde3ea;
         vertical-align: top; }
th { color: #5b6b7c; font-weight: 500; }
td:first-child { white-space: nowrap; }
td.number { font-variant-numeric: tabular-nums; text-align: right; white-space: nowrap; }
.pass { color: #1a7f37; font-weight: 600; } .fail { color: #c62828; font-weight: 600; }
tr.failed { background: #fdecea; }
.note { color: #5b6b7c; font-size: 12.5px; }
.plots { display: flex; flex-wrap: wrap; gap: 1em; }
.matrix table { width: auto; } .matrix td { white-space: nowrap; }
.plots svg { width: 37em; max-width: 100%; height: auto; }
"""


def _lines(axes: Axes, lines: list[Series]) -> None:
    """Puts the lines into a panel."""
    for series in lines:
        colour = axes.lines[-1].get_color() if series.colour_of_previous and axes.lines else None
        order = np.argsort(series.x) if series.joined else np.arange(len(series.x))
        drawn, = axes.plot(
            series.x[order], series.y[order], series.style, label=series.label or None,
            markersize=4, linewidth=6 if series.wide else 1.4, alpha=0.3 if series.wide else 1,
            **({} if colour is None else {"color": colour}))
        if series.band is not None:
            drawn.set_linewidth(1.0)
            axes.fill_between(series.x, series.y, series.band, color=drawn.get_color(), alpha=0.4,
                              linewidth=0.5)
    axes.spines[["top", "right"]].set_visible(False)


LEGEND_INSIDE = 5  #: more lines than this are named above the plot, where they hide nothing
COLUMNS = 3  #: plots side by side in one picture


def _height(plot: Plot) -> float:
    """Inches."""
    named = len({series.label for series in plot.series if not series.label.startswith("_")})
    return (5 if plot.below else 3.8) + (0.1 * named if named > LEGEND_INSIDE else 0)


def _fill(figure: Figure | SubFigure, plot: Plot) -> None:
    """Draws a plot, with a smaller panel under it when it has one."""
    if plot.below:
        axes, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.2, 1))
        _lines(lower, plot.below)
        if plot.below_log:
            # Four powers of ten: what is smaller has no part in the error.
            largest = max(float(np.max(series.y)) for series in plot.below)
            lower.set(yscale="log", ylim=(1e-4 * largest, 3 * largest))
        else:
            lower.axhline(0, color="k", linewidth=0.6)
        lower.set(xlabel=plot.x_label, ylabel=plot.below_label)
    else:
        axes = figure.subplots()
        axes.set_xlabel(plot.x_label)
    _lines(axes, plot.series)
    axes.set(ylabel=plot.y_label)
    if plot.ticks:
        axes.set_xticks(list(plot.ticks), list(plot.ticks.values()))
    if plot.log_x:
        axes.set_xscale("log")
    if plot.log_y and any((series.y > 0).any() for series in plot.series):
        axes.set_yscale("log")
    if len(axes.get_legend_handles_labels()[1]) <= LEGEND_INSIDE:
        axes.legend(fontsize=8, frameon=False)
        axes.set_title(plot.title, fontsize=10)
    else:
        axes.legend(fontsize=8, frameon=False, ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1))
        figure.suptitle(plot.title, fontsize=10)


def _figure(plots: list[Plot]) -> Figure:
    """Plots side by side."""
    columns = min(COLUMNS, len(plots))
    rows = -(-len(plots) // columns)
    figure = plt.figure(figsize=(6 * columns, rows * max(map(_height, plots))), layout="constrained")
    if len(plots) == 1:
        _fill(figure, plots[0])
    else:
        for part, plot in zip(figure.subfigures(rows, columns, squeeze=False).flat, plots):
            _fill(part, plot)
    return figure


def draw(plot: Plot) -> str:
    """A plot as SVG text."""
    figure = _figure([plot])
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()[text.getvalue().index("<svg"):]


def _join(into: list[Series], others: list[Series], variant: str) -> None:
    """Adds lines of a variant. One that is there already is drawn once, or gets longer when it is
    joined; another of the same name is told by its variant."""
    known = {series.label: series for series in into if series.label}
    for series in others:
        before = known.get(series.label)
        if before is None:
            into.append(replace(series))
        elif series.joined:
            before.x, before.y = np.r_[before.x, series.x], np.r_[before.y, series.y]
        elif not _same(before, series):
            _join(into, [replace(series, label=f"{series.label}, {variant}")], f"{variant}, again")


def _same(one: Series, other: Series) -> bool:
    return np.array_equal(one.x, other.x) and np.array_equal(one.y, other.y)


def merged_plots(rows: list[Row]) -> list[Plot]:
    """Plots of the same title, axes and case put together; a series is drawn once."""
    merged: dict[tuple[str, ...], Plot] = {}
    for row in rows:
        if row.plot is None:
            continue
        plot = row.plot
        key = (row.case, plot.figure, plot.title, plot.x_label, plot.y_label)
        into = merged.setdefault(key, replace(plot, series=[], below=[], ticks={}))
        into.ticks |= plot.ticks
        _join(into.series, plot.series, row.variant)
        _join(into.below, plot.below, row.variant)
    return list(merged.values())


def write_figures(rows: list[Row], directory: Path) -> list[Path]:
    """Writes the pictures that plots ask for; plots that ask for the same one stand side by side.

    Returns their paths.
    """
    pictures: dict[str, list[Plot]] = defaultdict(list)
    for plot in merged_plots(rows):
        if plot.figure:
            pictures[plot.figure].append(plot)
    paths = []
    for name, plots in pictures.items():
        directory.mkdir(parents=True, exist_ok=True)
        paths.append(directory / f"{name}.png")
        figure = _figure(plots)
        figure.savefig(paths[-1], dpi=130)
        plt.close(figure)
    return paths


def _table(header: tuple[str, ...], body: list[str]) -> str:
    head = "".join(f"<th>{escape(word)}</th>" for word in header)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(body)}</tbody></table>"


def _row(row: Row) -> str:
    words = list(cells(row))[1:]
    columns = []
    for name, word in zip(HEADER[1:], words):
        kind = ' class="number"' if name in ("error", "tolerance", "time/s") else ""
        text = escape(word)
        if name == "":
            text = f'<span class="{word.lower()}">{word}</span>'
        if name == "quantity":
            below = row.note if row.error is None else f"{row.reason} {row.note}".strip()
            text += f'<br><span class="note">{escape(below)}</span>'
        columns.append(f"<td{kind}>{text}</td>")
    return f'<tr class="{"" if row.passed else "failed"}">{"".join(columns)}</tr>'


def _matrix(rows: list[Row], codes: list[str], anchors: dict[str, str]) -> str:
    """Cases by codes, how many checks passed, each case a link to its rows."""
    header, lines = matrix(rows, codes)
    body = []
    for name, *words in lines:
        passed = [_kind(word) for word in words]
        cells_of_case = "".join(
            f'<td class="{kind}">{escape(word)}</td>' for word, kind in zip(words, passed))
        body.append(f'<tr><td><a href="#{name}">{escape(anchors.get(name, name))}</a></td>'
                    f"{cells_of_case}</tr>")
    return '<div class="matrix">' + _table(header, body) + "</div>"


def _kind(word: str) -> str:
    """The class of a cell of the matrix."""
    passed, _, all_of_them = word.partition("/")
    return "" if not word else "pass" if passed == all_of_them else "fail"


def _run(line: RunLine) -> str:
    return "<tr>" + "".join(f"<td>{escape(word)}</td>" for word in run_cells(line)) + "</tr>"


def page(rows: list[Row], lines: list[RunLine], titles: dict[str, tuple[str, str]],
         made: Provenance) -> str:
    """The whole page; `titles` gives title and description of each case."""
    cases: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        cases[row.case].append(row)
    parts = [f"<h1>Verification</h1><p>{escape(verdict(rows))}</p>",
             f'<p class="note">{"<br>".join(map(escape, made.lines()))}</p>',
             _matrix(rows, list(made.versions), {name: title for name, (title, _) in titles.items()}),
             f"<p>{escape(CLASSES)} {escape(LAW)}</p>"]
    for name, of_case in cases.items():
        title, about = titles.get(name, (name, ""))
        parts.append(f'<h2 id="{escape(name)}">{escape(title)}</h2><p>{escape(about)}</p>')
        parts.append(_table(HEADER[1:], [_row(row) for row in of_case]))
        parts.append(f'<div class="plots">{"".join(map(draw, merged_plots(of_case)))}</div>')
    if lines:
        parts.append("<h2>Runs</h2>" + _table(RUN_HEADER, [_run(line) for line in lines]))
    return ('<!doctype html><html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width"><title>solidem verification</title>'
            f"<style>{STYLE}</style></head><body>{''.join(parts)}</body></html>\n")


def write(rows: list[Row], lines: list[RunLine], titles: dict[str, tuple[str, str]],
          made: Provenance, directory: Path) -> Path:
    """Writes index.html and the pictures of figures/; returns the page's path."""
    write_figures(rows, directory / "figures")
    path = directory / "index.html"
    path.write_text(page(rows, lines, titles, made))
    return path
