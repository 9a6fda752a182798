# SPDX-License-Identifier: GPL-2.0-or-later
"""A sector of an annulus, its first plane held at another temperature."""

from __future__ import annotations

import numpy as np

from compare.references.layers import Layer, layers_temperature
from compare.result import Floats


def wedge_temperature(radius: Floats, angle: Floats, time: float, ring: Layer, opening: float,
                      initial: float, first: float, last: float, terms: int = 80,
                      cells: int = 400) -> Floats:
    """Temperature, K, at radii, m, and angles, rad, a time after the start, s.

    The plane at angle 0 is held at `first`, that at `opening`, rad, at `last`, the round faces are
    insulated. Late: linear in the angle. Before: a sine series in the angle, of which every term
    decays along the radius for itself (`layers_temperature` with a sink).
    """
    radius, angle = np.asarray(radius, dtype=float), np.asarray(angle, dtype=float)
    found = first + (last - first) * angle / opening
    for m in range(1, terms + 1):
        wave = m * np.pi / opening
        # The sine coefficient of what is left above the steady state at the start.
        weight = 2 / (m * np.pi) * ((initial - first) - (-1) ** m * (initial - last))
        if weight == 0:
            continue
        slowest = ring.conductivity / ring.capacity * (wave / ring.upper) ** 2
        if slowest * time > 45:  # exp(-45): no later term is seen either
            break
        found += weight * np.sin(wave * angle) * layers_temperature(
            radius, time, [ring], 1.0, (None, None), radial=True, sink=wave**2, cells=cells)
    return found
