# SPDX-License-Identifier: GPL-2.0-or-later
"""What the studies of accuracy and cost found, in studies.csv: at which order bodies of which kind of
scene converge, and what the laws of conduction err by however fine they are.

The table is made by `python3 -m benchmarks.accuracy_cost.front_page`.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping

TABLE = Path(__file__).with_name("studies.csv")
#: Spread of an order at least: another scene is not the study's, and promises shall hold for orders from .4 to
#: 2 whatever a few studies agree on.
NARROWEST = 0.75


@dataclass(frozen=True)
class Study:
    """A row of the table."""

    kind: str  #: of scenes
    law: str  #: of conduction; empty: none
    order: float  #: p of the error over the size of elements
    spread: float  #: standard deviation of that order over the study's points and scenes
    least_error: float  #: that was reached with this law
    time_exponent: float  #: of the time over the elements
    studies: str  #: where that was found


def table(path: Path = TABLE) -> list[Study]:
    """All rows."""
    with path.open(newline="", encoding="utf-8") as file:
        return [Study(row["kind"], row["law"], float(row["order"]),
                      max(float(row["spread"]), NARROWEST), float(row["least_error"]),
                      float(row["time_exponent"]), row["studies"]) for row in csv.DictReader(file)]


def kind_of(tables: Mapping[str, Any]) -> str:
    """Of a scene: "heat", "elastic", "plastic", "contact", "coupled", "central forces", or "" where
    nothing acts."""
    moves = "beams" in tables or "central_forces" in tables
    touches = "contact" in tables or "tools" in tables
    if "conduction" in tables:
        return "coupled" if moves or touches else "heat"
    if "central_forces" in tables:
        return "central forces"
    if "plasticity" in tables or "rupture" in tables:
        return "plastic"
    if touches:
        return "contact"
    return "elastic" if moves else ""


def study_of(kind: str, law: str = "") -> Study | None:
    """The row of a kind of scene; of heat that of its law."""
    return next((row for row in table() if row.kind == kind and row.law in ("", law)), None)
