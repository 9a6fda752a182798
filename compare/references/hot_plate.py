# SPDX-License-Identifier: GPL-2.0-or-later
"""A free plate that is heated through its thickness in a disc and cooled on both faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.references.moving_disc import disc_fraction
from compare.result import Floats


@dataclass(frozen=True)
class HotPlate:
    """The plate, from 0 to its size, and what a body of elements must be like to be the same.

    Where stresses are plane they do not depend on Poisson's ratio, and go with Young's modulus: so
    stress over Young's modulus is what two codes can be compared by.
    """

    size: tuple[float, float, float]  #: m
    young_modulus: float  #: Pa
    poisson_ratio: float
    expansion_coefficient: float  #: 1/K
    conductivity: float  #: W/(m K)
    coefficient: float  #: of convection on the faces across z, W/(m² K)
    temperature: float  #: of the fluid; free of strain, K
    centre: tuple[float, float]  #: of the disc, m
    disc_radius: float  #: m
    power_density: float  #: W/m³ inside the disc

    def fraction_heated(self, lower: Floats, upper: Floats) -> Floats:
        """(N,) fraction of each rectangle from `lower` to `upper` (N, 2), m, inside the disc."""
        return disc_fraction(lower - np.array(self.centre), upper - np.array(self.centre),
                             self.disc_radius)
