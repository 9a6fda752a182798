# SPDX-License-Identifier: GPL-2.0-or-later
"""`solidem explain` tells what acts, and foretells what the run takes and does."""

from __future__ import annotations

import json

import numpy as np

PLASTIC = "[plasticity]\nyield_strain = 0.002\n[rupture]\nstrain = 0.2\n"


def explained(solidem, text, *words):
    done = solidem("explain", solidem.scene("scene.toml", text), "--json", *words)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_time_of_a_run_is_foretold_by_its_parts(solidem, bar):
    forecast = explained(solidem, bar)["forecast"]
    seconds = forecast["seconds"]
    assert np.isclose(seconds["total"], sum(seconds.values()) - seconds["total"])
    assert all(value > 0 for value in seconds.values())
    assert solidem("run", "scene.toml", "-o", "out", "-q").returncode == 0
    rows = np.genfromtxt(solidem.folder / "out" / "history.csv", delimiter=",", names=True)
    assert forecast["rows"] == len(rows) and forecast["frames"] == 5
    assert sorted(path.name for path in solidem.folder.iterdir()) == ["out", "scene.toml"]


def test_flow_and_rupture_are_foretold(solidem, bar):
    for speed, words in (("0.1 m/s", ("its bonds by 0.0256 %", "it will not flow", "it will not break")),
                         ("0.5 m/s", ("it may flow where strain concentrates", "it will not break")),
                         ("10 m/s", ("it will flow", "it will not break")),
                         ("-10 m/s", ("of pressure", "it will flow")),
                         ("1 km/s", ("it will flow", "it will break"))):
        scene = solidem.scene("scene.toml", bar.replace("1 m/s", speed) + PLASTIC)
        done = solidem("explain", scene)
        assert done.returncode == 0, done.stderr
        said = done.stdout[done.stdout.index("foretold:"):]
        assert "the grips left and right strain the body" in said and "bonds yield at 0.2 %" in said
        for word in words:
            assert word in said, (speed, said)


def test_what_is_not_foretold_is_told(solidem, bar):
    pulled = bar.replace('velocity = ["1 m/s", "free", "free"]', 'force = ["1 N", "free", "free"]')
    sayings = " ".join(explained(solidem, pulled)["forecast"]["sayings"])
    assert "no two grips strain the body" in sayings
    assert "the force of the grip right" in sayings


def test_without_a_trial_nothing_is_foretold(solidem, bar):
    assert "forecast" not in explained(solidem, bar, "--quick")
    assert "foretold" not in solidem("explain", "scene.toml", "--quick").stdout


def test_a_scene_that_does_not_say_how_long_to_run_has_a_cost_for_each_step(solidem, bar):
    endless = (bar[:bar.index("[run]")] + bar[bar.index("[output]"):]
               + '[calibration]\nyoung_modulus = "73 GPa"\npoisson_ratio = 0.33\n')
    forecast = explained(solidem, endless)["forecast"]
    assert forecast["seconds_per_step"] > 0 and forecast["seconds"]["steps"] == 0
    assert "ms a step" in solidem("explain", "scene.toml").stdout


def test_a_run_that_would_diverge_at_once_is_told(solidem, bar):
    forced = bar.replace("time_step_ratio = 0.3", "time_step_ratio = 3.0")
    done = solidem("explain", solidem.scene("scene.toml", forced), "--force")
    assert done.returncode == 0, done.stderr
    assert "Its beginning, tried here: the run diverged" in done.stdout
