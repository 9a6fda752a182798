# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the variants of a case in their codes, once each, and keeps results and failures."""

from __future__ import annotations

import json
import re
import shutil
import time
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable

from compare.case import Case, Check, Variant
from compare.codes.base import Code, Job
from compare.codes.standalone import Standalone
from compare.result import CodeFailure, Result
from compare.row import RunLine
from contrib.yade.prepared import PreparedError, parse_parameters, read_specimen

Say = Callable[[str], None]


def table_text(scene: str, name: str) -> str:
    """The text of a table [name] of a scene, header included; CodeFailure when there is none."""
    found = re.search(rf"^\[{re.escape(name)}\].*?(?=^\[\[?[A-Za-z_]|\Z)", scene,
                      re.MULTILINE | re.DOTALL)
    if not found:
        raise CodeFailure(f"the scene has no [{name}]")
    return found.group()


def replace_words(text: str, words: dict[str, str]) -> str:
    """Replaces each key, which must occur exactly once; CodeFailure otherwise."""
    for old, new in words.items():
        if (count := text.count(old)) != 1:
            raise CodeFailure(f"{old!r} occurs {count} times in the scene; once is needed")
        text = text.replace(old, new)
    return text


class CaseRuns:
    """Everything that was run for one case."""

    def __init__(self, case: Case, codes: dict[str, Code], directory: Path, say: Say = print):
        """Files go to `directory`, one folder a variant and code; old ones are removed."""
        self.case, self.codes, self.directory, self._say = case, codes, directory, say
        self._jobs: dict[str, tuple[Job, dict[str, Any]] | CodeFailure] = {}
        self._results: dict[tuple[str, str], Result | CodeFailure] = {}
        self._specimens: dict[str, Path] = {}
        self.kept: dict[Any, Any] = {}  #: what measures keep for one another
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir(parents=True)

    def code(self, name: str) -> Code:
        """The adaptor of that name; CodeFailure when there is none or its code is missing."""
        if name not in self.codes:
            raise CodeFailure(f"no code and no reference is called {name!r}")
        if reason := self.codes[name].missing():
            raise CodeFailure(f"{name} is missing: {reason}")
        return self.codes[name]

    def _specimen(self, standalone: Standalone, scene: str, folder: Path) -> Path:
        """The specimen of a scene's recipe, made once for all variants that share it."""
        recipe = table_text(scene, "specimen")
        if recipe not in self._specimens:
            path = self.directory / f"specimen_{len(self._specimens)}.h5"
            (folder / "recipe.toml").write_text(scene)
            standalone.call(["specimen", folder / "recipe.toml", "--output", path],
                            folder / "specimen", self.case.timeout)
            self._specimens[recipe] = path
        return self._specimens[recipe]

    def _prepare(self, variant: Variant) -> tuple[Job, dict[str, Any]]:
        if self.case.scene is None:
            raise CodeFailure(f"case {self.case.name} has no scene")
        standalone = self.codes.get("standalone")
        if not isinstance(standalone, Standalone):
            raise CodeFailure("the standalone program is needed to prepare the specimen")
        folder = self.directory / _file_name(variant.name)
        folder.mkdir()
        text = replace_words(self.case.scene.read_text(), variant.replace)
        specimen = self._specimen(standalone, text, folder)
        scene = folder / "scene.toml"
        scene.write_text(text.replace(table_text(text, "specimen"),
                                      f'[specimen]\nfile = "{specimen}"\n\n'))
        prepared, timeout = folder / "prepared.h5", self.case.timeout
        standalone.call(["prepare", scene, "--output", prepared], folder / "prepare", timeout)
        explained = standalone.call(["explain", scene, "--json"], folder / "explain", timeout)
        meaning = json.loads(explained.read_text())
        parameters = parse_parameters(meaning)
        controls = tomllib.loads(text)
        frames = controls.get("output", {}).get("frames", 10)
        observe = controls["run"].get("observe_every", max(1, parameters.steps // 200))
        return Job(scene, prepared, explained, read_specimen(prepared), parameters, observe,
                   max(1, parameters.steps // frames), timeout), meaning

    def _prepared(self, name: str) -> tuple[Job, dict[str, Any]]:
        if name not in self._jobs:
            self._say(f"  {self.case.name} / {name}: specimen ...")
            start = time.perf_counter()
            try:
                self._jobs[name] = self._prepare(self.case.variant(name))
            except CodeFailure as failure:
                self._jobs[name] = CodeFailure(f"not prepared: {failure}")
            except (PreparedError, OSError, KeyError, TypeError, ValueError) as error:
                self._jobs[name] = CodeFailure(
                    f"not prepared: {type(error).__name__}: {error}")
            self._done(self._jobs[name], start)
        job = self._jobs[name]
        if isinstance(job, CodeFailure):
            raise job
        return job

    def job(self, variant: str) -> Job:
        """The job of a variant; CodeFailure when the specimen could not be prepared."""
        return self._prepared(variant)[0]

    def explained(self, variant: str) -> dict[str, Any]:
        """What `solidem explain --json` said of a variant."""
        return self._prepared(variant)[1]

    def result(self, variant: str, code: str) -> Result:
        """The result of a code, run on first demand; CodeFailure says why there is none."""
        key = (variant, code)
        if key not in self._results:
            job = self.job(variant)
            self._say(f"  {self.case.name} / {variant}: {code} ...")
            start = time.perf_counter()
            try:
                folder = self.directory / _file_name(variant) / _file_name(code)
                self._results[key] = self.code(code).run(job, folder).check()
            except CodeFailure as failure:
                self._results[key] = failure
            # An adaptor that breaks in a way nobody thought of is a failure, not an agreement.
            except Exception as error:  # noqa: BLE001
                self._results[key] = CodeFailure(f"{code}: {type(error).__name__}: {error}")
            self._done(self._results[key], start)
        result = self._results[key]
        if isinstance(result, CodeFailure):
            raise result
        return result

    def _done(self, outcome: object, start: float) -> None:
        words = f"FAILED: {outcome}" if isinstance(outcome, CodeFailure) else "done"
        self._say(f"    {words} ({time.perf_counter() - start:.1f} s)")

    def lines(self) -> list[RunLine]:
        """One line for each run that gave a result."""
        return [RunLine(self.case.name, variant, code, r.elements, r.bonds, r.steps,
                        r.wall_seconds, r.nanoseconds_per_bond_step)
                for (variant, code), r in self._results.items() if isinstance(r, Result)]


def _file_name(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", name)


@dataclass(frozen=True)
class View:
    """All that a measure may look at: one check of one variant."""

    runs: CaseRuns
    check: Check
    variant: Variant

    @property
    def case(self) -> Case:
        """The case."""
        return self.runs.case

    @property
    def job(self) -> Job:
        """What every code was given."""
        return self.runs.job(self.variant.name)

    @property
    def explained(self) -> dict[str, Any]:
        """What the scene means, as the standalone program says."""
        return self.runs.explained(self.variant.name)

    @property
    def tested(self) -> Result:
        """The result of the code that is tested."""
        return self.runs.result(self.variant.name, self.check.code)

    @property
    def other(self) -> Result:
        """The result of the code that is the reference."""
        return self.runs.result(self.variant.name, self.check.reference)

    def of(self, variant: Variant) -> View:
        """The same check of another variant."""
        return replace(self, variant=variant)

    def option(self, name: str) -> Any:
        """An option of the check; CodeFailure names the one that is missing."""
        if name not in self.check.options:
            raise CodeFailure(f"check {self.check.quantity!r} needs the option {name!r}")
        return self.check.options[name]

    @property
    def diffusivity(self) -> float:
        """α = λ / (ρ c_p), m²/s."""
        law = self.explained["laws"]["conduction"]
        density = float(self.explained["density"])
        return float(law["conductivity"]) / (density * float(law["specific_heat_capacity"]))
