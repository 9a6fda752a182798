# SPDX-License-Identifier: GPL-2.0-or-later
"""Conduction along one coordinate through layers: bars, walls, annuli, contacts between bodies.

Fine finite volumes in space, exact in time (by the eigenvalues of the system).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from compare.result import Floats


@dataclass(frozen=True)
class Layer:
    """One homogeneous layer."""

    lower: float  #: m; of an annulus the inner radius
    upper: float  #: m
    conductivity: float  #: W/(m K)
    capacity: float  #: ρ c_p, J/(m³ K)


def layers_temperature(position: Floats, time: float, layers: Sequence[Layer], initial: float,
                       ends: tuple[float | None, float | None],
                       contacts: Sequence[float] = (), radial: bool = False, sink: float = 0.0,
                       cells: int = 1000) -> Floats:
    """Temperature, K, at positions, m, a time after the start, s.

    ends: temperature imposed at the lowest and the highest face, K; None is insulated.
    contacts: conductance between each layer and the next, W/(m² K); inf is perfect contact.
    radial: layers are rings of an annulus, not slabs.
    sink: ν² of a field that varies as sin(νφ) round an annulus and so loses λ ν²/r² T, W/m³.
    cells: of all layers together. The error falls with their square; at 1000 it is below 1e-6 of
    the temperature differences.
    """
    span = layers[-1].upper - layers[0].lower
    counts = [max(8, round(cells * (layer.upper - layer.lower) / span)) for layer in layers]
    edges = [np.linspace(layer.lower, layer.upper, n + 1) for layer, n in zip(layers, counts)]
    centre = np.concatenate([(e[1:] + e[:-1]) / 2 for e in edges])
    low = np.concatenate([e[:-1] for e in edges])
    high = np.concatenate([e[1:] for e in edges])
    conductivity = np.repeat([layer.conductivity for layer in layers], counts)
    volume = (high**2 - low**2) / 2 if radial else high - low
    heat = np.repeat([layer.capacity for layer in layers], counts) * volume

    def resistance(a: Floats, b: Floats) -> Floats:
        return (np.log(b / a) if radial else b - a) / conductivity

    to_low, to_high = resistance(low, centre), resistance(centre, high)
    between = to_high[:-1] + to_low[1:]
    joints = np.cumsum(counts)[:-1] - 1
    for joint, conductance in zip(joints, contacts, strict=True):
        between[joint] += 1 / (conductance * (high[joint] if radial else 1.0))
    matrix = np.diag(sink * conductivity * volume / centre**2)
    here = np.arange(len(between))
    matrix[here, here] += 1 / between
    matrix[here + 1, here + 1] += 1 / between
    matrix[here, here + 1] = matrix[here + 1, here] = -1 / between
    gain = np.zeros(len(centre))
    for cell, value, path in ((0, ends[0], to_low[0]), (-1, ends[1], to_high[-1])):
        if value is not None:
            matrix[cell, cell] += 1 / path
            gain[cell] += value / path
    root = np.sqrt(heat)
    rate, wave = np.linalg.eigh(matrix / np.multiply.outer(root, root))
    rate = np.maximum(rate, 0.0)
    grown = np.where(rate * time > 1e-12, -np.expm1(-rate * time) / np.where(rate > 0, rate, 1.0),
                     time)
    found = wave @ (np.exp(-rate * time) * (wave.T @ (initial * root))
                    + grown * (wave.T @ (gain / root))) / root
    return _interpolate(np.asarray(position, dtype=float), edges, centre, found, ends)


def _interpolate(position: Floats, edges: list[Floats], centre: Floats, found: Floats,
                 ends: tuple[float | None, float | None]) -> Floats:
    """Values inside each layer, linear between centres and on to the layer's faces."""
    values = np.empty(position.shape)
    start = 0
    for n, edge in enumerate(edges):
        stop = start + len(edge) - 1
        x, t = centre[start:stop], found[start:stop]
        # At a contact the line through the last two centres goes on to the face.
        low, high = 1.5 * t[0] - 0.5 * t[1], 1.5 * t[-1] - 0.5 * t[-2]
        if n == 0:  # held, or insulated: no slope at the face
            low = (9 * t[0] - t[1]) / 8 if ends[0] is None else ends[0]
        if n == len(edges) - 1:
            high = (9 * t[-1] - t[-2]) / 8 if ends[1] is None else ends[1]
        inside = (position >= edge[0]) if n else np.ones(position.shape, dtype=bool)
        values[inside] = np.interp(position[inside], np.r_[edge[0], x, edge[-1]],
                                   np.r_[low, t, high])
        start = stop
    return values
