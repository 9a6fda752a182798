# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS' own (m,n) pair styles against velocity Verlet over all pairs, and what it must refuse."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from compare.codes.base import Job
from compare.codes.lammps import Lammps
from compare.result import CodeFailure
from contrib.yade.central_body import CentralBody, near_pairs
from contrib.yade.central_law import interaction_of
from contrib.prepared import CentralForces, Damage, Grip, Parameters, Specimen

STEPS = 300
MIE = CentralForces("mie", {"energy": 2e-4, "repulsive_exponent": 9, "attractive_exponent": 5}, 1.3,
                    interpenetration=0.5)


def specimen(spread: float) -> Specimen:
    """Two layers of a lattice at each end are grips; radii 0.1 mm (1 ± spread)."""
    random = np.random.default_rng(3)
    cell = np.indices((8, 4, 4)).reshape(3, -1).T
    position = 2e-4 * cell + spread * 1e-5 * random.normal(size=cell.shape)
    radius = 1e-4 * random.uniform(1 - spread, 1 + spread, len(cell))
    mass = 1.7 * 2790 * 4 / 3 * np.pi * radius**3
    sets = {"grip.left": np.flatnonzero(cell[:, 0] < 2), "grip.right": np.flatnonzero(cell[:, 0] > 5)}
    return Specimen(Path("lattice"), position, radius, near_pairs(position, 1.05 * radius), sets,
                    {"mechanics/mass": mass})


def job(tmp_path: Path, body: Specimen, forces: CentralForces, **words: Any) -> Job:
    grips = (Grip("left", (0.0, 0.0, 0.0), True), Grip("right", (60.0, None, 10.0), True))
    parameters = Parameters(4e-9, STEPS, None, None, grips, {}, central_forces=forces, **words)
    return Job(tmp_path, tmp_path, tmp_path, body, parameters, 10, 100, 60)


def verlet(of: Job) -> tuple[np.ndarray, np.ndarray]:
    """Places at the end, and the force of the right grip along x in every tenth step."""
    forces = of.parameters.central_forces
    assert forces is not None
    body, dt = CentralBody(of.specimen, interaction_of(forces), forces), of.parameters.time_step
    position, velocity = of.specimen.position.copy(), np.zeros_like(of.specimen.position)
    held = np.zeros(position.shape, dtype=bool)
    for grip in of.parameters.grips:
        for axis, speed in enumerate(grip.velocity):
            elements = of.specimen.sets[f"grip.{grip.name}"]
            held[elements, axis] = speed is not None
            velocity[elements, axis] = speed or 0.0
    mass, pulls = of.specimen.columns["mechanics/mass"][:, None], []
    force = body.respond(0, position).force
    for step in range(STEPS + 1):
        if step % 10 == 0:
            pulls.append(-force[of.specimen.sets["grip.right"], 0].sum())
        if step == STEPS:
            break
        velocity += np.where(held, 0, 0.5 * dt * force / mass)
        position = position + dt * velocity
        force = body.respond(step + 1, position).force
        velocity += np.where(held, 0, 0.5 * dt * force / mass)
    return position, np.array(pulls)


@pytest.mark.parametrize("style", ["nm/cut", "mie/cut"])
@pytest.mark.parametrize("spread, forces", [
    (0.0, MIE),
    (0.1, MIE),
    (0.1, replace(MIE, equilibrium="radii")),
    (0.0, CentralForces("lennard-jones", {"energy": 2e-4}, 1.3)),
], ids=["equal", "initial", "radii", "12-6"])
def test_motion_is_that_of_the_law(tmp_path: Path, style: str, spread: float,
                                   forces: CentralForces) -> None:
    of = job(tmp_path, specimen(spread), forces)
    found = Lammps(style=style).run(of, tmp_path / "run").check()
    position, pulls = verlet(of)
    moved = np.abs(position - of.specimen.position).max()
    assert moved > 0.7e-4
    assert np.abs(found.frame(STEPS).columns["position"] - position).max() < 1e-10 * moved
    history = found.history
    assert np.abs(history["grip.right.force_x"] - pulls).max() < 1e-10 * np.abs(pulls).max()
    assert (history["step"] == np.arange(0, STEPS + 1, 10)).all()
    assert not history["grip.right.force_y"].any()
    assert found.wall_seconds > 0


@pytest.mark.parametrize("forces, words, said", [
    (replace(MIE, dissipation=1.0), {}, "dissipation"),
    (replace(MIE, neighbours="fixed"), {}, "neighbours"),
    (CentralForces("piecewise", {"stiffness": 1e6, "attraction": 1.0}, 1.3), {}, "piecewise"),
    (MIE, {"damage": Damage(crack_threshold=0.4)}, "damage"),
    (MIE, {"unsupported": ("grip left: varies",)}, "grip left: varies"),
    (None, {}, "central forces alone"),
])
def test_what_lammps_has_not_is_refused(tmp_path: Path, forces: CentralForces, words: dict[str, Any],
                                        said: str) -> None:
    with pytest.raises(CodeFailure, match=said):
        Lammps().run(job(tmp_path, specimen(0.0), forces, **words), tmp_path / "run")


def test_more_kinds_of_elements_than_types(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    many = Specimen(Path("many"), random.uniform(size=(400, 3)), random.uniform(1, 2, 400),
                    np.zeros((0, 2), dtype=int), {}, {"mechanics/mass": np.ones(400)})
    with pytest.raises(CodeFailure, match="400 elements that are not alike"):
        Lammps().run(job(tmp_path, many, MIE), tmp_path / "run")


def test_a_program_that_is_not_there(tmp_path: Path) -> None:
    assert "Debian package lammps" in (Lammps(program="no-such-lmp").missing() or "")
