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
from matplotlib.figure import Figure  # noqa: E402

from compare.row import Plot, Row, RunLine, Series  # noqa: E402
from compare.table import HEADER, RUN_HEADER, cells, run_cells, verdict  # noqa: E402

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


def _figure(plot: Plot) -> Figure:
    """A plot, with a smaller panel under it when it has one."""
    figure = plt.figure(figsize=(6, 5 if plot.below else 3.8), layout="constrained")
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
    axes.set_title(plot.title, fontsize=10)
    if plot.ticks:
        axes.set_xticks(list(plot.ticks), list(plot.ticks.values()))
    if plot.log_x:
        axes.set_xscale("log")
    if plot.log_y and any((series.y > 0).any() for series in plot.series):
        axes.set_yscale("log")
    shown = len(axes.get_legend_handles_labels()[1])
    if shown < 6:
        axes.legend(fontsize=8, frameon=False)
    else:  # above the plot, where it hides nothing
        figure.set_figheight(figure.get_figheight() + 0.1 * shown)
        axes.legend(fontsize=8, frameon=False, ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1))
        axes.set_title("")
        figure.suptitle(plot.title, fontsize=10)
    return figure


def draw(plot: Plot) -> str:
    """A plot as SVG text."""
    figure = _figure(plot)
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    return text.getvalue()[text.getvalue().index("<svg"):]


def _join(into: list[Series], others: list[Series]) -> None:
    """Adds lines; one that is there already is drawn once, or gets longer when it is joined."""
    known = {series.label: series for series in into if series.label}
    for series in others:
        if series.label not in known:
            into.append(replace(series))
        elif series.joined:
            before = known[series.label]
            before.x, before.y = np.r_[before.x, series.x], np.r_[before.y, series.y]


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
        _join(into.series, plot.series)
        _join(into.below, plot.below)
    return list(merged.values())


def write_figures(rows: list[Row], directory: Path) -> list[Path]:
    """Writes the plots that are to be pictures of their own; returns their paths."""
    paths = []
    for plot in merged_plots(rows):
        if plot.figure:
            directory.mkdir(parents=True, exist_ok=True)
            paths.append(directory / f"{plot.figure}.png")
            figure = _figure(plot)
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


def _run(line: RunLine) -> str:
    return "<tr>" + "".join(f"<td>{escape(word)}</td>" for word in run_cells(line)) + "</tr>"


def page(rows: list[Row], lines: list[RunLine], titles: dict[str, tuple[str, str]]) -> str:
    """The whole page; `titles` gives title and description of each case."""
    cases: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        cases[row.case].append(row)
    parts = [f"<h1>Verification</h1><p>{escape(verdict(rows))} Class: A analytic, P published, "
             "C other code, R regression.</p>"]
    for name, of_case in cases.items():
        title, about = titles.get(name, (name, ""))
        parts.append(f"<h2>{escape(title)}</h2><p>{escape(about)}</p>")
        parts.append(_table(HEADER[1:], [_row(row) for row in of_case]))
        parts.append(f'<div class="plots">{"".join(map(draw, merged_plots(of_case)))}</div>')
    if lines:
        parts.append("<h2>Runs</h2>" + _table(RUN_HEADER, [_run(line) for line in lines]))
    return ('<!doctype html><html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width"><title>solidem verification</title>'
            f"<style>{STYLE}</style></head><body>{''.join(parts)}</body></html>\n")


def write(rows: list[Row], lines: list[RunLine], titles: dict[str, tuple[str, str]],
          directory: Path) -> Path:
    """Writes index.html and the pictures of figures/; returns the page's path."""
    write_figures(rows, directory / "figures")
    path = directory / "index.html"
    path.write_text(page(rows, lines, titles))
    return path
