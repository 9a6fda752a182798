# SPDX-License-Identifier: GPL-2.0-or-later
"""A bar of 112 elements in YADE against references stepped in numpy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from prepared_bar import (CONDUCTIVITY, RADIUS, RATIO, SHEAR, YOUNG, Bar, beam_task, heat_task,
                      loaded_task, run_yade)

from compare.references import beam_stiffness

STEPS = 400


def linear_beams(bar: Bar, speed: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacements and grip force along x after STEPS steps of velocity Verlet, small motion."""
    specimen = bar.specimen
    count = len(specimen.radius)
    matrix = np.zeros((6 * count, 6 * count))
    for i, j in specimen.pairs:
        unknowns = np.concatenate([np.arange(3) + 6 * i, np.arange(3) + 6 * j,
                                   np.arange(3, 6) + 6 * i, np.arange(3, 6) + 6 * j])
        chord = specimen.position[j] - specimen.position[i]
        matrix[np.ix_(unknowns, unknowns)] += beam_stiffness(chord, RATIO * RADIUS, YOUNG, SHEAR)
    mass = np.repeat(np.stack([specimen.columns["mechanics/mass"],
                               specimen.columns["mechanics/inertia"]], 1), 3, axis=1).ravel()
    held = np.zeros((count, 6), dtype=bool)
    velocity = np.zeros((count, 6))
    for side in ("left", "right"):
        held[specimen.sets[f"grip.{side}"]] = True
    velocity[specimen.sets["grip.right"], :2] = speed, 0.3 * speed
    held, velocity = held.ravel(), velocity.ravel()
    moved, load = np.zeros(6 * count), np.zeros(6 * count)
    for _ in range(STEPS):
        velocity += np.where(held, 0, 0.5 * bar.beam_step * load / mass)
        moved += bar.beam_step * velocity
        load = -matrix @ moved
        velocity += np.where(held, 0, 0.5 * bar.beam_step * load / mass)
    force = -load.reshape(count, 6)[specimen.sets["grip.right"], 0].sum()
    return moved.reshape(count, 6)[:, :3], force


@pytest.fixture(scope="module")
def beam_errors(bar: Bar, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    """Rows: strain, relative error of the grip force, of the positions."""
    length = float(np.ptp(bar.specimen.position[:, 0]))
    rows = []
    for strain in (1e-2, 1e-3, 1e-4):
        speed = strain * length / (STEPS * bar.beam_step)
        moved, force = linear_beams(bar, speed)
        result = run_yade(bar.path, beam_task(bar, speed, STEPS),
                          tmp_path_factory.mktemp("beams"), "--observe-every", "100")
        found = result.frame(STEPS).columns["position"] - bar.specimen.position
        rows.append((strain, abs(result.history["grip.right.force_x"][-1] / force - 1),
                     np.abs(found - moved).max() / np.abs(moved).max()))
    return np.array(rows)


def test_beams_differ_from_small_motion_in_proportion_to_the_strain(
        beam_errors: np.ndarray) -> None:
    strain, force, position = beam_errors.T
    # The reference is linear, so finite strain shows in it as well as in YADE.
    assert (force < 2 * strain).all()
    assert (position < 5 * strain).all()  # the bar is sheared besides, so it turns
    for error in (force, position):
        assert np.polyfit(np.log(strain), np.log(error), 1)[0] == pytest.approx(1, abs=0.2)


def conduction_matrix(bar: Bar, law: str) -> np.ndarray:
    """Power into each element, W, of temperatures."""
    specimen = bar.specimen
    if law == "voronoi":
        section = specimen.columns["conduction/area"] / specimen.columns["conduction/distance"]
    else:
        area = specimen.columns["conduction/transmission_area"][specimen.pairs]
        section = np.sqrt(area.prod(axis=1)) / specimen.rest_length
    matrix = np.zeros((len(specimen.radius),) * 2)
    for (i, j), c in zip(specimen.pairs, CONDUCTIVITY * section):
        matrix[[i, j], [j, i]] += c
        matrix[[i, j], [i, j]] -= c
    return matrix


def euler(bar: Bar, steps: int) -> np.ndarray:
    """Temperatures after explicit steps, one end held."""
    matrix = conduction_matrix(bar, "platonic")
    temperature = np.full(len(bar.specimen.radius), 298.0)
    hot = bar.specimen.sets["temperature.hot"]
    temperature[hot] = 798
    for _ in range(steps):
        temperature += (bar.heat_step * (matrix @ temperature)
                        / bar.specimen.columns["conduction/heat_capacity"])
        temperature[hot] = 798
    return temperature


@pytest.mark.parametrize("law", ["native", "scripted"])
def test_conduction_is_the_explicit_scheme(bar: Bar, tmp_path: Path, law: str) -> None:
    result = run_yade(bar.path, heat_task(bar, 300), tmp_path, "--law", law)
    for step in (0, 30, 300):
        found, expected = result.frame(step).columns["temperature"], euler(bar, step)
        assert np.abs(found - expected).max() < 500 * 1e-12
    assert 300 < found.min() < 790  # heat went all the way, and is still on its way
    capacity = bar.specimen.columns["conduction/heat_capacity"]
    gained = capacity @ (found - 298)
    assert result.history["temperature.hot.heat"][-1] == pytest.approx(gained, rel=1e-9)


@pytest.mark.parametrize("law, how", [("platonic", "native"), ("platonic-calibrated", "native"),
                                      ("platonic", "scripted"), ("voronoi", "scripted")])
def test_walls_and_sources_are_the_explicit_scheme(bar: Bar, tmp_path: Path, law: str,
                                                   how: str) -> None:
    specimen, steps = bar.specimen, 200
    result = run_yade(bar.path, loaded_task(bar, steps, law), tmp_path,
                      *(["--law", how] if law != "voronoi" else []))
    matrix, capacity = conduction_matrix(bar, law), specimen.columns["conduction/heat_capacity"]
    temperature, heat = np.full(len(capacity), 298.0), {"left": 0.0, "top": 0.0}
    for _ in range(steps):
        power = matrix @ temperature
        power[specimen.powers["laser"].elements] += specimen.powers["laser"].values
        for name, outside in (("left", 798.0), ("top", 350.0)):
            wall = specimen.exchanges[name]
            gain = wall.values * (outside - temperature[wall.elements])
            power[wall.elements] += gain
            heat[name] += bar.heat_step * gain.sum()
        temperature += bar.heat_step * power / capacity
    found = result.frame(steps).columns["temperature"]
    assert np.abs(found - temperature).max() < 500 * 1e-12
    assert np.ptp(found) > 100
    for name, expected in heat.items():
        assert result.history[f"{name}.heat"][-1] == pytest.approx(expected, rel=1e-9)
    energy = result.history["thermal_energy"]
    laser = specimen.powers["laser"].values.sum() * steps * bar.heat_step
    assert energy[-1] - energy[0] == pytest.approx(sum(heat.values()) + laser, rel=1e-8)


@pytest.mark.parametrize("law", ["native", "scripted"])
def test_what_heats_held_elements_leaves_through_them(bar: Bar, tmp_path: Path, law: str) -> None:
    steps, lamp = 100, bar.specimen.powers["lamp"]
    assert np.isin(lamp.elements, bar.specimen.sets["temperature.hot"]).any()
    task = {**heat_task(bar, steps), "powers": [{"name": "lamp", "constant": True}],
            "exchanges": [{"name": "left", "temperature": 350.0}]}  # of the held elements
    history = run_yade(bar.path, task, tmp_path, "--law", law).history
    supplied = history["temperature.hot.heat"] + history["left.heat"]
    supplied += lamp.values.sum() * history["time"]
    capacity = bar.specimen.columns["conduction/heat_capacity"]
    gained = history["thermal_energy"] - 298 * capacity.sum()
    assert history["left.heat"][-1] < 0
    assert supplied == pytest.approx(gained, rel=1e-8)


@pytest.mark.slow
def test_incremental_form_agrees_to_first_order_in_strain(bar: Bar, tmp_path: Path) -> None:
    task = beam_task(bar, 1e-3 * 12 * RADIUS / (STEPS * bar.beam_step), STEPS)
    total = run_yade(bar.path, task, tmp_path / "total")
    other = run_yade(bar.path, task, tmp_path / "incremental", "--law", "incremental")
    a, b = (r.history["grip.right.force_x"][-1] for r in (total, other))
    assert a != b
    assert abs(a / b - 1) < 1e-3


def test_a_run_repeats_bit_for_bit(bar: Bar, tmp_path: Path) -> None:
    task = beam_task(bar, 1.0, 50)
    a, b = (run_yade(bar.path, task, tmp_path / name) for name in ("one", "two"))
    assert (a.frame(50).columns["position"] == b.frame(50).columns["position"]).all()
