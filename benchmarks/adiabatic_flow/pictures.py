# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures 4.3 and 4.4 of Terreros 2013, drawn anew."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib  # type: ignore[import]

matplotlib.use("agg")
import matplotlib.pyplot as plt  # type: ignore[import]  # noqa: E402
import numpy as np  # noqa: E402

from .blocks import SEEDS, Flow  # noqa: E402
from .law import A, B, MODULUS, N, TESTS, adiabatic, quickening, softening  # noqa: E402

COLOURS = ("tab:blue", "tab:green", "tab:red")


def draw_rises(mean: Any, scatter: Any, path: Path) -> None:
    """Figure 4.3: rises over strain, measured, of the thesis, of the law and of the blocks (10,)."""
    figure, panels = plt.subplots(1, len(TESTS), figsize=(9.5, 3.4), constrained_layout=True)
    first = 0
    for axes, test, colour in zip(panels, TESTS, COLOURS):
        rows = slice(first, first + len(test.strain))
        first = rows.stop
        strain, _, rise = adiabatic(test, 2000)
        axes.plot(test.strain, test.measured, "o-", color=colour, ms=5, label="measured")
        axes.plot(test.strain, test.thesis, "^:", color="0.5", ms=4, lw=1, label="thesis")
        axes.plot(strain, rise, "k-.", lw=0.8, label="law alone")
        axes.errorbar(test.strain, mean[rows], scatter[rows], fmt="s--", color="k", ms=4,
                      capsize=3, lw=1, label="blocks, ± of packings")
        axes.set(xlabel="strain", title=test.label, xlim=(0, None), ylim=(0, None))
    panels[0].set_ylabel("rise of temperature, K")
    panels[0].legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def draw_stresses(found: dict[tuple[str, int, int], Flow], path: Path) -> None:
    """Figure 4.4: true stress over strain of blocks that only harden, of blocks, and of the law."""
    figure, axes = plt.subplots(figsize=(6, 4), constrained_layout=True)
    for seed in SEEDS:
        hard = found["hard", 2, seed]
        axes.plot(hard.strain, 1e-6 * hard.stress, color="0.5", lw=0.8,
                  label="blocks that only harden" if seed == SEEDS[0] else None)
    for t, (test, colour) in enumerate(zip(TESTS, COLOURS)):
        for seed in SEEDS:
            one = found["law", t, seed]
            axes.plot(one.strain, 1e-6 * one.stress, color=colour, lw=0.8, alpha=0.7,
                      label=f"blocks, {test.label}" if seed == SEEDS[0] else None)
        strain, stress, _ = adiabatic(test, 2000)
        axes.plot(strain, 1e-6 * stress, "--", color=colour, lw=1.2)
    plastic = np.linspace(0, 0.2, 400)
    for temperature, style in ((296, "k:"), (473, "k-."), (573, "k--")):
        stress = (A + B * plastic**N) * quickening(1) * softening(temperature)
        axes.plot(plastic + stress / MODULUS, 1e-6 * stress, style, lw=0.8,
                  label=f"law, slow, at {temperature} K")
    axes.plot([], [], "--", color="0.4", lw=1.2, label="law, adiabatic")
    axes.set(xlabel="strain", ylabel="true stress, MPa", xlim=(0, 0.2), ylim=(0, 520))
    axes.legend(frameon=False, fontsize=7, ncol=2, loc="lower right")
    figure.savefig(path, dpi=100)
    plt.close(figure)
