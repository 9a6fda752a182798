# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes in Python: from files, texts and dicts alike; changes; errors; recorded runs."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("SOLIDEM_PROGRAM", ROOT / "build" / "release" / "solidem"))


def test_a_dict_its_text_and_a_file_are_one_scene_to_the_bit(solidem, tables, tmp_path):
    text = solidem.toml_text(tables)
    (tmp_path / "bar.toml").write_text(text)
    scenes = [solidem.Scene(tables), solidem.Scene(text), solidem.Scene(tmp_path / "bar.toml")]
    assert scenes[0].values == scenes[1].values == scenes[2].values
    for k, scene in enumerate(scenes):
        scene.run(tmp_path / str(k))
    program = subprocess.run([str(PROGRAM), "run", "bar.toml", "-o", "program", "-q"], cwd=tmp_path,
                             check=False, capture_output=True, text=True)
    assert program.returncode == 0, program.stderr
    histories = {(tmp_path / name / "history.csv").read_bytes() for name in ("0", "1", "2", "program")}
    assert len(histories) == 1


def test_every_kind_of_value_comes_back_from_toml(solidem):
    import tomllib
    table = {"text": 'a "quoted" \\ µ\n\x7f', "truth": True, "number": 0.1 + 0.2, "count": 2**40,
             "large": 1e300, "numpy": np.float64(1 / 3), "array": np.array([1.0, 2.5]),
             "path": Path("a/b.h5"), "tuple": (1, 2), "section": {"a b": {"x": [{"y": 1}]}},
             "sections": [{"name": "first"}, {"name": "second"}], "infinite": float("inf"),
             "left out": None}
    read = tomllib.loads(solidem.toml_text(table))
    assert read == {**{name: value for name, value in table.items() if value is not None},
                    "array": [1.0, 2.5], "path": "a/b.h5", "tuple": [1, 2]}
    with pytest.raises(TypeError, match="nothing that a scene can hold"):
        solidem.toml_text({"section": {"key": object()}})


def test_changes_hold_instead_and_leave_the_scene_as_it_was(solidem, tables):
    scene = solidem.Scene(tables)
    stiffer = scene.changed({"beams.young_modulus": "7 TPa", "grips.right.velocity.0": "2 m/s"})
    both = stiffer.changed({"beams.poisson_ratio": 0.2, "gauge": None})
    assert scene.values["[beams] young_modulus"] != stiffer.values["[beams] young_modulus"]
    assert both.values["[beams] young_modulus"] == stiffer.values["[beams] young_modulus"]
    assert "gauge" in stiffer.sections and "gauge" not in both.sections
    tables["beams"]["young_modulus"] = "7 TPa"
    tables["grips"][1]["velocity"][0] = "2 m/s"
    assert solidem.Scene(tables).values == stiffer.values
    assert solidem.Scene(scene.tables).values == scene.values


def test_errors_are_exceptions_with_the_words_of_the_program(solidem, tables, tmp_path):
    tables["beams"]["young_modulus"] = "3 kg"
    (tmp_path / "scene.toml").write_text(solidem.toml_text(tables))
    program = subprocess.run([str(PROGRAM), "explain", "scene.toml"], cwd=tmp_path, check=False,
                             capture_output=True, text=True)
    with pytest.raises(solidem.InputError) as found:
        solidem.Scene(tables, folder="")
    assert program.returncode == 2 and program.stderr == f"error: {found.value}\n"
    assert issubclass(solidem.InputError, ValueError)
    with pytest.raises(solidem.InputError, match="no such file"):
        solidem.Scene("missing.toml")
    with pytest.raises(solidem.InputError, match="^--set bems.young_modulus="):
        solidem.Scene(tables, {"bems.young_modulus": "1 Pa"})


def test_a_recorded_run_is_kept_until_told(solidem, tables, tmp_path):
    scene = solidem.Scene(tables)
    results = scene.run(tmp_path / "run")
    with pytest.raises(solidem.InputError, match="overwrite"):
        scene.run(tmp_path / "run")
    assert results.summary["completed"]
    longer = scene.changed({"run.steps": 300}).run(tmp_path / "run", resume=True)
    assert longer.history["step"][-1] == 300
    whole = scene.changed({"run.steps": 300}).run(tmp_path / "whole")
    np.testing.assert_array_equal(longer.history["gauge.stress"], whole.history["gauge.stress"])


def test_results_are_read_as_they_were_written(solidem, tables, tmp_path):
    results = solidem.Scene(tables).run(tmp_path / "run")
    history = results.history
    assert list(history["step"]) == [0, 50, 100, 150, 200]
    final = results.summary["final"]
    assert all(history[name][-1] == value for name, value in final.items())
    frames = results.frames
    assert [frame.step for frame in frames] == [0, 100, 200]
    assert frames[-1].time == history["time"][-1]
    moved = frames[-1]["position"] - results.rest["position"]
    assert moved[:, 0].max() == pytest.approx(history["grip.right.displacement_x"][-1], rel=1e-12)
    with pytest.raises(KeyError, match="gauge.stress"):
        history["gauge.stres"]
    with pytest.raises(solidem.InputError, match="summary.json"):
        solidem.Results(tmp_path)
    (tmp_path / "history.csv").write_text("no,history\n1\n")
    with pytest.raises(solidem.InputError, match="no history"):
        solidem.History(tmp_path / "history.csv")


def test_a_history_is_a_frame_of_pandas(solidem, tables, tmp_path):
    import pandas

    history = solidem.Scene(tables).run(tmp_path / "run").history
    frame = history.frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame.index) == [0, 50, 100, 150, 200]
    np.testing.assert_array_equal(frame["gauge.stress"], history["gauge.stress"])


def test_a_scene_is_solved_as_by_the_program(solidem, tables, tmp_path):
    scene = solidem.Scene(tables)
    kept = scene.solve(tmp_path / "rest")
    own = scene.solve()
    assert own.folder.exists() and own.summary["gauge"] == kept.summary["gauge"]
    assert kept.summary["gauge"]["stress"] > 0
    assert own.frames[0]["displacement"].shape == (len(scene.specimen()), 3)
    folder = own.folder
    del own
    assert not folder.exists()
    with pytest.raises(ValueError, match="small"):
        scene.solve(rotations="large")
    with pytest.raises(solidem.InputError, match="needs bonds to solve"):
        solidem.Scene({"specimen": tables["specimen"]}).solve()


def test_a_scene_is_calibrated_as_by_the_program(solidem, tables, tmp_path):
    del tables["gauge"], tables["grips"], tables["run"], tables["output"]
    tables["specimen"] = {"shape": "box", "size": ["3 mm", "1 mm", "1 mm"], "elements": 300}
    tables["calibration"] = {"young_modulus": "70 GPa"}
    found = solidem.Scene(tables).calibrate(tmp_path / "found")
    assert found["results"][0]["mean"]["young_modulus"] == pytest.approx(70e9, rel=0.02)
    assert found == json.loads((tmp_path / "found" / "calibration.json").read_text())
    sections = tmp_path / "found" / "calibrated.toml"
    assert "young_modulus" in sections.read_text()


def test_specimens_are_views_and_files(solidem, tables, tmp_path):
    specimen = solidem.Scene(tables).specimen()
    assert specimen.positions.shape == (len(specimen), 3) and specimen.bonds.shape[1] == 2
    assert np.shares_memory(specimen.positions, specimen.positions)
    assert not specimen.positions.flags.writeable
    lengths = np.linalg.norm(np.diff(specimen.positions[specimen.bonds], axis=1)[:, 0], axis=1)
    touching = specimen.radii[specimen.bonds].sum(axis=1)
    assert np.all(lengths <= touching * (1 + 1e-9))
    specimen.write(tmp_path / "bar.h5")
    read = solidem.Specimen.read(tmp_path / "bar.h5")
    np.testing.assert_array_equal(read.positions, specimen.positions)
    np.testing.assert_array_equal(read.bonds, specimen.bonds)
    assert read.report["coordination_number"] == specimen.report["coordination_number"]
    with pytest.raises(solidem.InputError):
        solidem.Specimen.read(tmp_path / "missing.h5")


def test_what_is_shown_in_a_notebook(solidem, tables, tmp_path):
    scene = solidem.Scene({**tables, "title": "a <bar>"})
    assert "a <bar>" in repr(scene) and "a &lt;bar&gt;" in scene._repr_html_()
    assert "elements" in repr(scene.specimen()) and "<pre>" in scene.specimen()._repr_html_()
    simulation = scene.simulation()
    assert "step 0 of 200" in repr(simulation) and "gauge.stress" in simulation._repr_html_()
    results = scene.run(tmp_path / "run")
    assert "gauge.stress" in results._repr_html_() and "run" in repr(results)
