# SPDX-License-Identifier: GPL-2.0-or-later
"""How fine a scene has to be for a figure that errs by no more than is asked for, and how long that
takes: from a few small runs and from what the studies found of such scenes.

    solidem advise tension.toml --error 1% --of gauge.stress --write fine.toml
    solidem advise conduction.toml --error 0.5% --run
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from ._core import InputError, RunError
from .advice_text import json_of, text_of, verdict_of
from .choices import Choices, Chooser
from .foretold import Cost, ErrorModel, Errors, exponent_of
from .level import Level
from .pilots import Pilot, Pilots, mean_cost
from .proposal import Advice, Proposal, write_scene
from .refinement import Refinement, refinement_of
from .scene import Scene
from .series import Part, Series, parts_of, rarer_heat, series_for
from .studies import Study, kind_of, study_of
from .verdict import check

COARSEST = 300.0  #: elements of the coarsest body, all bodies together
GROWTH = 2.5  #: from one level to the next
MOST_LEVELS = 6
LARGEST = 300_000  #: elements that are proposed at most
PILOT_SECONDS = 60.0
LONGEST = 600.0  #: s: that what is proposed may take
LESS_TIME = 0.5  #: of that of a body: then a series is worth telling of
PACKINGS = 3  #: of each level, or more where they scatter
SHARE = 0.15  #: of the time, for more packings of one level


class Adviser:
    """Makes the pilot runs of one scene."""

    def __init__(self, scene: Scene, error: float, *, of: str = "", at: str = "end",
                 packings: int = 1, largest: float = LARGEST, seconds: float = PILOT_SECONDS,
                 longest: float = LONGEST,
                 folder: str | os.PathLike[str] = "results/advise") -> None:
        self.scene, self.error, self.packings = scene, error, packings
        self.largest, self.seconds, self.longest = largest, seconds, longest
        self.tables = scene.tables
        self.kind = kind_of(self.tables)
        if not self.kind or "run" not in self.tables:
            raise InputError(f"{scene.path}: nothing in it moves or gets warm; expected [run] and one "
                             "of [conduction], [beams], [central_forces], [contact]")
        self.refinement: Refinement = refinement_of(self.tables)
        self.pilots = Pilots(scene, self.refinement, of, at, Path(folder))
        self.choices = Choices()
        self.factors: list[float] = []  # of the levels: times the scene's own elements
        self.changes: list[dict[str, Any]] = []  # of the levels, besides their fineness

    def advice(self) -> Advice:
        """Chooses, refines, foretells."""
        refined = bool(self.refinement.bodies)
        coarse = self._coarse() if refined else 1.0
        chooser = Chooser(self.pilots, self.tables, self.kind, self.error, coarse)
        self.choices = chooser.all()
        self._note_layers()
        study = study_of(self.kind, self.choices.law)
        if not refined:
            return self._as_they_are(study)
        levels, runs = self._ladder(coarse, study)
        scale = float(np.mean([run.scale for run in runs[-1]]))
        if scale == 0:
            raise InputError(f"{self.scene.path}: {self.pilots.of} is zero all through the run; expected "
                             "a figure that something happens to")
        costs = [mean_cost(level) for level in runs]
        model = ErrorModel(levels, scale, study, self.choices.step_error)
        exponent = self._exponent(levels, costs)

        def proposal(elements: float, packings: int) -> Proposal:
            return self._proposal(model, elements, packings, levels, costs, runs, exponent)

        def allowed(elements: float | None, packings: int) -> Proposal | None:
            made = proposal(elements, packings) if elements else None
            return made if made and packings * made.cost.seconds <= self.longest else None

        best = allowed(model.elements_for(self.error, self.largest, self.packings), self.packings)
        cheaper = None
        if self.packings == 1:
            for packings in (2, 3, 4, 6, 8):
                other = allowed(model.elements_for(self.error, self.largest, packings), packings)
                known = cheaper or best
                if other and (known is None or packings * other.cost.seconds
                              < 0.8 * known.packings * known.cost.seconds):
                    cheaper = other
        least = proposal(self._most(levels, costs, exponent), self.packings) if best is None else None
        return Advice(self.scene, self.pilots.of, self.pilots.at, self.error, self.kind, study, scale,
                      levels, costs, model, self.choices, "", best, cheaper, least,
                      self._series(model, levels, costs, exponent, best), self.pilots.seconds)

    def _most(self, levels: list[Level], costs: list[Cost], exponent: float) -> float:
        """Elements that are allowed, by their number and by the time that they take."""
        few, many = levels[0].value, max(self.largest, levels[0].value)

        def taken(elements: float) -> float:
            seconds = costs[-1].times(elements / levels[-1].value, exponent).seconds
            return self.packings * seconds

        if taken(many) <= self.longest:
            return many
        while many > 1.02 * few:
            middle = float(np.sqrt(few * many))
            few, many = (middle, many) if taken(middle) <= self.longest else (few, middle)
        return few

    def _series(self, model: ErrorModel, levels: list[Level], costs: list[Cost], exponent: float,
                best: Proposal | None) -> Series | None:
        """Where it is the only one to keep the error, or the nearest to it, or takes far less time."""
        longest = self.longest
        if best is not None:
            longest = min(LESS_TIME * best.packings * best.cost.seconds, longest)
        parts: list[Part] = parts_of(self.factors, self.changes, levels, costs, exponent, self.largest,
                                     GROWTH)
        found = series_for(model, parts, self.error, longest)
        worth = found.promised <= self.error and found.seconds > 0
        return found if best is None or worth else None

    def _coarse(self) -> float:
        """How many times the scene's own elements the coarsest body has."""
        asked = [body.elements for body in self.refinement.bodies]
        if None in asked:  # a radius is asked for: the packing tells
            self.own_elements = float(len(self.scene.specimen()))
        else:
            self.own_elements = float(sum(count or 0 for count in asked))
        return min(COARSEST / self.own_elements, 1.0)

    def _ladder(self, factor: float,
                study: Study | None) -> tuple[list[Level], list[list[Pilot]]]:
        """Levels as long as their runs fit into the time, and are needed."""
        levels: list[Level] = []
        runs: list[list[Pilot]] = []
        exponent = self.choices.time_exponent or 4 / 3
        for number in range(MOST_LEVELS):
            packings = PACKINGS
            if levels:
                cost = mean_cost(runs[-1]).times(GROWTH, exponent)
                foreseen = min(cost.seconds, cost.processor)
                left = self.seconds - self.pilots.seconds
                packings = min(PACKINGS, int(left / foreseen))
                if packings < 1 and len(levels) > (1 if foreseen > 2 * self.seconds else 2):
                    break
            self._rarer_heat(factor)
            level, made = self.pilots.level(factor, self.choices.changes, max(packings, 1),
                                            self.error, SHARE * self.seconds)
            levels.append(level)
            runs.append(made)
            self.factors.append(factor)
            self.changes.append(dict(self.choices.changes))
            factor *= GROWTH
            if factor * self.own_elements > self.largest or self._told(levels, made, study):
                break
        return levels, runs

    def _told(self, levels: list[Level], finest: list[Pilot], study: Study | None) -> bool:
        """Whether a body no finer than these keeps the error."""
        scale = float(np.mean([run.scale for run in finest]))
        if len(levels) < 3 or scale == 0:
            return False
        model = ErrorModel(levels, scale, study, self.choices.step_error)
        return model.elements_for(self.error, levels[-1].value, self.packings) is not None

    def _rarer_heat(self, factor: float) -> None:
        """Explicit heat is stable up to the square of the size, steps of motion go as the size."""
        every = self.choices.changes.get("conduction.every")
        while every and every > 1:
            try:
                self.pilots.run(factor, self.choices.changes)
                return
            except InputError:
                every = max(1, every // 3)
                self.choices.changes["conduction.every"] = every

    def _exponent(self, levels: list[Level], costs: list[Cost]) -> float:
        return exponent_of((levels[-2].value, costs[-2]), (levels[-1].value, costs[-1]),
                           self.choices.time_exponent)

    def _proposal(self, model: ErrorModel, elements: float, packings: int, levels: list[Level],
                  costs: list[Cost], runs: list[list[Pilot]], exponent: float) -> Proposal:
        rounded = float(f"{elements * 1.005:.2g}")
        elements = rounded if rounded >= elements else rounded + 10**np.floor(np.log10(elements) - 1)
        # The scene's own number of elements is asked for, what is made may differ a little.
        asked = levels[-1].value / self._factor_of(levels[-1])
        changes = {**self.choices.changes, **self.refinement.changes(elements / asked)}
        changes |= rarer_heat(changes, elements / levels[-1].value)
        cost = costs[-1].times(elements / levels[-1].value, exponent)
        return Proposal(int(elements), packings, changes, model.errors(elements, packings), cost,
                        elements * runs[-1][0].bytes_per_element)

    def _factor_of(self, level: Level) -> float:
        """Of the scene's own elements."""
        return level.value / self.own_elements

    def _as_they_are(self, study: Study | None) -> Advice:
        """A body that stays: its steps alone are chosen."""
        run = self.pilots.run(1.0, self.choices.changes)
        step = self.choices.step_error
        errors = Errors(0.0, 0.0, 0.0, step / 2, step)
        proposal = Proposal(run.elements, 1, dict(self.choices.changes), errors, run.cost,
                            run.elements * run.bytes_per_element)
        kept = step <= self.error
        return Advice(self.scene, self.pilots.of, self.pilots.at, self.error, self.kind, study,
                      run.scale, [], [], None, self.choices, self.refinement.why_not,
                      proposal if kept else None, None, None if kept else proposal, None,
                      self.pilots.seconds)

    def _note_layers(self) -> None:
        """Regions that shrink with the elements."""
        left = [name for name in ("grips", "sets", "beams", "initial_velocities", "body")
                if "'layers'" in str(self.tables.get(name))]
        left += [str(table.get("name")) for table in self.tables.get("temperatures", [])
                 if "layers" in table.get("region", {})
                 and f"temperatures.{table.get('name')}.wall" not in self.choices.changes]
        if "beams" in self.tables and self.refinement.bodies:
            self.choices.notes.append(
                "moduli of beams hold for bodies of one fineness: solidem calibrate finds them for what "
                "is proposed, and takes away what of the error of fineness is stiffness")
        for section, key in (("contact", "normal_stiffness"), ("contact_conduction", "conductance")):
            if key in self.tables.get(section, {}) and self.refinement.bodies:
                self.choices.notes.append(f"[{section}] {key} is that of one contact: finer bodies have "
                                          "more of them, and are stiffer or conduct better by it")
        if self.refinement.bodies and left:
            self.choices.notes.append(
                f"regions of so many layers ({', '.join(left)}) get thinner as bodies get finer, which "
                "moves the figure; depth = \"…\" in their place holds the same part of each body")


def advise(scene: Scene | str | os.PathLike[str], error: float, **how: Any) -> Advice:
    """Advice on a scene for a figure that errs by no more than `error`, a share of its scale. `how`:
    of, at, packings, largest (elements), seconds (of pilot runs), longest (s, of what is proposed),
    folder."""
    return Adviser(scene if isinstance(scene, Scene) else Scene(scene), error, **how).advice()


def share(text: str) -> float:
    """ "1%", "1 %" or 0.01."""
    word = text.strip()
    try:
        value = float(word.rstrip("% ")) / (100 if word.endswith("%") else 1)
    except ValueError:
        value = -1.0
    if not 1e-6 <= value < 1:
        raise argparse.ArgumentTypeError(f"{text!r}: expected a share such as 1% or 0.01, from "
                                         "0.0001% and below 100%")
    return value


def positive(text: str) -> float:
    """A number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r}: expected a number above 0")
    return value


def parser() -> argparse.ArgumentParser:
    """Of the command's words."""
    made = argparse.ArgumentParser(
        prog="solidem advise", description="How fine a scene has to be for a figure that errs by no "
        "more than is asked for, and how long that takes: by a few small runs.")
    add = made.add_argument
    add("scene", type=Path)
    add("--error", required=True, type=share, metavar="SHARE", help="of the figure's largest magnitude "
        "in the run (of a temperature: of its largest change), such as 1%%")
    add("--of", default="", metavar="COLUMN", help="of the history, for example gauge.stress (default: "
        "the stress of the gauge, else the first sensor, grip or tool)")
    add("--at", default="end", help="end, peak (largest magnitude) or a time in s (default: end)")
    add("--packings", type=int, default=1, metavar="N", help="whose mean is meant (default: 1)")
    add("--largest", type=positive, default=LARGEST, metavar="N",
        help=f"elements that may be proposed (default: {LARGEST})")
    add("--longest", type=positive, default=LONGEST, metavar="S",
        help=f"that what is proposed may take (default: {LONGEST:g})")
    add("--pilot-seconds", type=positive, default=PILOT_SECONDS, metavar="S", help="that small runs may "
        f"take together, about (default: {PILOT_SECONDS:g})")
    add("--write", type=Path, metavar="FILE", help="the proposed scene")
    add("--overwrite", action="store_true", help="FILE, where it is there")
    add("--run", action="store_true", help="run what is proposed and something finer, and say whether "
        "the promise held; exit status 1: it did not")
    add("--json", action="store_true", help="for programs, all in SI units")
    add("-o", "--output", type=Path, default=Path("results/advise"), metavar="DIR",
        help="runs that are there are not made again (default: results/advise)")
    return made


def main(words: Sequence[str] | None = None) -> int:
    """The command; 2 where something given cannot be used, 1 where a run cannot go on, no body keeps
    the error, or the promise did not hold."""
    reader = parser()
    given = reader.parse_args(words)
    if given.packings < 1:
        reader.error(f"argument --packings: {given.packings}: expected 1 or more")
    verdict = None
    try:
        if given.write and given.write.exists() and not given.overwrite:
            raise InputError(f"{given.write}: exists already; expected a new name, or --overwrite")
        found = advise(Scene(given.scene), given.error, of=given.of, at=given.at,
                       packings=given.packings, largest=given.largest, seconds=given.pilot_seconds,
                       longest=given.longest, folder=given.output / "pilots")
        if not given.json:
            print(text_of(found), flush=True)
        if found.proposed and given.write:
            write_scene(found, found.proposed, given.write, given.overwrite)
            if not given.json:
                print(given.write)
        if found.proposed and given.run:
            verdict = check(found, found.proposed, given.output)
    except (InputError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except RunError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    if given.json:
        print(json.dumps(json_of(found) | ({"verdict": asdict(verdict)} if verdict else {}), indent=2))
    elif verdict:
        print(verdict_of(found, verdict))
    return 0 if found.proposed and (verdict is None or verdict.held) else 1


if __name__ == "__main__":
    sys.exit(main())
