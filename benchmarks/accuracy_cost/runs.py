# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the specimens, runs the points of studies one at a time, and keeps what each run gave."""

from __future__ import annotations

import hashlib
import json
import os
import random
import re
import shutil
import time
import tomllib
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any, Callable

import benchmarks.accuracy_cost.known_measures  # noqa: F401  (makes its measures known)
from benchmarks.accuracy_cost.calibration import Calibrations
from benchmarks.accuracy_cost.known import Figures, figures
from benchmarks.accuracy_cost.measures import errors
from benchmarks.accuracy_cost.study import Point, Study
from compare.codes.base import Code, Job
from compare.codes.standalone import Standalone
from compare.result import CodeFailure, Result
from compare.runs import replace_words
from contrib.explained import parse_parameters
from contrib.prepared import PreparedError, read_specimen

#: A time step as a fraction of the true limit of the very body, in place of the criterion's.
STEP_OF_LIMIT = re.compile(r"^time_step_of_limit = ([0-9.]+)$", re.MULTILINE)

#: Codes that read the scene themselves.
OWN = ("standalone", "standalone-2", "statics")


@dataclass(frozen=True)
class Run:
    """One run that gave a result."""

    study: str
    labels: dict[str, str]
    repetition: int  #: from 1; the seed of its specimen
    order: int  #: its place in the shuffled order
    elements: int
    bonds: int
    steps: int
    seconds: float  #: of the steps
    set_up_seconds: float | None  #: reading, tessellation, calibration, bonds; None: not told
    packing_seconds: float  #: of the specimen and of finding its bonds, made once and shared
    errors: dict[str, dict[str, float]]  #: reading -> name -> relative error
    summary: dict[str, Any] = field(default_factory=dict)  #: what the program said of itself
    program_seconds: float = 0.0  #: of the code from its start to its end, packing and calibration apart
    load: float = 0.0  #: of the machine before it

    def error(self, reading: str) -> float:
        """The largest error of a reading."""
        return max(self.errors[reading].values())


@dataclass(frozen=True)
class Omission:
    """A run that was meant to be, and gave nothing."""

    study: str
    labels: dict[str, str]
    repetition: int
    reason: str


#: The table of the specimen with what belongs to it, such as [[specimen.cut]].
SPECIMEN = re.compile(r"^\[specimen\].*?(?=^\[\[?(?!specimen\b)[A-Za-z_]|\Z)", re.MULTILINE | re.DOTALL)


def specimen_text(scene: str) -> str:
    """The recipe of a scene's specimen, as the scene writes it; CodeFailure when there is none."""
    found = SPECIMEN.search(scene)
    if not found:
        raise CodeFailure("the scene has no [specimen]")
    return found.group()


def digest(*words: str) -> str:
    """A short name for words."""
    return hashlib.sha256("\0".join(words).encode()).hexdigest()[:16]


def scene_of(study: Study, point: Point, repetition: int) -> str:
    """The scene of one run, its specimen still a recipe; one that is no packing is always the same."""
    packing = {"seed = 1": f"seed = {repetition}"} if "seed = 1" in study.template else {}
    return replace_words(study.template, {**point.replace, **packing})


class Specimens:
    """Specimens by recipe, each made once, with the time that took."""

    def __init__(self, folder: Path, standalone: Standalone, program: str):
        """`program` names the very build, so that another one makes its own."""
        self.folder, self._standalone, self._program = folder, standalone, program
        self._failed: dict[str, CodeFailure] = {}
        folder.mkdir(parents=True, exist_ok=True)

    def get(self, scene: str, timeout: float) -> tuple[Path, float]:
        """File and seconds of the specimen of a scene; CodeFailure when it cannot be made."""
        recipe = json.dumps(tomllib.loads(scene)["specimen"], sort_keys=True)
        name = digest(recipe, self._program)
        if name in self._failed:
            raise self._failed[name]
        path, told = self.folder / f"{name}.h5", self.folder / f"{name}.json"
        if not told.exists():
            text = self.folder / f"{name}.scene"
            text.write_text(specimen_text(scene))
            start = time.perf_counter()
            try:
                self._standalone.call(["specimen", text, "--output", path, "--overwrite"],
                                      self.folder / f"{name}.log", timeout)
            except CodeFailure as failure:
                self._failed[name] = CodeFailure(f"no specimen: {failure}")
                raise self._failed[name] from failure
            told.write_text(json.dumps({"recipe": json.loads(recipe),
                                        "seconds": time.perf_counter() - start}))
        return path, float(json.loads(told.read_text())["seconds"])


class Bench:
    """Runs points of studies and remembers them by scene, code and program."""

    def __init__(self, folder: Path, codes: dict[str, Code], resume: bool,
                 say: Callable[[str], None] = print):
        """Without `resume` everything in `folder` is measured anew."""
        standalone = codes["standalone"]
        assert isinstance(standalone, Standalone)
        if reason := standalone.missing():
            raise CodeFailure(reason)
        if not resume:
            shutil.rmtree(folder, ignore_errors=True)
        self.codes, self._standalone, self._say = codes, standalone, say
        self.program = hashlib.sha256(standalone.program.read_bytes()).hexdigest()[:16]
        self._kept_runs, self._work = folder / "runs", folder / "work"
        self._kept_runs.mkdir(parents=True, exist_ok=True)
        self.specimens = Specimens(folder / "specimens", standalone, self.program)
        self.calibrations = Calibrations(folder / "calibrations", standalone, self.program,
                                         self.specimens.get)
        self._known = folder / "known"
        self._series: dict[Any, Any] = {}
        self._limits: dict[str, float] = {}
        self._references: dict[str, Result | CodeFailure] = {}

    def all(self, studies: list[Study], quick: bool, repetitions: int | None,
            seed: int = 1) -> tuple[list[Run], list[Omission]]:
        """Everything the studies ask for, in a shuffled order that is always the same."""
        todo = [(study, point, n + 1) for study in studies for point in study.points(quick)
                for n in range(min(study.repetitions_of(point), repetitions or 1000))]
        random.Random(seed).shuffle(todo)
        self._get_ready(todo)
        runs: list[Run] = []
        omissions: list[Omission] = []
        for order, (study, point, repetition) in enumerate(todo, 1):
            start = time.perf_counter()
            try:
                run = self._run(study, point, repetition, order)
                runs.append(run)
                words = f"{run.seconds:.3g} s, error {run.error(study.readings[0].name):.2g}"
            except CodeFailure as failure:
                omissions.append(Omission(study.name, point.labels, repetition, str(failure)))
                words = f"FAILED: {failure}"
            self._say(f"{order}/{len(todo)} {study.name}, {point.name}: {words} "
                      f"({time.perf_counter() - start:.1f} s in all)")
        return runs, omissions

    def _get_ready(self, todo: list[tuple[Study, Point, int]]) -> None:
        """Builds codes and makes specimens before a run is timed; its runs say what failed."""
        for name in {point.code for _, point, _ in todo} & set(self.codes):
            self.codes[name].missing()
        for study, point, repetition in todo:
            try:
                text = scene_of(study, point, repetition)
                self.specimens.get(text, study.timeout)
                self.calibrations.get(text, study.timeout)
                self.known(study)
            except CodeFailure:
                continue

    def known(self, study: Study) -> dict[str, Figures]:
        """What a study knows without a run."""
        return {name: figures(options, self._known) for name, options in study.known.items()}

    def all_known(self, studies: list[Study]) -> dict[str, dict[str, Figures]]:
        """By study; those that could not be found out are missing, as their runs say."""
        found = {}
        for study in studies:
            try:
                found[study.name] = self.known(study)
            except CodeFailure:
                continue
        return found

    def _run(self, study: Study, point: Point, repetition: int, order: int) -> Run:
        """One run, or what is kept of it."""
        text = scene_of(study, point, repetition)
        kept = self._kept_runs / (digest(
            text, point.code, json.dumps(point.environment, sort_keys=True), self.program,
            str(repetition), json.dumps([asdict(r) for r in study.readings]),
            json.dumps(study.options),
            json.dumps({k: asdict(r) for k, r in study.references.items()}),
            json.dumps(study.known)) + ".json")
        if kept.exists():
            return Run(**{**json.loads(kept.read_text()), "order": order, "labels": point.labels})
        shutil.rmtree(self._work, ignore_errors=True)
        self._work.mkdir(parents=True)
        try:
            run = self._measure(study, point, repetition, order, text)
        except (PreparedError, OSError, KeyError, TypeError, ValueError) as error:
            raise CodeFailure(f"{type(error).__name__}: {error}") from error
        kept.write_text(json.dumps(asdict(run)))
        return run

    def _measure(self, study: Study, point: Point, repetition: int, order: int,
                 text: str) -> Run:
        code = self.codes.get(point.code)
        if code is None or (reason := code.missing()):
            raise CodeFailure(f"{point.code} is missing" + (f": {reason}" if code else ""))
        references = {name: self._reference(study, point, name, repetition)
                      for name in study.runs_of()}
        known = self.known(study)
        specimen, packing = self.specimens.get(text, study.timeout)
        text, calibrating = self.calibrations.get(text, study.timeout)
        scene = self._write_scene(text, specimen, study.timeout)
        job = self._job(study, point, scene, specimen, text)
        before = {name: os.environ.get(name) for name in point.environment}
        os.environ.update(point.environment)
        load = os.getloadavg()[0]
        try:
            start = time.perf_counter()
            result = code.run(job, self._work / point.code).check()
            program_seconds = time.perf_counter() - start
        finally:
            for name, value in before.items():
                os.environ.pop(name) if value is None else os.environ.update({name: value})
        found = {reading.name: errors(study, reading, job, result, self._series,
                                      references.get(reading.reference),
                                      known.get(reading.reference))
                 for reading in study.readings}
        summary, set_up = self._summary(point)
        seconds = result.wall_seconds
        if point.code == "statics":  # which takes no steps; writing counts nowhere
            seconds = sum(summary["wall_seconds"].get(part, 0) for part in ("equilibrium", "modes"))
        return Run(study.name, point.labels, repetition, order, result.elements, result.bonds,
                   result.steps, seconds, set_up, packing + calibrating, found, summary,
                   program_seconds, load)

    def _write_scene(self, text: str, specimen: Path, timeout: float) -> Path:
        """The scene as codes get it: its specimen a file, its time step a number."""
        text = text.replace(specimen_text(text), f'[specimen]\nfile = "{specimen}"\n\n')
        scene = self._work / "scene.toml"
        if fraction := STEP_OF_LIMIT.search(text):
            probe = STEP_OF_LIMIT.sub("time_step_ratio = 0.1", text)
            if probe not in self._limits:
                scene.write_text(probe)
                told = self._standalone.call(["explain", scene, "--json", "--quick"],
                                             self._work / "limit", timeout)
                self._limits[probe] = float(json.loads(told.read_text())["time_step"]["limit"])
            step = float(fraction.group(1)) * self._limits[probe]
            text = STEP_OF_LIMIT.sub(f'time_step = "{step:.12g} s"', text)
        scene.write_text(text)
        return scene

    def _reference(self, study: Study, point: Point, name: str, repetition: int) -> Result:
        """The run that a point is compared with, made once by the standalone program or its statics."""
        reference = study.reference_of(point, name)
        own = study.references[name].own_specimen
        text = scene_of(study, reference, repetition if own else 1)
        key = f"{reference.code}\n{text}"
        if key not in self._references:
            self._references[key] = self._make_reference(study, text, reference.code)
        found = self._references[key]
        if isinstance(found, CodeFailure):
            raise found
        return found

    def _make_reference(self, study: Study, text: str, code: str) -> Result | CodeFailure:
        try:
            specimen, _ = self.specimens.get(text, study.timeout)
            text, _ = self.calibrations.get(text, study.timeout)
            scene = self._write_scene(text, specimen, study.timeout)
            job = self._standalone_job(study, scene, specimen)
            result = self.codes[code].run(job, self._work / "reference").check()
            shutil.rmtree(self._work / "reference")
            return replace(result, frames=[])
        except CodeFailure as failure:
            return CodeFailure(f"no reference: {failure}")

    def _summary(self, point: Point) -> tuple[dict[str, Any], float | None]:
        """What the standalone program said of itself, and its set-up, s."""
        if point.code not in OWN:
            return {}, None
        said = json.loads((self._work / point.code / "results" / "summary.json").read_text())
        wall = said["wall_seconds"]
        kept = ("solidem", "precision", "threads", "instruction_set", "hardware", "integrator",
                "time_step", "time_step_limit", "peak_memory_bytes", "wall_seconds")
        return {k: said[k] for k in kept if k in said}, wall.get("specimen", 0) + wall["set-up"]

    @staticmethod
    def _standalone_job(study: Study, scene: Path, specimen: Path) -> Job:
        """The standalone program reads the scene itself; measures look at the body alone."""
        return Job(scene, specimen, specimen, read_specimen(specimen),
                   parse_parameters({"time_step": {"value": 0}, "steps": 0}), 0, 0,
                   study.timeout, study.options)

    def _job(self, study: Study, point: Point, scene: Path, specimen: Path, text: str) -> Job:
        """The job; other codes, and measures that ask for it, also need what `prepare` and `explain`
        give."""
        if point.code in OWN and not study.options.get("prepared"):
            return self._standalone_job(study, scene, specimen)
        prepared = self._work / "prepared.h5"
        self._standalone.call(["prepare", scene, "--output", prepared, "--overwrite"],
                              self._work / "prepare", study.timeout)
        explained = self._standalone.call(["explain", scene, "--json", "--quick"],
                                          self._work / "explain", study.timeout)
        parameters = parse_parameters(json.loads(explained.read_text()))
        frames = tomllib.loads(text).get("output", {}).get("frames", 10)
        return Job(scene, prepared, explained, read_specimen(prepared), parameters,
                   max(1, parameters.steps // 200), max(1, parameters.steps // max(1, frames)),
                   study.timeout, study.options)
