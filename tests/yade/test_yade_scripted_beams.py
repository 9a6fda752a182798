# SPDX-License-Identifier: GPL-2.0-or-later
"""Beams that are scripted in YADE: elastic against small motion, and torn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from prepared_bar import Bar, beam_task, run_yade
from test_yade_bar import STEPS, linear_beams


def test_elastic_bar_moves_as_in_small_motion(bar: Bar, tmp_path: Path) -> None:
    strain = 1e-4
    speed = strain * float(np.ptp(bar.specimen.position[:, 0])) / (STEPS * bar.beam_step)
    moved, force = linear_beams(bar, speed)
    result = run_yade(bar.path, beam_task(bar, speed, STEPS), tmp_path, "--law", "scripted",
                      "--observe-every", "100")
    found = result.frame(STEPS).columns["position"] - bar.specimen.position
    assert abs(result.history["grip.right.force_x"][-1] / force - 1) < 2 * strain
    assert np.abs(found - moved).max() / np.abs(moved).max() < 5 * strain


@pytest.mark.slow
def test_torn_bar_keeps_its_energy(bar: Bar, tmp_path: Path) -> None:
    steps, strain = 2000, 0.12
    speed = strain * float(np.ptp(bar.specimen.position[:, 0])) / (steps * bar.beam_step)
    task = beam_task(bar, speed, steps)
    task["laws"] |= {
        "plasticity": {"law": "radial-return", "yield_strain": 0.005, "hardening_ratio": 0.01},
        "rupture": {"elastic_strain": None, "strain": 0.05, "minimal_bonds": 0}}
    history = run_yade(bar.path, task, tmp_path, "--observe-every", "1").history
    work = sum(np.concatenate([[0], np.cumsum(
        0.5 * (f[1:] + f[:-1]) * np.diff(d))]) for f, d in (
            (history[f"grip.right.force_{a}"], history[f"grip.right.displacement_{a}"])
            for a in "xy"))
    stored = sum(history[name] for name in ("kinetic_energy", "elastic_energy", "plastic_work",
                                            "fracture_energy"))
    # The right grip's own motion is not its work on the body, but it has it from the first row on.
    error = np.abs(stored - stored[0] - work) / work[-1]
    assert error.max() < 0.02
    broken = history["broken_bonds"]
    assert broken[-1] > 10 and broken[0] == 0 and (np.diff(broken) >= 0).all()
    assert history["plastic_work"][-1] > 0.3 * work[-1]
    assert (np.diff(history["plastic_work"]) >= 0).all()
