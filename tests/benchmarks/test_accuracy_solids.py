# SPDX-License-Identifier: GPL-2.0-or-later
"""References of the studies of a warm rod and of pins: series and finite elements against theory."""

from __future__ import annotations

import math
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.accuracy_cost.known import figures
from compare.codes.calculix_solids import Cylinder, indentation_curve, indentation_stiffness
from compare.references import rod_temperature, warming_rod

needs_calculix = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")

LENGTH, DIFFUSIVITY, RISE, RAMP = 2e-3, 5e-5, 100.0, 0.05  #: m, m²/s, K, s
DISTANCE = np.array([0.0, 0.3, 1.0]) * LENGTH


def test_a_ramp_is_many_small_steps() -> None:
    """Duhamel: the mean over a window of steps of temperature at every time of the ramp."""
    window, middles = (0.03, 0.09), (np.arange(100) + 0.5) / 100
    right = np.zeros(3)
    for when in window[0] + (window[1] - window[0]) * middles:
        end = min(when, RAMP)  # of the steps up to then
        for start in end * middles:
            fourier = DIFFUSIVITY * (when - start) / LENGTH**2
            right += end / RAMP / 1e4 * rod_temperature(DISTANCE / LENGTH, 1.0, fourier, 0, RISE, 60)
    found = warming_rod(DISTANCE, LENGTH, DIFFUSIVITY, RISE, RAMP, window)
    assert found == pytest.approx(right, rel=1e-3)


def test_a_rod_that_is_warmed_steadily_lags_by_a_parabola() -> None:
    ramp, window = 10.0, (4.0, 6.0)
    lag = (LENGTH * DISTANCE - DISTANCE**2 / 2) / DIFFUSIVITY
    assert warming_rod(DISTANCE, LENGTH, DIFFUSIVITY, RISE, ramp, window) == pytest.approx(
        RISE / ramp * (5.0 - lag), rel=1e-6)
    assert warming_rod(DISTANCE, LENGTH, DIFFUSIVITY, RISE, ramp, (20.0, 21.0)) == pytest.approx(RISE)


def warm_rod(poisson_ratio: float, width: float, cells: list[int]) -> dict[str, Any]:
    return {"kind": "warm_rod", "size": [LENGTH, width, width], "young_modulus": 70e9,
            "poisson_ratio": poisson_ratio, "density": 2700, "expansion_coefficient": 2e-5, "conductivity": 121.5,
            "specific_heat_capacity": 900, "rise": RISE, "ramp": RAMP, "cells": cells,
            "windows": {"warm": [10, 11], "half": [0.02, 0.03]}}


@needs_calculix
def test_without_poissons_ratio_a_rod_grows_by_its_mean_warmth(tmp_path: Path) -> None:
    """If it is slender: faces of a wide one are curved where it is warmer on one side."""
    found = figures(warm_rod(0.0, 0.3e-3, [2, 2, 2]), tmp_path)
    assert found["warm"].value == pytest.approx(2e-5 * RISE * LENGTH, rel=1e-3)
    assert found["half"].value == pytest.approx(found["half, free sideways"].value, rel=4e-3)
    assert 0.1 < found["half"].value / found["warm"].value < 0.5


@needs_calculix
def test_a_bed_that_holds_a_warm_rod_sideways_lengthens_it(tmp_path: Path) -> None:
    """It is squeezed there by α ΔT: by less than if all of it were, and over about a third of its width."""
    found = figures(warm_rod(0.33, 1e-3, [2, 2, 2]), tmp_path)["warm"]
    more = found.value / (2e-5 * RISE * LENGTH) - 1
    assert 0 < more < 2 * 0.33
    assert more * LENGTH / 1e-3 == pytest.approx(0.33 / 3, abs=0.03)
    assert found.error < 0.01


@needs_calculix
def test_a_pin_as_wide_as_its_cylinder_presses_a_bar(tmp_path: Path) -> None:
    bar = Cylinder(2e-3, 1e-3, 70e9, 0.0)
    assert indentation_stiffness(bar, 0.999999e-3, (4, 1, 4), tmp_path) == pytest.approx(
        70e9 * math.pi * 1e-6 / 2e-3, rel=1e-5)


@needs_calculix
def test_a_pin_on_a_large_body_is_sneddons(tmp_path: Path) -> None:
    """A body of 30 radii is stiffer than the half-space by less than two parts in a hundred."""
    large = {"kind": "indentation", "length": 30e-3, "radius": 30e-3, "pin_radius": 1e-3,
             "young_modulus": 70e9, "poisson_ratio": 0.3, "cells": [2, 8, 10]}
    found = figures(large, tmp_path)
    assert found["stiffness, half-space"].value == pytest.approx(2 * 1e-3 * 70e9 / 0.91)
    assert found["stiffness"].value == pytest.approx(found["stiffness, half-space"].value, rel=0.03)
    assert found["stiffness"].value > found["stiffness, half-space"].value


@needs_calculix
def test_a_wide_pin_makes_a_bar_flow(tmp_path: Path) -> None:
    bar = Cylinder(2e-3, 1e-3, 70e9, 0.3)
    depth, force = indentation_curve(bar, [(210e6, 0), (280e6, 1)], 0.98e-3, 20e-6, (3, 1, 6), tmp_path)
    strain = -math.log(1 - depth[-1] / bar.length)
    # Its section grows as its length falls; it yields at .3 %.
    right = (210e6 + 70e6 * (strain - 0.003)) * math.pi * bar.radius**2 * math.exp(strain)
    assert force[-1] == pytest.approx(right, rel=0.01)


@needs_calculix
def test_a_small_pin_on_a_metal_is_that_of_the_theory_of_plasticity(tmp_path: Path) -> None:
    """Mean pressure at collapse over the yield stress: 2.85 by Tresca (Shield 1955), at most 2/√3 times that by
    von Mises. Before it flows it is an elastic body."""
    block = Cylinder(4e-3, 4e-3, 70e9, 0.3)
    depth, force = indentation_curve(block, [(100e6, 0), (101e6, 1)], 1e-3, 15e-6, (3, 5, 6), tmp_path)
    assert 2.84 < force[-1] / (100e6 * math.pi * 1e-6) < 2.845 * 2 / math.sqrt(3)
    assert force[1] / depth[1] == pytest.approx(
        indentation_stiffness(block, 1e-3, (3, 5, 6), tmp_path), rel=1e-4)
