# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter sweeps: points, resumption, failures, measures, checks, with a program that is quick."""

from __future__ import annotations

import csv
import math
import signal
import stat
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import numpy as np
import pytest

from compare.sweep.__main__ import main
from compare.sweep.measures import MEASURES, Curve, measured
from compare.sweep.scene_text import SceneChangeError, changed, write_scene
from compare.sweep.sweep import SweepError, find_sweeps, read_sweep

ROOT = Path(__file__).resolve().parents[2]

#: y = stiffness * x up to x = seed / 10, nothing beyond. Says every call in calls.log; waits where
#: the scene says so, and then writes a checkpoint when it is interrupted.
PROGRAM = """\
#!/usr/bin/python3
import json, os, signal, sys, time, tomllib
from pathlib import Path
words = sys.argv[1:]
scene = tomllib.loads(Path(words[1]).read_text())
folder = Path(words[words.index("--output") + 1])
with open(Path(__file__).parent / "calls.log", "a") as log:
    log.write(words[0] + (" --resume" if "--resume" in words else "") + "\\n")
if words[0] == "specimen":
    folder.write_text(json.dumps(scene["specimen"]))
    sys.exit(0)
assert os.environ["OMP_NUM_THREADS"] == "1"
seed = json.loads(Path(scene["specimen"]["file"]).read_text())["seed"]
stiffness = scene["forces"]["stiffness"]
folder.mkdir(exist_ok=True)
if stiffness < 0:
    print("error: scene.toml:3: stiffness is below 0", file=sys.stderr)
    sys.exit(2)
def interrupted(*_):
    (folder / "checkpoint.h5").write_text("")
    sys.exit(130)
signal.signal(signal.SIGINT, interrupted)
if "wait" in scene["run"] and "--resume" not in words:
    (folder / "waiting").write_text("")
    time.sleep(60)
lines = ["step,time,x,y"]
for k in range(101):
    x = k / 100
    lines.append(f"{k},{k},{x},{stiffness * x if x <= seed / 10 else 0}")
(folder / "history.csv").write_text("\\n".join(lines) + "\\n")
(folder / "summary.json").write_text(json.dumps({"completed": True}))
"""

SCENE = """\
title = "spring"
[specimen]
elements = 10
seed = 1
[forces]
stiffness = 2.0
limit = 5
[[grips]]
name = "left"
velocity = ["1 m/s", "free"]
[run]
steps = 100
"""

SWEEP = """\
title = "Springs"
about = "Springs that snap."
scene = "spring.toml"
seeds = [3, 5]
[quick]
seeds = [4]
set = { "specimen.elements" = 2 }
[x]
label = "x"
columns = { x = 1 }
[y]
label = "y, twice"
columns = { y = 2 }
[[vary]]
name = "stiffness"
key = "forces.stiffness"
symbol = "K"
values = [1.0, 2.0, 4.0]
[[vary]]
name = "limit"
seeds = [3]
settings = [{ label = "as it is" }, { label = "none", remove = ["forces.limit"] }]
[[measure]]
name = "peak"
kind = "peak"
unit = "cN"
scale = 0.01
[[measure]]
name = "snap"
kind = "fall_place"
options = { fraction = 0.5 }
[[check]]
vary = "stiffness"
measure = "peak"
expects = "rises"
reason = "stiffer springs pull harder"
[[check]]
vary = "limit"
measure = "snap"
expects = "stays"
reason = "the limit does nothing"
options = { within = 1e-9 }
"""


class Place:
    """A folder with a program, a scene and a sweep; calls the runner in it."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.program = folder, folder / "program"
        self.write(PROGRAM)
        (folder / "spring.toml").write_text(SCENE)
        self.sweep(SWEEP)

    def write(self, program: str) -> None:
        self.program.write_text(program)
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)

    def sweep(self, text: str) -> None:
        (self.folder / "springs.toml").write_text(text)

    def calls(self) -> list[str]:
        log = self.folder / "calls.log"
        words = log.read_text().split("\n")[:-1] if log.exists() else []
        log.unlink(missing_ok=True)
        return words

    def words(self, *more: str) -> list[str]:
        return ["springs", "--sweep-directory", str(self.folder), "--output",
                str(self.folder / "out"), *more]

    def __call__(self, *more: str) -> int:
        return main(self.words(*more), self.program)

    def rows(self, name: str = "springs") -> list[dict[str, str]]:
        with (self.folder / "out" / name / "points.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path)


def test_points_share_bodies_and_runs_and_are_measured(place, capsys):
    assert place("--jobs", "2") == 0
    calls = place.calls()
    # Three stiffnesses with two specimens; "as it is" is one of them; "none" is another scene.
    assert calls.count("specimen") == 2 and calls.count("run") == 7
    rows = {(r["variation"], r["setting"], r["seed"]): r for r in place.rows()}
    assert len(rows) == 8
    assert float(rows["stiffness", "K = 4.0", "5"]["peak"]) == pytest.approx(2 * 4 * 0.5)
    assert float(rows["limit", "none", "3"]["snap"]) == pytest.approx(0.305)
    table = (place.folder / "out" / "springs" / "table.md").read_text(encoding="utf-8")
    assert "| K = 4.0 | 2 | 320 (240–400) |" in table and "stiffer springs" in table
    assert (place.folder / "out" / "springs" / "springs.png").stat().st_size > 10000
    assert "K = 2.0" in capsys.readouterr().out


def test_what_is_there_stays_until_scene_or_program_change(place):
    assert place() == 0
    place.calls()
    assert place() == 0 and place.calls() == []
    place.sweep(SWEEP.replace("values = [1.0, 2.0, 4.0]", "values = [1.0, 2.0, 8.0]"))
    assert place() == 0 and place.calls() == ["run", "run"]
    (place.folder / "spring.toml").write_text(SCENE.replace("steps = 100", "steps = 101"))
    assert place() == 0 and place.calls() == ["run"] * 7
    place.write(PROGRAM + "# another build\n")
    assert place("--any-program") == 0 and place.calls() == []
    assert place() == 0 and sorted(set(place.calls())) == ["run", "specimen"]


def test_a_run_cut_short_is_made_again(place):
    assert place() == 0
    place.calls()
    done = sorted((place.folder / "out" / "springs" / "points").iterdir())
    (done[0] / "record.json").unlink()
    assert place() == 0 and place.calls() == ["run"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("at_start", [signal.SIG_DFL, signal.SIG_IGN])
def test_an_interrupted_sweep_goes_on_where_it_was(place, number, at_start):
    """Also where the signal was ignored when the sweep began, as in the background of a shell."""
    (place.folder / "spring.toml").write_text(SCENE + "wait = true\n")
    command = [sys.executable, "-c", "import sys; from pathlib import Path; from "
               "compare.sweep.__main__ import main; sys.exit(main(sys.argv[2:], Path(sys.argv[1])))",
               str(place.program), *place.words("--quick", "--jobs", "1")]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, preexec_fn=lambda: signal.signal(number, at_start)) as running:
        end = time.monotonic() + 60
        while not list(place.folder.glob("out/*/points/*/run/waiting")):
            assert time.monotonic() < end and running.poll() is None
            time.sleep(0.05)
        running.send_signal(number)
        assert running.wait(30) == 130
        assert running.stderr is not None and "goes on" in running.stderr.read()
    assert place.calls() == ["specimen", "run"]
    # That point alone: the others would wait.
    vary = SWEEP.replace("values = [1.0, 2.0, 4.0]", "values = [1.0]").split("[[vary]]")[:2]
    place.sweep("[[vary]]".join(vary) + SWEEP[SWEEP.index("[[measure]]"):].split("[[check]]")[0])
    assert place("--quick") == 0
    assert place.calls() == ["run --resume"]


def test_a_failure_is_told_and_the_other_points_run(place, capsys):
    place.sweep(SWEEP.replace("values = [1.0,", "values = [-1.0,"))
    assert place("--quick") == 1
    out = capsys.readouterr().out
    assert "FAILED: exit status 2: error: scene.toml:3: stiffness is below 0" in out
    assert len(place.rows("springs_quick")) == 4
    assert place("--quick") == 1 and place.calls().count("run") == 5  # four, then the failed one


def test_a_check_that_does_not_hold_fails_the_sweep(place, capsys):
    place.sweep(SWEEP.replace('expects = "rises"', 'expects = "falls"'))
    assert place("--quick") == 1
    assert "NOT" in capsys.readouterr().out


@pytest.mark.parametrize(("check", "holds"), [
    ('expects = "rises"', True), ('expects = "falls"', False),
    ('expects = "moves"\noptions = { least = 0.5 }', True),
    ('expects = "moves"\noptions = { least = 5.0 }', False),
    ('expects = "stays"\noptions = { within = 0.1 }', False),
    ('expects = "above"\noptions = { lower = 79.0 }', True),
    ('expects = "above"\noptions = { lower = 81.0 }', False),
    ('expects = "between"\noptions = { lower = 79.0, upper = 321.0 }', True),
    ('expects = "between"\noptions = { lower = 79.0, upper = 319.0 }', False),
    ('expects = "printed"\noptions = { lower = 1.0, upper = 2.0 }', True),
    # The peak goes with the first power of the stiffness.
    ('expects = "hardly goes"\noptions = { of = [1, 4], power = 1.01 }', True),
    ('expects = "hardly goes"\noptions = { of = [1, 4], power = 0.99 }', False),
    ('expects = "same curve"\noptions = { until = 0.3, within = 1e-9 }', False),
    ('expects = "scatters less"\noptions = { than = "snap" }', False),
    ('expects = "falls over"\noptions = { setting = "K = 4.0", then = ["snap"] }', True),
])
def test_checks_hold_or_do_not(place, check, holds):
    text = SWEEP[:SWEEP.index("[[check]]")]
    place.sweep(text + f'[[check]]\nvary = "stiffness"\nmeasure = "peak"\nreason = ""\n{check}\n')
    assert place("--quick") == (0 if holds else 1)


@pytest.mark.parametrize(("old", "new", "told"), [
    ('kind = "peak"', 'kind = "paek"', "unknown kind 'paek'"),
    ('vary = "limit"', 'vary = "limits"', "limits"),
    ('remove = ["forces.limit"]', 'remove = ["forces.limits"]', "nothing to remove"),
    ('key = "forces.stiffness"\n', "", "needs key and values"),
    ('[x]', '[x', "springs.toml"),
])
def test_a_bad_sweep_is_refused(place, capsys, old, new, told):
    place.sweep(SWEEP.replace(old, new))
    assert place() == 2
    assert told in capsys.readouterr().err and place.calls() == []


def test_an_unknown_sweep_and_a_missing_program_are_told(place, capsys):
    assert main(["sprnigs", "--sweep-directory", str(place.folder)], place.program) == 2
    assert "springs" in capsys.readouterr().err
    assert main(place.words(), place.folder / "nothing") == 2
    assert "nothing is not there" in capsys.readouterr().err


def test_scenes_are_written_as_they_were_read():
    for path in sorted((ROOT / "compare" / "scenes").glob("*.toml")):
        scene = tomllib.loads(path.read_text(encoding="utf-8"))
        assert tomllib.loads(write_scene(scene)) == scene, path.name


def test_keys_are_changed_by_their_names_in_a_copy():
    scene = tomllib.loads(SCENE)
    new = changed(scene, {"forces.stiffness": 3, "grips.left.velocity.0": "2 m/s", "new.key": 1},
                  ["forces.limit"])
    assert new["forces"] == {"stiffness": 3} and new["new"] == {"key": 1}
    assert new["grips"][0]["velocity"] == ["2 m/s", "free"]
    assert scene == tomllib.loads(SCENE)
    for values, removed in (({"grips.right.velocity": 1}, []), ({"grips.left.velocity.7": 1}, []),
                            ({}, ["forces.nothing"])):
        with pytest.raises(SceneChangeError):
            changed(scene, values, removed)


def test_measures_of_a_curve_that_is_known():
    time_, x = np.linspace(0, 1, 1001), np.linspace(0, 1, 1001)
    y = np.where(x < 0.3, 10 * x, np.where(x < 0.6, 3.0, 3 - 10 * (x - 0.6)))
    curve = Curve(time_, x, y, {"z": x * 2})
    assert measured("slope", curve, {"lower": 0.0, "upper": 0.2}) == pytest.approx(10)
    # 5 % below 10 x: where 3 = .95 * 10 x
    assert measured("departure", curve, {"lower": 0.0, "upper": 0.2, "fraction": 0.05}
                    ) == pytest.approx(0.3 / 0.95, abs=0.002)
    assert measured("peak", curve, {}) == pytest.approx(3)
    assert measured("fall_place", curve, {"fraction": 0.5}) == pytest.approx(0.75)
    assert measured("fall_length", curve, {"start": 0.9, "end": 0.5}) == pytest.approx(0.12)
    assert measured("plateau", curve, {"fraction": 0.9}) == pytest.approx(0.36, abs=0.002)
    assert measured("value_at", curve, {"x": 0.1505}) == pytest.approx(1.505)
    assert measured("largest", curve, {"column": "z"}) == pytest.approx(2)
    assert measured("largest", curve, {"column": "none"}) == 0
    assert math.isnan(measured("fall_place", Curve(time_, x, x, {}), {"fraction": 0.5}))
    assert measured("ripple", Curve(time_, x, 1 + 2 * x + 3 * x**2, {}),
                    {"lower": 0.1, "upper": 0.9}) == pytest.approx(0, abs=1e-12)


def test_areas_of_loops_are_those_of_ellipses_that_shrink():
    period, b = 2.0, 3.0
    time_ = np.linspace(0, 3 * period, 6001)
    phase = 2 * np.pi * time_ / period
    height = b * 0.5 ** np.floor(time_ / period + 1e-9)
    curve = Curve(time_, 2 * np.sin(phase), -height * np.cos(phase), {})
    # x goes right while y is on the lower half first, then back above: ∮ y dx is below 0 then.
    for cycle in (1, 2, 3):
        area = measured("loop_area", curve, {"cycle": cycle, "period": period})
        assert abs(area) == pytest.approx(np.pi * 2 * b * 0.5 ** (cycle - 1), rel=5e-3)
    assert measured("loop_ratio", curve, {"cycle": 3, "before": 1, "period": period}
                    ) == pytest.approx(0.25, rel=1e-2)
    assert math.isnan(measured("loop_area", curve, {"cycle": 4, "period": period}))
    # An elastic body has no loop, whatever its curve.
    elastic = Curve(time_, np.sin(phase), np.sin(phase) ** 3, {})
    assert measured("loop_area", elastic, {"cycle": 2, "period": period}) == pytest.approx(
        0, abs=1e-10)


def test_every_sweep_of_the_project_can_be_read():
    paths = find_sweeps()
    assert paths
    for path in paths.values():
        for quick in (False, True):
            sweep = read_sweep(path, quick)
            assert sweep.points and sweep.measures
            assert all(m.kind in MEASURES for m in sweep.measures)
    with pytest.raises(SweepError):
        read_sweep(ROOT / "compare" / "cases" / "plate.toml")
