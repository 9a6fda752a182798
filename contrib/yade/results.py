# SPDX-License-Identifier: GPL-2.0-or-later
"""Results in the layout of the standalone program: history.csv, trajectory.h5, summary.json."""

from __future__ import annotations

import csv
import json
import math
import os
import time
from pathlib import Path
from typing import Any, Callable

import h5py
import numpy as np
from numpy.typing import NDArray


class Recorder:
    """Collects rows and frames while a program runs and writes them at the end."""

    def __init__(self, directory: str | Path, observe_every: int, frame_every: int, last: int):
        """`last` is the number of the last step, always recorded."""
        self.directory = Path(directory)
        self.observe_every, self.frame_every, self.last = observe_every, frame_every, last
        self._rows: list[dict[str, float]] = []
        self._frames: list[tuple[int, float, dict[str, NDArray[np.float64]]]] = []
        self.observing_seconds = 0.0

    @property
    def period(self) -> int:
        """Every step that is due is a multiple of this."""
        return math.gcd(self.observe_every, self.frame_every, self.last)

    def observe(
        self,
        step: int,
        moment: float,
        row: Callable[[], dict[str, float]],
        frame: Callable[[], dict[str, NDArray[np.float64]]],
    ) -> None:
        """Records a row and a frame of the state at a step when they are due."""
        start = time.perf_counter()
        if step % self.observe_every == 0 or step == self.last:
            self._rows.append({"step": step, "time": moment, **row()})
        if step % self.frame_every == 0 or step == self.last:
            self._frames.append((step, moment, frame()))
        self.observing_seconds += time.perf_counter() - start

    def write(self, summary: dict[str, Any]) -> None:
        """Writes the three files; the summary comes last and says that the run is whole."""
        self.directory.mkdir(parents=True, exist_ok=True)
        with open(self.directory / "history.csv", "w", newline="") as file:
            if self._rows:
                writer = csv.DictWriter(file, list(self._rows[0]))
                writer.writeheader()
                for row in self._rows:
                    writer.writerow({k: repr(v) for k, v in row.items()})
        with h5py.File(self.directory / "trajectory.h5", "w") as file:
            for step, moment, columns in self._frames:
                group = file.create_group(f"frames/{len(file.get('frames', {})):06d}")
                group.attrs["step"], group.attrs["time"] = step, moment
                for name, values in columns.items():
                    group[name] = values
        temporary = self.directory / "summary.json.new"
        temporary.write_text(json.dumps({**summary, "completed": True}, indent=2) + "\n")
        os.replace(temporary, self.directory / "summary.json")
