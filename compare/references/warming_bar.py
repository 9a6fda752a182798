# SPDX-License-Identifier: GPL-2.0-or-later
"""A bar heated at one end whose conductivity and heat capacity depend on temperature.

Where λ(T) and ρ c(T) are proportional, their quotient α is constant and heat content and the integral of λ
(Kirchhoff 1894) are the same thing but for a factor: u = ∫ λ dT follows the linear equation u' = α u''
exactly, however bent λ(T) is. So the field is that of a linear rod in u, turned back into temperature.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from compare.references.rod import rod_temperature
from compare.result import Floats


@dataclass(frozen=True)
class Table:
    """A quantity over temperature, K, linear between its rows and constant beyond them."""

    temperature: Sequence[float]  #: ascending, two at least
    value: Sequence[float]  #: above 0

    def at(self, temperature: Floats) -> Floats:
        """The quantity at temperatures."""
        return np.interp(temperature, self.temperature, self.value)

    def integral(self, temperature: Floats) -> Floats:
        """From the first row's temperature to others, which lie within the table."""
        t, value = np.array(self.temperature), np.array(self.value)
        n = np.clip(np.searchsorted(t, temperature, side="right") - 1, 0, len(t) - 2)
        above = np.asarray(temperature) - t[n]
        found: Floats = self._sums()[n] + above * (value[n] + self._slopes()[n] * above / 2)
        return found

    def temperature_of(self, integral: Floats) -> Floats:
        """The temperatures, within the table, up to which the quantity integrates to this."""
        sums = self._sums()
        n = np.clip(np.searchsorted(sums, integral, side="right") - 1, 0, len(sums) - 2)
        first, rest = np.array(self.value)[n], np.asarray(integral) - sums[n]
        # value·x + slope·x²/2 = rest, in the form that a slope of zero leaves whole.
        found: Floats = np.array(self.temperature)[n] + 2 * rest / (
            first + np.sqrt(first**2 + 2 * self._slopes()[n] * rest))
        return found

    def _slopes(self) -> Floats:
        found: Floats = np.diff(self.value) / np.diff(self.temperature)
        return found

    def _sums(self) -> Floats:
        """The integral up to each row."""
        t, value = np.array(self.temperature), np.array(self.value)
        return np.r_[0.0, np.cumsum(np.diff(t) * (value[1:] + value[:-1]) / 2)]


def warming_bar_temperature(distance: Floats, length: float, fourier: float, conductivity: Table,
                            initial: float, imposed: float) -> Floats:
    """Temperature, K, of a bar heated at one end and insulated at the other, with λ(T) ∝ ρ c(T).

    `distance` from the hot end, m; `fourier` = α t / L² > 0, α = λ/(ρ c) at any temperature.
    """
    first, last = conductivity.integral(np.array([initial, imposed]))
    content = rod_temperature(distance, length, fourier, float(first), float(last))
    # The series ends after finitely many terms: at the ends it may miss by the last bits.
    return conductivity.temperature_of(np.clip(content, min(first, last), max(first, last)))
