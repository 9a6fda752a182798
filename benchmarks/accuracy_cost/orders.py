# SPDX-License-Identifier: GPL-2.0-or-later
"""At which order errors fall, and how time grows, over the elements of a study's points."""

from __future__ import annotations

import csv
import math
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

import numpy as np

ORDERS = np.arange(0.1, 3.001, 0.02)  #: that are weighed
FIELDS = ("kind", "law", "order", "spread", "least_error", "time_exponent", "studies")


@dataclass(frozen=True)
class Order:
    """Of one law in one study and reading."""

    study: str
    law: str
    order: float  #: of the error over the size of elements: mean of what its points leave likely
    spread: float  #: standard deviation of that
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


def order_of(study: str, law: str, points: Iterable[dict[str, str]],
             reference: float = math.inf) -> Order | None:
    """None: fewer than three sizes. `reference`: elements of the body that errors are read against,
    which errs itself: then they are C (h^p - h_reference^p)."""
    best = [row for row in best_by_elements(points) if row[0] < reference]
    if len(best) < 3:
        return None
    sizes = np.array([elements for elements, _, _ in best])**(-1 / 3)
    errors = np.log([max(error, 1e-12) for _, error, _ in best])
    times = np.log([seconds for _, _, seconds in best])
    missed = []
    for order in ORDERS:
        apart = errors - np.log(sizes**order - reference**(-order / 3))
        missed.append(float(((apart - apart.mean())**2).sum()))
    # Of an unknown deviation, which is integrated over: as in Student's distribution.
    weights = (np.array(missed) + 1e-6)**(-(len(best) - 1) / 2)
    weights /= weights.sum()
    order = float((weights * ORDERS).sum())
    spread = float(np.sqrt((weights * (ORDERS - order)**2).sum()))
    exponent, _ = np.polyfit(-3 * np.log(sizes), times, 1)
    return Order(study, law, order, spread, float(np.exp(errors.min())), float(exponent))


def table(orders: dict[str, list[Order]]) -> list[dict[str, Any]]:
    """Rows of the studies' table, for each kind of scene and law of conduction: means over studies, spread
    within them and from one to the next."""
    rows = []
    for kind, of_kind in orders.items():
        for law in sorted({one.law for one in of_kind}):
            same = [one for one in of_kind if one.law == law]
            found = np.array([one.order for one in same])
            within = np.mean([one.spread**2 for one in same])
            rows.append({
                "kind": kind, "law": law, "order": f"{found.mean():.3g}",
                "spread": f"{np.sqrt(within + found.var()):.2g}",
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
