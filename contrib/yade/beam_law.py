# SPDX-License-Identifier: GPL-2.0-or-later
"""Beam bonds that flow and break: all bonds of a body at once, in numpy.

The law is that of solidem (standalone/laws/beam*.hpp), written a second time from its equations. It
needs no simulation program; `scripted_beams.py` runs it in YADE.

Symbols: x unit chord from i to j, L its length, l at rest; a_i, a_j normals of the end sections in
world axes, both x where the beam is free of load; w + u the relative orientation q_j q_i*, w >= 0;
A = E S, B = 2 E I, C = 2 E I / (1 + Φ), T = G I_0 the rigidities; e = L − l and φ = u·(a_i + a_j)
less what is plastic of them. The energy of a beam is

    U = [A e² + 3 C (|a_i − x|² + |a_j − x|²) − ½ (3 C − B) |a_j − a_i|² + T φ²] / 2 l

and its loads are the gradient of U. The equivalent strain at the edge of the middle section is

    ε = sqrt((|e| + r |a_j − a_i|)² + 3 (G/E r φ)²) / l.

Flow leaves the share p of the elastic deformation, in every mode alike: it moves the shape in which
the beam is free of load. Its work is ½ (Q_n + Q')·Δq, with Q_n and Q' the loads in the last pose and
after the flow. With the elastic deformations q_n in the last pose, q before and q' after the flow and
W(a, b) half of what the load of a does along b this is

    W(q_n, q) − W(q_n, q') + W(q, q') − W(q', q').

A bond that did not stand on the yield surface in the last pose reached it at the share s of the way from
there, s (ε − ε_n) = ε_y(κ) − ε_n: q_n is then q_n + s (q − q_n).

A bond that breaks still acts in the pose in which it does. What is lost is the energy that it has
there, less half of what its load does on the way to the next pose: W of its deformations in both.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from contrib.prepared import Beams, Plasticity, Rupture, Specimen

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


def _dot(a: Floats, b: Floats) -> Floats:
    return np.asarray(np.einsum("...k,...k->...", a, b))


def _norm(a: Floats) -> Floats:
    return np.sqrt(_dot(a, a))


def rotated(turn: Floats, vector: Floats, back: bool = False) -> Floats:
    """Vectors (B, 3) turned by unit quaternions (B, 4) = w, x, y, z; `back`: by their inverse."""
    w, v = turn[:, :1], -turn[:, 1:] if back else turn[:, 1:]
    across = 2 * np.cross(v, vector)
    return np.asarray(vector + w * across + np.cross(v, across))


def relative_turn(of_i: Floats, of_j: Floats) -> tuple[Floats, Floats]:
    """w (B,) and u (B, 3) of q_j q_i*, the one of both signs with w >= 0."""
    w = _dot(of_i, of_j)
    u = (of_i[:, :1] * of_j[:, 1:] - of_j[:, :1] * of_i[:, 1:]
         - np.cross(of_j[:, 1:], of_i[:, 1:]))
    sign = np.where(w < 0, -1.0, 1.0)
    return sign * w, sign[:, None] * u


def turn_of(of_i: Floats, of_j: Floats) -> Floats:
    """(B, 4) q_i* q_j, in body axes of i, the one of both signs with w >= 0."""
    w, u = relative_turn(of_i, of_j)
    return np.column_stack([w, rotated(of_i, u, back=True)])


@dataclass(frozen=True)
class Yield:
    """When bonds flow; strains are stresses over E."""

    strain: float  #: σ_y / E
    hardening_ratio: float = 0.0  #: H / E
    scaled_offset: bool = False  #: the law of Terreros 2013 instead of radial return


@dataclass
class Bonds:
    """What the bonds are (B of them)."""

    rigidity: Floats  #: (B, 4) A, B, C, T; N and N m²
    rest_length: Floats  #: (B,) m
    rest_direction: Floats  #: (B, 3) x at rest
    radius: Floats  #: (B,) m
    shear_ratio: Floats  #: (B,) G / E


@dataclass
class Modes:
    """How the bonds are deformed, elastically, as their energy sees it; in body axes of i."""

    lean_i: Floats  #: (B, 3) a_i − x
    lean_j: Floats  #: (B, 3) a_j − x
    extension: Floats  #: (B,) m
    twist: Floats  #: (B,) rad


@dataclass
class History:
    """What the bonds remember."""

    normal_i: Floats  #: (B, 3) in body axes of i
    normal_j: Floats  #: (B, 3) in body axes of j
    extension: Floats  #: (B,) plastic, m
    twist: Floats  #: (B,) plastic, rad
    strain: Floats  #: (B,) equivalent plastic strain
    last: Modes  #: elastic deformation in the last pose
    last_turn: Floats  #: (B, 4) quaternions by which j stood turned against i there, in axes of i


@dataclass
class Deformation:
    """How the bonds are deformed, elastically."""

    x: Floats
    length: Floats
    a_i: Floats
    a_j: Floats
    extension: Floats
    twist: Floats

    def modes(self, of_i: Floats) -> Modes:
        """The same as the energy sees it; orientations (B, 4) of i."""
        return Modes(rotated(of_i, self.a_i - self.x, back=True),
                     rotated(of_i, self.a_j - self.x, back=True), self.extension, self.twist)


@dataclass
class Response:
    """What the bonds do in a pose, and what they remember when it is kept."""

    force: Floats  #: (B, 3) on i; on j the reverse, N
    moment_i: Floats  #: (B, 3) N m
    moment_j: Floats  #: (B, 3) N m
    history: History
    strain: Floats  #: (B,) σ_e / E after any flow
    energy: Floats  #: (B,) elastic, after any flow, J
    plastic_work: Floats  #: (B,) of this flow, J
    breaks: Flags  #: (B,) broken from the next pose on
    shared: Floats  #: (B,) half of what the load in the last pose does along this deformation, J


class BeamLaw:
    """Bonds with their history. `respond` changes nothing; `keep` accepts a response."""

    def __init__(self, bonds: Bonds, flow: Yield | None = None,
                 largest_stress: float = np.inf, largest_strain: float = np.inf):
        """Bonds break when σ_e / E exceeds `largest_stress`, with the plastic strain
        `largest_strain`."""
        self.bonds, self.flow = bonds, flow
        self.largest_stress, self.largest_strain = largest_stress, largest_strain
        none = np.zeros(len(bonds.rest_length))
        still = np.zeros((len(none), 3))
        self.history = History(bonds.rest_direction.copy(), bonds.rest_direction.copy(), none,
                               none.copy(), none.copy(), Modes(still, still, none, none),
                               np.tile([1.0, 0, 0, 0], (len(none), 1)))
        self.intact: Flags = np.ones(len(none), dtype=bool)
        self.plastic_work = 0.0  #: so far, J
        self.fracture_energy = 0.0  #: lost by bonds that broke, J
        self._breaking: Flags = np.zeros(len(none), dtype=bool)  # in the last pose
        self._broke_with = 0.0  # energy of these then, J

    @property
    def broken(self) -> int:
        """Number of bonds that are no more."""
        return int((~self.intact).sum())

    def _deformation(self, chord: Floats, of_i: Floats, of_j: Floats,
                     history: History) -> Deformation:
        length = _norm(chord)
        a_i, a_j = rotated(of_i, history.normal_i), rotated(of_j, history.normal_j)
        _, u = relative_turn(of_i, of_j)
        return Deformation(chord / length[:, None], length, a_i, a_j,
                           length - self.bonds.rest_length - history.extension,
                           _dot(u, a_i + a_j) - history.twist)

    def _strain(self, d: Deformation) -> Floats:
        bonds = self.bonds
        edge = np.abs(d.extension) + bonds.radius * _norm(d.a_j - d.a_i)
        slip = bonds.shear_ratio * bonds.radius * d.twist
        return np.asarray(np.sqrt(edge**2 + 3 * slip**2) / bonds.rest_length)

    def _mutual(self, a: Modes, b: Modes) -> Floats:
        """Half of what the loads of one deformation do along another."""
        axial, bending, shear, torsion = self.bonds.rigidity.T
        leaning = _dot(a.lean_i, b.lean_i) + _dot(a.lean_j, b.lean_j)
        bent = _dot(a.lean_j - a.lean_i, b.lean_j - b.lean_i)
        return np.asarray((axial * a.extension * b.extension + 3 * shear * leaning
                           - 0.5 * (3 * shear - bending) * bent + torsion * a.twist * b.twist)
                          / (2 * self.bonds.rest_length))

    def _energy(self, d: Deformation) -> Floats:
        modes = Modes(d.a_i - d.x, d.a_j - d.x, d.extension, d.twist)
        return self._mutual(modes, modes)

    def _loads(self, d: Deformation, of_i: Floats,
               of_j: Floats) -> tuple[Floats, Floats, Floats]:
        per_length = self.bonds.rigidity / self.bonds.rest_length[:, None]
        axial, bending, shear, torsion = (column[:, None] for column in per_length.T)
        both = d.a_i + d.a_j
        across = both - _dot(both, d.x)[:, None] * d.x
        force = axial * d.extension[:, None] * d.x - 3 * shear / d.length[:, None] * across
        w, u = relative_turn(of_i, of_j)
        torque = 0.5 * torsion * d.twist[:, None] * (
            w[:, None] * both + np.cross(d.a_j - d.a_i, u))
        opening = 0.5 * (3 * shear - bending) * np.cross(d.a_i, d.a_j)
        return (force, 3 * shear * np.cross(d.a_i, d.x) - opening + torque,
                3 * shear * np.cross(d.a_j, d.x) + opening - torque)

    def _flow(self, elastic: Floats, whole: Floats) -> tuple[Floats, Floats, Floats]:
        """Share p that remains of the deformation, plastic and elastic strain afterwards."""
        flow, plastic = self.flow, self.history.strain
        if flow is None:
            return np.ones_like(elastic), plastic, elastic
        h = flow.hardening_ratio
        if flow.scaled_offset:
            # One monotonic curve of the strain since the bond was made; back along it, elastic.
            strain, reached = whole, flow.strain + (1 + h) * plastic
            stress, before = (flow.strain + h * whole) / (1 + h), np.zeros_like(plastic)
        else:
            strain, reached = elastic, flow.strain + h * plastic
            stress, before = (reached + h * elastic) / (1 + h), plastic
        flows = strain > reached
        fraction = np.where(flows, stress / np.where(flows, strain, 1), 1.0)
        return (fraction, np.where(flows, before + strain - stress, plastic),
                np.where(flows, stress, elastic))

    def respond(self, chord: Floats, of_i: Floats, of_j: Floats) -> Response:
        """Loads of chords (B, 3) from i to j and orientations (B, 4) = w, x, y, z of both ends."""
        old, bonds = self.history, self.bonds
        found = self._deformation(chord, of_i, of_j, old)
        elastic = self._strain(found)
        start = found
        if self.flow is not None and self.flow.scaled_offset:
            none = np.zeros_like(elastic)
            start = self._deformation(
                chord, of_i, of_j,
                replace(old, normal_i=bonds.rest_direction, normal_j=bonds.rest_direction,
                        extension=none, twist=none, strain=none))
        fraction, plastic, strain = self._flow(elastic, self._strain(start))
        flows = (plastic > old.strain) & self.intact

        def leant(normal: Floats, unmoved: Floats) -> Floats:
            moved = start.x + fraction[:, None] * (normal - start.x)
            return np.where(flows[:, None], moved / _norm(moved)[:, None], unmoved)

        a_i, a_j = leant(start.a_i, found.a_i), leant(start.a_j, found.a_j)
        left = Deformation(found.x, found.length, a_i, a_j,
                           np.where(flows, fraction * start.extension, found.extension),
                           np.where(flows, fraction * start.twist, found.twist))
        _, u = relative_turn(of_i, of_j)
        column = flows[:, None]
        energy = self._energy(left)
        history = History(
            np.where(column, rotated(of_i, a_i, back=True), old.normal_i),
            np.where(column, rotated(of_j, a_j, back=True), old.normal_j),
            np.where(flows, found.length - bonds.rest_length - left.extension, old.extension),
            np.where(flows, _dot(u, a_i + a_j) - left.twist, old.twist),
            np.where(flows, plastic, old.strain),
            left.modes(of_i), turn_of(of_i, of_j))
        loads = [np.where(self.intact[:, None], load, 0.0)
                 for load in self._loads(left, of_i, of_j)]
        return Response(
            *loads, history, strain, np.where(self.intact, energy, 0.0),
            self._work(found.modes(of_i), history, flows),
            self.intact & ((strain > self.largest_stress)
                           | (strain + history.strain > self.largest_strain)),
            self._mutual(old.last, found.modes(of_i)))

    def _work(self, before: Modes, after: History, flows: Flags) -> Floats:
        """Plastic work of a flow from an elastic deformation to another: by half of the load in the
        last pose, along what the flow means there, and half of that which is left."""
        left = after.last
        flown = Modes(before.lean_i - left.lean_i, before.lean_j - left.lean_j,
                      before.extension - left.extension, before.twist - left.twist)
        now, then = after.last_turn, self.history.last_turn
        of_j = rotated(then, rotated(now, flown.lean_j, back=True))
        twist = (flown.twist + _dot(then[:, 1:], flown.lean_i + of_j)
                 - _dot(now[:, 1:], flown.lean_i + flown.lean_j))
        flown_then = Modes(flown.lean_i, of_j, flown.extension, twist)
        return np.where(flows, self._mutual(self.history.last, flown_then)
                        + self._mutual(left, flown), 0.0)

    def keep(self, response: Response) -> None:
        """Accepts the pose that the response belongs to."""
        self.history = response.history
        self.plastic_work += float(response.plastic_work.sum())
        if self._breaking.any():
            still = float(response.shared[self._breaking].sum())
            self.fracture_energy += still - self._broke_with
        self._breaking = response.breaks
        self._broke_with = float(response.energy[response.breaks].sum())
        self.fracture_energy += self._broke_with
        self.intact &= ~response.breaks


def law_of(specimen: Specimen, beams: Beams, plasticity: Plasticity | None = None,
           rupture: Rupture | None = None) -> BeamLaw:
    """The law of a prepared specimen's bonds."""
    pairs, length = specimen.pairs, specimen.rest_length
    chord = specimen.position[pairs[:, 1]] - specimen.position[pairs[:, 0]]
    bonds = Bonds(beams.rigidity(specimen), length, chord / length[:, None],
                  beams.radius(specimen),
                  np.full(len(pairs), beams.shear_modulus / beams.young_modulus))
    flow = None if plasticity is None else Yield(
        plasticity.yield_strain, plasticity.hardening_ratio, plasticity.law == "scaled-offset")
    if rupture is None:
        return BeamLaw(bonds, flow)
    return BeamLaw(bonds, flow, rupture.elastic_strain, rupture.strain)


def turns(rotation: Floats) -> Floats:
    """Quaternions (B, 4) = w, x, y, z of rotation vectors (B, 3)."""
    half = 0.5 * _norm(rotation)
    return np.column_stack([np.cos(half), 0.5 * np.sinc(half / np.pi)[:, None] * rotation])


def path_loads(law: BeamLaw, position: Floats, motions: Floats) -> Floats:
    """(M, 4, 3) loads of one bond along a path, each pose kept: forces on i and j, moments on i and
    j. `position` (2, 3) at rest; `motions` (M, 4, 3) displacements and rotation vectors of i and j
    from rest."""
    loads = []
    for motion in motions:
        chord = position[1] + motion[1] - position[0] - motion[0]
        response = law.respond(chord[None], turns(motion[2:3]), turns(motion[3:4]))
        law.keep(response)
        loads.append([response.force[0], -response.force[0], response.moment_i[0],
                      response.moment_j[0]])
    return np.array(loads)
