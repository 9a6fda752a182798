# SPDX-License-Identifier: GPL-2.0-or-later
"""A case: a scene, the codes that run it, and what their results are checked against.

A case is one TOML file in compare/cases/; the README of compare/ lists its keys.
"""

from __future__ import annotations

import itertools
import string
import tomllib
from dataclasses import MISSING, dataclass, field, fields
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

#: What a reference is worth.
CLASSES = {"A": "analytic", "P": "published", "C": "other code", "R": "regression"}


class CaseError(ValueError):
    """A case file is wrong; says file, key, value and what is allowed."""


@dataclass(frozen=True)
class Variant:
    """One run of the scene in some codes, with words of the scene replaced."""

    name: str
    codes: tuple[str, ...]
    replace: dict[str, str] = field(default_factory=dict)  #: text of the scene -> other text
    values: dict[str, Any] = field(default_factory=dict)  #: what checks refer to
    pattern: str = ""  #: the name before words were put in

    def name_over(self, keys: tuple[str, ...], group: list[Variant]) -> str:
        """A name for a group of variants that differ in these values only."""
        if not any(f"${key}" in self.pattern for key in keys):
            return "all"
        ends = {key: (group[0].values[key], group[-1].values[key]) for key in keys}
        spans = {key: f"{a}–{b}" if a != b else a for key, (a, b) in ends.items()}
        return str(_put_in(self.pattern, {**self.values, **spans}, ""))


@dataclass(frozen=True)
class Check:
    """One row (or one for each variant) of the table."""

    quantity: str  #: what the row is called
    measure: str  #: name of a measure, compare/measures.py
    label: str  #: "A", "P", "C" or "R"
    code: str  #: the code that is tested
    reference: str  #: another code, or the name of a reference
    tolerance: float
    reason: str  #: why this tolerance
    variants: tuple[str, ...] = ()  #: names, * for any text; empty: all that run the code
    over: tuple[str, ...] = ()  #: values: one row for the variants that differ in these alone
    tolerance_times: str = ""  #: a value of the variant that multiplies the tolerance
    options: dict[str, Any] = field(default_factory=dict)  #: of the measure


@dataclass(frozen=True)
class Case:
    """What a file in compare/cases/ says."""

    name: str
    title: str
    path: Path
    scene: Path | None
    variants: tuple[Variant, ...]
    checks: tuple[Check, ...]
    timeout: float = 600  #: s, for one run of one code
    about: str = ""
    long: bool = False  #: left out unless it is asked for
    timed: bool = True  #: False: runs side by side, their times are no measurements
    options: dict[str, Any] = field(default_factory=dict)  #: what measures and codes may need

    def variant(self, name: str) -> Variant:
        """The variant of that name."""
        return next(v for v in self.variants if v.name == name)

    def variants_of(self, check: Check) -> list[Variant]:
        """The variants that a check looks at."""
        return [v for v in self.variants if check.code in v.codes
                and (not check.variants or any(fnmatchcase(v.name, n) for n in check.variants))]

    def groups_of(self, check: Check) -> list[list[Variant]]:
        """The variants of each row of a check."""
        groups: dict[str, list[Variant]] = {}
        for v in self.variants_of(check):
            key = {k: x for k, x in v.values.items() if k not in check.over} if check.over else v.name
            groups.setdefault(repr(key), []).append(v)
        return list(groups.values())


def _put_in(text: Any, words: dict[str, Any], where: str) -> Any:
    """Puts words in place of $name, in tables and lists too; "$name" alone keeps its kind."""
    if isinstance(text, dict):
        return {_put_in(k, words, where): _put_in(v, words, where) for k, v in text.items()}
    if isinstance(text, list):
        return [_put_in(v, words, where) for v in text]
    if not isinstance(text, str) or "$" not in text:
        return text
    if text.startswith("$") and text[1:] in words:
        return words[text[1:]]
    try:
        return string.Template(text).substitute(words)
    except (KeyError, ValueError) as error:
        raise CaseError(f"{where}: {text!r}: no value for {error}; known: "
                        f"{', '.join(words) or 'none'}") from error


def _repeat(table: dict[str, Any], where: str) -> list[tuple[dict[str, Any], dict[str, Any]]]:
    """A table once for each combination in its `for`, words put in, with these words."""
    lists = table.pop("for", {})
    if not isinstance(lists, dict) or not all(isinstance(v, list) for v in lists.values()):
        raise CaseError(f"{where}: 'for' must be a table of lists")
    repeated = []
    for combination in itertools.product(*lists.values()):
        words: dict[str, Any] = {}
        for name, word in zip(lists, combination):
            words |= word if isinstance(word, dict) else {name: word}
        repeated.append((_put_in(table, words, where), words))
    return repeated


def _build(kind: type, table: dict[str, Any], where: str) -> Any:
    """A dataclass from a table; unknown and missing keys are errors."""
    known = {f.name: f for f in fields(kind)}
    for key in table:
        if key not in known:
            raise CaseError(f"{where}: unknown key {key!r}; known: {', '.join(known)}")
    for name, f in known.items():
        if name not in table and f.default is MISSING and f.default_factory is MISSING:
            raise CaseError(f"{where}: {name!r} is missing")
    return kind(**{k: tuple(v) if isinstance(v, list) else v for k, v in table.items()})


def _check(table: dict[str, Any], where: str) -> Check:
    table = {"class": None, **table}
    table["label"] = table.pop("class")
    if table["label"] not in CLASSES:
        raise CaseError(f"{where}: class {table['label']!r}; allowed: {', '.join(CLASSES)}")
    if isinstance(table.get("over"), str):
        table["over"] = [table["over"]]
    check: Check = _build(Check, table, where)
    if not check.tolerance > 0:
        raise CaseError(f"{where}: tolerance {check.tolerance}; must be above 0")
    if not check.reason.strip():
        raise CaseError(f"{where}: the reason for the tolerance is empty")
    return check


def _variants(tables: list[dict[str, Any]], where: str) -> tuple[Variant, ...]:
    variants = []
    for n, table in enumerate(tables):
        here = f"{where}: variant {n + 1}"
        pattern = str(table.get("name", ""))
        for found, words in _repeat(table, here):
            found["values"] = {**words, **found.get("values", {})}
            variants.append(_build(Variant, {**found, "pattern": pattern}, here))
    return tuple(variants)


def _checks(tables: list[dict[str, Any]], where: str) -> tuple[Check, ...]:
    return tuple(_check(found, f"{where}: check {n + 1}") for n, table in enumerate(tables)
                 for found, _ in _repeat(table, f"{where}: check {n + 1}"))


def _agree(case: Case, check: Check) -> None:
    """CaseError when a check asks for variants or values that are not there."""
    where = f"{case.path}: check {check.quantity!r}"
    for name in check.variants:
        if not any(fnmatchcase(v.name, name) for v in case.variants):
            raise CaseError(f"{where}: no variant {name!r}")
    if not case.variants_of(check):
        raise CaseError(f"{where}: no variant runs {check.code!r}")
    for variant in case.variants_of(check):
        for key in (*check.over, check.tolerance_times):
            if key and key not in variant.values:
                raise CaseError(f"{where}: variant {variant.name!r} has no value {key!r}")


def read_case(path: Path) -> Case:
    """Reads and checks a case file; CaseError says what is wrong."""
    try:
        table = tomllib.loads(path.read_text())
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise CaseError(f"{path}: {error}") from error
    variants = _variants(table.pop("variant", []), str(path))
    checks = _checks(table.pop("check", []), str(path))
    scene = table.pop("scene", None)
    case: Case = _build(Case, {
        **table, "name": path.stem, "path": path, "variants": variants, "checks": checks,
        "scene": None if scene is None else (path.parent / scene).resolve()}, str(path))
    if not variants or not checks:
        raise CaseError(f"{path}: a case needs at least one [[variant]] and one [[check]]")
    if len({v.name for v in variants}) < len(variants):
        raise CaseError(f"{path}: two variants have the same name")
    for check in checks:
        _agree(case, check)
    return case


def find_cases(directory: Path) -> dict[str, Path]:
    """Case files of a directory by name."""
    return {path.stem: path for path in sorted(directory.glob("*.toml"))}
