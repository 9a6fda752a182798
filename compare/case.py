# SPDX-License-Identifier: GPL-2.0-or-later
"""A case: a scene, the codes that run it, and what their results are checked against.

A case is one TOML file in compare/cases/; the README of compare/ lists its keys.
"""

from __future__ import annotations

import tomllib
from dataclasses import MISSING, dataclass, field, fields
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
    values: dict[str, float] = field(default_factory=dict)  #: numbers that checks refer to


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
    variants: tuple[str, ...] = ()  #: empty: every variant that runs the code
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
    options: dict[str, Any] = field(default_factory=dict)  #: of cases without a scene

    def variant(self, name: str) -> Variant:
        """The variant of that name."""
        return next(v for v in self.variants if v.name == name)

    def variants_of(self, check: Check) -> list[Variant]:
        """The variants that a check looks at."""
        if check.variants:
            return [self.variant(name) for name in check.variants]
        return [v for v in self.variants if check.code in v.codes]


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
    check: Check = _build(Check, table, where)
    if not check.tolerance > 0:
        raise CaseError(f"{where}: tolerance {check.tolerance}; must be above 0")
    if not check.reason.strip():
        raise CaseError(f"{where}: the reason for the tolerance is empty")
    return check


def read_case(path: Path) -> Case:
    """Reads and checks a case file; CaseError says what is wrong."""
    try:
        table = tomllib.loads(path.read_text())
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise CaseError(f"{path}: {error}") from error
    variants = tuple(_build(Variant, v, f"{path}: variant {n + 1}")
                     for n, v in enumerate(table.pop("variant", [])))
    checks = tuple(_check(c, f"{path}: check {n + 1}")
                   for n, c in enumerate(table.pop("check", [])))
    scene = table.pop("scene", None)
    case: Case = _build(Case, {
        **table, "name": path.stem, "path": path, "variants": variants, "checks": checks,
        "scene": None if scene is None else (path.parent / scene).resolve()}, str(path))
    if not variants or not checks:
        raise CaseError(f"{path}: a case needs at least one [[variant]] and one [[check]]")
    names = {v.name for v in variants}
    for check in checks:
        if unknown := [name for name in check.variants if name not in names]:
            raise CaseError(f"{path}: check {check.quantity!r}: no variant {unknown[0]!r}")
        if not case.variants_of(check):
            raise CaseError(f"{path}: check {check.quantity!r}: no variant runs {check.code!r}")
        for variant in case.variants_of(check):
            if check.tolerance_times and check.tolerance_times not in variant.values:
                raise CaseError(f"{path}: variant {variant.name!r} has no value "
                                f"{check.tolerance_times!r}")
    return case


def find_cases(directory: Path) -> dict[str, Path]:
    """Case files of a directory by name."""
    return {path.stem: path for path in sorted(directory.glob("*.toml"))}
