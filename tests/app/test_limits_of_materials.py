# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds of several materials: each flows and breaks where its own limits say."""

from __future__ import annotations

import csv
import json
import math

import h5py
import numpy as np
import pytest

from contrib.explained import parse_parameters
from scene_parts import PULLED_ENDS

CHAIN = """\
[specimen]
shape = "crystal"
lattice = "simple_cubic"
cells = [CELLS, 1, 1]
element_radius = "0.1 mm"
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "100 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
MATERIALS
""" + PULLED_ENDS + """\
[run]
steps = STEPS
time_step = "1 ns"
observe_every = EVERY
[output]
frames = 1
"""
FLOWS = """
[plasticity]
yield_strain = 0.002
hardening_ratio = 0.05
"""
BREAKS = """
[rupture]
strain = 0.02
"""
VOCE = """
[plasticity]
hardening = "voce"
yield_strain = 0.002
saturation_strain = 0.001
plastic_scale = 0.004
"""
OWN = """
[[beams.material]]
name = "own"
region = { all = true }
young_modulus = "50 GPa"
poisson_ratio = 0.3
yield_stress = "60 MPa"
plastic_strain_ratio = 2
"""
BRITTLE = OWN + "rupture_ratio = 0.7013\n"
BREAKS_AT = 0.7013 * 0.02
LENGTH, SECTION = 2e-4, math.pi * (0.5e-4) ** 2


def material(name, where, more="", modulus="100 GPa"):
    return f"""
[[beams.material]]
name = "{name}"
region = {where}
young_modulus = "{modulus}"
poisson_ratio = 0.3
{more}"""


def chain(materials, cells=2, speed=10, steps=450, every=1):
    text = CHAIN
    for word, value in (("CELLS", cells), ("MATERIALS", materials), ("SPEED", speed),
                        ("STEPS", steps), ("EVERY", every)):
        text = text.replace(word, str(value))
    return text


def run(solidem, text, *words, name="scene.toml"):
    done = solidem("run", solidem.scene(name, text), "-o", "out", "--overwrite", "--quiet", *words)
    assert done.returncode == 0, done.stderr
    with (solidem.folder / "out" / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def last_frame(solidem, name):
    with h5py.File(solidem.folder / "out" / "trajectory.h5") as file:
        frames = file["frames"]
        return np.array(frames[sorted(frames)[-1]][name])


def bonds_of(solidem, name):
    """A quantity of the bonds of a chain, from its low to its high end."""
    with h5py.File(solidem.folder / "out" / "trajectory.h5") as file:
        frames = file["frames"]
        return np.array(frames[sorted(frames)[-1]]["bonds"][name])


def yield_curve_of(strain, limit):
    """Elastic strain of a bond pulled to a strain, where ε_y(κ) is the limit."""
    low, high = np.zeros_like(strain), strain
    for _ in range(200):
        flow = 0.5 * (low + high)
        beyond = strain - flow > limit(flow)
        low, high = np.where(beyond, flow, low), np.where(beyond, high, flow)
    return strain - 0.5 * (low + high)


@pytest.mark.parametrize("law, limit", [
    (FLOWS, lambda k: 0.002 + 0.05 * k),
    (VOCE, lambda k: 0.002 + 0.001 * (1 - np.exp(-k / 0.004))),
])
def test_a_bond_follows_the_curve_of_its_material_and_breaks_where_it_says(solidem, law, limit):
    columns = run(solidem, chain(BRITTLE + law + BREAKS))
    strain = columns["grip.right.displacement_x"] / LENGTH
    # 60 MPa over 50 GPa is 0.6 of the yield strain of the law.
    elastic = yield_curve_of(strain, lambda flow: 0.6 * limit(flow / 2))
    whole = columns["broken_bonds"] == 0
    expected = 50e9 * SECTION * elastic
    assert np.allclose(columns["grip.right.force_x"][whole], expected[whole], rtol=1e-9, atol=1e-12)
    # It acts once more when it is found strained beyond what its material says.
    assert strain[whole][-2] < BREAKS_AT < strain[whole][-1]
    assert np.abs(columns["energy_balance"]).max() <= 1e-9 * columns["external_work"][-1]


@pytest.mark.parametrize("rule", ["radial-return", "scaled-offset", "associated"])
def test_every_rule_of_flow_takes_the_scale(solidem, rule):
    columns = run(solidem, chain(OWN + FLOWS + f'law = "{rule}"\n'))
    strain = columns["grip.right.displacement_x"] / LENGTH
    elastic = yield_curve_of(strain, lambda flow: 0.6 * (0.002 + 0.05 * flow / 2))
    assert np.allclose(columns["grip.right.force_x"], 50e9 * SECTION * elastic,
                       rtol=1e-9, atol=1e-12)


def test_a_bar_flows_and_breaks_in_its_weak_half(solidem):
    weak = material("weak", '{ lower = ["0.6 mm", "any", "any"] }',
                    "yield_strain = 0.001\nrupture_ratio = 0.5\n")
    columns = run(solidem, chain(weak + FLOWS + BREAKS, cells=6, speed=1, steps=40000, every=20))
    broken = np.argmax(columns["broken_bonds"] > 0)
    assert columns["broken_bonds"][-1] >= 1
    # Two bonds, and the one between the halves, flow to a hundredth, hardening by 0.05 / 2.
    largest = 100e9 * SECTION * (0.001 + 0.025 * 0.01) / 1.025
    assert math.isclose(columns["grip.right.force_x"][broken - 1], largest, rel_tol=0.01)
    intact = bonds_of(solidem, "intact")
    assert (bonds_of(solidem, "plastic_strain")[:2] == 0).all()
    assert list(intact[:2]) == [1, 1]
    assert 0 in intact[2:]


def test_a_weak_plane_breaks_where_it_is(solidem):
    plane = material("other", '{ lower = ["0.6 mm", "any", "any"] }') + """
[[beams.interface]]
between = ["other", "rest"]
young_modulus = "100 GPa"
poisson_ratio = 0.3
rupture_ratio = 0.25
"""
    columns = run(solidem, chain(plane + BREAKS, cells=6, speed=1, steps=8000, every=10))
    assert columns["broken_bonds"][-1] == 1
    assert list(bonds_of(solidem, "intact")) == [1, 1, 0, 1, 1]
    broken = np.argmax(columns["broken_bonds"] > 0)
    assert math.isclose(columns["grip.right.force_x"][broken - 1], 100e9 * SECTION * 0.005,
                        rel_tol=0.02)


def test_a_bond_between_two_materials_bears_what_the_weaker_half_does(solidem):
    stiff = material("stiff", '{ lower = ["0.2 mm", "any", "any"] }', modulus="300 GPa")
    columns = run(solidem, chain(stiff + FLOWS + BREAKS, steps=400))
    strain = columns["grip.right.displacement_x"] / LENGTH
    # Both yield at 0.002, the soft half at 200 MPa: a strain of 0.002 · 100 / 150 of the whole.
    elastic = yield_curve_of(strain, lambda flow: (0.002 + 0.05 * flow) * 100 / 150)
    whole = columns["broken_bonds"] == 0
    expected = 150e9 * SECTION * elastic
    assert np.allclose(columns["grip.right.force_x"][whole], expected[whole], rtol=1e-9)
    assert math.isclose(strain[np.argmin(whole)], 0.02 * 100 / 150, rel_tol=0.03)


TWICE = (material("a", '{ upper = ["0.6 mm", "any", "any"] }', "yield_strain = 0.001\n")
         + material("b", '{ lower = ["0.6 mm", "any", "any"] }', "yield_strain = 0.001\n"))


def test_one_material_twice_is_one_material(solidem):
    places = []
    for materials in (TWICE, material("all", "{ all = true }", "yield_strain = 0.001\n")):
        run(solidem, chain(materials + FLOWS, cells=6, steps=3000, every=100))
        places.append(last_frame(solidem, "position"))
    assert np.array_equal(*places)


def test_threads_and_a_pause_change_no_bit(solidem):
    weak = material("weak", '{ lower = ["0.6 mm", "any", "any"] }',
                    "yield_strain = 0.001\nplastic_strain_ratio = 3\nrupture_ratio = 0.4\n")
    text = chain(weak + FLOWS + BREAKS, cells=6, steps=6000, every=50).replace(
        "cells = [6, 1, 1]", "cells = [6, 3, 3]")
    whole = run(solidem, text, "-t", "1")
    frame = last_frame(solidem, "position")
    assert whole["plastic_work"][-1] > 0
    run(solidem, text, "-t", "3")
    assert np.array_equal(last_frame(solidem, "position"), frame)
    run(solidem, text.replace("steps = 6000", "steps = 2950"))
    done = solidem("run", solidem.scene("scene.toml", text), "-o", "out", "--resume", "--quiet")
    assert done.returncode == 0, done.stderr
    assert np.array_equal(last_frame(solidem, "position"), frame)


def test_what_a_scene_does_not_state_costs_no_column(solidem):
    def columns(more):
        done = solidem("explain", "--json", solidem.scene("scene.toml", chain(more)))
        assert done.returncode == 0, done.stderr
        return done.stdout
    assert "bond_limits" not in columns(FLOWS)
    assert "bond_limits" not in columns(material("same", "{ all = true }") + FLOWS)
    assert "bond_limits" not in columns(material("same", "{ all = true }"))
    told = columns(BRITTLE + FLOWS + BREAKS)
    assert "bond_limits" in told
    explained = json.loads(told)
    assert explained["laws"]["beams"]["materials"][0]["yield_strain"] == 60e6 / 50e9
    assert explained["laws"]["beams"]["materials"][0]["rupture_ratio"] == 0.7013
    assert "materials" in "; ".join(parse_parameters(explained).unsupported)


@pytest.mark.parametrize("more, words", [
    (BRITTLE + BREAKS, "there is no section [plasticity]"),
    (BRITTLE + FLOWS, "there is no section [rupture]"),
    (OWN + "yield_strain = 0.001\n" + FLOWS + BREAKS, "yield_strain"),
    (BRITTLE.replace("0.7013", "-0.7") + FLOWS + BREAKS, "rupture_ratio"),
])
def test_what_makes_no_sense_is_refused(solidem, more, words):
    done = solidem("explain", solidem.scene("scene.toml", chain(more)))
    assert done.returncode != 0
    assert words in done.stderr, done.stderr
