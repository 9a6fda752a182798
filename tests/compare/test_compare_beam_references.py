# SPDX-License-Identifier: GPL-2.0-or-later
"""References of beams are right by facts of their own, and what is measured against them can fail."""

from __future__ import annotations

import numpy as np
import pytest

from compare.references import (beam_stiffness, bilinear_stress, cantilever_frequencies,
                                cantilever_roots, collapse_load, cyclic_stress,
                                scaled_offset_stress, spring_stiffness, tip_deflection)
from compare.result import CodeFailure
from compare.slender_beams import peak_frequency

CHORD, RADIUS, YOUNG, SHEAR = np.array([0.3, -0.2, 0.6]), 0.05, 7.0, 2.6


def assembled(count: int, length: float, shear_coefficient: float = np.inf) -> np.ndarray:
    """Stiffness matrix of a straight chain of `count` beams; unknowns node by node."""
    matrix = np.zeros((6 * count + 6,) * 2)
    for n in range(count):
        part = beam_stiffness([length / count, 0, 0], RADIUS, YOUNG, SHEAR, shear_coefficient)
        at = np.concatenate([6 * n + np.r_[0:3], 6 * n + np.r_[6:9], 6 * n + np.r_[3:6],
                             6 * n + np.r_[9:12]])
        matrix[np.ix_(at, at)] += part
    return matrix


def test_timoshenko_cantilever_bends_and_shears() -> None:
    length, kappa = float(np.linalg.norm(CHORD)), 0.9
    matrix = beam_stiffness(CHORD, RADIUS, YOUNG, SHEAR, kappa)
    assert matrix == pytest.approx(matrix.T)
    side = np.cross(CHORD, [0, 0, 1.0])
    side /= np.linalg.norm(side)
    free = np.r_[3:6, 9:12]
    tip = np.linalg.solve(matrix[np.ix_(free, free)], np.concatenate([side, np.zeros(3)]))
    second, area = np.pi * RADIUS**4 / 4, np.pi * RADIUS**2
    expected = tip_deflection(1.0, length, YOUNG * second) + length / (kappa * SHEAR * area)
    assert tip[:3] @ side == pytest.approx(expected)


def test_timoshenko_beams_in_a_row_are_one_beam() -> None:
    free = np.r_[6:66]
    for kappa in (np.inf, 0.9):
        tips = []
        for count in (1, 10):
            matrix = assembled(count, 0.7, kappa)
            load = np.zeros(6 * count + 6)
            load[[-5, -1]] = 1.0, 0.3
            free = np.arange(6, 6 * count + 6)
            tips.append(np.linalg.solve(matrix[np.ix_(free, free)], load[free])[-6:])
        assert tips[0] == pytest.approx(tips[1])


def test_spring_resists_its_own_direction_alone() -> None:
    matrix = spring_stiffness(CHORD, RADIUS, YOUNG)
    length = float(np.linalg.norm(CHORD))
    pulled = matrix @ np.r_[np.zeros(3), CHORD / length, np.zeros(6)]
    assert pulled[3:6] == pytest.approx(YOUNG * np.pi * RADIUS**2 / length * CHORD / length)
    assert np.linalg.matrix_rank(matrix) == 1


def test_roots_of_the_cantilever() -> None:
    # Tabulated everywhere; a heavy tip leaves a beam clamped and pinned.
    assert cantilever_roots(3) == pytest.approx([1.875104069, 4.694091133, 7.854757438])
    assert cantilever_roots(3, 1e9)[1:] == pytest.approx([3.926602, 7.068583], rel=1e-6)


def test_heavy_tip_swings_as_a_mass_on_a_spring() -> None:
    found = cantilever_frequencies(1, 0.7, 3.0, 1e-6, 5.0)[0]
    assert found == pytest.approx(np.sqrt(3 * 3.0 / 0.7**3 / 5.0) / (2 * np.pi), rel=1e-6)


def test_frequencies_against_the_matrix_of_many_beams() -> None:
    length, mass, errors = 0.7, 2.0, []
    for count in (20, 40):
        matrix = assembled(count, length)
        inertia = np.tile([mass / count] * 3 + [1e-9] * 3, count + 1)
        across = [k for k in range(6, len(inertia)) if k % 6 in (1, 5)]
        root = np.sqrt(inertia[across])
        matrix = matrix[np.ix_(across, across)] / np.outer(root, root)
        found = np.sqrt(np.linalg.eigvalsh(matrix)[:3]) / (2 * np.pi)
        expected = cantilever_frequencies(3, length, YOUNG * np.pi * RADIUS**4 / 4, mass / length,
                                          0.5 * mass / count)
        errors.append(np.abs(found / expected - 1))
    assert (errors[1] < 4e-3).all()
    assert errors[0] / errors[1] == pytest.approx(np.full(3, 4.0), rel=0.15)  # second order


def test_collapse_is_a_moment_in_the_middle() -> None:
    assert collapse_load(3.0, 2.0) / 2 * 1.0 == pytest.approx(3.0)  # half the load, half the span


def path(*points: float) -> np.ndarray:
    return np.concatenate([np.linspace(a, b, 200) for a, b in zip((0.0, *points), points)])


def test_curves_of_flow_agree_where_they_must() -> None:
    strain = path(5.0)
    curve = bilinear_stress(strain, 1.0, 0.1)
    assert cyclic_stress(strain, 1.0, 0.1) == pytest.approx(curve, abs=1e-12)
    assert scaled_offset_stress(strain, 1.0, 0.1) == pytest.approx(curve, abs=1e-12)
    plastic = strain - curve
    assert curve[-1] == pytest.approx(1 + 0.1 * plastic[-1])


def test_reverse_flow_comes_at_once_or_late() -> None:
    strain = path(4.0, -4.0)
    back = cyclic_stress(strain, 1.0, 0.0)
    assert back.min() == pytest.approx(-1.0)
    late = scaled_offset_stress(strain[:-1], 1.0, 0.0)
    assert late.min() == pytest.approx(1 - 8.0, rel=0.01)  # elastic all the way back


def test_dissipated_work_is_never_negative() -> None:
    strain = path(4.0, -3.0, 5.0, 0.0)
    stress = cyclic_stress(strain, 1.0, 0.1)
    flow = np.diff(strain - stress)
    assert (stress[1:] * flow > -1e-12).all()
    assert (stress[1:] * flow).sum() > 10


def test_peak_of_a_spectrum() -> None:
    time = np.linspace(0, 10, 4001)
    record = np.sin(2 * np.pi * 3.217 * time) + 0.4 * np.cos(2 * np.pi * 11.3 * time) + 0.2
    assert peak_frequency(time, record, 2.8, 3.6) == pytest.approx(3.217, rel=1e-5)
    with pytest.raises(CodeFailure, match="no peak"):
        peak_frequency(time, record, 6.0, 8.0)
