# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against wall time, one picture a study."""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

from benchmarks.accuracy_cost.results import Median  # noqa: E402
from benchmarks.accuracy_cost.study import Study  # noqa: E402

MARKERS = "osD^vP<>"
OTHER_CODES = "*XpH8"
LEVELS = (0.05, 0.01, 0.001)


def _words(points: Sequence[Median], label: str) -> list[str]:
    """What a label says in these points, in order of the study."""
    return list(dict.fromkeys(m.labels[label] for m in points if label in m.labels))


def _scatter(axes: Axes, points: Sequence[Median], label: str, laws: list[str], words: list[str],
             codes: list[str]) -> None:
    sizes = sorted({m.elements for m in points})
    for m in points:
        code = m.labels.get("code", "standalone")
        marker = (MARKERS[words.index(m.labels[label])] if code == "standalone"
                  else OTHER_CODES[codes.index(code) % len(OTHER_CODES)])
        colour = f"C{laws.index(m.labels['law'])}"
        axes.plot(m.seconds, m.error, marker, color=colour, alpha=0.85,
                  markersize=4 + 6 * sizes.index(m.elements) / max(1, len(sizes) - 1),
                  markerfacecolor=colour if m.on_front else "none")


def _legend(axes: Axes, laws: list[str], words: list[str], codes: list[str]) -> None:
    handles = [Line2D([], [], color=f"C{n}", linewidth=3, label=law) for n, law in enumerate(laws)]
    handles += [Line2D([], [], color="k", linestyle="", marker=MARKERS[n], label=word,
                       markerfacecolor="none") for n, word in enumerate(words)]
    handles += [Line2D([], [], color="k", linestyle="", marker=OTHER_CODES[n % len(OTHER_CODES)],
                       label=code, markerfacecolor="none") for n, code in enumerate(codes)]
    handles += [Line2D([], [], color="k", linewidth=0.8, label="Pareto front"),
                Line2D([], [], linestyle="", label="larger: more elements")]
    axes.legend(handles=handles, fontsize=8, frameon=False, loc="center left",
                bbox_to_anchor=(1, 0.5))


def draw(study: Study, points: Sequence[Median], path: Path) -> None:
    """Writes a picture of one study's medians of one reading."""
    laws, words = _words(points, "law"), _words(points, study.markers)
    codes = [c for c in _words(points, "code") if c != "standalone"]
    order = [v.labels["law"] for v in study.axes["law"]]
    laws.sort(key=order.index)
    words.sort(key=[v.labels[study.markers] for values in study.axes.values() for v in values
                    if study.markers in v.labels].index)
    figure, axes = plt.subplots(figsize=(9, 5.4), layout="constrained")
    for level in LEVELS:
        axes.axhline(level, color="#cccccc", linewidth=0.8, zorder=0)
    front = sorted((m.seconds, m.error) for m in points if m.on_front)
    axes.step(*zip(*front), where="post", color="k", linewidth=0.8, zorder=1)
    _scatter(axes, points, study.markers, laws, words, codes)
    axes.set(xscale="log", yscale="log", xlabel="wall time of the steps, s",
             ylabel=f"error: {points[0].reading}" if len(study.readings) > 1
             else "error", title=study.title)
    axes.yaxis.set_major_formatter(lambda y, _: f"{100 * y:g} %")
    axes.spines[["top", "right"]].set_visible(False)
    _legend(axes, laws, words, codes)
    figure.savefig(path, dpi=120, metadata={"Software": None})
    plt.close(figure)
