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
from prepared import Beams, Floats, Parameters, Specimen
from results import Recorder
from visible import make_visible
from yade import (CohFrictMat, Engine, ForceResetter, Ig2_Sphere_Sphere_ScGeom6D, InteractionLoop,
                  Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
                  Law2_ScGeom6D_CohFrictPhys_CohesionMoment, NewtonIntegrator, O, PyRunner, utils)
from yade import _utils

#: Adhesion that never breaks, N.
UNBREAKABLE = 1e300


def bulk_positions() -> Floats:
    """(N, 3) positions of all bodies, m."""
    columns = [_utils.coordsAndDisplacements(axis)[0] for axis in range(3)]
    return np.array(columns, dtype=float).T


def _add_bodies(specimen: Specimen) -> None:
    mass, inertia = specimen.column("mechanics/mass"), specimen.column("mechanics/inertia")
    material = O.materials.append(
        CohFrictMat(young=1, poisson=1, density=1, frictionAngle=0, isCohesive=True,
                    momentRotationLaw=True))
    # One common radius puts the contact point at mid-length, and makes every bonded pair overlap:
    # YADE drops an interaction that does not.
    common = float(specimen.rest_length.max()) if len(specimen.pairs) else specimen.radius.max()
    O.bodies.append([utils.sphere(p, common, material=material)
                     for p in specimen.position.tolist()])
    for body, m, j in zip(O.bodies, mass.tolist(), inertia.tolist()):
        body.state.mass, body.state.inertia = m, (j, j, j)


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


class BeamScene:
    """A beam-bonded body in YADE, ready to run; one at a time (YADE has one global scene)."""

    def __init__(self, specimen: Specimen, parameters: Parameters, incremental: bool = False):
        """`incremental` chooses YADE's faster step-by-step moments instead of total rotations."""
        if parameters.beams is None:
            raise ValueError("the scene has no beams")
        if any(specimen.periodic):
            raise ValueError(f"{specimen.path}: periodic bodies are not supported in YADE")
        O.reset()
        make_visible(self)
        self.specimen, self.parameters = specimen, parameters
        self.recorder: Recorder | None = None
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
            PyRunner(iterPeriod=1, nDo=1, initRun=True, command="scene.start_motion()"),
            PyRunner(iterPeriod=1, initRun=True, label="observer",
                     command="scene.observe()"),
            NewtonIntegrator(damping=0, gravity=(0, 0, 0), exactAsphericalRot=False),
        ]
        O.dt = self.parameters.time_step

    def start_motion(self) -> None:
        """Blocks what the grips hold and sets their velocities."""
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
            # What the grip does to the body balances what the bonds do to the grip.
            force = -np.sum([list(O.forces.f(i)) for i in elements], axis=0)
            moved = np.array(list(O.bodies[elements[0]].state.displ()))
            for axis, name in enumerate("xyz"):
                row[f"grip.{grip.name}.force_{name}"] = float(force[axis])
                row[f"grip.{grip.name}.displacement_{name}"] = float(moved[axis])
        return row

    def _frame(self) -> dict[str, Floats]:
        return {"position": bulk_positions()}

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        observer = next(e for e in O.engines if e.label == "observer")
        observer.iterPeriod = self.recorder.period if self.recorder else steps
        O.run(steps + 1, True)
