# SPDX-License-Identifier: GPL-2.0-or-later
"""What a code brings back from a run, and the reader of the standalone program's layout."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class CodeFailure(Exception):
    """A code is missing, crashed, ran out of time, or brought back nothing that can be used."""


@dataclass
class Frame:
    """All elements at one step."""

    step: int
    time: float  #: s
    columns: dict[str, Floats]  #: "position" (N, 3) m, "temperature" (N,) K


@dataclass
class Result:
    """What one code computed."""

    code: str
    elements: int
    bonds: int
    steps: int
    time_step: float  #: s
    wall_seconds: float  #: of the time steps alone
    history: dict[str, Floats]  #: column -> (rows,), with "step" and "time"
    frames: list[Frame]

    @property
    def nanoseconds_per_bond_step(self) -> float:
        """Cost of one bond in one step, ns."""
        return 1e9 * self.wall_seconds / max(1, self.steps * self.bonds)

    def frame(self, step: int) -> Frame:
        """The frame of a step; CodeFailure when there is none."""
        for frame in self.frames:
            if frame.step == step:
                return frame
        raise CodeFailure(f"{self.code} wrote no frame of step {step}")

    def check(self) -> Result:
        """Itself, when it is whole and finite; CodeFailure otherwise."""
        if not self.frames:
            raise CodeFailure(f"{self.code} wrote no frame")
        # Frames come at even intervals; the last one may lie before the last step.
        last = self.frames[-1].step
        if last != self.steps and (len(self.frames) < 2 or
                                   2 * last - self.frames[-2].step <= self.steps):
            raise CodeFailure(
                f"{self.code} stopped at step {self.frames[-1].step} of {self.steps}")
        for frame in self.frames:
            for name, values in frame.columns.items():
                if values.size == 0:
                    raise CodeFailure(f"{self.code} wrote no {name} at step {frame.step}")
                if not np.isfinite(values).all():
                    raise CodeFailure(f"{self.code}: {name} at step {frame.step} is not a number")
        for name, values in self.history.items():
            if not np.isfinite(values).all():
                raise CodeFailure(f"{self.code}: {name} in the history is not a number")
        return self


def read_history(path: Path) -> dict[str, Floats]:
    """Columns of a CSV file with a header; CodeFailure when it is missing or torn."""
    try:
        with open(path, newline="") as file:
            rows = list(csv.DictReader(file))
        return {k: np.array([float(row[k]) for row in rows]) for k in (rows[0] if rows else {})}
    except (OSError, TypeError, ValueError) as error:
        raise CodeFailure(f"{path.name}: {error}") from error


def _read_frames(path: Path) -> list[Frame]:
    frames = []
    with h5py.File(path) as file:
        for name in sorted(file.get("frames", {})):
            group = file["frames"][name]
            columns = {k: np.asarray(v[:], dtype=float) for k, v in group.items()
                       if isinstance(v, h5py.Dataset)}
            frames.append(Frame(int(group.attrs["step"]), float(group.attrs["time"]), columns))
    return sorted(frames, key=lambda frame: frame.step)


def read_result(code: str, directory: Path) -> Result:
    """The result in a directory of summary.json, history.csv and trajectory.h5."""
    try:
        summary = json.loads((directory / "summary.json").read_text())
        if summary.get("completed") is not True:
            raise CodeFailure(f"{code} did not complete its run")
        wall = summary["wall_seconds"]
        return Result(
            code, int(summary["elements"]), int(summary["bonds"]), int(summary["steps"]),
            float(summary["time_step"]), float(wall.get("steps", sum(wall.values()))),
            read_history(directory / "history.csv"), _read_frames(directory / "trajectory.h5"),
        ).check()
    except (OSError, KeyError, TypeError, ValueError, AttributeError) as error:
        raise CodeFailure(f"{code} wrote no usable result: {error}") from error
