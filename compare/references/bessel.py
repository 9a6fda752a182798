# SPDX-License-Identifier: GPL-2.0-or-later
"""The Bessel function that a disc needs."""

from __future__ import annotations

import numpy as np

from compare.result import Floats


def bessel_j1(x: Floats) -> Floats:
    """J₁(x) to 1e-13, for |x| up to some thousands.

    J₁(x) = 1/π ∫ cos(θ − x sin θ) dθ over half a period; midpoints converge exponentially once they
    resolve the fastest wave (the error with n points is J of order 2n − 1).
    """
    x = np.asarray(x, dtype=float)
    if x.size == 0:
        return np.zeros_like(x)
    points = int(np.abs(x).max() / 2) + 60
    angle = (np.arange(points) + 0.5) * np.pi / points
    total = np.zeros_like(x)
    for a, sine in zip(angle, np.sin(angle)):
        total += np.cos(a - x * sine)
    return total / points
