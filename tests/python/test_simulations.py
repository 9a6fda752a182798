# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulations step by step in Python: the same steps, views of the same memory, checkpoints."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest


def test_steps_are_those_of_the_recorded_run(solidem, tables, tmp_path):
    scene = solidem.Scene(tables)
    history = scene.run(tmp_path / "run").history
    simulation = scene.simulation()
    rows = [simulation.observe()]
    simulation.run(every=50, callback=lambda now: rows.append(now.observe()))
    for name in history:
        np.testing.assert_array_equal([row[name] for row in rows], history[name], err_msg=name)


def test_views_alias_memory_and_copy_nothing(solidem, tables):
    simulation = solidem.Scene(tables).simulation()
    assert np.shares_memory(simulation.velocities, simulation.column("velocity"))
    before = {name: simulation.column(name).__array_interface__["data"][0]
              for name in simulation.columns}
    velocities, old = simulation.velocities, simulation.positions
    was = old.copy()
    simulation.step(2)  # both buffers of the places once: the same one is read again
    assert simulation.column("pose").__array_interface__["data"][0] == before["pose"]
    assert np.shares_memory(old, simulation.positions) and not np.array_equal(old, was)
    assert np.abs(velocities).max() > 0, "what was taken before the steps must show them"
    np.testing.assert_array_equal(velocities, simulation.velocities)
    for array in (velocities, old, simulation.orientations):
        assert not array.flags.owndata and not array.flags.writeable
        with pytest.raises(ValueError):
            array[...] = 0


def test_views_show_the_elements_in_the_order_of_the_specimen(solidem, tables):
    scene = solidem.Scene(tables)
    specimen, simulation = scene.specimen(), scene.simulation()
    elements = len(simulation)
    np.testing.assert_array_equal(simulation.positions, specimen.positions)
    np.testing.assert_array_equal(simulation.orientations, np.tile([1.0, 0, 0, 0], (elements, 1)))
    assert simulation.velocities.shape == (-(-elements // 8), 8, 3)
    simulation.step(20)
    before = simulation.positions.copy()
    simulation.step(1)
    moved = simulation.positions - before
    # Leapfrog: the velocities after a step are those of the way it took, where no grip holds.
    velocities = solidem.by_element(simulation.velocities, elements)
    ends = specimen.positions[:, 0].min(), specimen.positions[:, 0].max()
    free = np.all([np.abs(specimen.positions[:, 0] - end) > 0.3e-3 for end in ends], axis=0)
    assert free.sum() > elements / 2
    scale = np.abs(moved[free]).max()
    np.testing.assert_allclose(moved[free], velocities[free] * simulation.time_step,
                               atol=1e-6 * scale)


def test_forces_of_neighbours_add_up_to_nothing_and_hold_the_grips(solidem, tables):
    scene = solidem.Scene(tables)
    simulation = scene.simulation()
    simulation.step(100)
    forces = simulation.forces
    assert forces.shape == (len(simulation), 3)
    assert np.abs(forces.sum(axis=0)).max() < 1e-9 * np.abs(forces).sum()
    row = simulation.observe()
    moved = simulation.positions[:, 0] - scene.specimen().positions[:, 0]
    held = np.isclose(moved, row["grip.right.displacement_x"], rtol=1e-9)
    assert held.any() and row["grip.right.force_x"] > 0
    assert forces[held, 0].sum() == pytest.approx(-row["grip.right.force_x"], rel=1e-9)


def test_temperatures_are_a_view_and_motion_is_refused_where_nothing_moves(solidem, hot):
    simulation = solidem.Scene(hot).simulation()
    assert simulation.temperatures.shape == (len(simulation),)
    simulation.step(50)
    temperatures = simulation.temperatures
    assert temperatures.max() == pytest.approx(400, abs=1e-6) and temperatures.min() >= 300
    assert temperatures.mean() > 300.5 and not temperatures.flags.owndata
    with pytest.raises(solidem.InputError, match="no column pose.*temperature"):
        simulation.positions  # noqa: B018
    with pytest.raises(solidem.InputError, match="nothing moves"):
        simulation.motion()


def test_a_view_keeps_its_simulation_alive(solidem, tables):
    def view() -> np.ndarray:
        simulation = solidem.Scene(tables).simulation()
        simulation.step(3)
        return simulation.positions

    kept = view()
    was = kept.copy()
    others = []
    for _ in range(5):  # other simulations would take memory that was given back
        gc.collect()
        others.append(solidem.Scene(tables).simulation())
        others[-1].step(5)
    np.testing.assert_array_equal(kept, was)
    bonds = solidem.Scene(tables).specimen().bonds
    gc.collect()
    assert bonds.max() < len(kept)


def test_a_callback_ends_a_run_and_its_exception_comes_through(solidem, tables):
    simulation = solidem.Scene(tables).simulation()
    simulation.run(every=10, callback=lambda now: now.steps_done < 50)
    assert simulation.steps_done == 50

    def fail(_: object) -> None:
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        simulation.run(every=10, callback=fail)
    assert list(simulation.advance(every=70)) == [130, 200]
    assert list(simulation.advance()) == []
    with pytest.raises(solidem.InputError, match="at least 0"):
        simulation.step(-1)


def test_a_checkpoint_goes_on_to_the_same_bits(solidem, tables, tmp_path):
    scene = solidem.Scene(tables)
    whole, first, second = (scene.simulation() for _ in range(3))
    whole.step(150)
    first.step(75)
    first.write_checkpoint(tmp_path / "half.h5")
    second.read_checkpoint(tmp_path / "half.h5")
    assert second.steps_done == 75
    second.step(75)
    np.testing.assert_array_equal(second.positions, whole.positions)
    assert second.observe() == whole.observe()
    other = scene.changed({"beams.young_modulus": "1 TPa"}).simulation()
    with pytest.raises(solidem.InputError, match="young_modulus"):
        other.read_checkpoint(tmp_path / "half.h5")
    with pytest.raises(solidem.InputError, match="missing.h5"):
        second.read_checkpoint(tmp_path / "missing.h5")


def test_a_checkpoint_of_a_recorded_run_is_taken(solidem, tables, tmp_path):
    scene = solidem.Scene(tables)
    scene.run(tmp_path / "run")
    simulation = scene.simulation()
    simulation.read_checkpoint(tmp_path / "run" / "checkpoint.h5")
    whole = scene.simulation()
    whole.run()
    assert simulation.steps_done == 200
    np.testing.assert_array_equal(simulation.positions, whole.positions)


def test_a_run_that_diverges_is_told_as_by_the_program(solidem, tables):
    tables["run"] = {"steps": 4000, "time_step_ratio": 5}
    with pytest.raises(solidem.InputError, match="beyond the stable limit"):
        solidem.Scene(tables).simulation()
    simulation = solidem.Scene(tables).simulation(force=True)
    with pytest.raises(solidem.RunError, match="the run diverged"):
        simulation.run()


def test_other_threads_run_while_it_steps(solidem, tables):
    simulation = solidem.Scene(tables).simulation()
    counted = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(0)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted
    simulation.step(2000)
    during = counted - before
    stop.set()
    thread.join()
    assert during > 10


def test_ctrl_c_ends_a_run_in_order(solidem, tables, tmp_path):
    tables["run"]["steps"] = 10**9
    del tables["output"]
    (tmp_path / "bar.toml").write_text(solidem.toml_text({**tables, "output": {"frames": 0}}))
    for what, tells in (("scene.simulation().run()", ""), ("scene.run('run')", "run/checkpoint.h5")):
        # Ctrl-C counts even where whoever started the tests had it ignored.
        code = ("import signal, solidem, sys\n"
                "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                "scene = solidem.Scene('bar.toml')\nprint('ready', flush=True)\n"
                f"try:\n    {what}\nexcept KeyboardInterrupt:\n    sys.exit(7)\n")
        path = os.pathsep.join([str(solidem.__path__[0] + "/..")])
        with subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path, stdout=subprocess.PIPE,
                              env={**os.environ, "PYTHONPATH": path}) as process:
            try:
                assert process.stdout is not None and process.stdout.readline() == b"ready\n"
                time.sleep(1.5)
                process.send_signal(signal.SIGINT)
                assert process.wait(timeout=60) == 7
            finally:
                process.kill()
        assert not tells or (tmp_path / tells).exists()
