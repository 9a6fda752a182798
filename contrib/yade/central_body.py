# SPDX-License-Identifier: GPL-2.0-or-later
"""A body whose elements interact by central forces: neighbours that change, cracks, removals; numpy.

Written a second time from what docs/scene.md says of [central_forces] and [damage]; needs no
simulation program. `scripted_central_forces.py` runs it in YADE.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from contrib.yade.central_law import Interaction
    from contrib.prepared import CentralForces, Damage, Specimen

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: Half of the cells that touch a cell, and itself.
_FORWARD = [(0, 0, 0), *((a, b, c) for a in (0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)
                         if (a, b, c) > (0, 0, 0))]


def near_pairs(position: Floats, reach: Floats) -> Integers:
    """(P, 2) pairs i < j nearer than reach_i + reach_j, sorted; by linked cells."""
    size = 2 * float(reach.max())
    cell = np.floor((position - position.min(axis=0)) / size).astype(np.int64) + 1
    shape = cell.max(axis=0) + 2
    stride = np.array([shape[1] * shape[2], shape[2], 1])
    key = cell @ stride
    order = np.argsort(key, kind="stable")
    ranked, everyone = key[order], np.arange(len(key))
    found = []
    for offset in _FORWARD:
        target = key + np.array(offset) @ stride
        first, last = (np.searchsorted(ranked, target, side) for side in ("left", "right"))
        count = last - first
        i = np.repeat(everyone, count)
        place = np.arange(len(i)) - np.repeat(np.cumsum(count) - count - first, count)
        j = order[place]
        keep = i < j if offset == (0, 0, 0) else np.ones(len(i), dtype=bool)
        found.append(np.stack([i[keep], j[keep]], axis=1))
    pairs = np.sort(np.concatenate(found), axis=1)
    chord = position[pairs[:, 1]] - position[pairs[:, 0]]
    near = np.einsum("ij,ij->i", chord, chord) < reach[pairs].sum(axis=1) ** 2
    pairs = pairs[near]
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


@dataclass
class Response:
    """What the pairs of a body do in a pose."""

    force: Floats  #: (N, 3) on the elements, N
    dissipation: float  #: power of the dissipation, W
    interaction: Interaction
    distance: Floats  #: (P,) of the pairs within the range, m
    equilibrium: Floats  #: (P,) m
    limit: Floats  #: (P,) m

    @property
    def interactions(self) -> int:
        """Pairs within the range."""
        return len(self.distance)

    @property
    def potential(self) -> float:
        """Energy of all pairs, J; of crack faces that only push, as if they attracted, too."""
        return float(self.interaction.potential(self.distance, self.equilibrium, self.limit).sum())


class CentralBody:
    """A body whose elements interact by central forces, with its neighbours, crack faces and removals."""

    def __init__(self, specimen: Specimen, interaction: Interaction, forces: CentralForces,
                 damage: Damage | None = None):
        """The start: `specimen.pairs` are the pairs that keep their distance as equilibrium."""
        self.interaction, self.forces, self.damage = interaction, forces, damage
        self.radius = specimen.radius
        self.skin = forces.skin * float(specimen.radius.mean())
        self.initial_pairs, self._initial_key = specimen.pairs, self._key(specimen.pairs)
        self._initial_order = np.argsort(self._initial_key)
        self.rest_length = specimen.rest_length
        count = len(specimen.radius)
        self.removed: Flags = np.zeros(count, dtype=bool)
        self.barycentre: Floats = np.zeros((count, 3))  #: of crack faces, from the element, m; else 0
        self.deepest = 0.0  #: largest (δ_eq − δ)/δ_eq so far
        self.rebuilds = 0
        self._listed_at: Floats | None = None
        self._neighbours_at_start: Integers | None = None

    @property
    def crack_faces(self) -> Flags:
        """(N,) elements that stand on the face of a crack."""
        return np.asarray((self.barycentre != 0).any(axis=1))

    def _key(self, pairs: Integers) -> Integers:
        return np.asarray(pairs[:, 0] * len(self.radius) + pairs[:, 1])

    def _list(self, position: Floats) -> None:
        """Lists the pairs that may interact before an element has moved by half the skin."""
        if self.forces.neighbours == "fixed":
            self._pairs = self.initial_pairs
        else:
            self._pairs = near_pairs(position, self.forces.range * self.radius + 0.5 * self.skin)
        self._pairs = self._pairs[~self.removed[self._pairs].any(axis=1)]
        together = self.radius[self._pairs].sum(axis=1)
        self._limit = self.forces.range * together
        self._equilibrium = together.copy()
        if self.forces.equilibrium == "initial" and len(self._initial_key):
            key, order = self._key(self._pairs), self._initial_order
            place = order[np.searchsorted(self._initial_key[order], key).clip(0, len(order) - 1)]
            known = self._initial_key[place] == key
            self._equilibrium[known] = self.rest_length[place[known]]
        self._listed_at = position.copy()
        self.rebuilds += 1

    def _chords(self, position: Floats) -> tuple[Integers, Integers, Floats, Floats]:
        """i, j, chord from i to j and distance of the listed pairs."""
        if self._listed_at is None or (((position - self._listed_at) ** 2).sum(axis=1).max()
                                       > (0.5 * self.skin) ** 2):
            self._list(position)
        i, j = self._pairs.T
        chord = position[j] - position[i]
        return i, j, chord, np.sqrt(np.einsum("ij,ij->i", chord, chord))

    def _sum(self, i: Integers, j: Integers, on_i: Floats, on_j: Floats) -> Floats:
        """(N, 3) sums of what pairs give to both ends."""
        count = len(self.radius)
        return np.stack([np.bincount(i, on_i[:, axis], count) + np.bincount(j, on_j[:, axis], count)
                         for axis in range(3)], axis=1)

    def _neighbours(self, i: Integers, j: Integers, within: Flags) -> Integers:
        count = len(self.radius)
        return np.asarray(np.bincount(i[within], minlength=count)
                          + np.bincount(j[within], minlength=count))

    def _remove(self, neighbours: Integers) -> Flags:
        """Removes elements that lost neighbours and keep too few; those that went now."""
        assert self.damage is not None and self._neighbours_at_start is not None
        isolated = ((neighbours < self.damage.minimal_neighbours)
                  & (neighbours < self._neighbours_at_start) & ~self.removed)
        self.removed |= isolated
        return np.asarray(isolated)

    def _look_for_crack_faces(self, i: Integers, j: Integers, chord: Floats, within: Flags) -> None:
        assert self.damage is not None and self.damage.crack_threshold is not None
        total = self._sum(i[within], j[within], chord[within], -chord[within])
        mean = total / np.maximum(self._neighbours(i, j, within), 1)[:, None]
        on_face = np.sqrt((mean**2).sum(axis=1)) > self.damage.crack_threshold * self.radius
        self.barycentre = np.where(on_face[:, None], mean, 0.0)

    def _crack(self, step: int, i: Integers, j: Integers, chord: Floats, distance: Floats) -> Flags:
        """Removals and crack faces that are due; whether each pair still counts."""
        damage, within = self.damage, distance < self._limit
        here = np.ones(len(i), dtype=bool)
        if damage is None:
            return here
        if damage.minimal_neighbours:
            if self._neighbours_at_start is None:
                self._neighbours_at_start = self._neighbours(i, j, within)
            elif step % damage.removal_every == 0 and self._remove(
                    self._neighbours(i, j, within)).any():
                here = ~self.removed[i] & ~self.removed[j]
                self._listed_at = None
        if damage.crack_threshold is not None and step % damage.every == 0:
            self._look_for_crack_faces(i, j, chord, within & here)
        return here

    def respond(self, step: int, position: Floats, velocity: Floats | None = None) -> Response:
        """Forces of places (N, 3) at a step, which come in turn; velocities (N, 3) are needed where
        there is dissipation."""
        i, j, chord, distance = self._chords(position)
        here = self._crack(step, i, j, chord, distance)
        within = here & (distance < self._limit)
        i, j, chord, distance = i[within], j[within], chord[within], distance[within]
        equilibrium, limit = self._equilibrium[within], self._limit[within]
        force = self.interaction.force(distance, equilibrium, limit)
        if self.damage is not None and self.damage.crack_threshold is not None:
            apart = ((np.einsum("ij,ij->i", self.barycentre[i], chord) < 0)
                     & (np.einsum("ij,ij->i", self.barycentre[j], chord) > 0))
            force = np.where(apart, np.maximum(force, 0.0), force)
        dissipation, coefficient = 0.0, self.forces.dissipation
        if coefficient:
            if velocity is None:
                raise ValueError("dissipation needs velocities")
            parting = np.einsum("ij,ij->i", chord, velocity[j] - velocity[i]) / distance
            force = force - coefficient * parting
            dissipation = float((coefficient * parting**2).sum())
        if len(distance):
            self.deepest = max(self.deepest, float((1 - distance / equilibrium).max()))
        on_j = (force / distance)[:, None] * chord
        return Response(self._sum(i, j, -on_j, on_j), dissipation, self.interaction, distance,
                        equilibrium, limit)
