# SPDX-License-Identifier: GPL-2.0-or-later
"""Bars that a fluid cools, and whose material changes with temperature, against limits and finite volumes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from compare.references import (Layer, Table, cooling_bar_temperature, cooling_roots,
                                layers_temperature, rod_temperature, warming_bar_temperature)
from compare.result import CodeFailure, Floats
from compare.solutions import solution

X = np.linspace(0, 1, 21)
CONDUCTIVITY = Table((300.0, 500.0, 800.0), (15.0, 18.0, 30.0))
STEEL = {"kind": "warming_bar", "axis": 0, "length": 1.0, "initial": 300.0, "hot": 800.0,
         "density": 3.0, "conductivity": {"temperature": [300, 500, 800], "value": [15, 18, 30]},
         "specific_heat_capacity": {"temperature": [300, 500, 800], "value": [5, 6, 10]}}


@pytest.mark.parametrize("biot", [1e-6, 0.1, 1.0, 10.0, 1e6])
def test_each_root_solves_its_equation_between_its_bounds(biot: float) -> None:
    root, n = cooling_roots(biot, 50), np.arange(50)
    assert np.all((root > n * np.pi) & (root < (n + 0.5) * np.pi))
    assert root * np.sin(root) == pytest.approx(biot * np.cos(root), abs=1e-13 * (biot + 160))
    if biot == 1.0:  # Carslaw and Jaeger, appendix IV, table I
        assert root[:3] == pytest.approx([0.8603, 3.4256, 6.4373], abs=1e-4)


def test_a_bar_that_gives_its_heat_slowly_cools_as_one_lump() -> None:
    biot, fourier = 1e-4, 5e3
    found = cooling_bar_temperature(X, 1.0, fourier, biot, 800, 300)
    assert found == pytest.approx(300 + 500 * math.exp(-biot * fourier), abs=500 * biot)


def test_a_bar_in_a_fluid_that_takes_all_heat_has_its_end_held() -> None:
    biot = 1e5
    for fourier in (0.01, 0.2, 1.0):
        found = cooling_bar_temperature(X, 1.0, fourier, biot, 800, 300)
        assert found == pytest.approx(rod_temperature(X, 1.0, fourier, 800, 300), abs=1000 * 10 / biot)


def test_what_the_fluid_takes_is_what_the_bar_loses() -> None:
    """The fluid is a film that conducts h over its thickness and holds next to nothing: finite volumes."""
    biot, conductivity = 1.5, 3.0
    film = Layer(-0.01, 0.0, conductivity=0.01 * biot * conductivity, capacity=1e-4)
    bar = Layer(0.0, 1.0, conductivity=conductivity, capacity=2.0)
    for fourier in (0.05, 0.5):
        found = cooling_bar_temperature(X[1:], 1.0, fourier, biot, 800, 300)
        cells = layers_temperature(X[1:], fourier * 2.0 / conductivity, [film, bar], 800,
                                   (300.0, None), contacts=[math.inf])
        assert found == pytest.approx(cells, abs=1e-5 * 500)


def test_a_table_is_integrated_and_turned_back() -> None:
    temperature = np.array([300.0, 421.0, 500.0, 640.0, 800.0])
    fine = np.linspace(300, 800, 500001)
    sums = np.concatenate([[0.0], np.cumsum(np.diff(fine) * CONDUCTIVITY.at((fine[1:] + fine[:-1]) / 2))])
    found = CONDUCTIVITY.integral(temperature)
    assert found == pytest.approx(np.interp(temperature, fine, sums), rel=1e-12)
    assert CONDUCTIVITY.temperature_of(found) == pytest.approx(temperature, rel=1e-14)


def test_a_material_that_does_not_change_leaves_the_rod() -> None:
    constant = Table((300.0, 800.0), (20.0, 20.0))
    found = warming_bar_temperature(X, 1.0, 0.05, constant, 300, 800)
    assert found == pytest.approx(rod_temperature(X, 1.0, 0.05, 300, 800), abs=1e-9)


def finite_volumes(cells: int, fourier: float) -> Floats:
    """Temperatures of equal cells of a bar of length 1 and α = 1, from 300 K, one end held at 800 K.

    The heat content is stepped explicitly, and λ taken half way between two temperatures: nothing here knows
    of Kirchhoff's transform.
    """
    size = 1 / cells
    steps = math.ceil(fourier / (0.2 * size**2))
    levels = np.linspace(300, 800, 20001)
    contents = np.concatenate([[0.0], np.cumsum(
        np.diff(levels) * CONDUCTIVITY.at((levels[1:] + levels[:-1]) / 2))])
    content = np.zeros(cells)
    for _ in range(steps):
        temperature = np.interp(content, contents, levels)
        flux = -np.diff(temperature) / size * CONDUCTIVITY.at((temperature[1:] + temperature[:-1]) / 2)
        wall = (800 - temperature[0]) / (size / 2) * CONDUCTIVITY.at((800 + temperature[:1]) / 2)
        content = content - fourier / steps / size * np.diff(np.concatenate([wall, flux, [0.0]]))
    return np.interp(content, contents, levels)


@pytest.mark.parametrize("fourier", [0.02, 0.2])
def test_a_changing_material_against_finite_volumes_of_the_nonlinear_equation(fourier: float) -> None:
    """Differences fall with the square of the cells."""
    differences = []
    for cells in (20, 40, 80):
        middle = (np.arange(cells) + 0.5) / cells
        right = warming_bar_temperature(middle, 1.0, fourier, CONDUCTIVITY, 300, 800)
        differences.append(float(np.abs(finite_volumes(cells, fourier) - right).max()) / 500)
    assert differences[2] < 3e-4
    assert differences[1] < 0.4 * differences[0] and differences[2] < 0.4 * differences[1]


def test_tables_that_are_not_proportional_have_no_such_solution() -> None:
    exact = solution({"solution": STEEL})
    assert exact.time_scale == pytest.approx(1.0) and exact.scale == 500
    capacity = {"temperature": [300, 800], "value": [5, 10]}
    with pytest.raises(CodeFailure, match="not proportional"):
        solution({"solution": STEEL | {"specific_heat_capacity": capacity}})
