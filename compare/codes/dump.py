# SPDX-License-Identifier: GPL-2.0-or-later
"""Text that LAMMPS and its kin write: dumps of elements, rows of numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from compare.result import CodeFailure, Floats, Frame


def read_dump(path: Path, columns: dict[str, tuple[str, ...]], time_step: float,
              code: str) -> list[Frame]:
    """Frames of a text dump, sorted by id; `columns`: name -> headings of its components."""
    try:
        words = path.read_text().split("ITEM: TIMESTEP\n")[1:]
    except OSError as error:
        raise CodeFailure(f"{code} wrote no dump: {error}") from error
    frames = []
    for text in words:
        head, _, body = text.partition("ITEM: ATOMS ")
        headings, _, numbers = body.partition("\n")
        names = headings.split()
        try:
            values = np.array(numbers.split(), dtype=float).reshape(-1, len(names))
        except ValueError as error:
            raise CodeFailure(f"{code} wrote a torn dump: {error}") from error
        values = values[np.argsort(values[:, names.index("id")])]
        step = int(head.split()[0])
        found = {name: np.squeeze(values[:, [names.index(h) for h in parts]], axis=1)
                 if len(parts) == 1 else values[:, [names.index(h) for h in parts]]
                 for name, parts in columns.items()}
        frames.append(Frame(step, step * time_step, found))
    return frames


def read_rows(path: Path, code: str) -> Floats:
    """Rows of numbers that a code printed."""
    try:
        return np.atleast_2d(np.loadtxt(path, ndmin=2))
    except (OSError, ValueError) as error:
        raise CodeFailure(f"{code} wrote no usable history: {error}") from error
