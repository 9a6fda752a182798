# SPDX-License-Identifier: GPL-2.0-or-later
"""A bar that a fluid cools at one end."""

from __future__ import annotations

import numpy as np

from compare.result import Floats


def cooling_roots(biot: float, terms: int) -> Floats:
    """The first roots of ζ tan ζ = Bi, ascending: one in each (n π, n π + π/2).

    Halving of ζ sin ζ − Bi cos ζ, which has no poles, until doubles end.
    """
    low = np.arange(terms) * np.pi
    high = low + np.pi / 2
    even = (-1.0) ** np.arange(terms)  # the function rises from −Bi to high over an even interval
    for _ in range(60):
        middle = (low + high) / 2
        below = even * (middle * np.sin(middle) - biot * np.cos(middle)) < 0
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return (low + high) / 2


def cooling_bar_temperature(distance: Floats, length: float, fourier: float, biot: float,
                           initial: float, fluid: float, terms: int = 400) -> Floats:
    """Temperature, K, of a bar whose one end a fluid cools, insulated elsewhere.

    `distance` from the cooled end, m; `fourier` = α t / L² > 0; `biot` = h L / λ > 0; `fluid`: its
    temperature, K. Source: Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 3.11.
    """
    root = cooling_roots(biot, terms)
    weight = 2 * np.sin(root) / (root + np.sin(root) * np.cos(root)) * np.exp(-root**2 * fourier)
    wave = np.cos(np.multiply.outer(1 - np.asarray(distance) / length, root))
    found: Floats = fluid + (initial - fluid) * (wave @ weight)
    return found
