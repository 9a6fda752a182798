# SPDX-License-Identifier: GPL-2.0-or-later
"""What readings of accuracy are held against: finite elements, theories, and bonds for a given solid."""

from __future__ import annotations

import csv
import math
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from benchmarks.accuracy_cost.calibration import calibration_scene, with_bonds
from benchmarks.accuracy_cost.known import Figure, extrapolated, figures, swing
from benchmarks.accuracy_cost.page import own_error
from benchmarks.accuracy_cost.runs import specimen_text
from benchmarks.accuracy_cost.study import StudyError, read_study
from compare.codes.calculix_solids import (HolePlate, Solid, bar_frequencies, bar_stiffness,
                                           hole_stress, ringing_bar)
from compare.codes.statics import motion_of_sections
from compare.references import RectangularBeam, cantilever_frequencies
from compare.result import CodeFailure

ROOT = Path(__file__).resolve().parents[2]
needs_calculix = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")

BAR = """\
title = "a bar"
[specimen]
shape = "box"
size = ["1.2 mm", "0.4 mm", "0.4 mm"]
elements = 80
seed = 1
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.3
[calibration]
young_modulus = "73 GPa"
specimens = 1
[[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1 }
velocity = ["2 m/s", "free", "free"]
rotation = "free"
[gauge]
axis = "x"
lower = "0.4 mm"
upper = "0.8 mm"
[run]
duration = "2 us"
time_step_of_limit = 0.5
[output]
frames = 1
"""

STUDY = """\
title = "A short bar"
about = "It is pulled."
error = "modulus of its middle"
scene = "bar.scene"
repetitions = 2
timeout = 60
markers = "step"
[known.solid]
kind = "given"
source = "the solid that is asked for"
values = { modulus = 73e9 }
[[reading]]
name = "modulus"
measure = "slope_against"
reference = "solid"
[reading.options]
modulus = { value = "modulus", x = "gauge.strain", y = "gauge.stress", from = 0.2, to = 1.0 }
[[axis]]
name = "law"
values = ["beams"]
[[axis]]
name = "elements"
values = [80, 200]
replace = { "elements = 80" = "elements = $value" }
[[axis]]
name = "step"
[[axis.values]]
step = "0.5"
[[axis.values]]
step = "solved for at rest"
solver = "statics"
replace = { "time_step_of_limit = 0.5" = "time_step_ratio = 0.5" }
"""


@pytest.mark.parametrize("order", [1.0, 1.4, 2.0])
def test_values_on_three_meshes_are_led_on_to_their_limit(order: float) -> None:
    found = extrapolated([7 + 0.3 * h**order for h in (1.0, 0.5, 0.25)], "three meshes")
    assert found.value == pytest.approx(7)
    assert found.error == pytest.approx(0.3 * 0.25**order / 7)


def test_values_that_do_not_settle_are_told_as_far_apart_as_they_are() -> None:
    found = extrapolated([1.0, 1.1, 1.0], "three meshes")
    assert found.value == 1.0 and found.error == pytest.approx(0.1)


def test_a_swing_is_read_between_its_rows() -> None:
    time = np.linspace(0, 1.2, 61)
    found = swing(time, 3 * np.sin(math.pi * time))
    assert found["largest"] == pytest.approx(3, rel=1e-5)
    assert found["back"] == pytest.approx(1, rel=1e-3)
    with pytest.raises(CodeFailure, match="does not come back"):
        swing(time[:20], time[:20])


def test_a_slender_beam_is_that_of_euler_and_bernoulli() -> None:
    beam = RectangularBeam(0.5, 1e-3, 2e-3, 70e9, 0.3, 2700)
    right = cantilever_frequencies(3, 0.5, beam.bending_stiffness, 2700 * 2e-6)
    assert beam.frequencies(3) == pytest.approx(right, rel=2e-4)
    assert np.all(beam.frequencies(3) < right)
    assert beam.tip_stiffness == pytest.approx(3 * beam.bending_stiffness / 0.5**3, rel=2e-5)


@needs_calculix
def test_finite_elements_of_a_slender_bar_are_those_of_its_theory(tmp_path: Path) -> None:
    solid = Solid((0.04, 2e-3, 2e-3), 70e9, 0.0, 2700)
    beam = RectangularBeam(0.04, 2e-3, 2e-3, 70e9, 0.0, 2700)
    assert bar_stiffness(solid, "tension", (8, 1, 1), tmp_path) == pytest.approx(
        70e9 * 4e-6 / 0.04, rel=1e-5)
    assert bar_stiffness(solid, "bending", (20, 2, 2), tmp_path) == pytest.approx(
        beam.tip_stiffness, rel=2e-3)
    assert bar_frequencies(solid, 3, (20, 2, 2), tmp_path) == pytest.approx(
        beam.frequencies(3), rel=5e-3)


@needs_calculix
def test_finite_elements_know_kirsch_and_the_speed_of_sound(tmp_path: Path) -> None:
    wide = HolePlate(0.04, 0.04, 1e-3, 1e-3, 70e9, 0.0)
    field = hole_stress(wide, (12, 12, 1), tmp_path)
    # Kirsch: 1 + ½ (r/y)² + 3/2 (r/y)⁴ along the line across the load; by its mean from r to 1.5 r.
    right = 1 + (1 - 1 / 1.5) + (1 - 1 / 1.5**3)
    assert field.mean((0, 1e-3), (0.02e-3, 1.5e-3)) == pytest.approx(right, rel=0.02)
    rod = Solid((0.02, 1e-3, 1e-3), 70e9, 0.0, 2700)
    found = swing(*ringing_bar(rod, 1.0, 12e-6, (20, 1, 1), 60, tmp_path))
    assert found["back"] == pytest.approx(0.04 / math.sqrt(70e9 / 2700), rel=0.01)


def test_what_is_known_is_worked_out_once_and_what_is_not_is_said(tmp_path: Path) -> None:
    given = {"kind": "given", "source": "a book", "values": {"a": 2.0, "b": 3}, "errors": {"b": 0.1}}
    found = figures(given, tmp_path)
    assert found == figures(given, tmp_path) == {"a": Figure(2.0, 0.0, "a book"),
                                                 "b": Figure(3.0, 0.1, "a book")}
    assert len(list(tmp_path.glob("*.json"))) == 1
    with pytest.raises(CodeFailure, match="'rumour'.*bar"):
        figures({"kind": "rumour"}, tmp_path)
    with pytest.raises(CodeFailure, match="'size' is missing"):
        figures({"kind": "bar"}, tmp_path)
    assert own_error(found["b"]) == "own error 10 %"
    assert "not told" in own_error(Figure(1.0, math.nan, "measured"))


def test_the_law_alone_is_that_of_adiabatic_flow(tmp_path: Path) -> None:
    found = figures({"kind": "adiabatic_flow", "start": 296, "rate": 1000}, tmp_path)
    assert found["rise at 0.092"].value == pytest.approx(12.61, abs=0.01)
    assert found["rise at 0.092"].error < 1e-4
    assert found["rise at 0.092, measured"].value == 13.0
    with pytest.raises(CodeFailure, match="no test starts at 300"):
        figures({"kind": "adiabatic_flow", "start": 300, "rate": 1000}, tmp_path)


def test_bonds_are_found_on_the_body_or_on_three_that_are_not_run() -> None:
    own = calibration_scene(BAR)
    assert "seed = 1\n" in own and "[gauge]" in own and "[[grips]]" not in own and "[run]" not in own
    others = calibration_scene(BAR.replace("specimens = 1", "specimens = 3"))
    assert "seed = 1001\n" in others
    found = with_bonds(BAR, '[beams]\nlaw = "spring"\nyoung_modulus = "1 TPa"\n')
    assert "[calibration]" not in found and 'young_modulus = "1 TPa"' in found
    assert "3.5 TPa" not in found and found.count("[beams]") == 1 and "[[grips]]" in found


def test_cuts_belong_to_the_specimen() -> None:
    cut = '[[specimen.cut]]\nshape = { kind = "box" }\n'
    scene = BAR.replace("[material]", cut + "[material]")
    assert specimen_text(scene) == specimen_text(BAR) + cut
    with pytest.raises(CodeFailure, match="no \\[specimen\\]"):
        specimen_text("[run]\n")


def test_bending_is_told_from_twisting_and_stretching(tmp_path: Path) -> None:
    place = np.stack([a.ravel() for a in np.meshgrid(
        np.linspace(0, 12, 25), [-1.0, 1.0], [-1.0, 1.0], indexing="ij")], axis=1)
    x, y, z = place.T
    none = np.zeros_like(x)
    with h5py.File(tmp_path / "modes.h5", "w") as file:
        for n, moved in enumerate(([none, none, x**2], [none, -z * x, y * x], [x, none, none])):
            group = file.create_group(f"frames/{n:06d}")
            group["position"], group["displacement"] = place, np.stack(moved, axis=1)
    found = motion_of_sections(tmp_path / "modes.h5", np.ones(len(x)))
    assert found["mode_z"] == pytest.approx([1, 0, 0], abs=0.01)
    assert found["mode_y"] == pytest.approx([0, 0, 0], abs=0.01)
    assert found["mode_x"] == pytest.approx([0, 0, 1], abs=0.01)


@pytest.fixture
def study_file(tmp_path: Path) -> Path:
    (tmp_path / "bar.scene").write_text(BAR)
    (tmp_path / "bar.toml").write_text(STUDY)
    return tmp_path / "bar.toml"


@pytest.mark.parametrize("old, new, message", [
    ('reference = "solid"', 'reference = "liquid"', "known: solid"),
    ('markers = "step"', 'markers = "step"\norders = "colour"', "orders = 'colour'; known: modulus"),
    ("[known.solid]", "[reference.solid]\nlabels = { step = \"0.5\" }\n[known.solid]", "'solid' is a run")])
def test_a_reading_is_held_against_what_is_there(study_file: Path, old: str, new: str,
                                                 message: str) -> None:
    study_file.write_text(STUDY.replace(old, new))
    with pytest.raises(StudyError, match=message):
        read_study(study_file)


def rows(path: Path) -> list[dict[str, Any]]:
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def test_a_given_solid_from_its_calibration_to_the_page(study_file: Path, tmp_path: Path) -> None:
    output = tmp_path / "results"
    command = [sys.executable, "-m", "benchmarks.accuracy_cost", str(study_file), "--output",
               str(output)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=120,
                          check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    runs = rows(output / "runs.csv")
    assert len(runs) == 8
    for row in runs:
        # Calibrated on the very body, by its gauge section; a run has waves in it.
        assert float(row["error"]) < (0.05 if row["solver"] == "statics" else 0.3)
        assert float(row["steps_seconds"]) > 0 and float(row["set_up_seconds"]) > 0
    assert len(list((output / "scratch" / "calibrations").glob("*.json"))) == 4
    (known,) = rows(output / "references.csv")
    assert (known["study"], known["value"], float(known["in_si_units"])) == ("bar", "modulus", 73e9)
    page = (output / "page.md").read_text()
    assert "“modulus” is held against modulus = 7.3e+10 (as given): the solid that is asked for." in page
