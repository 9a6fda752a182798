# SPDX-License-Identifier: GPL-2.0-or-later
"""What the postscripts share: thermo tables, dumps, a figure, a check that counts."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np


def thermo(log: str) -> np.ndarray:
    """Rows of all thermo tables of a log file, one after the other."""
    rows, inside = [], False
    for line in Path(log).read_text().splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            inside = True
        elif line.startswith("Loop time"):
            inside = False
        elif inside:
            rows.append([float(word) for word in words])
    return np.array(rows)


def last_frame(dump: str) -> np.ndarray:
    """Rows of the last frame of a dump."""
    text = Path(dump).read_text().rpartition("ITEM: ATOMS")[2]
    return np.array([line.split() for line in text.splitlines()[1:]], dtype=float)


def figure(path: str, draw: Callable) -> None:
    """Draws into a file, where matplotlib is installed."""
    try:
        import matplotlib
    except ModuleNotFoundError:
        print("no matplotlib: no figure")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    draw(axes)
    plt.savefig(path, dpi=120)
    print(f"figure {path}")


def check(what: str, value: float, limit: float) -> None:
    """Says how far off a figure is; ends with failure when it is beyond its limit."""
    print(f"{what}: {value:.3g} (limit {limit:g})")
    if not value <= limit:
        sys.exit(f"FAILED: {what}")
