# SPDX-License-Identifier: GPL-2.0-or-later
"""Elastic beam bonds by YADE's native cohesive-frictional law with moments.

With every sphere of the same `shape.radius` the contact point lies at mid-length; an elastic spring
there with  kn = E S/l, ks = 12 E I/((1 + Φ) l³) (translations), kr = E I/l, ktw = G I_0/l
(rotations)  has the stiffness matrix of the Timoshenko beam between the two centres, with Φ = 0 that
of the Euler–Bernoulli beam; a plain spring has kn alone. YADE integrates shear force and moments
step by step, so it agrees with a total (co-rotational) form to first order in strain.
"""

from __future__ import annotations

import numpy as np
from motion import MotionScene, add_spheres
from prepared import Beams, Parameters, Specimen
from yade import (CohFrictMat, Engine, ForceResetter, Ig2_Sphere_Sphere_ScGeom6D, InteractionLoop,
                  Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
                  Law2_ScGeom6D_CohFrictPhys_CohesionMoment, O, PyRunner, utils)

#: Adhesion that never breaks, N.
UNBREAKABLE = 1e300


def _add_bodies(specimen: Specimen) -> None:
    inertia = specimen.column("mechanics/inertia")
    material = O.materials.append(
        CohFrictMat(young=1, poisson=1, density=1, frictionAngle=0, isCohesive=True,
                    momentRotationLaw=True))
    # One common radius puts the contact point at mid-length, and makes every bonded pair overlap:
    # YADE drops an interaction that does not.
    common = float(specimen.rest_length.max()) if len(specimen.pairs) else specimen.radius.max()
    add_spheres(specimen, np.full(len(specimen.radius), common), material)
    for body, j in zip(O.bodies, inertia.tolist()):
        body.state.inertia = (j, j, j)


def _add_bonds(specimen: Specimen, beams: Beams) -> None:
    length = specimen.rest_length
    axial, bending, shear, torsion = (beams.rigidity(specimen) / length[:, None]).T
    stiffness = np.stack([axial, 6 * shear / length**2, bending / 2, torsion], axis=1)
    for (i, j), (kn, ks, kr, ktw) in zip(specimen.pairs.tolist(), stiffness.tolist()):
        interaction = utils.createInteraction(i, j)
        physics = interaction.phys
        physics.kn, physics.ks, physics.kr, physics.ktw = kn, ks, kr, ktw
        physics.normalAdhesion = physics.shearAdhesion = UNBREAKABLE
        physics.maxRollPl = physics.maxTwistPl = -1
        physics.momentRotationLaw = True
        physics.fragile = physics.cohesionBroken = False
        physics.unpMax = -1
        physics.unp = interaction.geom.penetrationDepth


class BeamScene(MotionScene):
    """A beam-bonded body in YADE, ready to run."""

    def __init__(self, specimen: Specimen, parameters: Parameters, incremental: bool = False):
        """`incremental` chooses YADE's faster step-by-step moments instead of total rotations."""
        if parameters.beams is None:
            raise ValueError("the scene has no beams")
        super().__init__(specimen, parameters)
        _add_bodies(specimen)
        self._add_beams(parameters.beams, incremental)

    def _add_beams(self, beams: Beams, incremental: bool) -> None:
        """YADE's own law between the bodies."""
        self._add_engines(InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False,
                                        interactionDetectionFactor=3,
                                        updateRotations=not incremental)],
            [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(neverErase=True,
                                                       always_use_moment_law=True,
                                                       useIncrementalForm=incremental)]))
        _add_bonds(self.specimen, beams)

    def _add_engines(self, loads: Engine) -> None:
        """A time step, in which `loads` gives the loads of the present pose."""
        O.engines = [
            ForceResetter(),
            loads,
            # Motion imposed before the first look at the bonds would count as a shear of its own.
            PyRunner(iterPeriod=1, nDo=2, initRun=True, command="scene.start_motion()"),
            PyRunner(iterPeriod=1, initRun=True, label="observer",
                     command="scene.observe()"),
            self.newton(exactAsphericalRot=False),
        ]
        O.dt = self.parameters.time_step
