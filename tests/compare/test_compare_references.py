# SPDX-License-Identifier: GPL-2.0-or-later
"""The references are right by facts of their own."""

from __future__ import annotations

import math

import numpy as np
import pytest

from compare.references import beam_stiffness, finite_difference_step, rod_temperature
from compare.result import CodeFailure
from compare.runs import replace_words, table_text


def test_rod_at_its_hot_end_and_at_late_times() -> None:
    x = np.linspace(0, 2.0, 9)
    assert rod_temperature(x[:1], 2.0, 0.05, 298, 798)[0] == pytest.approx(798)
    assert rod_temperature(x, 2.0, 20.0, 298, 798) == pytest.approx(np.full(9, 798.0))


def test_rod_at_early_times_is_the_half_space() -> None:
    fourier = 0.01
    x = np.linspace(0.05, 0.5, 10)
    half_space = [298 + 500 * math.erfc(d / (2 * math.sqrt(fourier))) for d in x]
    assert rod_temperature(x, 1.0, fourier, 298, 798) == pytest.approx(half_space, abs=1e-8)


def test_finite_differences_keep_a_linear_field_and_damp_a_sine_exactly() -> None:
    grid = np.indices((9, 5, 5)).astype(float)
    linear = 2 * grid[0] - grid[1] + 3 * grid[2]
    assert finite_difference_step(linear, 0.1) == pytest.approx(linear, abs=1e-13)
    wave = np.sin(np.pi * grid[0] / 8)
    factor = 1 - 2 * 0.1 * (1 - math.cos(math.pi / 8))
    stepped = finite_difference_step(wave, 0.1)[1:-1, 1:-1, 1:-1]
    assert stepped == pytest.approx(factor * wave[1:-1, 1:-1, 1:-1], abs=1e-14)


def test_beam_matrix_against_beam_theory() -> None:
    chord, r, e, g = np.array([0.3, -0.2, 0.6]), 0.05, 7.0, 2.6
    length = float(np.linalg.norm(chord))
    matrix = beam_stiffness(chord, r, e, g)
    assert matrix == pytest.approx(matrix.T)
    # Six rigid motions, and no more, cost nothing.
    assert (np.abs(np.linalg.eigvalsh(matrix)) < 1e-14).sum() == 6
    # A cantilever under a load at its tip: deflection P l³ / 3 E I, slope P l² / 2 E I.
    side = np.cross(chord, [0, 0, 1.0])
    side /= np.linalg.norm(side)
    free = np.r_[3:6, 9:12]
    tip = np.linalg.solve(matrix[np.ix_(free, free)], np.concatenate([side, np.zeros(3)]))
    second = math.pi * r**4 / 4
    assert tip[:3] == pytest.approx(side * length**3 / (3 * e * second), abs=1e-9)
    assert tip[3:] == pytest.approx(np.cross(chord / length, side) * length**2 / (2 * e * second))


def test_scene_text_is_replaced_once_or_not_at_all() -> None:
    assert replace_words("a b c", {"b": "d"}) == "a d c"
    for text in ("a c", "b b"):
        with pytest.raises(CodeFailure):
            replace_words(text, {"b": "d"})
    assert table_text("x = 1\n[one]\na = [\n1]\n\n[two]\n", "one") == "[one]\na = [\n1]\n\n"
