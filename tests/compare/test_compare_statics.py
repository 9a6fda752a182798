# SPDX-License-Identifier: GPL-2.0-or-later
"""What the static solver wrote is read as it stands, or not at all; chains are held to theory."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest

from compare.codes.base import Job
from compare.codes.standalone import Standalone
from compare.codes.statics import Statics
import compare.slender_beams  # noqa: F401  (makes its measures known)
from compare.measures import MEASURES
from compare.references import cantilever_frequencies
from compare.result import CodeFailure, Result
from contrib.prepared import Beams, Parameters, Plasticity, Specimen

COUNT, RADIUS, YOUNG, MASS = 40, 1e-3, 70e9, 2e-5


class Solver(Standalone):
    """Writes what `solidem solve` would, or less."""

    whole = True

    def missing(self) -> str | None:
        return None

    def call(self, words: list[str | Path], directory: Path, timeout: float) -> Path:
        results = Path(words[words.index("--output") + 1])
        results.mkdir(parents=True)
        assert words[words.index("--modes") + 1] == "4"
        summary: dict[str, Any] = {
            "elements": 2, "bonds": 1, "frequencies": [3.0, 4.0], "wall_seconds": {"modes": 0.5},
            "sensors": {"tip": {"displacement": [0.0, 1e-3, 0.0]}},
            "grips": {"wall": {"force": [1.0, 2.0, 3.0], "displacement": [0.0, 0.0, 0.0]}}}
        if not self.whole:
            del summary["elements"]
        (results / "summary.json").write_text(json.dumps(summary))
        with h5py.File(results / "trajectory.h5", "w") as file:
            group = file.create_group("frames/000000")
            group.attrs["step"], group.attrs["time"] = 7, 0.1
            group["position"] = np.zeros((2, 3))
        return results


def job(tmp_path: Path) -> Job:
    parameters = Parameters(1e-9, 7, None, None, (), {})
    specimen = Specimen(tmp_path, np.zeros((2, 3)), np.ones(2), np.array([[0, 1]]))
    return Job(tmp_path, tmp_path, tmp_path, specimen, parameters, 1, 1, 10.0, {"modes": 4})


def test_rest_and_vibrations_are_read(tmp_path: Path) -> None:
    found = Statics(standalone=Solver()).run(job(tmp_path), tmp_path / "run").check()
    assert found.history["sensor.tip.displacement_y"] == pytest.approx([1e-3])
    assert found.history["grip.wall.force_z"] == pytest.approx([3.0])
    assert found.history["frequency"] == pytest.approx([3.0, 4.0])


def test_half_a_summary_is_no_result(tmp_path: Path) -> None:
    solver = Solver()
    solver.whole = False
    with pytest.raises(CodeFailure, match="no usable result"):
        Statics(standalone=solver).run(job(tmp_path), tmp_path / "run")


def chain_view(history: dict[str, np.ndarray], options: dict[str, Any],
               plasticity: Plasticity | None = None, bent: float = 0.0) -> Any:
    position = np.zeros((COUNT, 3))
    position[:, 0] = 2 * RADIUS * np.arange(COUNT)
    position[-1, 1] = bent
    pairs = np.stack([np.arange(COUNT - 1), np.arange(1, COUNT)], axis=1)
    specimen = Specimen(Path("chain"), position, np.full(COUNT, RADIUS), pairs,
                        columns={"mechanics/mass": np.full(COUNT, MASS)})
    parameters = Parameters(1e-9, 100, Beams(YOUNG, 27e9, 1.0, "mean", RADIUS), None, (), {},
                            plasticity=plasticity)
    result = Result("statics", COUNT, COUNT - 1, 100, 1e-9, 0.1, history, [])
    return SimpleNamespace(
        tested=result, job=SimpleNamespace(specimen=specimen, parameters=parameters),
        check=SimpleNamespace(options=options, code="statics"), option=options.__getitem__)


LENGTH, STIFFNESS = 2 * RADIUS * (COUNT - 1), YOUNG * np.pi * RADIUS**4 / 4


def test_frequencies_come_in_pairs() -> None:
    exact = cantilever_frequencies(2, LENGTH, STIFFNESS, MASS / (2 * RADIUS), MASS / 2)
    twice = np.repeat(exact, 2)
    assert MEASURES["natural_frequency"](
        chain_view({"frequency": twice}, {"mode": 2})).error < 1e-12
    off = twice * np.array([1, 1, 1, 1.01])
    assert MEASURES["natural_frequency"](
        chain_view({"frequency": off}, {"mode": 2})).error == pytest.approx(0.01)
    with pytest.raises(CodeFailure, match="6 frequencies"):
        MEASURES["natural_frequency"](chain_view({"frequency": twice}, {"mode": 3}))


def test_a_bent_chain_is_no_beam() -> None:
    with pytest.raises(CodeFailure, match="straight"):
        MEASURES["tip_deflection_error"](
            chain_view({"y": np.ones(1)}, {"column": "y", "force": 1.0}, bent=1e-4))


def test_deflection_of_the_tip() -> None:
    right = 2.0 * LENGTH**3 / (3 * STIFFNESS)
    view = chain_view({"y": np.array([1.002 * right])}, {"column": "y", "force": 2.0})
    assert MEASURES["tip_deflection_error"](view).error == pytest.approx(0.002)


def test_collapse_needs_a_steady_load_and_a_law_that_flows() -> None:
    flow = Plasticity("radial-return", 1e-4)
    load = 4 * 1e-4 * STIFFNESS / RADIUS / LENGTH
    force = load * np.minimum(np.linspace(0, 4, 100), 1.02)
    options = {"column": "f", "against": "u"}
    history = {"f": force, "u": np.linspace(0, 1e-3, 100), "time": np.linspace(0, 1, 100)}
    collapse = MEASURES["collapse_force"]
    assert collapse(chain_view(history, options, flow)).error == pytest.approx(0.02)
    with pytest.raises(CodeFailure, match="nothing yields"):
        collapse(chain_view(history, options))
    history["f"] = load * np.linspace(0, 4, 100)
    with pytest.raises(CodeFailure, match="still varies"):
        collapse(chain_view(history, options, flow))
