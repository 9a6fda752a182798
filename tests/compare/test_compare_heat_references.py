# SPDX-License-Identifier: GPL-2.0-or-later
"""Exact solutions of heat conduction against tables, closed forms, balances and brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest

from compare.references import (Layer, MovingDisc, bessel_j1, layers_temperature,
                                moving_disc_temperature, rod_temperature, wedge_temperature)
from compare.references.moving_disc import disc_fraction

PLATE = MovingDisc(length=0.05, width=0.03, thickness=0.002, density=2790.0,
                   specific_heat_capacity=880.0, conductivity=134.0, initial_temperature=298.15,
                   disc_radius=0.004, power_density=1e11, start=(0.02, 0.0), speed=3.3e-3,
                   duration=0.026 / 3.3e-3)
POINTS = np.array([[0.0095, -0.0005], [0.031, 0.0], [0.0415, -0.0095]])


def test_bessel_function_against_tables() -> None:
    x = np.array([0.0, 1.0, 2.0, 10.0, 100.0, 1000.0])
    table = [0.0, 0.44005058574493352, 0.57672480775687339, 0.04347274616886144,
             -0.07714535201411216, 0.00472831190708952]
    assert bessel_j1(x) == pytest.approx(np.array(table), abs=1e-13)
    assert bessel_j1(-x) == pytest.approx(-bessel_j1(x), abs=1e-13)
    assert bessel_j1(np.array([3.8317059702075123]))[0] == pytest.approx(0, abs=1e-13)


def test_moving_disc_keeps_its_heat() -> None:
    """The mean rises with the heat given: midpoints integrate low cosines exactly."""
    x = (np.arange(60) + 0.5) / 60 * PLATE.length
    y = ((np.arange(40) + 0.5) / 40 - 0.5) * PLATE.width
    grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    time = 3.0
    mean = moving_disc_temperature(PLATE, np.array([time]), grid, modes=60).mean()
    heat = PLATE.power_density * math.pi * PLATE.disc_radius**2 * time
    capacity = PLATE.density * PLATE.specific_heat_capacity * PLATE.length * PLATE.width
    assert mean - PLATE.initial_temperature == pytest.approx(heat / capacity, rel=1e-12)


def test_moving_disc_is_symmetric_and_converged() -> None:
    time = np.array([1.0, 4.0, PLATE.duration])
    series = moving_disc_temperature(PLATE, time, POINTS)
    mirrored = moving_disc_temperature(PLATE, time, POINTS * [1, -1])
    assert mirrored == pytest.approx(series, rel=1e-12)
    assert moving_disc_temperature(PLATE, time, POINTS, modes=1200) == pytest.approx(
        series, rel=2e-6)


def finite_volumes(plate: MovingDisc, cell: float, until: float) -> np.ndarray:
    """Temperatures of square cells stepped explicitly, the source by its fraction of each cell."""
    shape = (round(plate.length / cell), round(plate.width / cell))
    corner = np.stack(np.meshgrid(np.arange(shape[0]) * cell,
                                  np.arange(shape[1]) * cell - plate.width / 2,
                                  indexing="ij"), axis=-1).reshape(-1, 2)
    temperature = np.full(shape, plate.initial_temperature)
    steps = math.ceil(until * plate.diffusivity / (0.2 * cell**2))
    step = until / steps
    heat = plate.power_density * step / (plate.density * plate.specific_heat_capacity)
    number = plate.diffusivity * step / cell**2
    for n in range(steps):
        centre = np.array([plate.start[0] + plate.speed * (n + 0.5) * step, plate.start[1]])
        fraction = disc_fraction(corner - centre, corner + cell - centre, plate.disc_radius, lines=4)
        around = np.pad(temperature, 1, mode="edge")
        temperature = temperature + heat * fraction.reshape(shape) + number * (
            around[2:, 1:-1] + around[:-2, 1:-1] + around[1:-1, 2:] + around[1:-1, :-2]
            - 4 * temperature)
    return temperature


def test_moving_disc_against_finite_volumes() -> None:
    """The difference falls with the square of the cells and vanishes in the limit."""
    until, found = 1.0, []
    for cell in (1e-3, 0.5e-3):
        grid = finite_volumes(PLATE, cell, until)
        # Points on corners of cells: the mean of four.
        corners = (grid[1:, 1:] + grid[:-1, 1:] + grid[1:, :-1] + grid[:-1, :-1]) / 4
        index = np.rint(np.array([[0.01, -0.001], [0.02, 0.0], [0.03, 0.005]]) / cell).astype(int)
        index[:, 1] += round(PLATE.width / 2 / cell)
        found.append(corners[index[:, 0] - 1, index[:, 1] - 1])
    series = moving_disc_temperature(
        PLATE, np.array([until]), np.array([[0.01, -0.001], [0.02, 0.0], [0.03, 0.005]]))[0]
    rise = series - PLATE.initial_temperature
    coarse, fine = (np.abs(f - series) / rise for f in found)
    assert fine.max() < 4e-3
    limit = found[1] + (found[1] - found[0]) / 3
    assert np.abs(limit - series).max() < 1e-3 * rise.max()
    assert (fine < 0.4 * coarse).all()


def test_a_disc_that_leaves_the_plate_is_refused() -> None:
    with pytest.raises(ValueError, match="leaves"):
        MovingDisc(**{**vars(PLATE), "duration": 8.0})


def test_fraction_of_rectangles_inside_the_disc_sums_to_the_disc() -> None:
    cell = 0.5e-3
    x, y = np.meshgrid(np.arange(100) * cell, np.arange(60) * cell - 0.015, indexing="ij")
    lower = np.stack([x.ravel(), y.ravel()], axis=1)
    fraction = PLATE.fraction_heated(2.3, lower, lower + cell)
    assert fraction.min() >= 0 and fraction.max() == pytest.approx(1, abs=1e-12)
    assert fraction.sum() * cell**2 == pytest.approx(math.pi * PLATE.disc_radius**2, rel=1e-4)


def test_layers_are_the_rod() -> None:
    x = np.linspace(0, 0.3, 31)
    rod = Layer(0.0, 0.3, conductivity=5.0, capacity=2e6)
    time = 0.05 * 0.3**2 * 2e6 / 5.0
    found = layers_temperature(x, time, [rod], 298, (798, None))
    assert found == pytest.approx(rod_temperature(x, 0.3, 0.05, 298, 798), abs=1e-6 * 500)


def test_annulus_late_is_a_logarithm() -> None:
    r = np.linspace(1.0, 2.0, 11)
    ring = Layer(1.0, 2.0, conductivity=3.0, capacity=1.0)
    found = layers_temperature(r, 50.0, [ring], 10, (100, 0), radial=True)
    assert found == pytest.approx(100 * (1 - np.log(r) / math.log(2)), abs=1e-4)


def test_annulus_decays_as_its_first_bessel_mode() -> None:
    """Radii whose first eigenvalue is tabulated: 3.1230309 / inner radius for outer / inner = 2."""
    ring = Layer(1.0, 2.0, conductivity=1.0, capacity=1.0)
    early, late = (layers_temperature(np.array([1.5]), t, [ring], 1.0, (0.0, 0.0), radial=True)[0]
                   for t in (0.8, 1.0))
    assert math.log(early / late) / 0.2 == pytest.approx(3.1230309**2, rel=2e-6)


def test_two_bars_late_are_straight_lines_with_a_jump() -> None:
    left, right = Layer(0.0, 0.2, 10.0, 1.0), Layer(0.2, 0.5, 2.0, 3.0)
    conductance = 40.0
    flux = 100 / (0.2 / 10 + 1 / conductance + 0.3 / 2)
    x = np.array([0.0, 0.1, 0.19, 0.21, 0.35, 0.5])
    found = layers_temperature(x, 10.0, [left, right], 0.0, (100, 0), contacts=[conductance])
    exact = np.where(x < 0.2, 100 - flux * x / 10, flux * (0.5 - x) / 2)
    assert found == pytest.approx(exact, abs=1e-6)


def test_layers_without_held_ends_keep_their_heat() -> None:
    left, right = Layer(0.0, 0.4, 10.0, 1.0), Layer(0.4, 1.0, 2.0, 3.0)
    x = (np.arange(1000) + 0.5) / 1000
    found = layers_temperature(x, 0.01, [left, right], 7.0, (None, None), contacts=[5.0])
    assert found == pytest.approx(np.full(1000, 7.0), abs=1e-9)


def test_wedge_late_is_linear_in_the_angle_and_early_a_half_space() -> None:
    ring = Layer(1.0, 2.0, 1.0, 1.0)
    angle = np.linspace(0, 1.2, 13)
    late = wedge_temperature(np.full(13, 1.4), angle, 20.0, ring, 1.2, 5.0, 1.0, 9.0, cells=200)
    assert late == pytest.approx(1 + 8 * angle / 1.2, abs=1e-9)
    # A narrow ring near the plane at angle 0: distance along the circle, no curvature to see.
    thin, time = Layer(1.0, 1.001, 1.0, 1.0), 0.004
    early = wedge_temperature(np.full(4, 1.0005), angle[1:5], time, thin, 1.2, 0.0, 1.0, 0.0,
                              cells=20)
    exact = [math.erfc(1.0005 * a / (2 * math.sqrt(time))) for a in angle[1:5]]
    assert early == pytest.approx(exact, abs=1e-6)


def test_wedge_against_finite_volumes_in_the_plane() -> None:
    """Polar cells stepped explicitly, twice as fine the second time."""
    opening, time, found = 1.0, 0.05, []
    for n in (20, 40):
        r = 1 + (np.arange(n) + 0.5) / n
        dr, da = 1 / n, opening / n
        field = np.zeros((n, n))
        steps = math.ceil(time / (0.2 * min(dr, da) ** 2))
        step = time / steps
        for _ in range(steps):
            radial = np.diff(field, axis=0) / dr * (r[:-1, None] + dr / 2)
            radial = np.pad(radial, ((1, 1), (0, 0)))
            around = np.pad(field, ((0, 0), (1, 1)))
            around[:, 0], around[:, -1] = 2 - field[:, 0], -field[:, -1]
            field = field + step * (np.diff(radial, axis=0) / (dr * r[:, None])
                                    + np.diff(around, n=2, axis=1) / (r[:, None] * da) ** 2)
        found.append([field[k:k + 2, j:j + 2].mean() for k, j in
                      ((n // 4 - 1, n // 4 - 1), (n // 2 - 1, n // 2 - 1))])
    limit = np.array(found[1]) + (np.array(found[1]) - found[0]) / 3
    ring = Layer(1.0, 2.0, 1.0, 1.0)
    exact = wedge_temperature(np.array([1.25, 1.5]), np.array([0.25, 0.5]), time, ring, opening,
                              0.0, 1.0, 0.0)
    assert limit == pytest.approx(exact, abs=1e-4)
