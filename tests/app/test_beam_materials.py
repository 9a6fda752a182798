# SPDX-License-Identifier: GPL-2.0-or-later
"""Beams of several materials: bars in series, one material twice, and what goes with none of it."""

from __future__ import annotations

import json
import math

import h5py
import numpy as np
import pytest

from contrib.explained import parse_parameters

CHAIN = """\
[specimen]
shape = "crystal"
lattice = "simple_cubic"
cells = [10, 1, 1]
element_radius = "0.1 mm"
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "100 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
MORE
[[grips]]
name = "clamp"
region = { axis = "x", side = "low", depth = "0.15 mm" }
displacement = ["0 m", "0 m", "0 m"]
[[grips]]
name = "end"
region = { axis = "x", side = "high", depth = "0.15 mm" }
force = [{ time = ["0 us", "1 us"], value = ["0 N", "1 mN"] }, "free", "free"]
rotation = "free"
[[sensors]]
name = "tip"
point = ["1.9 mm", "0.1 mm", "0.1 mm"]
quantity = "displacement"
[run]
duration = "1 us"
"""
STIFF_HALF = """
[[beams.material]]
name = "stiff"
region = { lower = ["1 mm", "any", "any"] }
young_modulus = "300 GPa"
poisson_ratio = 0.3
"""
WEAK_PLANE = """
[[beams.interface]]
between = ["stiff", "rest"]
young_modulus = "1 GPa"
poisson_ratio = 0.3
"""
LENGTH, SECTION = 2e-4, math.pi * (0.5e-4) ** 2


def elongation(solidem, more):
    scene = solidem.scene("scene.toml", CHAIN.replace("MORE", more))
    done = solidem("solve", scene, "-o", "out", "--overwrite")
    assert done.returncode == 0, done.stderr
    summary = json.loads((solidem.folder / "out" / "summary.json").read_text())
    return summary["sensors"]["tip"]["displacement"][0]


def test_two_bars_one_after_the_other_are_springs_in_series(solidem):
    bonds = [1 / 100e9] * 4 + [0.5 / 100e9 + 0.5 / 300e9] + [1 / 300e9] * 4
    expected = 1e-3 * LENGTH / SECTION * sum(bonds)
    assert math.isclose(elongation(solidem, STIFF_HALF), expected, rel_tol=1e-9)


def test_an_interface_may_have_moduli_of_its_own(solidem):
    bonds = [1 / 100e9] * 4 + [1 / 1e9] + [1 / 300e9] * 4
    expected = 1e-3 * LENGTH / SECTION * sum(bonds)
    assert math.isclose(elongation(solidem, STIFF_HALF + WEAK_PLANE), expected, rel_tol=1e-9)


def last_frame(solidem, scene):
    done = solidem("run", scene, "-o", "out", "--overwrite", "--quiet")
    assert done.returncode == 0, done.stderr
    with h5py.File(solidem.folder / "out" / "trajectory.h5") as file:
        frames = file["frames"]
        return np.array(frames[sorted(frames)[-1]]["position"])


def test_one_material_twice_is_one_material(solidem):
    once = last_frame(solidem, solidem.scene("once.toml", CHAIN.replace("MORE", "")))
    same = STIFF_HALF.replace("300 GPa", "100 GPa")
    twice = last_frame(solidem, solidem.scene("twice.toml", CHAIN.replace("MORE", same)))
    moved = np.abs(once - once.mean(axis=0)).max()
    assert np.abs(twice - once).max() <= 1e-14 * moved


def test_the_time_step_follows_the_stiffest_beam(solidem):
    def limit(more):
        scene = solidem.scene("scene.toml", CHAIN.replace("MORE", more))
        done = solidem("explain", "--json", scene)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)
    plain, stiff = limit(""), limit(STIFF_HALF)
    ratio = stiff["time_step"]["limit"] / plain["time_step"]["limit"]
    assert 0.5 < ratio < 0.65  # 1 / sqrt(3), nearly
    assert stiff["laws"]["beams"]["materials"][0]["young_modulus"] == 300e9
    assert "materials" in "; ".join(parse_parameters(stiff).unsupported)


@pytest.mark.parametrize("more, words", [
    (STIFF_HALF.replace('"stiff"', '"rest"'), "that is what [beams] itself is called"),
    (STIFF_HALF.replace("poisson_ratio = 0.3\n", ""), "poisson_ratio"),
    (WEAK_PLANE, "no such material"),
    (STIFF_HALF + WEAK_PLANE.replace('"rest"', '"stiff"'), "no interface with itself"),
    (STIFF_HALF + WEAK_PLANE + WEAK_PLANE, "twice"),
    (STIFF_HALF + STIFF_HALF.replace('"stiff"', '"other"'), "share elements"),
    (STIFF_HALF.replace("1 mm", "9 mm"), "holds no element"),
    (STIFF_HALF + '[beams.fibres]\ndirection = [1, 0, 0]\n', "they have no grain"),
])
def test_what_makes_no_sense_is_refused(solidem, more, words):
    scene = solidem.scene("scene.toml", CHAIN.replace("MORE", more))
    done = solidem("explain", scene)
    assert done.returncode != 0
    assert words in done.stderr, done.stderr
