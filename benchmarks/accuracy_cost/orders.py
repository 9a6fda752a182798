# SPDX-License-Identifier: GPL-2.0-or-later
"""At which order errors fall, and how time grows, over the elements of a study's points."""

from __future__ import annotations

import csv
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

import numpy as np

LEAST = 0.3  #: of an order: errors that fall more slowly do not fall
FIELDS = ("kind", "law", "order", "spread", "least_error", "time_exponent", "studies")


@dataclass(frozen=True)
class Order:
    """Of one law in one study and reading."""

    study: str
    law: str
    order: float  #: of the error over the size of elements, over all points
    local: list[float]  #: between neighbouring points
    least_error: float
    time_exponent: float  #: of the time over the elements


def points_of(path: Path) -> list[dict[str, str]]:
    """Rows of a points.csv."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def best_by_elements(points: Iterable[dict[str, str]]) -> list[tuple[float, float, float]]:
    """(elements, least error, seconds of the fastest of those nearly as good), the fewest first."""
    groups: dict[float, list[tuple[float, float]]] = defaultdict(list)
    for point in points:
        if point["code"] == "standalone":
            groups[float(point["elements"])].append((float(point["error"]), float(point["seconds"])))
    found = []
    for elements, pairs in sorted(groups.items()):
        least = min(error for error, _ in pairs)
        found.append((elements, least, min(s for error, s in pairs if error <= 1.1 * least)))
    return found


def order_of(study: str, law: str, points: Iterable[dict[str, str]]) -> Order | None:
    """None: fewer than three sizes."""
    best = best_by_elements(points)
    if len(best) < 3:
        return None
    sizes = np.log([elements**(-1 / 3) for elements, _, _ in best])
    errors = np.log([max(error, 1e-12) for _, error, _ in best])
    times = np.log([seconds for _, _, seconds in best])
    order, _ = np.polyfit(sizes, errors, 1)
    exponent, _ = np.polyfit(-3 * sizes, times, 1)
    return Order(study, law, float(order), (np.diff(errors) / np.diff(sizes)).tolist(),
                 float(np.exp(errors.min())), float(exponent))


def table(orders: dict[str, list[Order]]) -> list[dict[str, Any]]:
    """Rows of the studies' table, for each kind of scene and law of conduction: means over studies whose
    errors fall."""
    rows = []
    for kind, all_of_kind in orders.items():
        of_kind = [one for one in all_of_kind if one.order >= LEAST]
        for law in sorted({one.law for one in of_kind}):
            same = [one for one in of_kind if one.law == law]
            local = [value for one in same for value in one.local]
            rows.append({
                "kind": kind, "law": law, "order": f"{np.mean([one.order for one in same]):.3g}",
                "spread": f"{np.std(local) / np.sqrt(len(local)) + np.std([o.order for o in same]):.2g}",
                "least_error": f"{min(one.least_error for one in same):.2g}",
                "time_exponent": f"{np.mean([one.time_exponent for one in same]):.3g}",
                "studies": " and ".join(dict.fromkeys(one.study for one in same))})
    return rows


def write_table(rows: list[dict[str, Any]], path: Path) -> None:
    """A CSV."""
    with path.open("w", newline="", encoding="utf-8") as file:
        made = csv.DictWriter(file, FIELDS, lineterminator="\n")
        made.writeheader()
        made.writerows(rows)
