# SPDX-License-Identifier: GPL-2.0-or-later
"""Error over time for one kind of problem: all studies of it in one picture, each with its front."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from benchmarks.accuracy_cost.plot import LEVELS  # noqa: E402
from benchmarks.accuracy_cost.results import Median, front  # noqa: E402

MARKERS = "osD^vP"


def draw_kind(studies: list[tuple[str, list[Median]]], title: str, path: Path) -> None:
    """Writes the picture; `studies`: title and points of each."""
    figure, axes = plt.subplots(figsize=(8, 4.2 + 0.17 * len(studies)), layout="constrained")
    for level in LEVELS:
        axes.axhline(level, color="#cccccc", linewidth=0.8, zorder=0)
    for number, (name, points) in enumerate(studies):
        colour, marker = f"C{number}", MARKERS[number % len(MARKERS)]
        told = [m for m in points if m.set_up_seconds is not None]
        times = [m.whole_seconds for m in told]
        errors = [max(m.error, 1e-7) for m in told]
        axes.plot(times, errors, marker, color=colour, markerfacecolor="none", markersize=4, alpha=0.4)
        best = sorted((time, error) for time, error, on in zip(
            times, errors, front(list(zip(times, errors)))) if on)
        axes.plot([time for time, _ in best], [error for _, error in best], marker, color=colour,
                  markersize=6)
        axes.step([time for time, _ in best], [error for _, error in best], where="post", color=colour,
                  linewidth=1.2, label=f"{name}: no run is both faster and more accurate")
    axes.set(xscale="log", yscale="log", xlabel="set-up and steps, s", ylabel="error", title=title)
    axes.yaxis.set_major_formatter(lambda y, _: f"{100 * y:g} %")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(fontsize=8, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.13))
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)
