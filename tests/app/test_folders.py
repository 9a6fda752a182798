# SPDX-License-Identifier: GPL-2.0-or-later
"""A folder belongs to one run: what is there is kept, replaced when told to, or gone on from."""

from __future__ import annotations

import json
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest

LONG = ("steps = 2000", "steps = 2000000")


def wait_for_rows(path, process, rows=3):
    deadline = time.monotonic() + 60
    while not (path.exists() and len(path.read_text().splitlines()) > rows):
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.005)


def test_earlier_results_are_kept_unless_told(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("run", scene, "-o", "out", "-q").returncode == 0
    out = solidem.folder / "out"
    before = (out / "summary.json").read_bytes()
    for command in ("run", "solve"):
        refused = solidem(command, scene, "-o", "out", "-q")
        assert refused.returncode == 2
        assert "summary.json" in refused.stderr and "--overwrite" in refused.stderr
    assert (out / "summary.json").read_bytes() == before
    assert solidem("run", scene, "-o", "out", "-q", "--overwrite").returncode == 0
    assert json.loads((out / "summary.json").read_text())["run"] != json.loads(before)["run"]
    both = solidem("run", scene, "-o", "out", "--overwrite", "--resume")
    assert both.returncode != 0 and "--overwrite" in both.stderr


@pytest.mark.parametrize("words", [("specimen", "bar.toml", "-o", "there.h5"),
                                   ("prepare", "bar.toml", "-o", "there.h5"),
                                   ("convert", "given.csv", "there.h5"),
                                   ("law", "plot", "mie", "energy=1 mJ", "attractive_exponent=6",
                                    "repulsive_exponent=12", "-o", "there")])
def test_files_are_kept_unless_told(solidem, bar, words):
    solidem.scene("bar.toml", bar)
    assert solidem("specimen", "bar.toml", "-o", "given.csv").returncode == 0
    there = solidem.folder / ("there.csv" if words[0] == "law" else "there.h5")
    there.write_text("mine")
    refused = solidem(*words)
    assert refused.returncode == 2 and f"{there.name}: is there already" in refused.stderr
    assert there.read_text() == "mine"
    done = solidem(*words, "--overwrite")
    assert done.returncode == 0, done.stderr
    assert there.read_bytes() != b"mine"


def test_a_run_that_is_refused_leaves_no_folder(solidem, bar):
    wrong = solidem.scene("bar.toml", bar.replace("time_step_ratio = 0.3", "time_step_ratio = 30"))
    assert solidem("run", wrong, "-o", "out").returncode == 2
    assert not (solidem.folder / "out").exists()


def test_two_runs_do_not_share_a_folder(solidem, bar):
    scene = solidem.scene("bar.toml", bar.replace(*LONG))
    first = solidem.start("run", scene, "-o", "out", "-q")
    try:
        wait_for_rows(solidem.folder / "out" / "history.csv", first)
        for way in ("--overwrite", "--resume"):
            second = solidem("run", scene, "-o", "out", "-q", way)
            assert second.returncode == 1 and "another solidem" in second.stderr
        assert first.poll() is None
    finally:
        first.send_signal(signal.SIGKILL)
        first.communicate()
    scene = solidem.scene("bar.toml", bar)  # the lock went with its owner
    assert solidem("run", scene, "-o", "out", "-q", "--overwrite").returncode == 0


def test_a_rerun_that_was_killed_does_not_go_on_from_the_run_before_it(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("run", scene, "-o", "out", "-q").returncode == 0
    scene = solidem.scene("bar.toml", bar.replace(*LONG))
    again = solidem.start("run", scene, "-o", "out", "-q", "--overwrite")
    while (solidem.folder / "out" / "summary.json").exists():  # until then it is the first run's
        assert again.poll() is None
        time.sleep(0.005)
    wait_for_rows(solidem.folder / "out" / "history.csv", again, rows=1)
    again.send_signal(signal.SIGKILL)
    again.communicate()
    resumed = solidem("run", scene, "-o", "out", "-q", "--resume")
    assert resumed.returncode == 2 and "no checkpoint" in resumed.stderr


def test_a_finished_run_that_is_resumed_says_the_same(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("run", scene, "-o", "out", "-q").returncode == 0
    before = json.loads((solidem.folder / "out" / "summary.json").read_text())
    assert solidem("run", scene, "-o", "out", "-q", "--resume").returncode == 0
    after = json.loads((solidem.folder / "out" / "summary.json").read_text())
    assert before["final"] and after["final"] == before["final"]
    assert after["run"] == before["run"]


def test_a_history_that_was_moved_away_begins_anew(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    assert solidem("run", scene, "-o", "out", "-q").returncode == 0
    (solidem.folder / "out" / "history.csv").unlink()
    (solidem.folder / "out" / "trajectory" / "000001.h5").unlink()
    solidem.scene("bar.toml", bar.replace("steps = 2000", "steps = 2500"))
    longer = solidem("run", scene, "-o", "out", "-q", "--resume")
    assert longer.returncode == 0, longer.stderr
    assert "history.csv is missing" in longer.stderr and "1 frames" in longer.stderr
    steps = np.genfromtxt(solidem.folder / "out" / "history.csv", delimiter=",", names=True)["step"]
    assert steps[0] == 2000 and steps[-1] == 2500
    notes = json.loads((solidem.folder / "out" / "summary.json").read_text())["notes"]
    assert any("history.csv" in note for note in notes)


def test_a_specimen_with_swapped_radii_is_another(solidem, bar):
    assert solidem("specimen", solidem.scene("bar.toml", bar), "-o", "body.h5").returncode == 0
    recipe = bar[bar.index("[specimen]"):bar.index("[material]")]
    scene = solidem.scene("file.toml", bar.replace(recipe, '[specimen]\nfile = "body.h5"\n'))
    with h5py.File(solidem.folder / "body.h5", "r+") as file:
        file["elements/radius"][5] *= 0.99
    assert solidem("run", scene, "-o", "out", "-q").returncode == 0
    with h5py.File(solidem.folder / "body.h5", "r+") as file:
        radius = file["elements/radius"]
        radius[5], radius[9] = radius[9], radius[5]
    refused = solidem("run", scene, "-o", "out", "-q", "--resume")
    assert refused.returncode == 2 and "another specimen" in refused.stderr


def test_what_is_printed_lands_in_no_result(solidem, bar):
    scene = solidem.scene("bar.toml", bar.replace("steps = 2000", "steps = 4000"))
    assert solidem("run", scene, "-o", "open", "-t", "1").returncode == 0
    words = f"{solidem.path} run {scene} -t 1 -o"
    for name, streams in (("closed", ">&- 2>&-"), ("full", "2>/dev/full"), ("input", "<&-")):
        done = subprocess.run(f"{words} {name} {streams}", shell=True, cwd=solidem.folder,
                              stdout=subprocess.DEVNULL, check=False)
        assert done.returncode == (1 if name == "closed" else 0), name
        assert ((solidem.folder / name / "history.csv").read_bytes()
                == (solidem.folder / "open" / "history.csv").read_bytes()), name


def test_a_full_standard_output_is_told_and_the_run_is_whole(solidem, bar):
    scene = solidem.scene("bar.toml", bar)
    done = subprocess.run(f"{solidem.path} run {scene} -o out -q >/dev/full", shell=True, text=True,
                          cwd=solidem.folder, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 1 and "standard output" in done.stderr
    assert json.loads((solidem.folder / "out" / "summary.json").read_text())["completed"] is True
