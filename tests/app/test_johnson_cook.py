# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds that yield by Johnson and Cook: harder the faster they flow, softer as they warm."""

from __future__ import annotations

import csv
import json
import math

import h5py
import numpy as np
import pytest

from contrib.explained import parse_parameters
from scene_parts import PULLED_ENDS

SCENE = """\
[specimen]
shape = "crystal"
lattice = "simple_cubic"
cells = [CELLS]
element_radius = "0.1 mm"
[material]
density = "2700 kg/m^3"
specific_heat_capacity = "900 J/(kg K)"
conductivity = "180 W/(m K)"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[plasticity]
hardening = "johnson-cook"
yield_stress = "219 MPa"
hardening_stress = "276 MPa"
hardening_exponent = EXPONENT
MORE
""" + PULLED_ENDS + """\
[run]
steps = STEPS
time_step = "STEP s"
observe_every = EVERY
[output]
frames = 1
"""
RATE = 'rate_sensitivity = 0.025\nreference_rate = "1 1/s"\nrate_time = "1 us"\n'
WARM = ('softening_exponent = 1.36\nreference_temperature = "296 K"\n'
        'melting_temperature = "855 K"\n')
HEAT = '[conduction]\ninitial_temperature = "INITIAL K"\n'
HEATED = '[plastic_heat]\nfraction = 0.9\n'
LENGTH, SECTION, MODULUS = 2e-4, math.pi * (0.5e-4) ** 2, 70e9


def scene(more="", cells="2, 1, 1", exponent=0.249, speed=2, step=1e-9, steps=1000, every=1,
          initial=296):
    text = SCENE
    for word, value in (("CELLS", cells), ("MORE", more), ("EXPONENT", exponent),
                        ("SPEED", speed), ("STEPS", steps), ("STEP", step), ("EVERY", every),
                        ("INITIAL", initial)):
        text = text.replace(word, str(value))
    return text


def run(solidem, text, *words, name="scene.toml"):
    done = solidem("run", solidem.scene(name, text), "-o", "out", "--overwrite", "--quiet", *words)
    assert done.returncode == 0, done.stderr
    with (solidem.folder / "out" / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def last_frame(solidem, name="position"):
    with h5py.File(solidem.folder / "out" / "trajectory.h5") as file:
        frames = file["frames"]
        return np.array(frames[sorted(frames)[-1]][name])


def hardening(flow, exponent=0.249):
    return (219e6 + 276e6 * flow**exponent) / MODULUS


def elastic_strain(strain, factor=1.0):
    """What a bond pulled to a strain has left that flows at a multiple of the hardening curve."""
    low, high = np.zeros_like(strain), strain
    for _ in range(200):
        flow = 0.5 * (low + high)
        beyond = strain - flow > factor * hardening(flow)
        low, high = np.where(beyond, flow, low), np.where(beyond, high, flow)
    return strain - 0.5 * (low + high)


@pytest.mark.parametrize("rule", ["radial-return", "scaled-offset", "associated"])
def test_without_rate_and_temperature_it_is_the_curve_of_hardening(solidem, rule):
    columns = run(solidem, scene(f'law = "{rule}"\n'))
    strain = columns["grip.right.displacement_x"] / LENGTH
    expected = MODULUS * SECTION * elastic_strain(strain)
    # Where a bond has hardly flowed its curve is infinitely steep.
    assert np.abs(columns["grip.right.force_x"] - expected).max() <= 1e-4 * expected.max()
    assert np.allclose(columns["grip.right.force_x"][-500:], expected[-500:], rtol=1e-9)


@pytest.mark.parametrize("speed", [0.2, 2, 200])
def test_fast_flow_is_harder_by_the_formula(solidem, speed):
    rate = speed / LENGTH
    steps = 4000
    step = 0.04 * LENGTH / speed / steps
    more = RATE.replace("1 us", f"{30 * step} s")
    columns = run(solidem, scene(more, speed=speed, step=step, steps=steps, every=10))
    strain = columns["grip.right.displacement_x"] / LENGTH
    left = columns["grip.right.force_x"] / SECTION / MODULUS
    flow = strain - left
    # The rate of the plastic strain at the end, by the history.
    flowing = rate * (flow[-1] - flow[-21]) / (strain[-1] - strain[-21])
    factor = 1 + 0.025 * math.log(flowing)
    assert math.isclose(left[-1], factor * hardening(flow[-1]), rel_tol=1e-5)
    assert np.abs(columns["energy_balance"]).max() <= 1e-8 * columns["external_work"][-1]


def test_flow_slower_than_the_reference_does_not_know_of_the_rate(solidem):
    slow = RATE.replace("1 1/s", "1e6 1/s")
    columns, plain = run(solidem, scene(slow)), run(solidem, scene())
    assert np.allclose(columns["grip.right.force_x"], plain["grip.right.force_x"], rtol=1e-12)


@pytest.mark.parametrize("initial", [250, 400, 700, 854, 900])
def test_warm_bonds_are_softer_by_the_formula(solidem, initial):
    columns = run(solidem, scene(WARM + HEAT, initial=initial))
    warmth = min(max((initial - 296) / (855 - 296), 0), 1)
    strain = columns["grip.right.displacement_x"] / LENGTH
    factor = 1 - warmth**1.36
    expected = MODULUS * SECTION * (elastic_strain(strain, factor) if factor else 0 * strain)
    assert np.allclose(columns["grip.right.force_x"][-500:], expected[-500:], rtol=1e-9, atol=1e-12)


def adiabatic(end, rate, rate_time, heat, count=8000):
    """Elastic strain and rise of temperature of a bond that is pulled steadily to a strain: the law
    itself at the end of each of many steps, the averaged rate and the heat by the trapezoidal rule.
    `heat`: K per elastic strain and flow."""
    start = 219e6 / MODULUS
    step = (end - start) / rate / count
    flow, averaged, warm, left = 0.0, 0.0, 0.0, start
    for n in range(1, count + 1):
        strain = start + n * step * rate

        def after(more):
            now_left = strain - flow - more
            now_averaged = (averaged * (rate_time - 0.5 * step) + more) / (rate_time + 0.5 * step)
            return now_left, now_averaged, warm + heat * 0.5 * (left + now_left) * more

        low, high = 0.0, 3 * step * rate
        for _ in range(45):
            more = 0.5 * (low + high)
            now_left, now_averaged, now_warm = after(more)
            limit = (hardening(flow + more) * (1 + 0.025 * math.log(max(now_averaged, 1)))
                     * (1 - (now_warm / (855 - 296)) ** 1.36))
            low, high = (more, high) if now_left > limit else (low, more)
        left, averaged, warm = after(low)
        flow += low
    return left, warm


def test_adiabatic_tension_is_the_law_integrated(solidem):
    rate, end, rate_time = 1e4, 0.05, 2e-7
    found = []
    for steps in (5000, 10000, 20000):
        text = scene(RATE.replace("1 us", f"{rate_time} s") + WARM + HEAT + HEATED,
                     steps=steps, step=end / rate / steps, every=steps)
        columns = run(solidem, text)
        rise = last_frame(solidem, "temperature") - 296
        assert math.isclose(*rise, rel_tol=1e-12)
        capacity = columns["thermal_energy"][-1] / rise.sum()  # of each element
        # The flow of the very last pose is not in the temperatures yet.
        found.append((columns["grip.right.force_x"][-1] / SECTION / MODULUS,
                      rise[0] + 0.5 * columns["waiting_heat"][-1] / capacity))
    # Half of the heat goes to each end.
    left, warm = adiabatic(end, rate, rate_time,
                           0.5 * 0.9 * MODULUS * SECTION * LENGTH / capacity)
    errors = np.abs(np.array(found) / [left, warm] - 1)
    assert errors.max() < 1e-6
    stress = errors[:, 0]  # first order: what is warm softens a step later
    assert np.allclose(stress[:-1] / stress[1:], 2, rtol=0.1)


def test_no_heat_of_work_is_none(solidem):
    more = RATE + WARM + HEAT
    without = run(solidem, scene(more))
    nothing = run(solidem, scene(more + HEATED.replace("0.9", "0")))
    assert np.array_equal(without["grip.right.force_x"], nothing["grip.right.force_x"])
    heated = run(solidem, scene(more + HEATED))
    assert heated["grip.right.force_x"][-1] < without["grip.right.force_x"][-1]


BLOCK = {"cells": "6, 3, 3", "speed": 20, "step": 2e-9, "steps": 3000, "every": 50}


def test_threads_and_a_pause_change_no_bit(solidem):
    more = RATE.replace("1 us", "0.1 us") + WARM + HEAT + "every = 7\n" + HEATED
    text = scene(more, **BLOCK)
    whole = run(solidem, text, "-t", "1")
    frame = last_frame(solidem)
    assert whole["plastic_work"][-1] > 0
    run(solidem, text, "-t", "3")
    assert np.array_equal(last_frame(solidem), frame)
    run(solidem, text.replace("steps = 3000", "steps = 1505"))
    done = solidem("run", solidem.scene("scene.toml", text), "-o", "out", "--resume", "--quiet")
    assert done.returncode == 0, done.stderr
    assert np.array_equal(last_frame(solidem), frame)


def test_extremes_stay_finite(solidem):
    hot = ('[[temperatures]]\nname = "hot"\n'
           'region = { axis = "x", side = "high", depth = "0.15 mm" }\nvalue = "1200 K"\n')
    more = RATE + WARM + HEAT + HEATED + hot
    columns = run(solidem, scene(more, cells="4, 2, 2", speed=200, step=1e-9, steps=3000, every=10))
    assert all(np.isfinite(column).all() for column in columns.values())
    assert np.abs(columns["energy_balance"]).max() <= 1e-3 * columns["external_work"][-1]


def test_expansion_softening_and_yield_go_together(solidem):
    more = (RATE + WARM + HEAT + HEATED + "[expansion]\n[softening]\n"
            'modulus_ratio = { temperature = ["296 K", "855 K"], value = [1, 0.5] }\n')
    text = scene(more, **BLOCK).replace(
        'conductivity = "180 W/(m K)"', 'conductivity = "180 W/(m K)"\n'
        'expansion_coefficient = "2.3e-5 1/K"')
    columns = run(solidem, text)
    assert columns["plastic_work"][-1] > 0
    assert np.abs(columns["energy_balance"]).max() <= 1e-4 * columns["external_work"][-1]


@pytest.mark.parametrize("more, words", [
    (WARM, "nothing has a temperature"),
    (WARM.replace("855 K", "200 K") + HEAT, "must be above"),
    ('reference_temperature = "296 K"\n' + HEAT, "melting_temperature is needed"),
    ('melting_temperature = "855 K"\n' + HEAT, "reference_temperature is needed"),
    ('rate_time = "1 us"\n', "does not look at the rate"),
    (RATE.replace("0.025", "-1"), "rate_sensitivity"),
    (RATE.replace("1 1/s", "1 m/s"), "reference_rate"),
])
def test_what_makes_no_sense_is_refused(solidem, more, words):
    done = solidem("explain", solidem.scene("scene.toml", scene(more)))
    assert done.returncode != 0
    assert words in done.stderr, done.stderr


def test_explain_tells_it_and_liggghts_takes_it(solidem):
    def explained(more):
        done = solidem("explain", "--json", solidem.scene("scene.toml", scene(more)))
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)
    told = explained(RATE + WARM + HEAT)
    assert told["laws"]["plasticity"]["melting_temperature"] == 855
    assert parse_parameters(told).unsupported == ()
    assert "flow_rate" in json.dumps(told)
    assert "flow_rate" not in json.dumps(explained(""))
