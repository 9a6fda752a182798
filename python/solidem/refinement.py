# SPDX-License-Identifier: GPL-2.0-or-later
"""How the bodies of a scene are made of more elements, or packed anew."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import log
from typing import Any, Mapping

from ._core import InputError

QUANTITY = re.compile(r"\s*([-+0-9.eE]+)\s*(.*)$")


@dataclass(frozen=True)
class Body:
    """A body whose packing a scene asks for."""

    place: str  #: "specimen", or "body.NAME"
    elements: int | None  #: that are asked for
    mean_radius: str | None  #: or this

    def changes(self, factor: float) -> dict[str, Any]:
        """For so many times the elements."""
        if self.elements is not None:
            return {f"{self.place}.elements": max(1, round(self.elements * factor))}
        assert self.mean_radius is not None
        quantity = QUANTITY.match(self.mean_radius)
        assert quantity is not None
        radius = float(quantity.group(1)) * factor**(-1 / 3)
        return {f"{self.place}.mean_radius": f"{radius:.6g} {quantity.group(2)}"}


@dataclass(frozen=True)
class Refinement:
    """What of a scene gets finer together."""

    bodies: list[Body]  #: empty: none can
    why_not: str  #: what keeps bodies as they are; empty: nothing
    seeds: dict[str, int]  #: key of the seed of each packing -> the scene's own

    def changes(self, factor: float, packing: int | None = None) -> dict[str, Any]:
        """For so many times the elements. `packing`: of which number; None: as the scene has its seed.
        Packings of one seed but another fineness resemble each other, so each has its own; number 0 of
        the scene's own fineness is the scene's."""
        found: dict[str, Any] = {}
        for body in self.bodies:
            found |= body.changes(factor)
        if packing is not None and (more := 100 * (packing + 1000 * round(100 * abs(log(factor))))):
            found |= {key: seed + more for key, seed in self.seeds.items()}
        return found


def _entries(tables: Mapping[str, Any]) -> list[tuple[str, Mapping[str, Any]]]:
    """The bodies of a scene by where their keys stand."""
    if "specimen" in tables:
        return [("specimen", tables["specimen"])]
    return [(f"body.{body.get('name', number)}", body)
            for number, body in enumerate(tables.get("body", []))]


def refinement_of(tables: Mapping[str, Any]) -> Refinement:
    """Bodies of one element stay what they are, as do lattices, packings from files, and bodies under
    central forces, whose constants make another material of finer elements."""
    if "central_forces" in tables:
        return Refinement([], "[central_forces]: stiffness and attraction are those of one fineness, "
                          "and of finer elements they make another material", {})
    bodies, seeds, kept = [], {}, []
    for place, table in _entries(tables):
        if "file" in table:
            kept.append(f"[{place}] file: a packing that is given")
        elif table.get("shape") == "crystal":
            kept.append(f"[{place}] shape = \"crystal\": a lattice")
        elif table.get("elements") == 1:
            continue
        elif "elements" in table or "mean_radius" in table:
            bodies.append(Body(place, table.get("elements"), table.get("mean_radius")))
            seeds[f"{place}.seed"] = int(table.get("seed", 1))
    if kept and bodies:
        raise InputError(f"{'; '.join(kept)}: it would stay coarse while other bodies get finer; "
                         "expected recipes of packings alone, or none")
    return Refinement(bodies, "; ".join(kept), seeds)
