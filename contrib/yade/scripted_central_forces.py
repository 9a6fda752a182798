# SPDX-License-Identifier: GPL-2.0-or-later
"""Central forces, scripted: neighbours, forces and cracks are numpy's, the motion is YADE's.

YADE has no law with a distance of equilibrium for each pair, so the laws are those of
`central_law.py` and the neighbours those of `central_body.py`. Their state lives in numpy arrays and
is no part of YADE's own saved states. Forces are handed over one by one: some thousand elements, not
more.
"""

from __future__ import annotations

import numpy as np
from central_body import CentralBody
from central_law import Floats, interaction_of
from motion import MotionScene, add_spheres, bulk_positions
from prepared import Parameters, Specimen
from yade import ForceResetter, FrictMat, O, PyRunner


def bulk_velocities() -> Floats:
    """(N, 3) velocities of all bodies, half a step behind their places, m/s."""
    # One by one: a list of a Vector3 takes four times as long.
    return np.array([(v[0], v[1], v[2]) for v in (b.state.vel for b in O.bodies)])


class CentralForceScene(MotionScene):
    """A body of central forces whose loads are found by numpy inside YADE."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        """Elements stand where `specimen` has them; its pairs are the initial ones."""
        if parameters.central_forces is None:
            raise ValueError("the scene has no central forces")
        super().__init__(specimen, parameters)
        add_spheres(specimen, specimen.radius, O.materials.append(FrictMat(density=1)))
        forces = parameters.central_forces
        self.body = CentralBody(specimen, interaction_of(forces), forces, parameters.damage)
        self.mass = specimen.column("mechanics/mass")
        self.driven = np.zeros((len(self.mass), 3), dtype=bool)  #: axes that grips move
        for grip in parameters.grips:
            self.driven[specimen.sets[f"grip.{grip.name}"]] = [v is not None for v in grip.velocity]
        self.dissipated = 0.0
        O.engines = [
            ForceResetter(),
            PyRunner(iterPeriod=1, nDo=2, initRun=True, command="scene.start_motion()"),
            PyRunner(iterPeriod=1, initRun=True, command="scene.load()"),
            PyRunner(iterPeriod=1, initRun=True, label="observer", command="scene.observe()"),
            self.newton(),
        ]
        O.dt = parameters.time_step

    def load(self) -> None:
        """Puts the forces of the present places on the bodies."""
        slow = self.body.forces.dissipation != 0
        stood = self.body.removed.copy()
        self.found = self.body.respond(O.iter, bulk_positions(), bulk_velocities() if slow else None)
        self.dissipated += self.found.dissipation * O.dt
        # YADE's velocities are half a step behind; at the start they are not, so half a push is due.
        push = self.found.force if O.iter else 0.5 * self.found.force
        add = O.forces.addF
        for body, force in enumerate(push.tolist()):
            add(body, force)
        for body in np.flatnonzero(self.body.removed & ~stood).tolist():
            state = O.bodies[body].state
            state.blockedDOFs, state.vel = "xyzXYZ", (0, 0, 0)

    def _force_on(self, elements: list[int]) -> Floats:
        return np.asarray(self.found.force[elements].sum(axis=0)) + self.weight_of(elements)

    def _kinetic_energy(self) -> float:
        """Of what grips do not move; velocities half a step behind are brought to this step, J."""
        behind = 0.5 * O.dt if O.iter else 0.0
        velocity = bulk_velocities() + behind * (self.found.force / self.mass[:, None]
                                                 + np.array(self.parameters.gravity))
        velocity[self.driven | self.body.removed[:, None]] = 0
        return float(0.5 * (self.mass[:, None] * velocity**2).sum())

    def _row(self) -> dict[str, float]:
        row = {"kinetic_energy": self._kinetic_energy(), "potential_energy": self.found.potential}
        if self.body.forces.dissipation:
            row["dissipated_energy"] = self.dissipated
        row["interactions"] = self.found.interactions
        row["largest_interpenetration"] = self.body.deepest
        damage = self.parameters.damage
        if damage is not None and damage.crack_threshold is not None:
            row["crack_faces"] = int(self.body.crack_faces.sum())
        if damage is not None and damage.minimal_neighbours:
            row["removed"] = int(self.body.removed.sum())
        return row | super()._row()

    def _frame(self) -> dict[str, Floats]:
        frame = super()._frame()
        damage = self.parameters.damage
        if damage is not None and damage.crack_threshold is not None:
            frame["crack_face"] = self.body.crack_faces.astype(float)
        if damage is not None and damage.minimal_neighbours:
            frame["removed"] = self.body.removed.astype(float)
        return frame
