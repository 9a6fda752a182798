# SPDX-License-Identifier: GPL-2.0-or-later
"""A specimen of solidem, with its bonds, in a YADE script of your own.

    from bonded import Bonds, add_specimen, engines, stable_step
    bonds = Bonds(young_modulus=70e9, shear_modulus=27e9, radius_ratio=0.5, density=2700)
    ids = add_specimen("specimen.h5", bonds)
    O.engines, O.dt = engines(gravity=(0, 0, -9.81)), stable_step()
    O.run(1000, True)

Bonds and contacts are YADE's own. A bond is an interaction of the cohesive-frictional law with
moments, of the stiffness of a beam between the two centres, free of load where it is made. What is
not bonded touches by the same law without cohesion; walls, facets and any sphere of another material by
`Law2_ScGeom_FrictPhys_CundallStrack`.

YADE puts the spring where two spheres touch, which is the middle of the beam for equal radii; for radii
that differ by a tenth the beam's shear is off by a few per cent. `beams.py` is exact there, but its
spheres all have one radius and touch nothing.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from prepared import Beams, Floats, Specimen, read_specimen  # noqa: E402
from yade import (Bo1_Facet_Aabb, Bo1_Sphere_Aabb, Bo1_Wall_Aabb, CohFrictMat,  # noqa: E402
                  ForceResetter, Ig2_Facet_Sphere_ScGeom, Ig2_Sphere_Sphere_ScGeom6D,
                  Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_CohFrictMat_CohFrictMat_CohFrictPhys, Ip2_FrictMat_FrictMat_FrictPhys,
                  Law2_ScGeom6D_CohFrictPhys_CohesionMoment, Law2_ScGeom_FrictPhys_CundallStrack,
                  NewtonIntegrator, O, utils)

#: Adhesion that never breaks, N.
UNBREAKABLE = 1e300
#: Label of the engine that knows bonds and contacts.
LOOP = "bonds_and_contacts"
#: A pair whose gap is less than this part of its radii stays known to YADE.
GAP = 0.2


@dataclass(frozen=True)
class Bonds:
    """What the bonds, and the spheres between them, are made of."""

    young_modulus: float  #: E of the beams, Pa
    shear_modulus: float  #: G of the beams, Pa
    radius_ratio: float  #: of a beam over the mean radius of its two spheres
    density: float  #: of the body, kg/m³
    tensile_strength: float = math.inf  #: tension over the beam's section that breaks it, Pa
    shear_strength: float = math.inf  #: the same of the shear force
    friction_angle: float = 0.5  #: of contacts, rad
    shear_to_normal: float = 0.4  #: stiffness of contacts

    def beams(self, specimen: Specimen) -> Beams:
        return Beams(self.young_modulus, self.shear_modulus, self.radius_ratio, "pair",
                     float(specimen.radius.mean()))

    def material(self) -> CohFrictMat:
        """What contacts follow from: between equal spheres as stiff as the beam, E S/l."""
        young = 0.5 * math.pi * self.radius_ratio**2 * self.young_modulus
        return CohFrictMat(young=young, poisson=self.shear_to_normal, density=self.density,
                           frictionAngle=self.friction_angle, isCohesive=False,
                           momentRotationLaw=True, label="bonded")


def add_specimen(path: str | Path, bonds: Bonds, move: tuple[float, float, float] = (0, 0, 0),
                 velocity: tuple[float, float, float] = (0, 0, 0)) -> list[int]:
    """Adds spheres and bonds of a specimen file to YADE's scene; the ids of the spheres.

    `move`: by which it is moved, m. The masses of the spheres sum to the body's, where the file knows
    its volume.
    """
    specimen = read_specimen(path)
    if any(specimen.periodic):
        raise ValueError(f"{path}: periodic bodies are not supported in YADE")
    material = O.materials.append(bonds.material())
    ids = O.bodies.append([utils.sphere(p, r, material=material) for p, r in
                           zip((specimen.position + move).tolist(), specimen.radius.tolist())])
    for index, mass, radius in zip(ids, _masses(specimen, bonds).tolist(),
                                   specimen.radius.tolist()):
        state = O.bodies[index].state
        state.mass, state.vel = mass, velocity
        state.inertia = (0.4 * mass * radius**2,) * 3
    _loop()  # YADE makes interactions with the functors of the engines in use
    for pair, stiffness, section in zip(specimen.pairs.tolist(), _stiffness(specimen, bonds),
                                        _sections(specimen, bonds)):
        _bond(ids[pair[0]], ids[pair[1]], stiffness, section, bonds)
    return ids


def _masses(specimen: Specimen, bonds: Bonds) -> Floats:
    """(N,) kg."""
    spheres = 4 / 3 * np.pi * specimen.radius**3
    share = specimen.volume / spheres.sum() if specimen.volume > 0 else 1.0
    return bonds.density * share * spheres


def _stiffness(specimen: Specimen, bonds: Bonds) -> Any:
    """(B, 4) kn and ks, N/m, kr and ktw, N·m."""
    length = specimen.rest_length
    axial, bending, shear, torsion = (bonds.beams(specimen).rigidity(specimen)
                                      / length[:, None]).T
    return np.stack([axial, 6 * shear / length**2, bending / 2, torsion], axis=1).tolist()


def _sections(specimen: Specimen, bonds: Bonds) -> Any:
    """(B,) m²."""
    return (np.pi * bonds.beams(specimen).radius(specimen) ** 2).tolist()


def _bond(i: int, j: int, stiffness: list[float], section: float, bonds: Bonds) -> None:
    interaction = utils.createInteraction(i, j)
    physics = interaction.phys
    physics.kn, physics.ks, physics.kr, physics.ktw = stiffness
    physics.normalAdhesion = min(UNBREAKABLE, bonds.tensile_strength * section)
    physics.shearAdhesion = min(UNBREAKABLE, bonds.shear_strength * section)
    physics.maxRollPl = physics.maxTwistPl = -1
    physics.momentRotationLaw = physics.fragile = True
    physics.cohesionBroken = False
    physics.unpMax = -1
    physics.unp = interaction.geom.penetrationDepth


def _loop() -> None:
    """Puts bonds and contacts of the spheres, of walls and of facets in the place of YADE's engines,
    once."""
    if any(engine.label == LOOP for engine in O.engines):
        return
    loop = InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False,
                                    interactionDetectionFactor=1 + GAP),
         Ig2_Facet_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(), Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=False),
         Law2_ScGeom_FrictPhys_CundallStrack()], label=LOOP)
    O.engines = [ForceResetter(),
                 InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1 + GAP),
                                        Bo1_Facet_Aabb(), Bo1_Wall_Aabb()]), loop]


def engines(gravity: tuple[float, float, float] = (0, 0, 0), damping: float = 0.0) -> list[Any]:
    """A step of bonds, contacts, walls, facets and motion; put your own engines before the last."""
    _loop()
    known = [engine for engine in O.engines if not isinstance(engine, NewtonIntegrator)]
    return [*known, NewtonIntegrator(gravity=gravity, damping=damping)]


def stable_step(ratio: float = 0.3) -> float:
    """This part of the least sqrt(m/kn), sqrt(J/kr), sqrt(J/ktw) of all bonds, s."""
    least = math.inf
    for interaction in O.interactions:
        physics = interaction.phys
        if not hasattr(physics, "unp"):
            continue
        states = [O.bodies[k].state for k in (interaction.id1, interaction.id2)]
        mass, inertia = min(s.mass for s in states), min(s.inertia[0] for s in states)
        for held, stiffness in ((mass, physics.kn), (inertia, physics.kr), (inertia, physics.ktw)):
            if stiffness > 0:
                least = min(least, math.sqrt(held / stiffness))
    if not math.isfinite(least):
        raise ValueError("no bonds: nothing bounds the time step")
    return ratio * least
