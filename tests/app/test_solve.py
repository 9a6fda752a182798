# SPDX-License-Identifier: GPL-2.0-or-later
"""`solidem solve`: files, figures, and what it says of scenes that it cannot solve."""

from __future__ import annotations

import json
import math

import h5py
import numpy as np
from scene_parts import (ALUMINIUM, CONDUCTING_ALUMINIUM, HELD, STIFF_BEAMS, THICK_BEAMS, crystal,
                         grip)

CANTILEVER = (
    'title = "cantilever"\n' + crystal("simple_cubic", 41, 1, 1) + ALUMINIUM + STIFF_BEAMS
    + grip("clamp", 'axis = "x", side = "low", depth = "0.15 mm"', HELD)
    + grip("end", 'axis = "x", side = "high", depth = "0.15 mm"', """\
force = ["free", { time = ["0 us", "1 us"], value = ["0 N", "1 mN"] }, "free"]
rotation = "free"\
""") + """\
[[sensors]]
name = "tip"
point = ["8.1 mm", "0.1 mm", "0.1 mm"]
quantity = "displacement"
[run]
duration = "2 us"
""")

LENGTH, RADIUS, MODULUS, FORCE = 8e-3, 0.27e-4, 3.5e12, 1e-3
BENDING = MODULUS * math.pi * RADIUS**4 / 4


def solve(solidem, text, *options):
    scene = solidem.scene("scene.toml", text)
    done = solidem("solve", scene, "-o", "out", "--overwrite", *options)
    assert done.returncode == 0, done.stderr
    return json.loads((solidem.folder / "out" / "summary.json").read_text()), done.stdout


def test_a_cantilever_bends_and_swings_by_beam_theory(solidem):
    summary, text = solve(solidem, CANTILEVER, "--modes", "2")
    deflection = FORCE * LENGTH**3 / (3 * BENDING)
    assert math.isclose(summary["sensors"]["tip"]["displacement"][1], deflection, rel_tol=1e-4)
    assert math.isclose(summary["energy"]["elastic_energy"], FORCE * deflection / 2, rel_tol=1e-4)
    assert np.allclose(summary["grips"]["clamp"]["force"], [0, -FORCE, 0], atol=1e-6 * FORCE)
    assert math.isclose(summary["grips"]["clamp"]["moment"][2], -FORCE * LENGTH, rel_tol=1e-4)
    assert np.allclose(summary["grips"]["end"]["force"], [0, FORCE, 0], atol=1e-6 * FORCE)
    assert summary["residual"] < 1e-8

    # The body reaches half an element beyond the last centre.
    line_density = 2790 * (0.2e-3) ** 2
    swing = (1.87510407 / (LENGTH + 1e-4)) ** 2 * math.sqrt(BENDING / line_density) / (2 * math.pi)
    assert np.allclose(summary["frequencies"], swing, rtol=1e-3)
    assert "mode 2" in text

    out = solidem.folder / "out"
    assert sorted(p.name for p in out.iterdir()) == [
        "modes", "modes.h5", "modes.xdmf", "summary.json", "trajectory", "trajectory.h5",
        "trajectory.xdmf"]
    with h5py.File(out / "trajectory.h5") as file:
        frame = file["frames/000000"]
        moved = frame["position"][:] - file["elements/position"][:]
        assert frame.attrs["time"] == 2e-6
        assert np.allclose(moved, frame["displacement"][:], atol=1e-15)
        assert math.isclose(moved[:, 1].max(), deflection, rel_tol=1e-4)
    with h5py.File(out / "modes.h5") as file:
        assert len(file["frames"]) == 2


def test_finite_rotations_stiffen_a_cantilever(solidem):
    heavy = CANTILEVER.replace("1 mN", "80 mN")
    small, _ = solve(solidem, heavy)
    finite, text = solve(solidem, heavy, "--rotations", "finite")
    k = 0.08 * LENGTH**2 / BENDING
    assert k > 0.5  # far from small
    tip = finite["sensors"]["tip"]["displacement"]
    assert tip[1] < 0.97 * small["sensors"]["tip"]["displacement"][1]
    assert tip[0] < 0
    assert finite["load_steps"] > 1
    assert "of the loads and displacements after" in text
    assert finite["unstable"] is False


def test_gauge_measures_as_in_a_slow_run(solidem, bar):
    # The last row of a run that pulls slowly, beside the equilibrium at the same displacement.
    solved, _ = solve(solidem, bar)
    assert solidem("run", "scene.toml", "-o", "run").returncode == 0
    ran = json.loads((solidem.folder / "run" / "summary.json").read_text())["final"]
    assert set(solved["gauge"]) >= {"stress", "strain", "lateral_strain"}
    assert math.isclose(solved["gauge"]["strain"], ran["gauge.strain"], rel_tol=0.2)
    assert math.isclose(solved["gauge"]["stress"] / solved["gauge"]["strain"],
                        ran["gauge.stress"] / ran["gauge.strain"], rel_tol=0.1)


def test_a_body_that_is_not_held_is_told_how_it_can_move(solidem):
    loose = CANTILEVER.replace('displacement = ["0 m", "0 m", "0 m"]',
                               'displacement = ["free", "0 m", "0 m"]')
    done = solidem("solve", solidem.scene("loose.toml", loose), "-o", "out")
    assert done.returncode == 2
    assert "loose.toml" in done.stderr
    assert "not held: it can shift along x;" in done.stderr
    assert not (solidem.folder / "out" / "summary.json").exists()


def test_without_beams_there_is_nothing_to_solve(solidem):
    warm = crystal("simple_cubic", 3, 1, 1) + CONDUCTING_ALUMINIUM + "[run]\nsteps = 1\n"
    done = solidem("solve", solidem.scene("warm.toml", warm))
    assert done.returncode == 2
    assert "no [beams]" in done.stderr


def test_what_a_run_does_and_a_body_at_rest_does_not_is_noted(solidem):
    warm = CANTILEVER.replace(ALUMINIUM, CONDUCTING_ALUMINIUM) + """\
[[initial_velocities]]
region = { all = true }
velocity = ["1 m/s", "0 m/s", "0 m/s"]
"""
    summary, text = solve(solidem, warm)
    assert "[[initial_velocities]], [conduction]: left out" in summary["notes"][0]
    assert "left out" in text


def test_a_fitted_sensor_reads_between_elements(solidem):
    """A row that is pulled moves as the distance from its clamp, between its centres as well."""
    pulled = (CANTILEVER.replace('["free", { time = ["0 us", "1 us"], value = ["0 N", "1 mN"] }, "free"]',
                                 '[{ time = ["0 us", "1 us"], value = ["0 N", "1 mN"] }, "free", "free"]')
              .replace('point = ["8.1 mm"', 'sampling = "fit"\npoint = ["5.17 mm"'))
    summary, _ = solve(solidem, pulled)
    tip = summary["sensors"]["tip"]
    moved = FORCE * (5.17e-3 - 0.1e-3) / (MODULUS * math.pi * RADIUS**2)
    assert np.allclose(tip["displacement"], [moved, 0, 0], rtol=1e-6, atol=1e-9 * moved)
    assert np.allclose(tip["position"], [5.17e-3 + moved, 0.1e-3, 0.1e-3], rtol=1e-12)


WARM = """\
density = "2790 kg/m^3"
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
expansion_coefficient = "23e-6 1/K"
[conduction]
initial_temperature = "298 K"
"""


def test_moduli_over_temperature_are_refused(solidem):
    warm = CANTILEVER.replace('density = "2790 kg/m^3"\n',
                              WARM + "[softening]\nmodulus_ratio = 0.5\n")
    done = solidem("solve", solidem.scene("warm.toml", warm))
    assert done.returncode == 2
    assert "[softening] acts in a run" in done.stderr


def test_a_warm_body_is_as_long_as_the_heat_of_the_run_makes_it(solidem):
    """One end is held at 298 K, the other at 398 K, for so long that the profile is straight."""
    ends = "".join(f'[[temperatures]]\nname = "{side}"\nvalue = "{value} K"\n'
                   f'region = {{ axis = "x", side = "{side}", depth = "0.15 mm" }}\n'
                   for side, value in (("low", 298), ("high", 398)))
    warm = (CANTILEVER.replace('density = "2790 kg/m^3"\n', WARM + 'law = "voronoi"\n[expansion]\n')
            .replace('duration = "2 us"', 'duration = "10 s"')
            .replace('["free", { time = ["0 us", "1 us"], value = ["0 N", "1 mN"] }, "free"]',
                     '["0 N", "0 N", "0 N"]')) + ends
    summary, _ = solve(solidem, warm)
    tip = summary["sensors"]["tip"]["displacement"]
    assert np.allclose(tip, [LENGTH * 23e-6 * 50, 0, 0], atol=1e-9 * LENGTH)
    with h5py.File(solidem.folder / "out" / "trajectory.h5") as file:
        temperature = np.sort(file["frames/000000/temperature"][:])
    assert np.allclose(temperature, np.linspace(298, 398, 41), atol=1e-6)
    done = solidem("solve", "scene.toml", "-o", "out", "--overwrite", "--rotations", "finite")
    assert done.returncode == 2
    assert "small rotations only" in done.stderr


PIECES = ('[specimen]\nfile = "pieces.csv"\n[material]\ndensity = "2700 kg/m^3"\n' + THICK_BEAMS
          + grip("low", 'upper = ["1 mm", "any", "any"]', HELD)
          + grip("high", 'lower = ["19 mm", "any", "any"]',
                 'displacement = ["1 um", "0 m", "0 m"]')
          + "[run]\nsteps = 10\n")


def chain_of(*places):
    return "x,y,z,radius\n" + "".join(f"{x}e-3,0,0,1e-3\n" for x in places)


def test_a_grip_that_holds_nothing_of_the_body_is_refused(solidem):
    (solidem.folder / "pieces.csv").write_text(chain_of(0, 2, 4, 6, 8, 14, 16, 18, 20))
    done = solidem("solve", solidem.scene("scene.toml", PIECES), "-o", "out")
    assert done.returncode == 2
    assert '[[grips]] "high"' in done.stderr and "5 of 9 elements" in done.stderr
    assert not (solidem.folder / "out").exists()


def test_elements_left_out_are_told(solidem):
    (solidem.folder / "pieces.csv").write_text(
        chain_of(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 30, 32, 40))
    summary, text = solve(solidem, PIECES)
    assert summary["residual"] < 1e-8
    assert math.isclose(summary["grips"]["high"]["force"][0], 70e9 * math.pi * 0.5e-3**2 * 1e-6 / 20e-3,
                        rel_tol=1e-9)
    notes = "\n".join(summary["notes"])
    assert "its volume" in notes
    assert "1 elements have no bond" in notes
    assert "2 pieces that do not see each other" in notes and "(0.03, 0, 0) m" in notes
    assert "11 of 14 elements" in notes
    assert 'grip "high": 3 of its 4 elements' in notes
    assert "11 of 14 elements" in text


def test_a_solution_that_is_round_off_is_no_success(solidem):
    (solidem.folder / "pieces.csv").write_text(chain_of(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20))
    moved = PIECES.replace('displacement = ["0 m", "0 m", "0 m"]', 'displacement = ["1 um", "0 m", "0 m"]')
    done = solidem("solve", solidem.scene("scene.toml", moved), "-o", "out")
    assert done.returncode == 1
    assert "round-off" in done.stderr
    assert not (solidem.folder / "out" / "summary.json").exists()


def test_what_would_have_yielded_is_noted(solidem):
    plastic = CANTILEVER + "[plasticity]\nyield_strain = 0.002\n"
    quiet, _ = solve(solidem, plastic)
    assert "notes" not in quiet
    strained, text = solve(solidem, plastic.replace("1 mN", "50 mN"))
    expected = 0.05 * LENGTH * RADIUS / BENDING  # at the clamp, but for half an element
    assert math.isclose(strained["largest_bond_strain"], expected, rel_tol=0.03)
    assert "would have yielded" in strained["notes"][0]
    assert "would have yielded" in text
