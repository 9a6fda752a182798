# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of one refinement: of several packings of as many elements, or of one step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Level:
    """What runs of one refinement gave."""

    value: float  #: of the key that is refined
    size: float  #: h: of an element or a step, in any unit
    figures: Floats  #: of each specimen
    seconds: float  #: of one run, mean over the specimens

    @property
    def mean(self) -> float:
        """Over the specimens."""
        return float(self.figures.mean())
