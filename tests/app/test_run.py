# SPDX-License-Identifier: GPL-2.0-or-later
"""A run's files, its interruption and its resumption."""

from __future__ import annotations

import json
import signal
import time

import h5py
import numpy as np


def read_history(path):
    table = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
    assert np.isfinite(table.view(float)).all()
    return table


def test_a_run_leaves_what_its_scene_asks_for(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    done = solidem("run", scene, "--output", "out")
    assert done.returncode == 0, done.stderr
    out = solidem.folder / "out"
    assert sorted(p.name for p in out.iterdir()) == [
        "checkpoint.h5", "history.csv", "summary.json", "trajectory", "trajectory.h5",
        "trajectory.xdmf"]

    summary = json.loads((out / "summary.json").read_text())
    assert summary["completed"] is True
    assert summary["effects"] == ["beams", "grip left", "grip right"]
    assert summary["steps"] == 2000
    assert summary["nanoseconds_per_bond_step"] > 0
    assert summary["peak_memory_bytes"] > summary["bytes_per_element"] * summary["elements"]

    history = read_history(out / "history.csv")
    assert history["step"].tolist() == list(range(0, 2001, 50))
    # The bar is pulled: its section strains, narrows, and both grips feel the same force in the mean.
    assert history["gauge.strain"][-1] > 1e-4
    assert history["gauge.lateral_strain"][-1] < 0
    late = history["step"] > 1000
    left, right = history["grip.left.force_x"][late], history["grip.right.force_x"][late]
    assert abs((left + right).mean()) < 0.2 * right.mean()
    assert np.abs(history["energy_balance"]).max() < 1e-3 * history["external_work"][-1]

    with h5py.File(out / "trajectory.h5") as file:
        frames = sorted(file["frames"])
        assert [file["frames"][f].attrs["step"] for f in frames] == [0, 500, 1000, 1500, 2000]
        position = file["frames"][frames[-1]]["position"][:]
        assert np.isclose((position - file["elements/position"][:])[:, 0].max(),
                          history["grip.right.displacement_x"][-1], rtol=1e-12)


def test_the_history_is_the_same_on_one_thread_and_two(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    for threads in ("1", "2"):
        assert solidem("run", scene, "-o", threads, "--threads", threads).returncode == 0
    assert ((solidem.folder / "1" / "history.csv").read_bytes()
            == (solidem.folder / "2" / "history.csv").read_bytes())


def test_interrupted_and_resumed_is_the_same_run(solidem, bar):
    scene = solidem.scene("bar.toml", bar.replace("steps = 2000", "steps = 20000"))
    assert solidem("run", scene, "-o", "whole", "-t", "1").returncode == 0

    process = solidem.start("run", scene, "-o", "parts", "-t", "1")
    history = solidem.folder / "parts" / "history.csv"
    deadline = time.monotonic() + 60
    while not (history.exists() and len(history.read_text().splitlines()) > 20):
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.005)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "--resume" in output
    summary = json.loads((solidem.folder / "parts" / "summary.json").read_text())
    assert summary["completed"] is False
    assert 1000 <= summary["steps"] < 20000
    read_history(history)

    resumed = solidem("run", scene, "-o", "parts", "-t", "1", "--resume")
    assert resumed.returncode == 0, resumed.stderr
    whole = read_history(solidem.folder / "whole" / "history.csv")
    parts = read_history(history)
    parts = parts[np.isin(parts["step"], whole["step"])]  # less the row where it was interrupted
    assert parts.tobytes() == whole.tobytes()
    with h5py.File(solidem.folder / "whole" / "trajectory.h5") as a, \
            h5py.File(solidem.folder / "parts" / "trajectory.h5") as b:
        assert sorted(a["frames"]) == sorted(b["frames"])
        last = sorted(a["frames"])[-1]
        assert (a["frames"][last]["position"][:] == b["frames"][last]["position"][:]).all()


def test_a_finished_run_can_be_made_longer(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("run", scene, "-o", "out").returncode == 0
    solidem.scene("bar.toml", bar.replace("steps = 2000", "steps = 3000"))
    longer = solidem("run", scene, "-o", "out", "--resume")
    assert longer.returncode == 0, longer.stderr
    assert read_history(solidem.folder / "out" / "history.csv")["step"][-1] == 3000


def test_the_checkpoint_of_another_scene_is_refused(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("run", scene, "-o", "out").returncode == 0
    before = (solidem.folder / "out" / "history.csv").read_bytes()
    solidem.scene("bar.toml", bar.replace("3.5 TPa", "3.6 TPa"))
    refused = solidem("run", scene, "-o", "out", "--resume")
    assert refused.returncode == 2
    assert "young_modulus" in refused.stderr
    assert (solidem.folder / "out" / "history.csv").read_bytes() == before


def test_explain_says_what_acts_and_what_it_costs(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    done = solidem("explain", scene)
    assert done.returncode == 0, done.stderr
    for words in ("beams", "[[grips]]", "move_beams", "rest_direction", "axial stiffness",
                  "bytes an element", "ns a bond-step"):
        assert words in done.stdout
    assert "temperature" not in done.stdout
    explained = json.loads(solidem("explain", scene, "--json").stdout)
    assert explained["laws"]["beams"]["young_modulus"] == 3.5e12
    assert {c["name"] for c in explained["columns"]} == {
        "pose", "velocity", "angular_velocity", "inverse_mass", "inverse_inertia",
        "rest_direction", "rest_length"}


def test_prepare_writes_what_another_code_needs(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("prepare", scene, "-o", "bar.h5").returncode == 0
    with h5py.File(solidem.folder / "bar.h5") as file:
        assert set(file["sets"]) == {"grip.left", "grip.right", "gauge", "sensor.A"}
        volume = file["domain"].attrs["volume"]
        assert np.isclose(file["mechanics/mass"][:].sum(), 2790 * volume, rtol=1e-14)
    # What was prepared is a specimen like any other.
    recipe = bar[bar.index("[specimen]"):bar.index("[material]")]
    again = solidem.scene("again.toml", bar.replace(recipe, '[specimen]\nfile = "bar.h5"\n'))
    assert solidem("run", scene, "-o", "a").returncode == 0
    assert solidem("run", again, "-o", "b").returncode == 0
    assert ((solidem.folder / "a" / "history.csv").read_bytes()
            == (solidem.folder / "b" / "history.csv").read_bytes())


def test_specimens_convert_there_and_back(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    made = solidem("specimen", scene, "-o", "bar.h5")
    assert made.returncode == 0, made.stderr
    assert "coordination" in made.stdout
    for step in (("bar.h5", "bar.data"), ("bar.data", "bar.csv"), ("bar.csv", "bar.txt"),
                 ("bar.txt", "again.h5")):
        done = solidem("convert", *step)
        assert done.returncode == 0, done.stderr
    with h5py.File(solidem.folder / "bar.h5") as a, h5py.File(solidem.folder / "again.h5") as b:
        for name in ("elements/position", "elements/radius"):
            assert (a[name][:] == b[name][:]).all()
    assert "fraction" in solidem("info", "again.h5").stdout
