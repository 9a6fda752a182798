# SPDX-License-Identifier: GPL-2.0-or-later
"""Advice: what it promises of figures that are known, small scenes of each kind, and what it refuses."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = os.environ.get("SOLIDEM_PYTHON", str(ROOT / "build" / "release" / "python"))
PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))
sys.path.insert(0, PACKAGES)
from solidem import InputError, Scene  # noqa: E402
from solidem.advise import advise, main, share  # noqa: E402
from solidem.foretold import Cost, ErrorModel, exponent_of  # noqa: E402
from solidem.level import Level  # noqa: E402
from solidem.proposal import scene_text  # noqa: E402
from solidem.refinement import refinement_of  # noqa: E402
from solidem.scene_edit import edited  # noqa: E402
from solidem.series import Series  # noqa: E402
from solidem.studies import Study, kind_of, study_of, table  # noqa: E402

BODY = """
title = "A bar"
[specimen]
shape = "box"
size = ["2 mm", "1 mm", "1 mm"]
elements = 120   # few
[material]
density = "2790 kg/m^3"
conductivity = "134 W/(m K)"
specific_heat_capacity = "880 J/(kg K)"
expansion_coefficient = "23e-6 1/K"
"""
BEAMS = """
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
[[grips]]
name = "left"
region = { axis = "x", side = "low", depth = "0.4 mm" }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
"""
PULL = """
[[grips]]
name = "right"
region = { axis = "x", side = "high", depth = "0.4 mm" }
velocity = ["10 m/s", "0 m/s", "0 m/s"]
"""
HEAT = """
[conduction]
initial_temperature = "300 K"
[[temperatures]]
name = "hot"
region = { axis = "x", side = "low", layers = 1 }
value = "400 K"
[[sensors]]
name = "middle"
point = ["1 mm", "0.5 mm", "0.5 mm"]
quantity = "temperature"
"""
MIDDLE = """
[[sensors]]
name = "middle"
point = ["1 mm", "0.5 mm", "0.5 mm"]
quantity = "displacement"
"""
SCENES = {
    "heat": (BODY + HEAT + '[run]\nduration = "5 ms"\n', "sensor.middle.temperature"),
    "elastic": (BODY + BEAMS + PULL + MIDDLE + '[run]\nduration = "0.8 us"\n',
                "sensor.middle.displacement_x"),
    "plastic": (BODY + BEAMS + PULL + MIDDLE + "[plasticity]\nyield_strain = 0.0005\n"
                'hardening_ratio = 0.01\n[run]\nduration = "0.8 us"\n', "sensor.middle.displacement_x"),
    "coupled": (BODY + BEAMS + HEAT.replace("sensors", "sensors") + "[expansion]\n"
                '[run]\nduration = "0.8 us"\n', "thermal_energy"),
    "contact": (BODY + """
[contact]
young_modulus = "1 GPa"
friction = 0.3
[beams]
young_modulus = "350 GPa"
poisson_ratio = 0.3
radius_ratio = 0.27
[[tools]]
name = "floor"
shape = "plane"
normal = [0, 0, 1]
[gravity]
acceleration = ["50000 m/s^2", "0 m/s^2", "-100000 m/s^2"]
""" + MIDDLE + '[run]\nduration = "4 us"\n', "sensor.middle.displacement_x"),
}


def levels(limit: float, constant: float, order: float, scatter: float, packings: int,
           seed: int, elements: tuple[float, ...] = (300, 750, 1900)) -> list[Level]:
    """Figures of bodies, of which the coarsest err by `constant`."""
    noise = np.random.default_rng(seed)
    found = []
    for count in elements:
        size = (count / elements[0])**(-1 / 3)
        found.append(Level(count, size, limit + constant * size**order
                           + scatter * size**1.5 * noise.standard_normal(packings), 1.0))
    return found


def test_a_promise_holds_as_often_as_said() -> None:
    """A run of as many elements as are proposed and of another packing, where orders are as spread as
    they are believed to be."""
    draw = np.random.default_rng(7)
    study = Study("elastic", "", 1.2, 0.2, 0, 4 / 3, "a study")
    kept = made = 0
    for seed in range(400):
        order = draw.normal(1.2, 0.2)
        model = ErrorModel(levels(10, 1.5, order, 0.15, 3, seed), 10, study)
        elements = model.elements_for(0.05, 1e7)
        if elements is None:
            continue
        size = (elements / 300)**(-1 / 3)
        made += 1
        kept += abs(1.5 * size**order + 0.15 * size**1.5 * draw.standard_normal()) <= 0.5
    assert made >= 320
    assert kept >= 0.94 * made


def test_a_study_narrows_what_these_runs_do_not_tell() -> None:
    few = levels(10, 1.5, 1.0, 0.05, 3, 1, (300, 750))
    with_study = ErrorModel(few, 10, Study("elastic", "", 1.0, 0.2, 0, 4 / 3, "a study"))
    without = ErrorModel(few, 10, None)
    assert with_study.limit[2] - with_study.limit[1] < without.limit[2] - without.limit[1]
    assert np.ptp(with_study.order) < 0.6 * np.ptp(without.order)


def test_fineness_and_packings_are_told_apart() -> None:
    """The mean of many packings errs as bodies of this fineness do."""
    model = ErrorModel(levels(10, 0.0, 1.0, 1.0, 20, 1), 10, None)
    assert model.scatter(300) == pytest.approx(0.1, rel=0.2)
    assert model.errors(300, 4).scatter == pytest.approx(model.errors(300).scatter / 2)
    assert model.errors(300, 4).bias == model.errors(300).bias


def test_costs_grow_as_their_parts() -> None:
    cost = Cost(2.0, 3.0, 4.0, 1.0).times(8, 4 / 3)
    assert (cost.linear, cost.rest) == (16.0, 1.0)
    assert cost.steps == pytest.approx(48) and cost.processor == pytest.approx(4 * 64 / 5)
    assert exponent_of((1, Cost(0, 1, 1)), (8, Cost(0, 16, 16)), None) == pytest.approx(4 / 3)
    assert exponent_of((1, Cost(0, 1, 1)), (8, Cost(0, 1, 1)), None) == 1


def test_the_words_of_a_scene_stay() -> None:
    text = edited(BODY + HEAT, {"specimen.elements": 500, "temperatures.hot.region": None,
                                "temperatures.hot.wall": "x_low", "run.duration": "1 ms",
                                "conduction.law": "voronoi"})
    read = tomllib.loads(text)
    assert read["specimen"]["elements"] == 500 and "elements = 500   # few" in text
    assert read["temperatures"] == [{"name": "hot", "value": "400 K", "wall": "x_low"}]
    assert read["run"] == {"duration": "1 ms"} and read["conduction"]["law"] == "voronoi"
    assert read["sensors"] == tomllib.loads(BODY + HEAT)["sensors"]


def test_bodies_get_finer_together() -> None:
    bodies = {"body": [{"name": "plate", "shape": "plate", "elements": 900},
                       {"name": "ball", "shape": "sphere", "mean_radius": "0.08 mm", "seed": 2},
                       {"name": "bullet", "shape": "sphere", "elements": 1}]}
    made = refinement_of(bodies)
    assert made.changes(8) == {"body.plate.elements": 7200, "body.ball.mean_radius": "0.04 mm"}
    assert made.changes(1, 2)["body.ball.seed"] == 202
    assert "body.ball.seed" not in made.changes(1, 0)
    seeds = {made.changes(factor, packing)["body.ball.seed"] for factor in (1, 2.5, 6.25)
             for packing in range(1, 4)}
    assert len(seeds) == 9
    with pytest.raises(InputError, match="body.grain.*stay coarse while other bodies get finer"):
        refinement_of({"body": [*bodies["body"], {"name": "grain", "file": "grain.csv"}]})
    assert "another material" in refinement_of({**bodies, "central_forces": {}}).why_not
    lattice = refinement_of({"specimen": {"shape": "crystal"}})
    assert not lattice.bodies and "a lattice" in lattice.why_not


def test_the_table_of_studies_is_right() -> None:
    assert all(0 < row.order < 4 and row.spread > 0 and row.studies for row in table())
    assert study_of("heat", "voronoi") is not None
    assert study_of("nothing") is None


@pytest.mark.parametrize("kind", SCENES)
def test_each_kind_of_scene_gets_advice(kind: str, tmp_path: Path) -> None:
    """A scene that can be read, whose error and time are told."""
    text, of = SCENES[kind]
    scene = Scene(text, folder=tmp_path, name=kind)
    assert kind_of(scene.tables) == kind
    found = advise(scene, 0.2, of=of, seconds=1, folder=tmp_path / "pilots")
    best = found.proposal or found.least
    assert best is not None and len(found.levels) >= 3
    assert best.cost.seconds > 0 and best.errors.promised >= best.errors.expected >= 0
    if found.proposal:
        assert found.proposal.errors.promised <= 0.2
    read = Scene(scene_text(found, best), folder=tmp_path, name="proposed")
    assert read.tables["specimen"]["elements"] == pytest.approx(best.elements, rel=0.02)
    if kind == "heat":
        assert found.choices.changes["conduction.law"] == "voronoi"
        assert read.tables["temperatures"][0]["wall"] == "x_low"


def test_a_lattice_stays_and_its_steps_are_chosen(tmp_path: Path, hot: dict) -> None:
    hot["sensors"] = [{"name": "end", "point": ["1.1 mm", "0.3 mm", "0.3 mm"],
                       "quantity": "temperature"}]
    found = advise(Scene(hot, folder=tmp_path), 0.01, folder=tmp_path / "pilots")
    assert found.model is None and "a lattice" in found.why_not_finer
    assert found.proposal is not None
    assert found.proposal.changes["run.steps"] is None  # a duration in its place


def test_the_command_writes_runs_and_judges(tmp_path: Path) -> None:
    scene = tmp_path / "heat.toml"
    scene.write_text(SCENES["heat"][0])
    words = ["advise", str(scene), "--error", "2 %", "--pilot-seconds", "1", "--output",
             str(tmp_path / "advice"), "--write", str(tmp_path / "fine.toml"), "--run"]
    done = subprocess.run([PROGRAM, *words], text=True, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "of fineness" in done.stdout and "of packings" in done.stdout
    assert "\nheld: sensor.middle.temperature" in done.stdout
    assert "Proposed by solidem advise" in (tmp_path / "fine.toml").read_text()
    again = subprocess.run([PROGRAM, *words], text=True, capture_output=True, check=False)
    assert again.returncode == 2 and "exists already" in again.stderr
    told = subprocess.run([PROGRAM, *words, "--overwrite", "--json"], text=True, capture_output=True,
                          check=False)
    read = json.loads(told.stdout)
    assert read["verdict"]["held"] and read["proposal"]["errors"]["promised"] <= 0.02


def test_a_series_where_no_body_is_allowed_to_be_fine_enough(tmp_path: Path) -> None:
    """Several packings of small bodies keep what one of them does not: written, run and judged by the
    command, whose small runs are not made again."""
    scene = tmp_path / "bar.toml"
    scene.write_text(SCENES["elastic"][0])
    words = ["advise", str(scene), "--error", "15 %", "--of", SCENES["elastic"][1], "--pilot-seconds", "1",
             "--largest", "800", "--output", str(tmp_path / "advice")]
    found = advise(Scene(scene), 0.15, of=SCENES["elastic"][1], seconds=1, largest=800,
                   folder=tmp_path / "advice" / "pilots")
    assert found.proposal is None and found.least is not None and found.least.errors.promised > 0.15
    series = found.proposed
    assert isinstance(series, Series) and series.promised <= 0.15
    assert series.seconds > 0 and all(part.made <= part.packings for part in series.parts)
    written = tmp_path / "fine.toml"
    done = subprocess.run([PROGRAM, *words, "--write", str(written), "--run"], text=True,
                          capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "a series, whose limit is taken" in done.stdout and "of them made" in done.stdout
    assert "\nheld: sensor.middle.displacement_x" in done.stdout and "known to ±" in done.stdout
    assert "as the limit of a series" in written.read_text()
    assert Scene(written).tables["specimen"]["elements"] <= 800
    refused = subprocess.run([PROGRAM, *words, "--longest", "0.01"], text=True, capture_output=True,
                             check=False)
    assert refused.returncode == 1, refused.stdout + refused.stderr
    assert "nor does a series of what is allowed" in refused.stdout or "that one has" in refused.stdout


@pytest.mark.parametrize("text", ["5", "one", "0", "100%", "nan"])
def test_errors_that_are_none(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(["scene.toml", "--error", text])
    assert stopped.value.code == 2
    assert f"--error: {text!r}: expected a share such as 1% or 0.01" in capsys.readouterr().err


def test_shares() -> None:
    assert share("1%") == share(" 1 % ") == share("0.01") == 0.01


@pytest.mark.parametrize(("scene", "words", "said"), [
    (SCENES["heat"][0], ["--of", "gauge.stress"], "gauge.stress: no column of"),
    (SCENES["heat"][0], ["--at", "noon"], "at noon: neither end nor peak nor a time"),
    (BODY, [], "the scene has no effect; expected a section"),
    (SCENES["heat"][0].replace('"134 W', '"134 GW'), [], "conductivity"),
    (SCENES["heat"][0].replace('"400 K"', '"300 K"'), [], "is zero all through the run"),
])
def test_what_cannot_be_used_is_told(scene: str, words: list[str], said: str, tmp_path: Path,
                                     capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(scene.replace('"134 GW/(m K)"', '"134 furlong"'))
    words = [str(file), "--error", "10%", "--pilot-seconds", "1", "-o", str(tmp_path / "a"), *words]
    assert main(words) == 2
    assert said in capsys.readouterr().err


def test_a_file_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tmp_path / "none.toml"), "--error", "1%"]) == 2
    assert "none.toml" in capsys.readouterr().err
