# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat from work, work from heat, scripted in YADE: a bar against solidem."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from prepared_bar import run_yade

from compare.codes.base import ROOT
from compare.result import CodeFailure, read_result

PROGRAM = ROOT / "build" / "release" / "solidem"
INITIAL, STEPS = 310.0, 150

BAR = f"""\
[specimen]
shape = "box"
size = ["3 mm", "1.5 mm", "1.5 mm"]
elements = 60
seed = 3
[material]
density = "2790 kg/m^3"
conductivity = "134 kW/(m K)"
specific_heat_capacity = "880 J/(kg K)"
expansion_coefficient = {{ temperature = ["290 K", "400 K"], value = ["2.2e-5 1/K", "2.6e-5 1/K"] }}
[beams]
young_modulus = "3.6 TPa"
poisson_ratio = 0.3
radius_ratio = 0.25
[plasticity]
yield_strain = 0.001
hardening_ratio = 0.05
[conduction]
law = "platonic"
initial_temperature = "{INITIAL} K"
[plastic_heat]
fraction = 0.9
[expansion]
reference_temperature = "309 K"
[softening]
modulus_ratio = {{ temperature = ["296 K", "700 K"], value = [1, 0.6] }}
[[temperatures]]
name = "cold"
region = {{ axis = "x", side = "low", depth = "0.3 mm" }}
value = "307 K"
[[grips]]
name = "left"
region = {{ axis = "x", side = "low", depth = "0.3 mm" }}
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = {{ axis = "x", side = "high", depth = "0.3 mm" }}
velocity = ["20 m/s", "0 m/s", "0 m/s"]
[run]
steps = {STEPS}
time_step = "12 ns"
observe_every = 10
[output]
frames = 1
"""


def prepare(folder: Path, scene: str) -> dict:
    """Prepares a scene; what solidem explains of it."""
    (folder / "scene.toml").write_text(scene)
    for words in (("prepare", "scene.toml", "--output", "prepared.h5"),
                  ("explain", "scene.toml", "--json", "--quick")):
        done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    return dict(json.loads(done.stdout))


def test_a_bar_that_flows_expands_softens_and_conducts_is_that_of_solidem(tmp_path: Path) -> None:
    """The law is written a second time. Work of flow is that of one end's view here, of both there."""
    explained = prepare(tmp_path, BAR)
    yade = run_yade(tmp_path / "prepared.h5", explained, tmp_path, "--observe-every", "10",
                    "--frame-every", str(STEPS))
    subprocess.run([PROGRAM, "run", "scene.toml", "--output", "own"], cwd=tmp_path, check=True,
                   capture_output=True)
    own = read_result("standalone", tmp_path / "own")

    def difference(name: str) -> float:
        a, b = (dict(zip(result.history["step"], result.history[name])) for result in (yade, own))
        steps = sorted(a.keys() & b.keys())
        assert steps[-1] == STEPS
        return float(max(abs(a[n] - b[n]) for n in steps) / max(abs(b[n]) for n in steps))

    assert own.history["plastic_work"][-1] > 1e-3
    assert difference("grip.right.force_x") < 1e-9
    assert difference("temperature.cold.heat") < 1e-8
    assert difference("plastic_work") < 1e-7 and difference("waiting_heat") < 1e-6
    frames = yade.frames[-1].columns, own.frames[-1].columns
    rise = np.abs(frames[1]["temperature"] - INITIAL).max()
    assert np.abs(frames[0]["temperature"] - frames[1]["temperature"]).max() < 1e-7 * rise


def test_bonds_that_break_are_told(tmp_path: Path) -> None:
    explained = prepare(tmp_path, BAR.replace("seed = 3\n", "seed = 3\n[rupture]\nstrain = 0.1\n"))
    with pytest.raises(CodeFailure):
        run_yade(tmp_path / "prepared.h5", explained, tmp_path)
    words = "bonds that break cannot conduct heat"
    assert words in (tmp_path / "output.log").read_text()
