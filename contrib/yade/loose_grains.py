# SPDX-License-Identifier: GPL-2.0-or-later
"""Loose elements in YADE: its native linear spring with Coulomb friction (Cundall and Strack).

Nothing of the law is solidem's. Radii, masses, moments of inertia and the velocities of the start are
those of the prepared specimen; stiffness and friction follow from YADE's own `FrictMat`.
"""

from __future__ import annotations

import math

from motion import MotionScene, add_spheres
from prepared import Contact, Parameters, PreparedError, Specimen
from yade import (Bo1_Sphere_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
                  InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_FrictPhys,
                  Law2_ScGeom_FrictPhys_CundallStrack, O, PyRunner)


def _material(contact: Contact) -> FrictMat:
    if contact.young_modulus is None:
        raise PreparedError("YADE's FrictMat takes [contact] young_modulus, no other stiffness")
    if contact.restitution != 1:
        raise PreparedError("[contact] restitution: YADE's native law has no dashpot")
    # Its name notwithstanding, poisson is k_s / k_n.
    return FrictMat(young=contact.young_modulus, poisson=contact.tangential_stiffness_ratio,
                    frictionAngle=math.atan(contact.friction), density=1)


class LooseGrainScene(MotionScene):
    """Loose elements in YADE, ready to run."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        """Spheres that move as the specimen says."""
        if parameters.contact is None:
            raise ValueError("the scene has no contact")
        super().__init__(specimen, parameters)
        add_spheres(specimen, specimen.radius, O.materials.append(_material(parameters.contact)))
        for body, j in zip(O.bodies, specimen.column("mechanics/inertia").tolist()):
            body.state.inertia = (j, j, j)
        if "mechanics/velocity" in specimen.columns:
            for body, v in zip(O.bodies, specimen.column("mechanics/velocity").tolist()):
                body.state.vel = v
        O.engines = [
            ForceResetter(),
            InsertionSortCollider([Bo1_Sphere_Aabb()],
                                  verletDist=0.2 * float(specimen.radius.mean())),
            # Levers end at the middle of the overlap, and no granular ratcheting is undone.
            InteractionLoop([Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False)],
                            [Ip2_FrictMat_FrictMat_FrictPhys()],
                            [Law2_ScGeom_FrictPhys_CundallStrack()]),
            PyRunner(iterPeriod=1, nDo=2, initRun=True, command="scene.start_motion()"),
            PyRunner(iterPeriod=1, initRun=True, label="observer", command="scene.observe()"),
            self.newton(exactAsphericalRot=False),
        ]
        O.dt = parameters.time_step
