# SPDX-License-Identifier: GPL-2.0-or-later
"""A straight beam of Timoshenko, held at one end: stiffness of its tip, natural frequencies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.result import Floats


@dataclass(frozen=True)
class RectangularBeam:
    """Held at one end; shaken or pushed along its height."""

    length: float  #: m
    height: float  #: m, along the deflection
    width: float  #: m
    young_modulus: float  #: Pa
    poisson_ratio: float
    density: float = 1.0  #: kg/m³

    @property
    def bending_stiffness(self) -> float:
        """E I, N m²."""
        return self.young_modulus * self.width * self.height**3 / 12

    @property
    def shear_stiffness(self) -> float:
        """κ G S, N; κ of Cowper 1966 for a rectangle, 10 (1 + ν) / (12 + 11 ν)."""
        nu = self.poisson_ratio
        shear_modulus = self.young_modulus / (2 * (1 + nu))
        return 10 * (1 + nu) / (12 + 11 * nu) * shear_modulus * self.width * self.height

    @property
    def tip_stiffness(self) -> float:
        """Force over deflection of the tip, N/m."""
        return 1 / (self.length**3 / (3 * self.bending_stiffness)
                    + self.length / self.shear_stiffness)

    def frequencies(self, count: int) -> Floats:
        """The first natural frequencies, Hz."""
        slender = (np.pi * (count + 1) / self.length) ** 2 * np.sqrt(
            self.bending_stiffness / (self.density * self.width * self.height))
        grid = np.linspace(1e-4, 1, 4000 * count) * slender
        values = np.array([self._misfit(omega) for omega in grid])
        starts = np.flatnonzero(values[:-1] * values[1:] < 0)[:count]
        found = []
        for low, high in zip(grid[starts], grid[starts + 1]):
            for _ in range(60):
                middle = 0.5 * (low + high)
                below = self._misfit(low) * self._misfit(middle) <= 0
                low, high = (low, middle) if below else (middle, high)
            found.append(0.5 * (low + high) / (2 * np.pi))
        return np.array(found)

    def _misfit(self, omega: float) -> float:
        """Vanishes at a natural frequency: determinant of what moment and shear at the free end are
        of those at the held one, where deflection and rotation are zero."""
        mass = self.density * self.width * self.height
        inertia = self.density * self.width * self.height**3 / 12
        # Deflection, rotation, moment and shear, each over a scale that makes it a length.
        ei, length = self.bending_stiffness, self.length
        rate = np.array([
            [0, 1, 0, ei / (length**2 * self.shear_stiffness)],
            [0, 0, 1, 0],
            [0, -inertia * omega**2 * length**2 / ei, 0, -1],
            [-mass * omega**2 * length**4 / ei, 0, 0, 0]])
        values, vectors = np.linalg.eig(rate)
        # Over the largest growth, so that no number is large.
        grown = np.exp(values - np.abs(values.real).max())
        over = (vectors * grown) @ np.linalg.inv(vectors)
        return float(np.linalg.det(over[2:, 2:]).real)
