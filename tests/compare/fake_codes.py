# SPDX-License-Identifier: GPL-2.0-or-later
"""A small body prepared by hand, and codes that lie, crash or are not there."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import h5py
import numpy as np
import pytest

from compare.codes.base import Job, TwoSpheres
from compare.codes.standalone import Standalone
from compare.result import CodeFailure, Floats, Frame, Result
from contrib.prepared import Parameters

SCENE = """\
title = "a rod"
[specimen]
shape = "box"
[run]
steps = 20
observe_every = 5
[output]
frames = 4
"""

EXPLAINED = {
    "time_step": {"value": 1e-3}, "steps": 20, "density": 1.0,
    "laws": {"conduction": {"conductivity": 1.0, "initial_temperature": 0.0,
                            "specific_heat_capacity": 1.0}},
    "temperatures": [{"name": "hot", "value": {"time": [0.0], "value": [1.0]}}],
}


def honest_result(name: str) -> Result:
    """A result that is whole: some field that grows with time."""
    frames = [Frame(step, step * 1e-3, {"temperature": np.linspace(0, step, 10)})
              for step in (0, 5, 10, 15, 20)]
    steps = np.array([0.0, 5, 10, 15, 20])
    return Result(name, 10, 9, 20, 1e-3, 0.5, {"step": steps, "time": steps * 1e-3,
                                               "thermal_energy": steps**2}, frames)


@dataclass
class FakeCode:
    """A code whose run is a function."""

    name: str
    action: Callable[[Job, Path], Result]
    reason: str | None = None
    shared: bool = False

    def missing(self) -> str | None:
        return self.reason

    def version(self) -> str:
        return "7.5"

    def shares_laws(self, parameters: Parameters | None) -> bool:
        return self.shared

    def run(self, job: Job, directory: Path) -> Result:
        return self.action(job, directory)

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        raise CodeFailure("no beams here")


class FakeStandalone(Standalone):
    """Prepares a rod of ten elements without the program and runs honestly."""

    def missing(self) -> str | None:
        return None

    def version(self) -> str:
        return "1.2.3"

    def call(self, words: list[str | Path], directory: Path, timeout: float) -> Path:
        directory.mkdir(parents=True, exist_ok=True)
        printed = directory / "output.log"
        printed.write_text(json.dumps(EXPLAINED))
        if words[0] in ("specimen", "prepare"):
            with h5py.File(words[words.index("--output") + 1], "w") as file:
                file["elements/position"] = np.arange(30.0).reshape(10, 3)
                file["elements/radius"] = np.ones(10)
                file["bonds/pairs"] = np.stack([np.arange(9), np.arange(1, 10)], 1)
                file["sets/temperature.hot"] = np.array([0])
        return printed

    def run(self, job: Job, directory: Path) -> Result:
        return honest_result(self.name)


@pytest.fixture
def case_directory(tmp_path: Path) -> Path:
    """A directory with one case: the code `other` against the standalone program."""
    directory = tmp_path / "cases"
    directory.mkdir()
    (directory / "rod.scene").write_text(SCENE)
    (directory / "rod.toml").write_text("""\
title = "A rod"
scene = "rod.scene"
timeout = 20
[[variant]]
name = "plain"
codes = ["standalone", "other"]
[[check]]
quantity = "temperature"
measure = "field_difference"
class = "C"
code = "other"
reference = "standalone"
tolerance = 1e-9
reason = "Same law, same order of steps."
options = { field = "temperature", scale = 20.0 }
""")
    return directory
