# SPDX-License-Identifier: GPL-2.0-or-later
"""Small runs of a scene: what its figure is, and what they cost."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from ._core import InputError
from .converge import Taken, figure_of, ran
from .foretold import Cost
from .level import Level
from .refinement import Refinement
from .results import Results
from .scene import Scene

#: Columns of the history that stand for a scene when none is named, the first that there is.
USUAL = ("gauge.stress", "sensor.", "grip.", "tool.", "thermal_energy", "kinetic_energy")


MOST_PACKINGS = 16
SCATTER_TOLD = 6  #: packings, where they take little: fewer may be alike by chance
WELL_KNOWN = 0.15  #: share of the error within which the mean of packings is known


@dataclass(frozen=True)
class Pilot:
    """One run."""

    figure: float
    scale: float  #: what errors are shares of
    elements: int
    steps: int
    cost: Cost
    bytes_per_element: float
    ratio: float  #: its time step over the criterion that [run] time_step_ratio speaks of
    limit_ratio: float  #: the same of the largest stable step of the very body
    duration: float  #: s
    warmest: float  #: K: largest change of a temperature in the history


def usual_column(history: Mapping[str, Any]) -> str:
    """What a scene is most likely about."""
    for begin in USUAL:
        for name in history:
            if name.startswith(begin) and not name.endswith((".value", ".heat", "_y")):
                return name
    raise InputError("the history has no figure to look at; expected a gauge, a sensor or a grip, or "
                     "a column named by --of")


def largest_change(column: np.ndarray[Any, np.dtype[np.float64]]) -> float:
    """From its first value."""
    return float(np.abs(column - column[0]).max())


def scale_of(results: Results, of: str) -> float:
    """The largest magnitude of a column; of temperatures, whose zero is far away, their largest
    change."""
    column = results.history[of]
    return largest_change(column) if of.endswith(".temperature") else float(np.abs(column).max())


def read(results: Results, of: str, at: str, taken: Taken) -> Pilot:
    """What a run gave."""
    summary = results.summary
    wall = summary["wall_seconds"]
    # What waited for others on a busy machine is no cost.
    busy = max(taken.seconds - wall["output"], 1e-9)
    own = min(1.0, taken.processor / busy)
    linear, steps = own * max(busy - wall["steps"], 0.0), own * wall["steps"]
    step = summary["time_step"]
    ratio = summary.get("time_step_ratio") or 0.0
    limit = summary.get("time_step_limit") or 0.0
    history = results.history
    changes = [largest_change(history[name]) for name in history
               if name.endswith(".temperature") or (name.startswith("temperature.")
                                                    and name.endswith(".value"))]
    imposed = [float(np.abs(history[name] - history[other][0]).max()) for name in history
               if name.startswith("temperature.") and name.endswith(".value")
               for other in history if other.endswith(".temperature")]
    return Pilot(figure_of(results, of, at), scale_of(results, of), summary["elements"],
                 summary["steps"], Cost(linear, steps, taken.processor, wall["output"]),
                 summary["bytes_per_element"], ratio, ratio * limit / step if limit else 0.0,
                 summary["simulated_time"], max(changes + imposed, default=0.0))


class Pilots:
    """Runs of one scene, each kept in its folder and made once."""

    def __init__(self, scene: Scene, refinement: Refinement, of: str, at: str, folder: Path) -> None:
        self.scene, self.refinement, self.of, self.at = scene, refinement, of, at
        self.folder = folder
        self.seconds = 0.0  #: of all runs up to now, without waiting for others

    def run(self, factor: float, choices: Mapping[str, Any], packing: int = 0) -> Pilot:
        """One run with `factor` times the elements. InputError where the scene does not allow these
        choices, RunError where it cannot go on with them."""
        output = self.scene.tables.get("output", {})
        changes: dict[str, Any] = {"output.frames": 0}
        changes |= {f"output.{key}": None for key in output if key in ("fields", "checkpoint_every")}
        changes |= {**self.refinement.changes(factor, packing), **choices}
        name = "_".join([f"{factor:.4g}", str(packing)]
                        + [f"{key.split('.')[-1]}={value}" for key, value in choices.items()
                           if value is not None])
        place = self.folder / "".join(sign if sign.isalnum() or sign in "._=-" else "-"
                                      for sign in name)
        results, taken = ran(self.scene.changed(changes), place)
        if not self.of:
            self.of = usual_column(results.history)
        found = read(results, self.of, self.at, taken)
        self.seconds += min(found.cost.seconds, found.cost.processor)
        return found

    def level(self, factor: float, choices: Mapping[str, Any], packings: int, error: float,
              seconds: float) -> tuple[Level, list[Pilot]]:
        """Packings of one fineness: so many, and more as long as they tell their scatter badly, or their
        mean is not known well beside the error, and they take no longer than this."""
        runs = [self.run(factor, choices, packing) for packing in range(packings)]
        while (1 < len(runs) < MOST_PACKINGS
               and (len(runs) < SCATTER_TOLD or _badly_known(runs, error))
               and sum(min(run.cost.seconds, run.cost.processor) for run in runs) < seconds):
            runs.append(self.run(factor, choices, len(runs)))
        elements = float(np.mean([run.elements for run in runs]))
        return Level(elements, elements**(-1 / 3), np.array([run.figure for run in runs]),
                     float(np.mean([run.cost.seconds for run in runs]))), runs


def _badly_known(runs: list[Pilot], error: float) -> bool:
    figures = np.array([run.figure for run in runs])
    scale = float(np.mean([run.scale for run in runs]))
    return bool(figures.std(ddof=1) / np.sqrt(len(runs)) > WELL_KNOWN * error * scale)


def mean_cost(runs: list[Pilot]) -> Cost:
    """Of packings of one fineness: medians, for a busy machine delays now this run, now that."""
    middle = [float(np.median([getattr(run.cost, part) for run in runs]))
              for part in ("linear", "steps", "processor", "rest")]
    return Cost(*middle)
