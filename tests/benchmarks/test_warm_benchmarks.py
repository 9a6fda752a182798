# SPDX-License-Identifier: GPL-2.0-or-later
"""What the benchmarks of warm bodies read and compute by themselves: laws in one point, fits, scenes."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

from benchmarks.adiabatic_flow import blocks, law
from benchmarks.bimetal_strip import __main__ as strip


def test_the_law_alone_comes_as_near_to_the_experiment_as_was_published() -> None:
    alone = np.concatenate([law.law_alone(test) for test in law.TESTS])
    measured = np.concatenate([test.measured for test in law.TESTS])
    assert np.sqrt(np.mean((alone - measured) ** 2)) == pytest.approx(2.53, abs=0.01)
    assert alone[2] == pytest.approx(5.51, abs=0.01) and alone[-1] == pytest.approx(27.64, abs=0.02)


def test_an_adiabatic_point_keeps_its_heat() -> None:
    """β times the work under the curve less what is elastic is what warms it."""
    strain, stress, rise = law.adiabatic(law.TESTS[2])
    plastic = strain - stress / law.MODULUS
    work = np.sum(stress[1:] * np.diff(plastic))
    heat = law.DENSITY * law.CAPACITY * rise[-1]
    assert heat == pytest.approx(law.TAYLOR_QUINNEY * work, rel=1e-4)


def test_what_work_is_not_elastic_warms_the_point_at_every_strain() -> None:
    for test in law.TESTS:
        work, elastic = law.energies_alone(test)
        heat = law.DENSITY * law.CAPACITY * law.law_alone(test)
        assert heat == pytest.approx(law.TAYLOR_QUINNEY * (work - elastic), rel=1e-3)


def test_without_softening_only_hardening_is_left() -> None:
    flow = tomllib.loads(blocks.without_softening(blocks.BEAMS))["plasticity"]
    assert set(flow) == {"section", "hardening", "yield_stress", "hardening_stress",
                         "hardening_exponent"}


def test_a_beam_of_known_stiffness_is_read_as_that() -> None:
    """Exact shapes of a beam that is pulled, curls, and is bent by a force at its end."""
    place = np.random.default_rng(1).uniform(0, 1, (500, 3)) * [12e-3, 1e-3, 1.6e-3]
    place[:, 0].sort()
    x, z = place[:, 0], place[:, 2]
    moved = np.zeros_like(place)
    moved[:, 2] = 1e-6 + 0.02 * x + 0.5 * 3.0 * x**2
    moved[:, 0] = 1e-4 * x + 0.5 * z
    assert strip.curvature(place, moved) == pytest.approx(3.0)
    pulled = {"grips": {"end": {"force": [7.0, 0, 0]}}}
    assert strip.tension_stiffness(place, moved, pulled) == pytest.approx(7e4)
    moved[:, 2] = 0.01 * x + strip.FORCE / 0.03 * (x[-1] * x**2 / 2 - x**3 / 6)
    assert strip.bending_stiffness(place, moved) == pytest.approx(0.03)


def test_scenes_of_the_strip_are_those_of_the_example() -> None:
    example = tomllib.loads(strip.SCENE.read_text())
    bent = tomllib.loads(strip.scene(300, 5, 9, strip.BENT))
    assert bent["specimen"] == {**example["specimen"], "elements": 300, "seed": 5,
                                "size": ["9 mm", *example["specimen"]["size"][1:]]}
    assert bent["temperatures"][0]["value"]["value"] == ["20 °C", "20 °C"]
    assert [grip["name"] for grip in bent["grips"]] == ["wall", "end"]
    warm = tomllib.loads(strip.scene(300, 5, 12))
    assert warm["temperatures"] == example["temperatures"] and len(warm["grips"]) == 1
