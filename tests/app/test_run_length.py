# SPDX-License-Identifier: GPL-2.0-or-later
"""How long a run is, where it ends, how it goes on, and what is told before or while it fails."""

from __future__ import annotations

import json
import signal
import time

import h5py
import numpy as np
import pytest

ROD = """\
[specimen]
shape = "crystal"
lattice = "simple_cubic"
cells = [20, 2, 2]
element_radius = "1 mm"
[material]
density = "1000 kg/m^3"
specific_heat_capacity = "1000 J/(kg K)"
conductivity = "10 W/(m K)"
[conduction]
law = "voronoi"
initial_temperature = "300 K"
integrator = "INTEGRATOR"
[[temperatures]]
name = "hot"
wall = "x_low"
value = "400 K"
[[sensors]]
name = "middle"
point = ["20 mm", "2 mm", "2 mm"]
quantity = "temperature"
[run]
duration = "10 s"
[output]
frames = 3
"""


def rod(integrator):
    extra = '"\ntolerance = "0.01 K"' if integrator != "explicit" else '"'
    return ROD.replace('INTEGRATOR"', integrator + extra)


def history_of(folder):
    return np.genfromtxt(folder / "history.csv", delimiter=",", names=True, deletechars="")


def frame_steps(folder):
    with h5py.File(folder / "trajectory.h5") as file:
        return [int(file["frames"][f].attrs["step"]) for f in sorted(file["frames"])]


@pytest.mark.parametrize(("steps", "frames", "at"), [
    (19, 10, [0, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19]),
    (20, 3, [0, 6, 13, 20]),
    (2, 10, [0, 1, 2]),
])
def test_a_run_has_as_many_frames_as_asked_for_and_the_last_at_its_end(solidem, bar, steps, frames,
                                                                      at):
    text = bar.replace("steps = 2000", f"steps = {steps}").replace("frames = 4",
                                                                   f"frames = {frames}")
    done = solidem("run", solidem.scene("bar.toml", text), "-o", "out")
    assert done.returncode == 0, done.stderr
    assert frame_steps(solidem.folder / "out") == at


def test_the_last_step_ends_at_the_duration(solidem, bar):
    text = bar.replace("steps = 2000\ntime_step_ratio = 0.3\nobserve_every = 50",
                       'duration = "1.03 us"\ntime_step = "10 ns"\nobserve_every = 1')
    done = solidem("run", solidem.scene("bar.toml", text), "-o", "out")
    assert done.returncode == 0, done.stderr
    times = history_of(solidem.folder / "out")["time"]
    assert len(times) == 104
    assert times[-1] == 1.03e-6
    text = text.replace("1.03 us", "1.034 us")
    assert solidem("run", solidem.scene("bar2.toml", text), "-o", "out2").returncode == 0
    history = history_of(solidem.folder / "out2")
    assert len(history) == 105
    assert history["time"][-1] == 1.034e-6
    # The grip went as far as its velocity says.
    assert np.isclose(history["grip.right.displacement_x"][-1], 1.034e-6, rtol=1e-12)


@pytest.mark.parametrize("integrator", ["explicit", "rkl2", "implicit", "auto"])
def test_a_run_of_heat_can_be_made_longer(solidem, integrator):
    text = rod(integrator)
    assert solidem("run", solidem.scene("rod.toml", text), "-o", "out").returncode == 0
    longer = text.replace('duration = "10 s"', 'duration = "20 s"').replace("frames = 3",
                                                                           "frames = 4")
    done = solidem("run", solidem.scene("rod.toml", longer), "-o", "out", "--resume")
    assert done.returncode == 0, done.stderr
    history = history_of(solidem.folder / "out")
    assert np.isclose(history["time"][-1], 20, rtol=1e-9)
    assert abs(history["heat_balance"][-1]) < 1e-9 * history["heat_input"][-1]
    assert solidem("run", "rod.toml", "-o", "whole").returncode == 0
    whole = history_of(solidem.folder / "whole")
    # One shorter step at 10 s, or other inner steps.
    tolerance = 1e-4 if integrator == "explicit" else 0.1
    assert abs(history["sensor.middle.temperature"][-1]
               - whole["sensor.middle.temperature"][-1]) < tolerance
    # The same time step said in another way goes on as well.
    if integrator != "explicit":
        said = longer.replace('"20 s"', '"30 s"\ntime_step = "50 ms"')
        done = solidem("run", solidem.scene("rod.toml", said), "-o", "out", "--resume")
        assert done.returncode == 0, done.stderr


def test_what_must_not_change_is_named_with_both_values(solidem):
    text = rod("rkl2")
    assert solidem("run", solidem.scene("rod.toml", text), "-o", "out").returncode == 0
    for old, new, words in [
        ('"10 W/(m K)"', '"20 W/(m K)"', ["material.conductivity = 10, not 20"]),
        ('duration = "10 s"', 'duration = "20 s"\ntime_step = "20 ms"', ["0.05 s", "0.02 s"]),
    ]:
        done = solidem("run", solidem.scene("rod.toml", text.replace(old, new)), "-o", "out",
                       "--resume")
        assert done.returncode == 2
        assert len(done.stderr) < 500
        for word in words:
            assert word in done.stderr, done.stderr


@pytest.mark.parametrize(("run", "words"), [
    ("steps = 9223372036854775807", "steps = 9223372036854775807"),
    ('duration = "1e12 s"\ntime_step_ratio = 0.3', "duration = 1e+12 s"),
])
def test_more_steps_than_can_be_counted_are_refused(solidem, bar, run, words):
    text = bar.replace("steps = 2000\ntime_step_ratio = 0.3", run)
    done = solidem("run", solidem.scene("bar.toml", text), "-o", "out")
    assert done.returncode == 2
    assert words in done.stderr
    assert "expected at most 1e+15 steps" in done.stderr


def test_a_short_run_that_diverges_says_so(solidem, bar):
    text = bar.replace("steps = 2000\ntime_step_ratio = 0.3", "steps = 50\ntime_step_ratio = 3")
    done = solidem("run", solidem.scene("bar.toml", text), "-o", "out", "--force")
    assert done.returncode == 1
    assert "the run diverged" in done.stderr
    assert not (solidem.folder / "out" / "checkpoint.h5").exists()


def test_temperatures_below_absolute_zero_end_a_run(solidem):
    sink = '[[heat_sources]]\nname = "sink"\nregion = { all = true }\npower = "-1 kW"\n[run]'
    text = rod("explicit").replace("[run]", sink)
    done = solidem("run", solidem.scene("rod.toml", text), "-o", "out")
    assert done.returncode == 1
    assert "below absolute zero" in done.stderr
    assert json.loads((solidem.folder / "out" / "summary.json").read_text())["completed"] is False


@pytest.mark.parametrize(("old", "new", "words"), [
    ('point = ["1 mm", "0 mm", "0 mm"]', 'point = ["1 m", "0 mm", "0 mm"]',
     ['[[sensors]] "A"', "away from the nearest element", "expected a point of the body"]),
    ('lower = "0.4 mm"', 'lower = "-10 mm"', ["[gauge]", "reaches beyond the body", "0 m or more"]),
])
def test_what_would_be_measured_wrongly_is_refused(solidem, bar, old, new, words):
    done = solidem("run", solidem.scene("bar.toml", bar.replace(old, new)), "-o", "out")
    assert done.returncode == 2
    for word in words:
        assert word in done.stderr, done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGXCPU])
def test_a_signal_within_a_long_step_is_answered(solidem, number):
    text = ROD.replace("INTEGRATOR", 'implicit"\ntolerance = "1 mK').replace("[20, 2, 2]",
                                                                          "[60, 60, 30]")
    text = text.replace('"10 s"', '"10000 s"\ntime_step = "10000 s"').replace("frames = 3",
                                                                             "frames = 0")
    process = solidem.start("run", solidem.scene("rod.toml", text), "-o", "out")
    out = solidem.folder / "out"
    deadline = time.monotonic() + 100
    while not (out / "history.csv").exists():
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.05)
    time.sleep(1)
    process.send_signal(number)
    output, _ = process.communicate(timeout=10)  # the step itself takes much longer
    assert process.returncode == 130
    assert "--resume" in output
    assert (out / "checkpoint.h5").exists()
    assert json.loads((out / "summary.json").read_text())["completed"] is False
