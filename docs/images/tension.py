#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws docs/images/tension.png from the results of docs/examples/tension.toml.

    solidem run docs/examples/tension.toml --output results/tension
    docs/images/tension.py results/tension docs/images/tension.png
"""

from __future__ import annotations

import sys
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PatchCollection  # noqa: E402
from matplotlib.patches import Circle  # noqa: E402


def draw(results: Path, picture: Path) -> None:
    """The bar seen from the side, coloured by displacement, beside its stress-strain curve."""
    with h5py.File(results / "trajectory.h5") as file:
        rest, radius = file["elements/position"][:], file["elements/radius"][:]
        frames = file["frames"]
        position = frames[sorted(frames)[-1]]["position"][:]
    history = np.genfromtxt(results / "history.csv", delimiter=",", names=True, deletechars="")
    displacement = (position - rest)[:, 0] * 1e6
    shown = rest + 20 * (position - rest)

    figure, (bar, curve) = plt.subplots(
        1, 2, figsize=(10, 3.2), width_ratios=(1.7, 1), layout="constrained")
    order = np.argsort(-shown[:, 2])
    circles = PatchCollection([Circle((shown[i, 0] * 1e3, shown[i, 1] * 1e3), radius[i] * 1e3)
                               for i in order], cmap="viridis", edgecolor="white", linewidth=0.3)
    circles.set_array(displacement[order])
    bar.add_collection(circles)
    bar.set(aspect="equal", xlabel="x (mm)", ylabel="y (mm)",
            title="1000 elements, beam bonds (displacements 20 times)")
    bar.autoscale_view()
    figure.colorbar(circles, ax=bar, label="displacement (µm)", shrink=0.9)

    strain, stress = history["gauge.strain"] * 100, history["gauge.stress"] / 1e6
    modulus = np.polyfit(strain / 100, stress / 1e3, 1)[0]
    ratio = -np.polyfit(history["gauge.strain"], history["gauge.lateral_strain"], 1)[0]
    curve.plot(strain, stress, lw=1.5)
    curve.set(xlabel="strain (%)", ylabel="stress (MPa)",
              title=f"E = {modulus:.1f} GPa, ν = {ratio:.3f}")
    curve.grid(alpha=0.3)
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
