#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws docs/images/bodies.png from the results of two examples.

    solidem run docs/examples/notched_bar.toml --output results/notched_bar
    solidem run docs/examples/ball_and_plate.toml --output results/ball_and_plate
    docs/images/bodies.py results/notched_bar results/ball_and_plate docs/images/bodies.png
"""

from __future__ import annotations

import sys
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.collections import PatchCollection  # noqa: E402
from matplotlib.patches import Circle  # noqa: E402


def spheres(axes: Axes, position: np.ndarray, radius: np.ndarray, value: np.ndarray,
            view: tuple[int, int, int], colours: str) -> PatchCollection:
    """The elements seen along an axis, the nearest last; `view`: right, up, towards the eye."""
    right, up, near = view
    order = np.argsort(position[:, near])
    circles = PatchCollection(
        [Circle((position[i, right] * 1e3, position[i, up] * 1e3), radius[i] * 1e3) for i in order],
        cmap=colours, edgecolor="black", linewidth=0.15)
    circles.set_array(value[order])
    axes.add_collection(circles)
    axes.set(aspect="equal", xlabel=f"{'xyz'[right]} (mm)", ylabel=f"{'xyz'[up]} (mm)")
    axes.autoscale_view()
    return circles


def draw(bar: Path, bodies: Path, picture: Path) -> None:
    """The bar after it broke; ball and plate from above and from the side."""
    figure, (left, above, side) = plt.subplots(
        1, 3, figsize=(13, 3.6), width_ratios=(1.8, 1.2, 1.2), layout="constrained")
    with h5py.File(bar / "trajectory.h5") as file:
        frame = file["frames"][sorted(file["frames"])[-1]]
        shown = spheres(left, frame["position"][:], file["elements/radius"][:],
                        frame["broken_bonds"][:], (0, 1, 2), "inferno_r")
    figure.colorbar(shown, ax=left, label="share of bonds broken", shrink=0.7)
    left.set_title("a notch and a hole")
    with h5py.File(bodies / "trajectory.h5") as file:
        position, radius = file["elements/position"][:], file["elements/radius"][:]
        body = file["elements/body"][:].astype(float)
    spheres(above, position, radius, body, (0, 1, 2), "coolwarm")
    spheres(side, position * [1, -1, 1], radius, body, (0, 2, 1), "coolwarm")
    above.set_title("two bodies, from above")
    side.set_title("from the side")
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]))
