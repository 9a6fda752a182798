# SPDX-License-Identifier: GPL-2.0-or-later
"""What the YADE scripts cannot do, they say; they never leave a result that looks whole."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from prepared_bar import Bar, beam_task, heat_task, loaded_task, run_yade

from compare.result import CodeFailure
from contrib.explained import parse_parameters
from contrib.prepared import PreparedError, read_specimen


def refuses(bar: Path, task: dict[str, Any], directory: Path, words: str) -> None:
    with pytest.raises(CodeFailure):
        run_yade(bar, task, directory)
    assert words in (directory / "output.log").read_text()
    assert not (directory / "results" / "summary.json").exists()


def test_missing_column(bar: Bar, tmp_path: Path) -> None:
    copy = tmp_path / "prepared.h5"
    shutil.copy(bar.path, copy)
    with h5py.File(copy, "a") as file:
        del file["mechanics/mass"]
    refuses(copy, beam_task(bar, 1.0, 10), tmp_path / "run", "/mechanics/mass is missing")


def test_periodic_body(bar: Bar, tmp_path: Path) -> None:
    copy = tmp_path / "prepared.h5"
    shutil.copy(bar.path, copy)
    with h5py.File(copy, "a") as file:
        file.create_group("domain").attrs["periodic"] = [1, 0, 0]
    refuses(copy, heat_task(bar, 10), tmp_path / "run", "periodic")


def test_nothing_to_simulate(bar: Bar, tmp_path: Path) -> None:
    refuses(bar.path, {**heat_task(bar, 10), "laws": {}}, tmp_path, "neither beams nor conduction")


@pytest.mark.parametrize("change, words", [
    ({"exchanges": [{"name": "left", "temperature": None}]}, "exchange left: varies with time"),
    ({"powers": [{"name": "laser", "constant": False}]}, "heat source laser: varies"),
    ({"temperatures": [{"name": "hot", "value": {"time": [0, 1], "value": [298, 798]}}]},
     "temperature hot: "),
    ({"laws": {"conduction": {"conductivity": 134.0, "initial_temperature": 298.0,
                              "integrator": "rkl2"}}}, "integrator 'rkl2'; only 'explicit'"),
    ({"laws": {"conduction": {"conductivity": None, "initial_temperature": 298.0}}},
     "conductivity is None; only one number"),
])
def test_heat_that_is_not_understood(bar: Bar, tmp_path: Path, change: dict[str, Any],
                                     words: str) -> None:
    refuses(bar.path, {**heat_task(bar, 10), **change}, tmp_path, words)


def test_faces_are_not_for_the_native_engine(bar: Bar, tmp_path: Path) -> None:
    with pytest.raises(CodeFailure):
        run_yade(bar.path, loaded_task(bar, 10, "voronoi"), tmp_path, "--law", "native")
    assert "law voronoi needs --law scripted" in (tmp_path / "output.log").read_text()


@pytest.mark.parametrize("axis, words", [
    ({"kind": "force", "function": {"value": [1.0]}}, "expected free"),
    ({"kind": "velocity", "function": {"time": [0, 1], "value": [0, 1]}}, "varies with time"),
    ({"kind": "velocity", "function": {"value": [0.0], "amplitude": 2.0}}, "varies with time"),
    ({"kind": "displacement", "function": {"value": [1.0]}}, "impose a velocity"),
])
def test_motions_that_are_not_steady(bar: Bar, axis: dict[str, Any], words: str) -> None:
    task = beam_task(bar, 1.0, 10)
    task["grips"][1]["axes"][0] = axis
    with pytest.raises(PreparedError, match=words):
        parse_parameters(task).require_support()


@pytest.mark.parametrize("section, laws, words", [
    ("centrifugal_load", {}, r"\[centrifugal_load\] is not understood"),
    ("friction_heat", {"friction_heat": {"fraction": 1.0, "damping_fraction": 0.5}},
     r"\[friction_heat\] damping_fraction: heat of dashpots is not understood"),
    ("contact_conduction", {"contact_conduction": {"conductance": 1.0}, "contact": {"friction": 0.1}},
     r"\[contact_conduction\] beside \[contact\]"),
    ("conduction", {"conduction": {"conductivity": 1.0, "initial_temperature": 300.0,
                                   "largest_change": 1.0}}, "largest_change: heat that chooses"),
    ("damping", {"damping": {"viscous": 100.0}}, "viscous damping is not understood"),
])
def test_effects_of_which_no_other_code_is_told(bar: Bar, section: str, laws: dict[str, Any],
                                                words: str) -> None:
    task = beam_task(bar, 1.0, 10)
    task["effects"] = [{"name": "beams", "reason": "[beams]"}, {"name": "x", "reason": f"[{section}]"}]
    task["laws"] |= laws
    with pytest.raises(PreparedError, match=words):
        parse_parameters(task).require_support()


def test_heat_of_friction_and_heat_that_waits(bar: Bar, tmp_path: Path) -> None:
    task = beam_task(bar, 1.0, 10)
    task["laws"] |= {"friction_heat": {"fraction": 1.0}}
    refuses(bar.path, task, tmp_path / "friction", "[friction_heat] is not supported in YADE")
    task = beam_task(bar, 1.0, 10)
    task["laws"] |= {"contact_conduction": {"conductance": 1.0}}
    refuses(bar.path, task, tmp_path / "touch", "[contact_conduction] is not supported in YADE")
    task = heat_task(bar, 10)
    task["laws"]["conduction"]["every"] = 5
    refuses(bar.path, task, tmp_path / "clock", "waits for several steps of the motion is not supported")


def test_damping_of_bonds(bar: Bar, tmp_path: Path) -> None:
    task = beam_task(bar, 1.0, 10)
    task["laws"] |= {"damping": {"viscous": None, "local": None, "bonds": 0.1}}
    refuses(bar.path, task, tmp_path, "[damping] bonds is not supported in YADE")


def test_bodies_that_move_from_the_start(bar: Bar, tmp_path: Path) -> None:
    task = {**beam_task(bar, 1.0, 10), "initial_velocities": 1}
    refuses(bar.path, task, tmp_path, "initial velocities")


@pytest.mark.parametrize("laws, words", [
    ({"plasticity": {"law": "radial-return", "yield_strain": 1e-3, "hardening_ratio": 0.0}},
     "need --law scripted"),
    ({"rupture": {"elastic_strain": None, "strain": 0.2, "minimal_bonds": 0}},
     "need --law scripted"),
])
def test_the_native_law_neither_flows_nor_breaks(bar: Bar, tmp_path: Path, laws: dict[str, Any],
                                                 words: str) -> None:
    task = beam_task(bar, 1.0, 10)
    task["laws"] |= laws
    with pytest.raises(CodeFailure):
        run_yade(bar.path, task, tmp_path, "--law", "native")
    assert words in (tmp_path / "output.log").read_text()


@pytest.mark.parametrize("laws, words", [
    ({"rupture": {"elastic_strain": None, "strain": 0.2, "minimal_bonds": 3}}, "minimal_bonds"),
    ({"rupture": {"elastic_strain": None, "strain": 0.2, "minimal_bonds": 0},
      "contact": {"stiffness_ratio": 1.0, "rebonding_pressure": None}}, "[contact]"),
    ({"plasticity": {"law": "radial-return", "hardening": "voce", "yield_strain": 1e-3,
                     "saturation_strain": 1e-3, "plastic_scale": 0.01}}, "hardening \"voce\""),
    ({"rupture": {"law": "mohr-coulomb", "tensile_strain": 1e-3, "cohesion_strain": 1e-3,
                  "friction_coefficient": 0.5, "minimal_bonds": 0}}, "law \"mohr-coulomb\""),
])
def test_what_scripted_beams_leave_out(bar: Bar, tmp_path: Path, laws: dict[str, Any],
                                       words: str) -> None:
    task = beam_task(bar, 1.0, 10)
    task["laws"] |= laws
    refuses(bar.path, task, tmp_path, words)


def test_beams_that_differ_from_bond_to_bond(bar: Bar, tmp_path: Path) -> None:
    copy = tmp_path / "prepared.h5"
    shutil.copy(bar.path, copy)
    with h5py.File(copy, "a") as file:
        file["mechanics/rigidity"] = np.ones((len(bar.specimen.pairs), 4))
    refuses(copy, beam_task(bar, 1.0, 10), tmp_path / "run", "/mechanics/rigidity differs")


@pytest.mark.parametrize("name", ["anisotropy", "fibres"])
def test_beams_that_differ_with_direction(bar: Bar, tmp_path: Path, name: str) -> None:
    task = beam_task(bar, 1.0, 10)
    task["laws"]["beams"] = {**task["laws"]["beams"], name: {"power": 4}}
    refuses(bar.path, task, tmp_path, name)


def test_file_that_is_no_specimen(tmp_path: Path) -> None:
    path = tmp_path / "noise.h5"
    path.write_text("not HDF5")
    with pytest.raises(PreparedError, match="noise.h5"):
        read_specimen(path)
