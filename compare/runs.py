# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the variants of a case in their codes, once each, and keeps results and failures."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
import threading
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Hashable, Iterable

from compare.case import Case, Check, Variant
from compare.codes.base import Code, Job
from compare.codes.standalone import Standalone
from compare.result import CodeFailure, Result
from compare.row import RunLine
from contrib.explained import parse_parameters
from contrib.prepared import PreparedError, read_specimen

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


class Once:
    """Results by key, each made once though several threads ask for it; failures are kept too."""

    def __init__(self) -> None:
        """Nothing is known yet."""
        self._lock = threading.Lock()
        self._locks: dict[Hashable, threading.Lock] = {}
        self.found: dict[Hashable, Any] = {}

    def get(self, key: Hashable, make: Callable[[], Any]) -> Any:
        """What was made for this key; raises the CodeFailure that making it ended with."""
        with self._lock:
            lock = self._locks.setdefault(key, threading.Lock())
        with lock:
            if key not in self.found:
                try:
                    self.found[key] = make()
                except CodeFailure as failure:
                    self.found[key] = failure
        if isinstance(self.found[key], CodeFailure):
            raise self.found[key]
        return self.found[key]


class Specimens:
    """Specimens made in this run of the harness, for every case that has the same recipe."""

    def __init__(self, directory: Path):
        """Files go to `directory`; old ones are removed."""
        self.directory, self._made = directory, Once()
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir(parents=True)

    def get(self, standalone: Standalone, scene: str, timeout: float) -> Path:
        """The specimen of a scene's recipe."""
        recipe = json.dumps(tomllib.loads(scene)["specimen"], sort_keys=True)
        return Path(self._made.get(recipe, lambda: self._make(standalone, scene, recipe, timeout)))

    def _make(self, standalone: Standalone, scene: str, recipe: str, timeout: float) -> Path:
        name = hashlib.sha256(recipe.encode()).hexdigest()[:12]
        path = self.directory / f"{name}.h5"
        (self.directory / f"{name}.toml").write_text(table_text(scene, "specimen"))
        standalone.call(["specimen", self.directory / f"{name}.toml", "--output", path],
                        self.directory / name, timeout)
        return path


class CaseRuns:
    """Everything that was run for one case."""

    def __init__(self, case: Case, codes: dict[str, Code], directory: Path, specimens: Specimens,
                 say: Say = print):
        """Files go to `directory`, one folder a variant and code; old ones are removed."""
        self.case, self.codes, self.directory, self._say = case, codes, directory, say
        self._specimens, self._jobs, self._results = specimens, Once(), Once()
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

    def _prepare(self, variant: Variant) -> tuple[Job, dict[str, Any]]:
        if self.case.scene is None:
            raise CodeFailure(f"case {self.case.name} has no scene")
        standalone = self.codes.get("standalone")
        if not isinstance(standalone, Standalone):
            raise CodeFailure("the standalone program is needed to prepare the specimen")
        folder = self.directory / _file_name(variant.name)
        folder.mkdir()
        text = replace_words(self.case.scene.read_text(), variant.replace)
        specimen = self._specimens.get(standalone, text, self.case.timeout)
        scene = folder / "scene.toml"
        scene.write_text(text.replace(table_text(text, "specimen"),
                                      f'[specimen]\nfile = "{specimen}"\n\n'))
        prepared, timeout = folder / "prepared.h5", self.case.timeout
        standalone.call(["prepare", scene, "--output", prepared], folder / "prepare", timeout)
        explained = standalone.call(["explain", scene, "--json", "--quick"], folder / "explain",
                                    timeout)
        meaning = json.loads(explained.read_text())
        parameters = parse_parameters(meaning)
        controls = tomllib.loads(text)
        frames = controls.get("output", {}).get("frames", 10)
        observe = controls["run"].get("observe_every", max(1, parameters.steps // 200))
        return Job(scene, prepared, explained, read_specimen(prepared), parameters, observe,
                   max(1, parameters.steps // max(1, frames)), timeout, self.case.options), meaning

    def _prepared(self, name: str) -> tuple[Job, dict[str, Any]]:
        def make() -> tuple[Job, dict[str, Any]]:
            try:
                return self._prepare(self.case.variant(name))
            except CodeFailure as failure:
                raise CodeFailure(f"not prepared: {failure}") from failure
            except (PreparedError, OSError, KeyError, TypeError, ValueError) as error:
                raise CodeFailure(f"not prepared: {type(error).__name__}: {error}") from error
        found: tuple[Job, dict[str, Any]] = self._jobs.get(
            name, lambda: self._told(f"{self.case.name} / {name}: specimen", make))
        return found

    def job(self, variant: str) -> Job:
        """The job of a variant; CodeFailure when the specimen could not be prepared."""
        return self._prepared(variant)[0]

    def explained(self, variant: str) -> dict[str, Any]:
        """What `solidem explain --json` said of a variant."""
        return self._prepared(variant)[1]

    def result(self, variant: str, code: str) -> Result:
        """The result of a code, run on first demand; CodeFailure says why there is none."""
        def make() -> Result:
            try:
                folder = self.directory / _file_name(variant) / _file_name(code)
                return self.code(code).run(self.job(variant), folder).check()
            except CodeFailure:
                raise
            # An adaptor that breaks in a way nobody thought of is a failure, not an agreement.
            except Exception as error:  # noqa: BLE001
                raise CodeFailure(f"{code}: {type(error).__name__}: {error}") from error

        def made() -> Result:
            self.job(variant)
            found: Result = self._told(f"{self.case.name} / {variant}: {code}", make)
            return found
        result: Result = self._results.get((variant, code), made)
        return result

    def run_ahead(self, pairs: Iterable[tuple[str, str]]) -> None:
        """Runs variants in codes, two at a time; what fails is said when a check asks for it."""
        def run(pair: tuple[str, str]) -> None:
            try:
                self.result(*pair)
            except CodeFailure:
                pass
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(run, dict.fromkeys(pairs)))

    def _told(self, what: str, make: Callable[[], Any]) -> Any:
        start = time.perf_counter()
        words = "done"
        try:
            return make()
        except CodeFailure as failure:
            words = f"FAILED: {failure}"
            raise
        finally:
            self._say(f"  {what}: {words} ({time.perf_counter() - start:.1f} s)")

    def lines(self) -> list[RunLine]:
        """One line for each run that gave a result."""
        return [RunLine(self.case.name, variant, code, r.elements, r.bonds, r.steps,
                        r.wall_seconds if self.case.timed else None,
                        r.nanoseconds_per_bond_step if self.case.timed else None)
                for (variant, code), r in sorted(self._results.found.items())
                if isinstance(r, Result)]


def _file_name(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", name)


@dataclass(frozen=True)
class View:
    """All that a measure may look at: one check of one variant, or of a group (`members`)."""

    runs: CaseRuns
    check: Check
    variant: Variant
    group: tuple[Variant, ...] = ()

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

    @property
    def members(self) -> list[View]:
        """One view for each variant of the group."""
        return [self.of(variant) for variant in self.group]

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
