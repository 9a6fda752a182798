# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a promise holds: what is proposed is run, and something finer."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .foretold import ErrorModel
from .level import Level
from .pilots import Pilots, mean_cost
from .proposal import Advice, Proposal, scene_text
from .refinement import Refinement, refinement_of
from .scene import Scene
from .series import Series, run_series


@dataclass(frozen=True)
class Verdict:
    """What the run and the finer one say of the promise."""

    figure: float  #: of the proposed scene, the mean of its packings; of a series its limit
    finer: float  #: of twice the elements and half the step; of a series its limit with such a level
    differs: float  #: as a share of the scale
    from_limit: float | None  #: of the figure, with all runs together
    foretold: float  #: s, of one run of the proposed scene
    seconds: float  #: that it took
    processor: float
    held: bool
    known: float | None = None  #: of a series: half of the interval of its limit, as a share


def check(advice: Advice, proposed: Proposal | Series, folder: Path) -> Verdict:
    """Runs what is proposed and something finer; what small runs are in `folder` are kept."""
    if isinstance(proposed, Series):
        return _check_series(advice, proposed, folder / "pilots")
    return _check_body(advice, proposed, folder / "run")


def _check_series(advice: Advice, series: Series, folder: Path) -> Verdict:
    assert advice.model is not None
    pilots = Pilots(advice.scene, refinement_of(advice.scene.tables), advice.of, advice.at, folder)
    told = run_series(pilots, series, advice.model, advice.error, check=True)
    assert told.finer is not None
    differs = abs(told.figure - told.finer) / advice.scale
    return Verdict(told.figure, told.finer, differs, None, series.seconds, told.seconds, told.processor,
                   differs <= advice.error and told.known <= advice.error, told.known)


def _check_body(advice: Advice, proposal: Proposal, folder: Path) -> Verdict:
    pilots = Pilots(advice.scene, Refinement([], "", {}), advice.of, advice.at, folder)
    refinement = refinement_of(advice.scene.tables)
    seeds = [{key: seed + 100 * packing for key, seed in refinement.seeds.items()} if packing else {}
             for packing in range(proposal.packings)]
    runs = [pilots.run(1.0, {**proposal.changes, **seed}) for seed in seeds]
    finer = dict(proposal.changes)
    if refinement.bodies:
        made = Scene(scene_text(advice, proposal), folder=advice.scene.path.parent, name="proposed")
        finer |= refinement_of(made.tables).changes(2.0)
    if "run.time_step_ratio" in finer and not refinement.bodies:
        finer["run.time_step_ratio"] = finer["run.time_step_ratio"] / 2
    fine = [pilots.run(2.0, {**finer, **seed}) for seed in seeds]
    figure = float(np.mean([run.figure for run in runs]))
    better = float(np.mean([run.figure for run in fine]))
    differs = abs(figure - better) / advice.scale
    from_limit = None
    if advice.model is not None:
        levels = [*advice.levels, Level(runs[0].elements, 0, np.array([r.figure for r in runs]), 0),
                  Level(fine[0].elements, 0, np.array([r.figure for r in fine]), 0)]
        limit = ErrorModel(levels, advice.scale, advice.study).limit[0]
        from_limit = abs(figure - limit) / advice.scale
    cost = mean_cost(runs)
    return Verdict(figure, better, differs, from_limit, proposal.cost.seconds, cost.seconds, cost.processor,
                   differs <= advice.error and (from_limit or 0.0) <= advice.error)
