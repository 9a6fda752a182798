# SPDX-License-Identifier: GPL-2.0-or-later
"""Loose elements in YADE: its native linear spring with Coulomb friction (Cundall and Strack).

Nothing of the law is solidem's. Radii, masses, moments of inertia and the velocities of the start
are those of the prepared specimen; stiffness and friction follow from YADE's own `FrictMat`, or from
tables of pairs of materials where there are tools (`rigid_tools`), or one stiffness for all.
"""

from __future__ import annotations

import math

import numpy as np
from motion import MotionScene, add_spheres
from prepared import Contact, Parameters, PreparedError, Specimen
from rigid_tools import RigidTools
from yade import (Bo1_Facet_Aabb, Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat,
                  Ig2_Facet_Sphere_ScGeom, Ig2_Sphere_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom,
                  InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_FrictPhys,
                  Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker, O, PyRunner, utils)


def _material(contact: Contact) -> FrictMat:
    if contact.restitution != 1:
        raise PreparedError("[contact] restitution: YADE's native law has no dashpot")
    # Its name notwithstanding, poisson is k_s / k_n. A young that is not asked for is for show.
    return FrictMat(young=contact.young_modulus or 1, poisson=contact.tangential_stiffness_ratio,
                    frictionAngle=math.atan(contact.friction), density=1)


def _one_stiffness(specimen: Specimen, contact: Contact) -> float:
    """k_n of all pairs of elements, N/m, which a table of materials takes."""
    if contact.normal_stiffness is not None:
        return contact.normal_stiffness
    radius = specimen.radius
    if contact.young_modulus is None or np.ptp(radius) > 1e-12 * float(radius.max()):
        raise PreparedError("[contact] beside [[tools]]: YADE takes one stiffness for a pair of "
                            "materials; give normal_stiffness, or elements of one radius")
    return contact.young_modulus * float(radius[0])


def _law_of_pairs(specimen: Specimen, parameters: Parameters) -> Ip2_FrictMat_FrictMat_FrictPhys:
    """Stiffness and friction of elements (material 0) and of each tool (1, 2, ...)."""
    contact, tools = parameters.contact, parameters.tools
    if contact.normal_stiffness is None and not tools:
        return Ip2_FrictMat_FrictMat_FrictPhys()
    normal = _one_stiffness(specimen, contact)
    rows = [(normal, contact.tangential_stiffness_ratio * normal, contact.friction)]
    rows += [(tool.stiffness, tool.tangential_stiffness, tool.friction) for tool in tools]

    def table(values: list[float]) -> MatchMaker:
        return MatchMaker(matches=[(0, k, value) for k, value in enumerate(values)])

    return Ip2_FrictMat_FrictMat_FrictPhys(
        kn=table([row[0] for row in rows]), ks=table([row[1] for row in rows]),
        frictAngle=table([math.atan(row[2]) for row in rows]))


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
        self.tools = RigidTools(specimen, parameters)
        O.engines = [
            ForceResetter(),
            InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb(), Bo1_Facet_Aabb()],
                                  verletDist=0.2 * float(specimen.radius.mean())),
            # Levers end at the middle of the overlap, and no granular ratcheting is undone.
            InteractionLoop([Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False),
                             Ig2_Wall_Sphere_ScGeom(noRatch=False), Ig2_Facet_Sphere_ScGeom()],
                            [_law_of_pairs(specimen, parameters)],
                            # Levers are those of spheres otherwise, of walls too.
                            [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
            PyRunner(iterPeriod=1, dead=not self.tools.have_edges,
                     command="scene.tools.check_edges()"),
            PyRunner(iterPeriod=1, nDo=2, initRun=True, command="scene.start_motion()"),
            PyRunner(iterPeriod=1, initRun=True, label="observer", command="scene.observe()"),
            self.newton(exactAsphericalRot=False),
        ]
        O.dt = parameters.time_step

    def run(self, steps: int) -> None:
        """Likewise; PreparedError where an element meets the side of two facets."""
        super().run(steps)
        if self.tools.fault:
            raise PreparedError(self.tools.fault)
