# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of central forces on results that are known, and on such that must not pass."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import compare.central  # noqa: F401  (makes its measures known)
from compare.measures import MEASURES
from compare.result import CodeFailure, Frame, Result
from contrib.prepared import CentralForces, Parameters, Specimen

REST, STIFFNESS, ATTRACTION = 2e-4, 1.5e6, 25.0
FORCES = CentralForces("piecewise", {"stiffness": STIFFNESS, "attraction": ATTRACTION}, 1.5,
                       interpenetration=0.5)
PAIR = Specimen(Path("pair"), np.array([[0, 0, 0], [REST, 0, 0]]), np.full(2, REST / 2),
                np.array([[0, 1]]))


def result(columns: dict[str, Any], code: str = "standalone") -> Result:
    rows = len(next(iter(columns.values())))
    steps = np.arange(rows, dtype=float)
    columns = {"grip.left.displacement_x": np.zeros(rows), **columns}
    return Result(code, 2, 1, rows - 1, 1e-9, 0.1, {"step": steps, "time": 1e-9 * steps, **columns},
                  [Frame(rows - 1, 0.0, {})])


def view(options: dict[str, Any], tested: Result, other: Result | None = None,
         reference: str = "other", specimen: Specimen = PAIR) -> Any:
    parameters = Parameters(1e-9, 10, None, None, (), {}, central_forces=FORCES)
    made = SimpleNamespace(
        tested=tested, other=other, case=SimpleNamespace(options={"length": 5e-3}),
        job=SimpleNamespace(specimen=specimen, parameters=parameters),
        check=SimpleNamespace(options=options, code=tested.code, reference=reference, quantity="q"),
        variant=SimpleNamespace(name="plain", values={"law": "piecewise"}),
        option=options.__getitem__)
    made.members = [made]
    return made


def path(to: float = 1.4, error: float = 0.0, rows: int = 200) -> Result:
    """The right element is moved; its force is the law's, but for an error at one place."""
    moved = np.linspace(0, to - 1, rows) * REST
    force = -np.maximum(-STIFFNESS * moved, -ATTRACTION)
    force[rows // 2] += error
    return result({"grip.right.displacement_x": moved, "grip.right.force_x": force})


def test_the_law_is_found_on_both_sides_of_the_equilibrium() -> None:
    for to in (0.7, 1.4):
        assert MEASURES["pair_force"](view({"to": to}, path(to), reference="equations")).error < 1e-14
        assert MEASURES["pair_force"](view({"to": to}, path(to), path(to))).error == 0


def test_a_small_force_is_measured_in_the_largest_attraction_and_a_large_one_in_itself() -> None:
    off = view({"to": 1.4}, path(1.4, 1e-3 * ATTRACTION), reference="equations")
    assert MEASURES["pair_force"](off).error == pytest.approx(1e-3)
    deep = path(0.7)
    there = abs(deep.history["grip.right.force_x"][100])
    off = view({"to": 0.7}, path(0.7, 1e-3 * there), path(0.7))
    assert there > 1.5 * ATTRACTION
    assert MEASURES["pair_force"](off).error == pytest.approx(1e-3)


def test_the_worst_of_a_group_counts() -> None:
    good, bad = (view({"to": 1.4}, path(1.4, e), reference="equations") for e in (0.0, 0.5))
    bad.variant.values["law"] = "another"
    good.members = [good, bad]
    assert MEASURES["pair_force"](good).error == pytest.approx(0.5 / ATTRACTION)


@pytest.mark.parametrize("tested, other, said", [
    (path(1.2), path(1.2), "the path went from 1 to 1.2"),
    (path(1.4), path(1.4, rows=100), "no row for each"),
    (path(1.4, rows=100), path(1.4), "different ways"),
    (path(1.4), path(1.39), "different ways"),
])
def test_paths_that_show_nothing_fail(tested: Result, other: Result, said: str) -> None:
    with pytest.raises(CodeFailure, match=said):
        MEASURES["pair_force"](view({"to": 1.4}, tested, other))


def test_more_than_two_elements_are_no_pair() -> None:
    three = Specimen(Path("three"), np.eye(3), np.ones(3), np.array([[0, 1], [1, 2]]))
    with pytest.raises(CodeFailure, match="3 elements and 2 pairs"):
        MEASURES["pair_force"](view({"to": 1.4}, path(), path(), specimen=three))


def test_a_body_that_does_not_rearrange_falls_short() -> None:
    pairs = np.full(30, 1000.0)
    still = view({"fraction": 0.01}, result({"interactions": pairs}))
    assert MEASURES["neighbours_changed"](still).error == 1
    pairs[10:20] = 1015  # they came and went
    assert MEASURES["neighbours_changed"](still).error == 0
    with pytest.raises(CodeFailure, match="no pair"):
        MEASURES["neighbours_changed"](view({"fraction": 0.01}, result({"interactions": 0 * pairs})))


def bar(peak: float, rupture: float, torn: bool = True) -> Result:
    """Force up to the peak at half of the elongation of rupture, then down to a quarter at it."""
    elongation = np.linspace(0, 0.3, 601)
    left = 0.25 if torn else 0.75
    force = np.interp(elongation, [0, rupture / 2, rupture - 1e-9, rupture],
                      [0, peak, 0.6 * peak, left * peak])
    half = 0.5 * elongation * 5e-3
    return result({"grip.right.displacement_x": half, "grip.left.displacement_x": -half,
                   "grip.right.force_x": force})


def group(pairs: list[tuple[Result, Result]], of: str) -> Any:
    members = [view({"of": of}, *pair) for pair in pairs]
    members[0].members = members
    return members[0]


def test_differences_of_codes_are_held_against_the_scatter_of_specimens() -> None:
    pairs = [(bar(1010, 0.15), bar(1000, 0.15)), (bar(1100, 0.18), bar(1100, 0.2))]
    assert MEASURES["rupture_over_scatter"](group(pairs, "peak")).error == pytest.approx(0.1)
    # Rows are 0.05 % of elongation apart.
    assert MEASURES["rupture_over_scatter"](group(pairs, "rupture")).error == pytest.approx(
        0.4, abs=0.02)


@pytest.mark.parametrize("pairs, of, said", [
    ([(bar(1000, 0.1), bar(1000, 0.1))], "peak", "two specimens"),
    ([(bar(1000, 0.1), bar(1000, 0.1))] * 2, "peak", "do not differ"),
    ([(bar(1000, 0.1), bar(1000, 0.1)), (bar(1000, 0.1, torn=False), bar(1000, 0.2))], "rupture",
     "not torn"),
    ([(bar(1000, 0.1), bar(1000, 0.1)), (bar(900, 0.1), bar(900, 0.1))], "modulus", "no figure"),
])
def test_scatter_that_is_none_fails(pairs: list[tuple[Result, Result]], of: str, said: str) -> None:
    with pytest.raises(CodeFailure, match=said):
        MEASURES["rupture_over_scatter"](group(pairs, of))
