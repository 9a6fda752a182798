# SPDX-License-Identifier: GPL-2.0-or-later
"""A rod heated at one end."""

from __future__ import annotations

import numpy as np

from compare.result import Floats


def rod_temperature(distance: Floats, length: float, fourier: float, initial: float,
                    imposed: float, terms: int = 400) -> Floats:
    """Temperature, K, of a rod heated at one end and insulated at the other.

    `distance` from the hot end, m; `fourier` = α t / L² > 0. Source: Terreros 2013, equation 2.8
    (with x counted from the hot end).
    """
    odd = 2 * np.arange(terms) + 1
    wave = np.sin(np.multiply.outer(np.asarray(distance) / length, odd * np.pi / 2))
    weight = 4 / (odd * np.pi) * np.exp(-((odd * np.pi / 2) ** 2) * fourier)
    return imposed + (initial - imposed) * (wave @ weight)
