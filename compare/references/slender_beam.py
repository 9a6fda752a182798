# SPDX-License-Identifier: GPL-2.0-or-later
"""A long slender beam of Euler and Bernoulli: deflection, vibration, plastic collapse."""

from __future__ import annotations

import numpy as np

from compare.result import Floats


def circular_second_moment(radius: float) -> float:
    """I = π r⁴ / 4, m⁴."""
    return float(np.pi * radius**4 / 4)


def tip_deflection(force: float, length: float, bending_stiffness: float) -> float:
    """P L³ / 3 E I of a cantilever loaded at its tip, m. `bending_stiffness`: E I, N m²."""
    return force * length**3 / (3 * bending_stiffness)


def cantilever_roots(count: int, tip_mass: float = 0.0) -> Floats:
    """The first numbers β L of a cantilever that carries a point mass at its tip.

    `tip_mass`: over the mass of the beam itself. Roots of
    1 + cos cosh + m β L (cos sinh − sin cosh) = 0.
    """
    def equation(x: Floats) -> Floats:
        # Over cosh, which never vanishes: no large numbers.
        return np.asarray(1 / np.cosh(x) + np.cos(x)
                          + tip_mass * x * (np.cos(x) * np.tanh(x) - np.sin(x)))

    grid = np.linspace(1e-3, np.pi * (count + 1), 4000 * (count + 1))
    values = equation(grid)
    starts = np.flatnonzero(values[:-1] * values[1:] < 0)[:count]
    low, high = grid[starts], grid[starts + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        left = equation(low) * equation(middle) <= 0
        low, high = np.where(left, low, middle), np.where(left, middle, high)
    return 0.5 * (low + high)


def cantilever_frequencies(count: int, length: float, bending_stiffness: float,
                           mass_per_length: float, tip_mass: float = 0.0) -> Floats:
    """The first frequencies, Hz. `bending_stiffness`: E I, N m²; `tip_mass` in kg."""
    roots = cantilever_roots(count, tip_mass / (mass_per_length * length))
    return (roots / length) ** 2 * np.sqrt(bending_stiffness / mass_per_length) / (2 * np.pi)


def collapse_load(plastic_moment: float, length: float) -> float:
    """4 M_p / L: the load in the middle of a simply supported beam when a hinge forms there, N."""
    return 4 * plastic_moment / length
