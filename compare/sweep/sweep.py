# SPDX-License-Identifier: GPL-2.0-or-later
"""What a sweep file says: a scene, what varies, what is measured, drawn and expected."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from compare.sweep.measures import MEASURES
from compare.sweep.scene_text import Scene, SceneChangeError, changed

SWEEPS = Path(__file__).parent.parent / "sweeps"
SCENES = Path(__file__).parent.parent / "scenes"


class SweepError(ValueError):
    """A sweep file that cannot be used."""


@dataclass(frozen=True)
class Setting:
    """One value of what varies: the changes it makes to the scene."""

    label: str
    values: dict[str, Any]
    removed: tuple[str, ...] = ()
    colour: str | None = None
    x_factor: float = 1.0  #: of x, where bodies differ in length
    y_factor: float = 1.0  #: of y, where bodies differ in section


@dataclass(frozen=True)
class Variation:
    """One thing that varies while all others stay as the scene has them."""

    name: str
    title: str
    settings: tuple[Setting, ...]
    seeds: tuple[int, ...]
    values: dict[str, Any] = field(default_factory=dict)  #: changes that all its points share
    removed: tuple[str, ...] = ()
    top: float | None = None  #: of its figure


@dataclass(frozen=True)
class Measure:
    """A figure read from the curve of a run."""

    name: str
    kind: str
    unit: str
    scale: float  #: of the unit
    options: dict[str, Any]


@dataclass(frozen=True)
class Check:
    """What a measure must do when a setting changes."""

    variation: str
    measure: str
    expects: str  #: see results.judge
    reason: str
    options: dict[str, Any]


@dataclass(frozen=True)
class Point:
    """One run: a setting of a variation with a specimen."""

    variation: str
    setting: Setting
    seed: int
    scene: Scene


@dataclass(frozen=True)
class Axis:
    """One axis of the curve: a sum of columns with factors, and how it is written."""

    columns: dict[str, float]
    label: str
    scale: float


@dataclass(frozen=True)
class Sweep:
    """A sweep file, read."""

    name: str
    title: str
    about: str
    x: Axis
    y: Axis
    variations: tuple[Variation, ...]
    measures: tuple[Measure, ...]
    checks: tuple[Check, ...]
    points: tuple[Point, ...]
    bands: tuple[dict[str, Any], ...]  #: what a source gives, drawn behind the curves


def find_sweeps(directory: Path = SWEEPS) -> dict[str, Path]:
    """Sweep files by name."""
    return {path.stem: path for path in sorted(directory.glob("*.toml"))}


def _settings(table: dict[str, Any], name: str) -> tuple[Setting, ...]:
    if "settings" in table:
        return tuple(Setting(entry["label"], entry.get("set", {}),
                             tuple(entry.get("remove", [])), entry.get("colour"),
                             float(entry.get("x_factor", 1)), float(entry.get("y_factor", 1)))
                     for entry in table["settings"])
    if "key" not in table or "values" not in table:
        raise SweepError(f"[[vary]] {name}: needs key and values, or settings")
    symbol = table.get("symbol", name)
    return tuple(Setting(f"{symbol} = {value}", {table["key"]: value})
                 for value in table["values"])


def _axis(table: dict[str, Any]) -> Axis:
    return Axis({k: float(v) for k, v in table["columns"].items()}, table["label"],
                float(table.get("scale", 1)))


def read_sweep(path: Path, quick: bool = False) -> Sweep:
    """Reads a sweep file and makes its points; SweepError says what is wrong with it."""
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        return _sweep(path, table, table.get("quick", {}) if quick else {})
    except (KeyError, TypeError) as error:
        raise SweepError(f"{path}: {type(error).__name__}: {error}") from error
    except (tomllib.TOMLDecodeError, SceneChangeError, SweepError) as error:
        raise SweepError(f"{path}: {error}") from error


def _sweep(path: Path, table: dict[str, Any], quick: dict[str, Any]) -> Sweep:
    scene_path = path.parent / table["scene"]
    base = changed(tomllib.loads(scene_path.read_text(encoding="utf-8")),
                   {**table.get("set", {}), **quick.get("set", {})}, table.get("remove", []))
    seeds = table.get("seeds", [1])
    variations = []
    for entry in table["vary"]:
        name = entry["name"]
        own = quick.get("seeds", entry.get("seeds", seeds))
        variations.append(Variation(name, entry.get("title", name), _settings(entry, name),
                                    tuple(own), entry.get("set", {}),
                                    tuple(entry.get("remove", [])), entry.get("top")))
    points = [Point(variation.name, setting, seed,
                    changed(base, {**variation.values, **setting.values,
                                   **({} if "file" in base["specimen"] else
                                      {"specimen.seed": seed})},
                            (*variation.removed, *setting.removed)))
              for variation in variations for setting in variation.settings
              for seed in variation.seeds]
    measures = tuple(Measure(entry["name"], entry["kind"], entry.get("unit", ""),
                             float(entry.get("scale", 1)), entry.get("options", {}))
                     for entry in table["measure"])
    for measure in measures:
        if measure.kind not in MEASURES:
            raise SweepError(f"[[measure]] {measure.name}: unknown kind {measure.kind!r}; there "
                             f"are {', '.join(sorted(MEASURES))}")
    checks = tuple(Check(entry["vary"], entry["measure"], entry["expects"], entry["reason"],
                         entry.get("options", {}))
                   for entry in table.get("check", [])
                   # Small bodies scatter too much for some.
                   if not (quick and entry.get("needs_size", False)))
    known = {v.name for v in variations}, {m.name for m in measures}
    for check in checks:
        if check.variation not in known[0] or check.measure not in known[1]:
            raise SweepError(f"[[check]] {check.variation}, {check.measure}: no such variation or "
                             "measure")
    return Sweep(path.stem, table["title"], table["about"], _axis(table["x"]), _axis(table["y"]),
                 tuple(variations), measures, checks, tuple(points),
                 tuple(table.get("band", [])))
