# SPDX-License-Identifier: GPL-2.0-or-later
"""A body in motion in YADE: its spheres, grips that hold or move them, rows and frames."""

from __future__ import annotations

from typing import Any

import numpy as np
from prepared import Floats, Parameters, Specimen
from results import Recorder
from visible import make_visible
from yade import Material, NewtonIntegrator, O, utils
from yade import _utils


def bulk_positions() -> Floats:
    """(N, 3) positions of all bodies, m."""
    columns = [_utils.coordsAndDisplacements(axis)[0] for axis in range(3)]
    return np.array(columns, dtype=float).T


def add_spheres(specimen: Specimen, radius: Floats, material: Material) -> None:
    """Adds the elements with the masses they represent; `radius` (N,) is what YADE sees of them."""
    O.bodies.append([utils.sphere(p, r, material=material)
                     for p, r in zip(specimen.position.tolist(), radius.tolist())])
    for body, mass in zip(O.bodies, specimen.column("mechanics/mass").tolist()):
        body.state.mass = mass


class MotionScene:
    """A body in YADE, without engines; one at a time (YADE has one global scene)."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        """An empty scene; the bodies come from a subclass, and so do `O.engines`."""
        if any(specimen.periodic):
            raise ValueError(f"{specimen.path}: periodic bodies are not supported in YADE")
        O.reset()
        make_visible(self)
        self.specimen, self.parameters = specimen, parameters
        self.recorder: Recorder | None = None

    def newton(self, **options: Any) -> NewtonIntegrator:
        """YADE's integrator of motion, with gravity and local damping."""
        self._newton = NewtonIntegrator(damping=self.parameters.local_damping, gravity=(0, 0, 0),
                                        **options)
        return self._newton

    def weight_of(self, elements: list[int]) -> Floats:
        """(3,) gravity on some elements, N."""
        mass = self.specimen.column("mechanics/mass")[elements].sum()
        return np.asarray(mass * np.array(self.parameters.gravity))

    def start_motion(self) -> None:
        """In the first step: blocks what the grips hold and sets their velocities. Gravity is half
        of its own there, as velocities stand half a step behind from then on."""
        self._newton.gravity = tuple((1.0 if O.iter else 0.5) * g for g in self.parameters.gravity)
        if O.iter:
            return
        for grip in self.parameters.grips:
            blocked = "".join(a for a, v in zip("xyz", grip.velocity) if v is not None)
            blocked += "XYZ" if grip.rotation_fixed else ""
            velocity = tuple(v or 0.0 for v in grip.velocity)
            for index in self.specimen.sets[f"grip.{grip.name}"].tolist():
                state = O.bodies[index].state
                state.blockedDOFs, state.vel = blocked, velocity

    def observe(self) -> None:
        """Forces belong to the present positions here: they move only at the end of the step."""
        if self.recorder is not None:
            self.recorder.observe(O.iter, O.iter * O.dt, self._row, self._frame)

    def _row(self) -> dict[str, float]:
        row: dict[str, float] = {}
        for grip in self.parameters.grips:
            elements = self.specimen.sets[f"grip.{grip.name}"].tolist()
            # What the grip does to the body balances what the body does to the grip.
            force = -self._force_on(elements)
            moved = np.array(list(O.bodies[elements[0]].state.displ()))
            for axis, name in enumerate("xyz"):
                row[f"grip.{grip.name}.force_{name}"] = float(force[axis])
                row[f"grip.{grip.name}.displacement_{name}"] = float(moved[axis])
        return row

    def _force_on(self, elements: list[int]) -> Floats:
        """(3,) sum of the body's forces on some elements, N."""
        force = np.sum([list(O.forces.f(i)) for i in elements], axis=0)
        return np.asarray(force) + self.weight_of(elements)

    def _frame(self) -> dict[str, Floats]:
        return {"position": bulk_positions()[:len(self.specimen.radius)]}

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        observer = next(e for e in O.engines if e.label == "observer")
        observer.iterPeriod = self.recorder.period if self.recorder else steps
        O.run(steps + 1, True)
