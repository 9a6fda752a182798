# SPDX-License-Identifier: GPL-2.0-or-later
"""A rod heated at one end, at once or steadily."""

from __future__ import annotations

import math

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


def _summed_ramp(distance: Floats, length: float, diffusivity: float, time: float, terms: int) -> Floats:
    """Integral over time, s², of the rise per rate, s, of a rod whose end warms steadily from time 0 on."""
    if time <= 0:
        return np.zeros_like(distance)
    n = 2 * np.arange(terms) + 1
    pace = diffusivity * (n * math.pi / (2 * length))**2
    behind = (time + np.expm1(-pace * time) / pace) / pace  # of each term, behind the end
    shape = np.sin(np.multiply.outer(distance, n * math.pi / (2 * length))) * 4 / (n * math.pi)
    found: Floats = time**2 / 2 - shape @ behind
    return found


def warming_rod(distance: Floats, length: float, diffusivity: float, rise: float, ramp: float,
                window: tuple[float, float], terms: int = 200) -> Floats:
    """Mean rise of temperature, K, over a window of time, s, at distances, m, from the end of an insulated
    rod that is warmed steadily by `rise`, K, within `ramp`, s, and then held.

    Fourier's series, integrated in time exactly; its terms fall with the fifth power of their number.
    """
    start, end = window
    summed = (_summed_ramp(distance, length, diffusivity, end, terms)
              - _summed_ramp(distance, length, diffusivity, start, terms)
              - _summed_ramp(distance, length, diffusivity, end - ramp, terms)
              + _summed_ramp(distance, length, diffusivity, start - ramp, terms))
    found: Floats = rise / ramp * summed / (end - start)
    return found
