# SPDX-License-Identifier: GPL-2.0-or-later
"""Exact solutions and independent discretisations that codes are checked against."""

from __future__ import annotations

from compare.references.beam import (beam_stiffness, bilinear_stress, cyclic_stress,
                                     scaled_offset_stress, spring_stiffness)
from compare.references.bessel import bessel_j1
from compare.references.cooling_bar import cooling_bar_temperature, cooling_roots
from compare.references.hot_plate import HotPlate
from compare.references.lattice import finite_difference_step
from compare.references.layers import Layer, layers_temperature
from compare.references.moving_disc import MovingDisc, moving_disc_temperature
from compare.references.rod import rod_temperature, warming_rod
from compare.references.slender_beam import (cantilever_frequencies, cantilever_roots,
                                             circular_second_moment, collapse_load,
                                             tip_deflection)
from compare.references.timoshenko_beam import RectangularBeam
from compare.references.warming_bar import Table, warming_bar_temperature
from compare.references.wedge import wedge_temperature

__all__ = ["HotPlate", "Layer", "MovingDisc", "RectangularBeam", "Table", "beam_stiffness",
           "bessel_j1", "bilinear_stress", "cantilever_frequencies", "cantilever_roots",
           "circular_second_moment", "collapse_load", "cooling_bar_temperature", "cooling_roots",
           "cyclic_stress", "finite_difference_step", "layers_temperature",
           "moving_disc_temperature", "rod_temperature", "scaled_offset_stress",
           "spring_stiffness", "tip_deflection", "warming_bar_temperature", "warming_rod",
           "wedge_temperature"]
