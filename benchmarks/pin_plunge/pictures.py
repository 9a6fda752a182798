# SPDX-License-Identifier: GPL-2.0-or-later
"""Force over depth, the warm plate cut open, and a film of it."""

from __future__ import annotations

from pathlib import Path

import matplotlib  # type: ignore[import]

matplotlib.use("agg")
import matplotlib.pyplot as plt  # type: ignore[import]  # noqa: E402
import numpy as np  # noqa: E402
from solidem.view import (View, bounds, colour_range, of_few_colours, painted,  # noqa: E402
                          shots_of, with_foot, write_film)

from .books import column, history_of  # noqa: E402
from .scene import Case  # noqa: E402

HOT = 120.0  #: rise at the end of the bar of colours, K
#: The front half of the plate is left out.
VIEW = View(field="temperature", label="rise of temperature, K", scale=1, shift=-296,
            range=(0, HOT), colours="plasma", cut=(("any", "any", "any"), ("any", 3, "any")),
            view=((0, 0.5, 0), (6, 6, 3.2)), azimuth=-80, elevation=20)


def force_over_depth(folders: dict[str, Path], path: Path) -> None:
    """Force and torque of runs by their labels."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), constrained_layout=True)
    for label, folder in folders.items():
        history = history_of(folder)
        depth = -history["tool.pin.displacement_z"]
        for axes, values, scale in ((left, history["tool.pin.force_z"], 1e-3),
                                    (right, column(history, "tool.pin.torque_z"), 1e3)):
            axes.plot(1e3 * depth, scale * values, lw=1, label=label)
    left.set(xlabel="depth, mm", ylabel="force on the pin, kN", xlim=(0, 0.5), ylim=(0, None))
    right.set(xlabel="depth, mm", ylabel="torque on the pin, N mm", xlim=(0, 0.5))
    left.legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def warm_plates(folders: list[Path], path: Path, width: int = 800) -> None:
    """The last frames beside each other, in the same colours."""
    shots = [shots_of(folder, VIEW, [-1])[0] for folder in folders]
    norm, corners = colour_range(VIEW, shots), bounds(VIEW, shots)
    pictures = [painted(VIEW, shot, norm, corners, width // len(shots)) for shot in shots]
    images = [picture.image() for picture in pictures]
    foot = with_foot(VIEW, np.concatenate(images, axis=1), norm, pictures[0].pixels_per_metre)
    of_few_colours(foot, 128).save(path, optimize=True)


def film(folder: Path, path: Path) -> None:
    """All frames."""
    write_film(folder, VIEW, path, width=360)


def labelled(cases: dict[Case, Path], factor: float, ratio: float) -> dict[str, Path]:
    """The runs that count, of every size, by what they are."""
    return {f"{case.elements} elements, {'rubbing' if case.rubs else 'smooth'}": folder
            for case, folder in cases.items()
            if (case.factor, case.ratio, case.seed) == (factor, ratio, 1)}


def largest(cases: dict[Case, Path]) -> list[Path]:
    """The runs of most elements, smooth and rubbing."""
    most = max(case.elements for case in cases)
    return [folder for case, folder in cases.items() if case.elements == most]
