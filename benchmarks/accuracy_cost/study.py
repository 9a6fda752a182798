# SPDX-License-Identifier: GPL-2.0-or-later
"""A study: a scene, what is varied in it, how the error is measured, and what is left out and why.

A study is one TOML file in studies/; the README of benchmarks/ lists its keys.
"""

from __future__ import annotations

import itertools
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


class StudyError(ValueError):
    """A study file is wrong; says file, key, value and what is allowed."""


@dataclass(frozen=True)
class Value:
    """One setting of an axis."""

    labels: dict[str, str]  #: what the tables say of it; the axis' own name is always there
    replace: dict[str, str] = field(default_factory=dict)  #: text of the scene -> other text
    environment: dict[str, str] = field(default_factory=dict)  #: of the program


@dataclass(frozen=True)
class Point:
    """One combination: a setting of every axis."""

    labels: dict[str, str]
    replace: dict[str, str]
    environment: dict[str, str]

    @property
    def code(self) -> str:
        """The code that runs it: the label `solver` or `code`, if an axis gives one."""
        return self.labels.get("solver", "") or self.labels.get("code", "standalone")

    @property
    def name(self) -> str:
        """All labels in a row."""
        return ", ".join(f"{key} {value}" for key, value in self.labels.items())

    def matches(self, where: dict[str, list[str]]) -> bool:
        """Whether each of these labels has one of these values."""
        return all(self.labels[key] in values for key, values in where.items())


@dataclass(frozen=True)
class Rule:
    """Points that are treated in another way than the rest."""

    where: dict[str, list[str]]
    unless: dict[str, list[str]]  #: but not these; empty: no exception
    why: str
    repetitions: int = 0  #: 0: left out

    def holds(self, point: Point) -> bool:
        """Whether the rule is about this point."""
        return point.matches(self.where) and not (self.unless and point.matches(self.unless))


@dataclass(frozen=True)
class Reading:
    """A way to read an error from a run: the largest of a measure with several options."""

    name: str
    measure: str  #: of compare/ or of measures.py
    options: dict[str, dict[str, Any]]  #: by what the table calls it
    reference: str = ""  #: the run, or what is known, that the measure compares with, if it needs one
    panel: bool = False  #: has a picture of its own


@dataclass(frozen=True)
class Move:
    """A knob and the pairs of its settings to be compared, all else equal."""

    words: str  #: "halving the step"
    axis: str
    pairs: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Reference:
    """The run that others are compared with: a point with some labels set to the best."""

    labels: dict[str, str]  #: the point's own hold where these say nothing
    replace: dict[str, str]  #: words of the scene -> other words
    own_specimen: bool  #: false: always the specimen of the first repetition


@dataclass(frozen=True)
class Study:
    """What a study file says."""

    name: str
    path: Path
    title: str
    about: str
    error: str  #: what the error is, in words
    template: str  #: text of the scene with what every run replaces
    axes: dict[str, list[Value]]
    readings: tuple[Reading, ...]  #: the first is the one the page speaks of
    moves: tuple[Move, ...]
    rules: tuple[Rule, ...]
    not_covered: tuple[str, ...]  #: what no axis has, and why
    quick: dict[str, list[str]]  #: labels kept in a quick try
    repetitions: int
    timeout: float  #: s, for one run
    options: dict[str, Any] = field(default_factory=dict)  #: of the measures, as in a case
    references: dict[str, Reference] = field(default_factory=dict)
    markers: str = "integrator"  #: the label that the markers of the picture tell
    kind: str = ""  #: of scene, as `solidem advise` calls it
    known: dict[str, dict[str, Any]] = field(default_factory=dict)  #: values that no run gives
    orders: str = ""  #: the reading whose errors fall with the size of elements at some order; empty: none

    def runs_of(self) -> list[str]:
        """References of readings that are runs, in their order."""
        return list(dict.fromkeys(r.reference for r in self.readings if r.reference in self.references))

    def reference_of(self, point: Point, name: str) -> Point:
        """The point that a point is compared with."""
        reference = self.references[name]
        labels: dict[str, str] = {}
        replace: dict[str, str] = {}
        environment: dict[str, str] = {}
        for axis, values in self.axes.items():
            wanted = reference.labels.get(axis, point.labels[axis])
            value = next(v for v in values if v.labels[axis] == wanted)
            labels |= value.labels
            replace |= value.replace
            environment |= value.environment
        return Point(labels, replace | reference.replace, environment)

    def points(self, quick: bool = False) -> list[Point]:
        """Every combination that is not left out."""
        return [p for p in self.combinations() if not (quick and not p.matches(self.quick))
                and self.repetitions_of(p) > 0]

    def combinations(self) -> list[Point]:
        """Every combination of the axes."""
        found = []
        for values in itertools.product(*self.axes.values()):
            labels: dict[str, str] = {}
            replace: dict[str, str] = {}
            environment: dict[str, str] = {}
            for value in values:
                labels |= value.labels
                replace |= value.replace
                environment |= value.environment
            found.append(Point(labels, replace, environment))
        return found

    def repetitions_of(self, point: Point) -> int:
        """How often a point is run; the first rule that matches decides, 0 is left out."""
        return next((r.repetitions for r in self.rules if r.holds(point)),
                    self.repetitions)

    def left_out(self) -> list[tuple[Rule, int]]:
        """Each rule that leaves points out, and how many no earlier rule decided on."""
        counts = dict.fromkeys(range(len(self.rules)), 0)
        for point in self.combinations():
            for number, rule in enumerate(self.rules):
                if rule.holds(point):
                    counts[number] += 1
                    break
        return [(r, counts[n]) for n, r in enumerate(self.rules) if r.repetitions == 0]


def _values(axis: dict[str, Any], where: str) -> list[Value]:
    """The settings of an axis, in a list of tables or of plain values with $value in `replace`."""
    name, found = str(axis["name"]), []
    for entry in axis["values"]:
        if not isinstance(entry, dict):
            entry = {name: entry, "replace": axis.get("replace", {})}
        entry = dict(entry)
        replace = {old: new.replace("$value", str(entry.get(name)))
                   for old, new in entry.pop("replace", {}).items()}
        environment = entry.pop("environment", {})
        if name not in entry:
            raise StudyError(f"{where}: axis {name!r}: a value without {name!r}")
        found.append(Value({k: str(v) for k, v in entry.items()}, replace, environment))
    return found


def _where(table: dict[str, Any], labels: dict[str, set[str]], where: str) -> dict[str, list[str]]:
    """Checked conditions: label -> allowed values."""
    found = {}
    for key, values in table.items():
        words = [str(v) for v in (values if isinstance(values, list) else [values])]
        for word in words:
            if word not in labels.get(key, set()):
                known = sorted(labels.get(key, labels))
                raise StudyError(f"{where}: {key} = {word!r}; known: {', '.join(known)}")
        found[key] = words
    return found


def _rules(table: dict[str, Any], labels: dict[str, set[str]], where: str) -> tuple[Rule, ...]:
    rules = []
    for kind in ("leave_out", "repeat"):
        for entry in table.pop(kind, []):
            if not str(entry.get("why", "")).strip():
                raise StudyError(f"{where}: [[{kind}]] without a reason; say `why`")
            here = f"{where}: [[{kind}]]"
            rules.append(Rule(_where(entry["where"], labels, here),
                              _where(entry.get("unless", {}), labels, here), entry["why"],
                              int(entry.get("repetitions", 0))))
    return tuple(rules)


def _moves(table: dict[str, Any], axes: dict[str, list[Value]], where: str) -> tuple[Move, ...]:
    found = []
    for entry in table.pop("move", []):
        axis = entry["axis"]
        known = {v.labels[axis] for v in axes.get(axis, [])}
        pairs = tuple((str(a), str(b)) for a, b in entry["pairs"])
        for word in itertools.chain(*pairs):
            if word not in known:
                raise StudyError(f"{where}: [[move]] {entry['words']!r}: {axis} has no {word!r}")
        found.append(Move(entry["words"], axis, pairs))
    return tuple(found)


def _references(table: dict[str, Any], axes: dict[str, list[Value]],
                where: str) -> dict[str, Reference]:
    known = {axis: {v.labels[axis] for v in values} for axis, values in axes.items()}
    found = {}
    for name, entry in table.pop("reference", {}).items():
        labels = _where(entry.get("labels", {}), known, f"{where}: [reference.{name}]")
        found[name] = Reference({axis: words[0] for axis, words in labels.items()},
                                entry.get("replace", {}), bool(entry.get("own_specimen", True)))
    return found


def _readings(table: dict[str, Any], references: list[str],
              where: str) -> tuple[Reading, ...]:
    readings = tuple(Reading(r["name"], r["measure"], r["options"], r.get("reference", ""),
                             bool(r.get("panel", False))) for r in table.pop("reading"))
    for reading in readings:
        if reading.reference and reading.reference not in references:
            raise StudyError(f"{where}: [[reading]] {reading.name!r}: reference = "
                             f"{reading.reference!r}; known: {', '.join(references) or 'none'}")
    return readings


def _orders(told: bool | str, readings: tuple[Reading, ...], where: str) -> str:
    """A reading's name: of the first, if nothing else is said; empty where no errors fall at an order."""
    name = told if isinstance(told, str) else readings[0].name if told else ""
    if name and name not in {reading.name for reading in readings}:
        raise StudyError(f"{where}: orders = {name!r}; known: {', '.join(r.name for r in readings)}")
    return name


def _template(table: dict[str, Any], path: Path) -> str:
    from compare.runs import replace_words  # the same replacing as in cases
    return replace_words((path.parent / table.pop("scene")).read_text(), table.pop("replace", {}))


def _study(table: dict[str, Any], path: Path) -> Study:
    where = str(path)
    axes = {str(axis["name"]): _values(axis, where) for axis in table.pop("axis")}
    labels: dict[str, set[str]] = {}
    for value in itertools.chain(*axes.values()):
        for key, word in value.labels.items():
            labels.setdefault(key, set()).add(word)
    references = _references(table, axes, where)
    known = table.pop("known", {})
    if both := set(known) & set(references):
        raise StudyError(f"{where}: {both.pop()!r} is a run and known; choose another name")
    readings = _readings(table, [*references, *known], where)
    markers = table.pop("markers", "integrator")
    if markers not in labels:
        raise StudyError(f"{where}: markers = {markers!r}; known: {', '.join(labels)}")
    kind = table.pop("kind", "")
    study = Study(
        path.stem, path, table.pop("title"), table.pop("about"), table.pop("error"),
        _template(table, path), axes, readings, _moves(table, axes, where),
        _rules(table, labels, where), tuple(table.pop("not_covered", [])),
        _where(table.pop("quick", {}), labels, f"{where}: [quick]"),
        int(table.pop("repetitions")), float(table.pop("timeout")), table.pop("options", {}),
        references, markers, kind, known, _orders(table.pop("orders", True), readings, where))
    if table:
        raise StudyError(f"{where}: unknown key {next(iter(table))!r}")
    if not study.points():
        raise StudyError(f"{where}: every combination is left out")
    return study


def read_study(path: Path) -> Study:
    """Reads and checks a study file; StudyError says what is wrong."""
    try:
        return _study(tomllib.loads(path.read_text()), path)
    except KeyError as error:
        raise StudyError(f"{path}: {error} is missing") from error
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise StudyError(f"{path}: {error}") from error
