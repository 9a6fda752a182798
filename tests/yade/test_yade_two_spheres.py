# SPDX-License-Identifier: GPL-2.0-or-later
"""One YADE beam under prescribed motions of its ends, against the stiffness matrix."""

from __future__ import annotations

import numpy as np
import pytest

from compare.beam_modes import modes
from compare.codes.base import TwoSpheres
from compare.codes.yade import Yade
from compare.references import beam_stiffness

FIRST = np.array([0.3e-3, -0.2e-3, 0.5e-3])
LENGTH, RADIUS, YOUNG, SHEAR = 1.9e-4, 0.3e-4, 3.5e12, 1.3e12
SIZES = np.array([1e-2, 1e-3, 1e-4])


@pytest.fixture(scope="module", params=["axis", "oblique"])
def errors(request: pytest.FixtureRequest,
           tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """Relative errors of each mode at all amplitudes."""
    oblique = np.array([2.0, -1.0, 3.0]) / np.sqrt(14.0)
    x = np.array([0.0, 1.0, 0.0]) if request.param == "axis" else oblique
    y = np.cross(x, [1.0, 0, 0])
    y /= np.linalg.norm(y)
    table = modes(np.stack([x, y, np.cross(x, y)]), LENGTH)
    motions = np.array([a * mode for mode in table.values() for a in SIZES])
    position = np.array([FIRST, FIRST + LENGTH * x])
    loads = Yade().beam_loads(TwoSpheres(position, 1e-4, RADIUS, YOUNG, SHEAR, motions),
                              tmp_path_factory.mktemp("two"), 300)
    matrix = beam_stiffness(LENGTH * x, RADIUS, YOUNG, SHEAR)
    expected = -np.einsum("ab,mb->ma", matrix, motions.reshape(-1, 12)).reshape(-1, 4, 3)
    scale = np.array([1, 1, 1 / LENGTH, 1 / LENGTH])[:, None]
    error = (np.abs((loads - expected) * scale).max(axis=(1, 2))
             / np.abs(expected * scale).max(axis=(1, 2)))
    return dict(zip(table, error.reshape(-1, len(SIZES))))


@pytest.mark.parametrize("mode", ["torsion", "bending", "bending at one end"])
def test_rotations_about_still_centres_are_exact(errors: dict[str, np.ndarray], mode: str) -> None:
    assert errors[mode].max() < 1e-12


def test_tension_is_exact_but_for_the_integration_of_the_first_step(
        errors: dict[str, np.ndarray]) -> None:
    assert errors["tension"].max() < 1e-6


@pytest.mark.parametrize("mode", ["shear", "combined"])
def test_other_modes_are_right_to_first_order(errors: dict[str, np.ndarray], mode: str) -> None:
    # A sheared chord stretches: (l/r)² / 6 = 6.7 times the amplitude, in shear forces.
    assert (errors[mode] < 10 * SIZES).all()
    order = np.polyfit(np.log(SIZES), np.log(errors[mode]), 1)[0]
    assert order > 0.95
