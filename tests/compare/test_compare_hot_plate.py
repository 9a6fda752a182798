# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate with a hot spot: what CalculiX is given and answers, and bodies of elements against it."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from compare.case import Case, Variant, read_case
from compare.codes.base import ROOT, Job
from compare.codes.calculix import Calculix
from compare.codes.calculix_hot_plate import QuadraticMesh, hot_plate
from compare.codes.standalone import Standalone
from compare.codes.statics import Statics
from compare.evaluate import run_case
from compare.result import CodeFailure, Floats
from compare.runs import Specimens
from compare.stress_measures import mean_over_patches
from contrib.prepared import Specimen

CASE = ROOT / "compare" / "cases" / "hot_plate.toml"
ELASTIC = 70e9 * 23e-6  #: of the case's plate, Pa/K
needs_calculix = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")


def solved(folder: Path, cells: list[int], **changes: Any) -> Floats:
    """(X, Y, Z, 6) stresses of bricks of the case's plate with changes, Pa."""
    options = read_case(CASE).options
    options = {"hot_plate": {**options["hot_plate"], **changes}, "calculix": {"cells": cells}}
    specimen = Specimen(folder, np.zeros((1, 3)), np.ones(1), np.zeros((0, 2), dtype=np.int64))
    job = Job(*[folder] * 3, specimen, None, 1, 1, 200.0, options)  # type: ignore[arg-type]
    frame = Calculix().run(job, folder / "run").frames[-1]
    stress = frame.columns["stress"].reshape(*cells[::-1], 6)
    return np.asarray(stress.transpose(2, 1, 0, 3))


def test_a_mesh_has_no_node_twice_and_every_node_in_its_place() -> None:
    mesh = QuadraticMesh((2, 1, 1), np.array([1.0, 2.0, 3.0]))
    lines = mesh.lines().splitlines()
    start = lines.index("*ELEMENT, TYPE=C3D20R, ELSET=PLATE")
    nodes = {int(n): np.array(xyz, dtype=float) for n, *xyz in
             (line.split(",") for line in lines[1:start])}
    assert len(nodes) == 20 + 12
    first = [int(n) for line in lines[start + 1:start + 3] for n in line.split(",") if n.strip()][1:]
    assert nodes[first[6]] == pytest.approx([1, 2, 3])
    for middle, (a, b) in {8: (0, 1), 9: (1, 2), 11: (3, 0), 14: (6, 7), 18: (2, 6)}.items():
        assert nodes[first[middle]] == pytest.approx((nodes[first[a]] + nodes[first[b]]) / 2)


@needs_calculix
def test_a_plate_of_one_temperature_bears_nothing(tmp_path: Path) -> None:
    stress = solved(tmp_path, [6, 5, 2], disc_radius=1.0, conductivity=2e6)
    rise = 1e9 * 0.002 / (2 * 2200)
    assert np.abs(stress).max() < 1e-5 * ELASTIC * rise


@needs_calculix
def test_what_presses_at_the_spot_pulls_beside_it(tmp_path: Path) -> None:
    """Through any section of a free plate no force goes; stress goes with heat, and is plane."""
    stress = solved(tmp_path / "one", [20, 16, 1])
    largest = np.abs(stress).max()
    assert np.abs(stress[..., 0].sum(axis=(1, 2))).max() < 0.01 * largest * 16
    assert np.abs(stress[..., 1].sum(axis=(0, 2))).max() < 0.01 * largest * 20
    assert stress[8, 7, 0, 0] < -0.9 * largest
    assert np.abs(stress[..., [2, 4, 5]]).max() < 0.02 * largest
    twice = solved(tmp_path / "twice", [20, 16, 1], power_density=2e9, poisson_ratio=0.35)
    assert np.abs(twice - 2 * stress)[..., [0, 1, 3]].max() < 0.02 * largest


def test_what_is_left_out_is_told() -> None:
    with pytest.raises(CodeFailure, match=r"\[options.hot_plate\]"):
        hot_plate({"hot_plate": {"size": [1, 1, 1]}, "calculix": {"cells": [1, 1, 1]}})


def test_means_over_patches_count_by_weight_and_leave_none_empty() -> None:
    place = np.array([[0.1, 0.1], [0.9, 0.9], [1.5, 0.5], [2.0, 1.0]])
    means, fewest = mean_over_patches(place, np.array([1.0, 3, 1, 1]),
                                      np.array([[0.0], [4], [5], [7]]), np.ones(2), (2, 1))
    assert means[:, 0, 0] == pytest.approx([3, 6]) and fewest == 2
    with pytest.raises(CodeFailure, match="no element"):
        mean_over_patches(place, np.ones(4), np.ones((4, 1)), np.ones(2), (2, 2))


def small(case: Case, elements: int) -> Case:
    """The case with one body of few elements, and a coarse mesh."""
    def fewer(variant: Variant) -> Variant:
        words = {old: new.replace("2500", str(elements)) for old, new in variant.replace.items()}
        return replace(variant, replace=words)
    variants = tuple(fewer(v) for v in case.variants
                     if v.name == "finite elements" or "t=0.4, 2500 elements, seed 1" in v.name)
    checks = tuple(c for c in case.checks if c.variants == ("t=0.4, 2500 elements, seed 1",))
    assert len(variants) == 4 and len(checks) == 2
    return replace(case, variants=variants, checks=checks,
                   options={**case.options, "calculix": {"cells": [20, 16, 1]}})


@needs_calculix
def test_few_elements_come_near_finite_elements(tmp_path: Path) -> None:
    """The case as it stands, of 1200 elements: held by what it asks of 2500, and half as much again."""
    codes = {code.name: code for code in (Standalone(), Statics(), Calculix())}
    rows, _ = run_case(small(read_case(CASE), 1200), codes, tmp_path / "runs",
                       Specimens(tmp_path / "specimens"), lambda _: None)
    for row in rows:
        assert row.error is not None, row.note
        assert 0 < row.error < 1.5 * row.tolerance, row.note
