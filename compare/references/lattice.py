# SPDX-License-Identifier: GPL-2.0-or-later
"""Central finite differences on a cubic grid."""

from __future__ import annotations

from compare.result import Floats


def finite_difference_step(temperature: Floats, number: float) -> Floats:
    """One explicit step of central finite differences on a cubic grid (X, Y, Z).

    `number` = α Δt / h². The outermost points keep their values.
    """
    new = temperature.copy()
    inner = temperature[1:-1, 1:-1, 1:-1]
    new[1:-1, 1:-1, 1:-1] = inner + number * (
        temperature[2:, 1:-1, 1:-1] + temperature[:-2, 1:-1, 1:-1]
        + temperature[1:-1, 2:, 1:-1] + temperature[1:-1, :-2, 1:-1]
        + temperature[1:-1, 1:-1, 2:] + temperature[1:-1, 1:-1, :-2] - 6 * inner)
    return new
