# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of stress–strain curves that are known, and curves that must not pass."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import compare.cyclic  # noqa: F401  (makes its measures known)
from compare.measures import MEASURES
from compare.references import cyclic_stress, scaled_offset_stress
from compare.result import CodeFailure, Frame, Result
from compare.tension import Curve

E, YIELD, HARDENING = 73e9, 0.004, 0.02


def curve(torn_at: float = 0.15) -> Curve:
    strain = np.concatenate([np.linspace(0, 0.01, 2000), np.linspace(0.0101, 0.2, 2000)])
    stress = E * cyclic_stress(strain, YIELD, HARDENING)
    stress[strain > torn_at] = 0
    return Curve(1.1 * strain, strain, -0.33 * strain, stress)


def test_figures_of_a_bilinear_curve() -> None:
    found = curve()
    assert found.young_modulus == pytest.approx(E)
    assert found.poisson_ratio == pytest.approx(0.33)
    # Where the line E (ε − 0.2 %) meets the hardening branch: plastic strain 0.2 %.
    assert found.yield_stress == pytest.approx(E * (YIELD + HARDENING * 0.002), rel=1e-6)
    assert found.rupture_strain == pytest.approx(1.1 * 0.15, abs=2e-4)
    assert found.peak_stress == pytest.approx(E * (YIELD + HARDENING / (1 + HARDENING)
                                                   * (0.15 - YIELD)), rel=1e-3)


def test_a_bar_that_is_not_torn_has_no_rupture_strain() -> None:
    with pytest.raises(CodeFailure, match="not torn"):
        curve(torn_at=1.0).rupture_strain


def test_a_curve_that_never_yields_has_no_yield_stress() -> None:
    strain = np.linspace(0, 0.1, 100)
    with pytest.raises(CodeFailure, match="0.2 %"):
        Curve(strain, strain, -0.3 * strain, E * strain).yield_stress


def result(columns: dict[str, np.ndarray], code: str = "standalone") -> Result:
    rows = len(next(iter(columns.values())))
    steps = np.arange(rows, dtype=float)
    return Result(code, 10, 9, rows - 1, 1e-9, 0.1,
                  {"step": steps, "time": 1e-9 * steps, **columns}, [Frame(rows - 1, 0.0, {})])


def view(options: dict[str, Any], tested: Result, other: Result | None = None,
         group: list[Any] | None = None) -> Any:
    made = SimpleNamespace(
        tested=tested, other=other, case=SimpleNamespace(options={}),
        check=SimpleNamespace(options=options, code="standalone", reference="other", quantity="q"),
        variant=SimpleNamespace(name="plain", values={}), option=options.__getitem__)
    made.members = group if group is not None else [made]
    return made


def loop(law: Any) -> Result:
    points = [0.0, 0.012, -0.012, 0.012]
    strain = np.concatenate([np.linspace(a, b, 400) for a, b in zip(points, points[1:])])
    return result({"gauge.strain": strain, "gauge.stress": E * law(strain, YIELD, 1e-6)})


def test_yield_in_reverse_tells_the_laws_apart() -> None:
    there_and_back = loop(cyclic_stress)
    late = loop(scaled_offset_stress)
    assert MEASURES["reverse_yield"](view({}, there_and_back)).error < 0.02
    assert MEASURES["reverse_yield"](view({}, late)).error > 1
    assert MEASURES["reverse_yield"](view({"at_least": 0.5}, late)).error == 0
    assert MEASURES["reverse_yield"](view({"at_least": 0.5}, there_and_back)).error > 0.4


def test_a_bar_that_stays_elastic_or_is_not_pushed_is_no_witness() -> None:
    elastic = loop(lambda strain, limit, hardening: strain)
    with pytest.raises(CodeFailure, match="did not flow"):
        MEASURES["reverse_yield"](view({}, elastic))
    strain = np.linspace(0, 0.01, 100)
    with pytest.raises(CodeFailure, match="pushed"):
        MEASURES["reverse_yield"](view({}, result({"gauge.strain": strain,
                                                   "gauge.stress": E * strain})))


def test_cycles_that_creep_are_seen() -> None:
    time = np.arange(4001) * 1e-9
    stress = 100e6 * (1 - np.cos(2 * np.pi * time / 1e-6))
    for creep, grown in ((0.0, 0.0), (0.5, 1.5)):
        strain = stress / E + 1e-3 * (1 + creep * np.floor(time / 1e-6))
        found = MEASURES["cycles"](view({"of": "lasting strain", "period": 1e-6},
                                        result({"gauge.strain": strain, "gauge.stress": stress})))
        assert found.error == pytest.approx(grown, abs=1e-3)


def test_a_fall_and_a_drift_are_seen() -> None:
    rising = np.linspace(0, 2, 101)
    assert MEASURES["history_fall"](view({"column": "w"}, result({"w": rising}))).error == 0
    rising[50] -= 0.1
    assert MEASURES["history_fall"](view({"column": "w"}, result({"w": rising}))).error == (
        pytest.approx(0.04))
    held = np.full(101, 5.0)
    held[80] += 1e-6
    options = {"column": "w", "after": 40e-9, "steps": 50}
    assert MEASURES["history_drift"](view(options, result({"w": held}))).error == (
        pytest.approx(2e-7))
    with pytest.raises(CodeFailure, match="are needed"):
        MEASURES["history_drift"](view({**options, "steps": 100}, result({"w": held})))


def broken_pair(after: float) -> tuple[Result, Result]:
    force = np.linspace(0, 1, 101)
    broken = (np.arange(101) > 60).astype(float)
    other = force + np.where(broken > 0, after, 1e-9)
    return result({"f": other, "broken_bonds": broken}), result({"f": force,
                                                                 "broken_bonds": broken})


def test_differences_before_and_after_rupture_are_kept_apart() -> None:
    tested, other = broken_pair(0.1)
    found = MEASURES["difference_before_rupture"](view({"column": "f"}, tested, other))
    assert found.error == pytest.approx(1e-9)
    scattered = [view({"column": "f"}, *broken_pair(after)) for after in (0.1, 0.1)]
    scattered[1].other.history["f"] = scattered[1].other.history["f"] + 0.2
    scattered[1].tested.history["f"] = scattered[1].tested.history["f"] + 0.2
    after = MEASURES["difference_after_rupture"](view({"column": "f"}, tested, other, scattered))
    assert after.error == pytest.approx(0.5, rel=0.05)


def test_without_rupture_nothing_is_compared() -> None:
    tested, other = broken_pair(0.1)
    other.history["broken_bonds"][:] = 0
    with pytest.raises(CodeFailure, match="no bond broke"):
        MEASURES["difference_before_rupture"](view({"column": "f"}, tested, other))
