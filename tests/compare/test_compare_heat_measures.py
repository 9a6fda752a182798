# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of heat find exactly the error that is put in."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fake_codes import FakeStandalone

import compare.heat_measures  # noqa: F401  (makes its measures known)
from compare.case import Case, Check, Variant
from compare.codes.base import Job
from compare.codes.calculix import Calculix, Mesh, source_lines
from compare.measures import MEASURES
from compare.references import MovingDisc, moving_disc_temperature
from compare.result import CodeFailure, Floats, Frame, Result
from compare.row import Measured
from compare.runs import CaseRuns, Specimens, View
from compare.solutions import solution
from contrib.prepared import Specimen

PLATE = {"length": 0.05, "width": 0.03, "thickness": 0.002, "density": 2790.0,
         "specific_heat_capacity": 880.0, "conductivity": 134.0, "initial_temperature": 298.15,
         "disc_radius": 0.004, "power_density": 1e11, "start": [0.02, 0.0], "speed": 3.3e-3,
         "duration": 0.026 / 3.3e-3}
MATERIAL = {"density": 2.0, "specific_heat_capacity": 3.0, "conductivity": 6.0}
ROD = {"kind": "rod", "axis": 0, "length": 1.0, "initial": 10.0, "hot": 20.0, **MATERIAL}
COOLING = {"kind": "cooling_bar", "axis": 0, "length": 1.0, "coefficient": 6.0, "initial": 20.0,
           "fluid": 10.0, **MATERIAL}
ANNULUS = {"kind": "annulus", "axis": 0, "inner": 1.0, "outer": 2.0, "initial": 10.0,
           "inner_temperature": 20.0, **MATERIAL}
WEDGE = {"kind": "wedge", "axis": 0, "inner": 1.0, "outer": 2.0, "angle": 1.0, "initial": 10.0,
         "first": 20.0, "last": 10.0, **MATERIAL}
LAYERS = {"kind": "layers", "axis": 0, "initial": 10.0, "low": 20.0, "contacts": [10.0],
          "layers": [{"length": 0.4, **MATERIAL},
                     {"length": 0.6, **MATERIAL, "conductivity": 1.0}]}


class Bodies(CaseRuns):
    """A case whose results are given."""

    def __init__(self, path: Path, options: dict[str, Any], results: dict[str, Result],
                 position: Floats):
        """Results by variant; all of one body."""
        variants = tuple(Variant(name, ("standalone",), {}, {"seed": name}) for name in results)
        case = Case("bodies", "", path, None, variants, (), options=options)
        super().__init__(case, {"standalone": FakeStandalone()}, path / "runs",
                         Specimens(path / "specimens"))
        self.given, self.position = results, position

    def job(self, variant: str) -> Job:
        specimen = Specimen(self.directory, self.position, np.ones(len(self.position)),
                            np.zeros((0, 2), dtype=np.int64))
        return Job(*[self.directory] * 3, specimen, None, 1, 1, 1.0)  # type: ignore[arg-type]

    def result(self, variant: str, code: str) -> Result:
        return self.given[variant]


def result(time: Floats, history: dict[str, Floats], field: Floats) -> Result:
    return Result("standalone", 1, 1, len(time), 1.0, 1.0, {"time": time, **history},
                  [Frame(len(time), float(time[-1]), {"temperature": field})])


def measured(runs: Bodies, measure: str, reference: str = "", **options: Any) -> Measured:
    check = Check("", measure, "A", "standalone", reference, 1.0, "a test", over=("seed",),
                  options=options)
    return MEASURES[measure](View(runs, check, runs.case.variants[0], runs.case.variants))


def body(kind: str) -> Floats:
    """Random places inside the body of a solution."""
    random = np.random.default_rng(1)
    if kind in ("rod", "cooling_bar", "layers"):
        return random.uniform(0, 1, (4000, 3))
    radius, angle = random.uniform(1, 2, 4000), random.uniform(0, 1, 4000)
    return np.stack([random.uniform(0, 1, 4000), radius * np.cos(angle),
                     radius * np.sin(angle)], axis=1)


@pytest.mark.parametrize("table", [ROD, COOLING, ANNULUS, WEDGE, LAYERS], ids=lambda t: t["kind"])
def test_profile_and_field_errors(tmp_path: Path, table: dict[str, Any]) -> None:
    exact, place = solution({"solution": table}), body(table["kind"])
    time = 0.05 * exact.time_scale
    field = exact.temperature(place, time)
    assert field.min() > 9.99 and field.max() < 20.01 and np.ptp(field) > 1
    # One of twenty parts is 0.3 K too warm.
    part = (exact.coordinate(place, time) * 20).astype(int)
    assert part.min() == 0 and part.max() == 19
    wrong = field + 0.3 * (part == 7)
    for values, error in ((field, 0.0), (wrong, 0.03)):
        runs = Bodies(tmp_path, {"solution": table},
                      {"one": result(np.array([0, time]), {}, values)}, place)
        assert measured(runs, "profile_error", fourier=0.05, bins=20).error == pytest.approx(
            error, abs=1e-12)
        assert measured(runs, "field_error", fourier=0.05).error == pytest.approx(
            error * np.sqrt(np.mean(part == 7)), abs=1e-12)
    with pytest.raises(CodeFailure, match="no frame"):
        measured(runs, "profile_error", fourier=0.06)


def test_dispersion_is_the_mean_of_the_relative_spread(tmp_path: Path) -> None:
    time = np.array([0.0, 1.0, 2.0])
    runs = Bodies(tmp_path, {}, {
        name: result(time, {"sensor.A.temperature": 273.15 + np.array(rise)}, np.zeros(1))
        for name, rise in {"1": [20, 100, 200], "2": [20, 90, 200], "3": [20, 95, 150]}.items()},
        np.zeros((1, 3)))
    found = measured(runs, "dispersion", column="sensor.A.temperature")
    assert found.error == pytest.approx((0 + 0.1 + 0.25) / 3)


def test_error_of_mean_against_the_exact_series(tmp_path: Path) -> None:
    time, point = np.linspace(0, PLATE["duration"], 30), [0.031, 0.0]
    exact = moving_disc_temperature(MovingDisc(**PLATE), time, np.array([point]))[:, 0]
    bump = np.where(np.arange(30) == 12, 50.0, 0.0)
    runs = Bodies(tmp_path, {"plate": PLATE}, {
        name: result(time, {"sensor.B.temperature": exact + sign * 9.0 + bump}, np.zeros(1))
        for name, sign in (("1", 1), ("2", -1))}, np.zeros((1, 3)))
    found = measured(runs, "error_of_mean", "exact series", column="sensor.B.temperature",
                     point=point)
    assert found.error == pytest.approx(50 / (exact[12] - 273.15))
    single = measured(runs, "history_error", "exact series", column="sensor.B.temperature",
                      point=point)
    assert single.error == pytest.approx(59 / (exact[12] - 273.15))


def test_heat_balance(tmp_path: Path) -> None:
    time = np.arange(4.0)
    runs = Bodies(tmp_path, {}, {"one": result(time, {
        "thermal_energy": 5 + 10 * time + np.array([0, 0, 0.3, 0]), "heat_input": 10 * time},
        np.zeros(1))}, np.zeros((1, 3)))
    assert measured(runs, "heat_balance").error == pytest.approx(0.01)


def test_calculix_is_given_the_heat_of_the_disc() -> None:
    plate = MovingDisc(**PLATE)
    mesh = Mesh((50, 30, 2), np.array([0, -0.015, 0]), np.full(3, 1e-3))
    increment = plate.duration / 40
    amplitudes, loads = source_lines(plate, mesh, increment)
    numbers = [list(map(float, block.split("\n", 1)[1].replace("\n", " ").strip(" ,").split(",")))
               for block in amplitudes.split("*AMPLITUDE, NAME=")[1:]]
    given = sum(sum(values[3::2]) for values in numbers) * increment * 1e-6
    assert given == pytest.approx(np.pi * plate.disc_radius**2 * plate.duration, rel=1e-3)
    assert loads.count("BF") == 2 * len(numbers)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
def test_calculix_on_a_coarse_mesh_comes_near_the_series(tmp_path: Path) -> None:
    options = {"plate": PLATE, "points": {"C": [0.042, -0.009], "D": [0.01, 0.005]},
               "calculix": {"cells": [25, 15, 2], "increments": 60}}
    specimen = Specimen(tmp_path, np.zeros((1, 3)), np.ones(1), np.zeros((0, 2), dtype=np.int64))
    job = Job(*[tmp_path] * 3, specimen, None, 1, 1, 200.0, options)  # type: ignore[arg-type]
    found = Calculix().run(job, tmp_path / "run")
    exact = moving_disc_temperature(MovingDisc(**PLATE), found.history["time"],
                                    np.array(list(options["points"].values())))
    for n, name in enumerate(options["points"]):
        error = np.abs(found.history[f"sensor.{name}.temperature"] - exact[:, n])
        assert error.max() < 0.02 * exact[:, n].max()


def test_calculix_refuses_a_point_between_nodes() -> None:
    mesh = Mesh((50, 30, 2), np.array([0, -0.015, 0]), np.full(3, 1e-3))
    assert mesh.nearest_node(np.array([0.0, -0.015, 0.0])) == 1
    with pytest.raises(CodeFailure, match="node"):
        mesh.nearest_node(np.array([0.0415, -0.0095, 0.001]))


def test_an_unknown_solution_is_refused() -> None:
    with pytest.raises(CodeFailure, match="kind"):
        solution({})
    broken = dict(ROD)
    del broken["hot"]
    with pytest.raises(CodeFailure, match="hot"):
        solution({"solution": broken})
    assert dataclasses.is_dataclass(solution({"solution": ROD}))
