# SPDX-License-Identifier: GPL-2.0-or-later
"""Central forces in YADE against velocity Verlet over all pairs, and what bodies must keep."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from prepared_bar import Bar, beam_task, run_yade
from test_yade_refusals import refuses

from contrib.yade.central_law import Interaction, law_named

STEPS = 400
SPEED = 60.0
STIFFNESS, ATTRACTION, DISSIPATION = 1.5e6, 12.0, 0.05
PIECEWISE = {"law": "piecewise", "range": 1.3,
             "parameters": {"stiffness": STIFFNESS, "attraction": ATTRACTION}}
MIE = {"law": "mie", "range": 1.3, "equilibrium": "radii",
       "parameters": {"energy": 6e-4, "repulsive_exponent": 8, "attractive_exponent": 4}}


def central_task(bar: Bar, law: dict[str, Any], steps: int = STEPS,
                 speed: float = SPEED) -> dict[str, Any]:
    task = beam_task(bar, speed, steps)
    mass = bar.specimen.columns["mechanics/mass"].min()
    task["time_step"] = {"value": 0.15 * float(np.sqrt(mass / STIFFNESS))}
    task["laws"] = {"central_forces": {"equilibrium": "initial", "neighbours": "changing",
                                       "interpenetration": 0.3, "dissipation": None, "skin": 0.1,
                                       **law}}
    return task


def verlet(bar: Bar, task: dict[str, Any]) -> tuple[np.ndarray, float, float]:
    """Places, the force of the right grip and the kinetic energy of what is free after all steps;
    every pair is looked at in every step."""
    specimen, dt = bar.specimen, task["time_step"]["value"]
    given = task["laws"]["central_forces"]
    of = Interaction(law_named(given["law"], given["parameters"]), given["interpenetration"])
    count = len(specimen.radius)
    i, j = np.triu_indices(count, 1)
    together = specimen.radius[i] + specimen.radius[j]
    limit, equilibrium = given["range"] * together, together.copy()
    if given["equilibrium"] == "initial":
        place = {pair: n for n, pair in enumerate(zip(i.tolist(), j.tolist()))}
        for (a, b), length in zip(specimen.pairs.tolist(), specimen.rest_length):
            equilibrium[place[a, b]] = length
    mass = specimen.columns["mechanics/mass"][:, None]
    position, velocity = specimen.position.copy(), np.zeros((count, 3))
    left, right = specimen.sets["grip.left"], specimen.sets["grip.right"]
    held = np.concatenate([left, right])
    velocity[right, :2] = task["grips"][1]["axes"][0]["function"]["value"][0], 0.3 * SPEED

    def forces() -> np.ndarray:
        chord = position[j] - position[i]
        distance = np.linalg.norm(chord, axis=1)
        parting = ((velocity[j] - velocity[i]) * chord).sum(axis=1) / distance
        size = of.force(distance, equilibrium, limit)
        size -= (given["dissipation"] or 0.0) * parting * (distance < limit)
        found = np.zeros((count, 3))
        np.add.at(found, j, (size / distance)[:, None] * chord)
        np.add.at(found, i, -(size / distance)[:, None] * chord)
        return found

    force = forces()
    for _ in range(task["steps"]):
        push = np.where(np.isin(np.arange(count), held)[:, None], 0, 0.5 * dt * force / mass)
        velocity = velocity + push
        position = position + dt * velocity
        force = forces()
        push = 0.5 * dt * force / mass
        push[held] = 0
        velocity = velocity + push
    free = np.setdiff1d(np.arange(count), held)
    energy = 0.5 * (mass[free] * velocity[free] ** 2).sum()
    return position, -force[right, 0].sum(), energy


@pytest.mark.parametrize("law", [
    PIECEWISE,
    {**PIECEWISE, "dissipation": DISSIPATION},
    MIE,  # no rest at the start: the first half step counts
], ids=["piecewise", "with dissipation", "mie, radii"])
def test_motion_is_that_of_all_pairs(bar: Bar, tmp_path: Path, law: dict[str, Any]) -> None:
    task = central_task(bar, law)
    position, force, energy = verlet(bar, task)
    result = run_yade(bar.path, task, tmp_path, "--observe-every", "10")
    moved = np.abs(position - bar.specimen.position).max()
    assert np.abs(result.frame(STEPS).columns["position"] - position).max() < 1e-10 * moved
    history = result.history
    assert history["grip.right.force_x"][-1] == pytest.approx(force, rel=1e-9)
    assert history["kinetic_energy"][-1] == pytest.approx(energy, rel=1e-9)
    assert np.ptp(history["interactions"]) > 50  # neighbours did change
    assert history["largest_interpenetration"][-1] > 0


def test_work_becomes_energy(bar: Bar, tmp_path: Path) -> None:
    task = central_task(bar, {**PIECEWISE, "neighbours": "fixed", "dissipation": DISSIPATION}, 300,
                        20.0)
    history = run_yade(bar.path, task, tmp_path, "--observe-every", "1").history
    work = sum(0.5 * (f[1:] + f[:-1]) @ np.diff(d) for f, d in (
        (history[f"grip.right.force_{a}"], history[f"grip.right.displacement_{a}"]) for a in "xy"))
    stored = sum(history[name] for name in ("kinetic_energy", "potential_energy",
                                            "dissipated_energy"))
    assert history["interactions"][-1] == history["interactions"][0]
    assert stored[-1] - stored[0] == pytest.approx(work, rel=0.01)
    assert history["dissipated_energy"][-1] > 0.02 * work


@pytest.mark.slow
def test_a_torn_bar_has_crack_faces_and_loses_elements(bar: Bar, tmp_path: Path) -> None:
    task = central_task(bar, PIECEWISE, 1500, 150.0)
    task["laws"]["damage"] = {"crack_threshold": 0.8, "every": 1, "minimal_neighbours": 3, "removal_every": 50}
    result = run_yade(bar.path, task, tmp_path, "--observe-every", "10", "--frame-every", "50")
    history, last = result.history, result.frame(1500)
    force = np.abs(history["grip.right.force_x"])
    assert force[-1] < 0.2 * force.max()
    assert history["crack_faces"].max() > 1.2 * history["crack_faces"][0] > 0
    assert (np.diff(history["removed"]) >= 0).all()
    gone = np.flatnonzero(last.columns["removed"])
    assert 0 < len(gone) == history["removed"][-1]
    since = next(f for f in result.frames if f.columns["removed"].sum() == len(gone))
    assert (last.columns["position"][gone] == since.columns["position"][gone]).all()


def test_central_forces_are_scripted(bar: Bar, tmp_path: Path) -> None:
    with pytest.raises(Exception):
        run_yade(bar.path, central_task(bar, PIECEWISE, 10), tmp_path, "--law", "native")
    assert "need --law scripted" in (tmp_path / "output.log").read_text()


def test_a_law_that_is_not_known(bar: Bar, tmp_path: Path) -> None:
    refuses(bar.path, central_task(bar, {**PIECEWISE, "law": "morse"}, 10), tmp_path,
            "no central law is called 'morse'")


def test_missing_mass(bar: Bar, tmp_path: Path) -> None:
    copy = tmp_path / "prepared.h5"
    copy.write_bytes(bar.path.read_bytes())
    with h5py.File(copy, "a") as file:
        del file["mechanics/mass"]
    refuses(copy, central_task(bar, PIECEWISE, 10), tmp_path / "run", "/mechanics/mass is missing")
