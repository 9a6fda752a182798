# SPDX-License-Identifier: GPL-2.0-or-later
"""One beam: elastic loads, yield."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from compare.result import Floats


def beam_stiffness(chord: Sequence[float] | Floats, radius: float, young_modulus: float,
                   shear_modulus: float, shear_coefficient: float = np.inf) -> Floats:
    """(12, 12) stiffness matrix of a Timoshenko beam of circular section, textbook form.

    `shear_coefficient` κ: the shear force is κ G S times the shear angle; infinite for an
    Euler–Bernoulli beam.
    Unknowns: displacement of i, of j (m), rotation of i, of j (rad); loads in the same order are
    those that must act on the ends, N and N·m.
    """
    chord = np.asarray(chord, dtype=float)
    length = float(np.linalg.norm(chord))
    area, second = np.pi * radius**2, np.pi * radius**4 / 4
    ea, ei, gj = young_modulus * area, young_modulus * second, shear_modulus * 2 * second
    local = np.zeros((12, 12))
    u_i, u_j, r_i, r_j = (np.arange(3) + 3 * n for n in range(4))

    def add(rows: Sequence[int], block: Floats) -> None:
        local[np.ix_(rows, rows)] += block

    line = np.array([[1.0, -1.0], [-1.0, 1.0]])
    add([u_i[0], u_j[0]], ea / length * line)
    add([r_i[0], r_j[0]], gj / length * line)
    for across, turn, sign in ((1, 2, 1.0), (2, 1, -1.0)):
        slack = 12 * ei / (shear_coefficient * shear_modulus * area * length**2)
        unit = ei / length / (1 + slack)
        k, b = 12 * unit / length**2, sign * 6 * unit / length
        near, far = (4 + slack) * unit, (2 - slack) * unit
        add([u_i[across], r_i[turn], u_j[across], r_j[turn]],
            np.array([[k, b, -k, b], [b, near, -b, far], [-k, -b, k, -b], [b, far, -b, near]]))
    x = chord / length
    helper = np.eye(3)[int(np.argmin(np.abs(x)))]
    y = np.cross(helper, x)
    y /= np.linalg.norm(y)
    axes = np.stack([x, y, np.cross(x, y)])
    turn_all = np.kron(np.eye(4), axes)
    return turn_all.T @ local @ turn_all


def spring_stiffness(chord: Sequence[float] | Floats, radius: float,
                     young_modulus: float) -> Floats:
    """(12, 12) stiffness matrix of a rod that resists stretching alone; unknowns as above."""
    chord = np.asarray(chord, dtype=float)
    length = float(np.linalg.norm(chord))
    block = young_modulus * np.pi * radius**2 / length**3 * np.outer(chord, chord)
    matrix = np.zeros((12, 12))
    matrix[:6, :6] = np.block([[block, -block], [-block, block]])
    return matrix


def bilinear_stress(strain: Floats, yield_strain: float, hardening_ratio: float) -> Floats:
    """Stress over E of a material that yields, then hardens by H = h E per plastic strain."""
    slope = hardening_ratio / (1 + hardening_ratio)
    return np.where(strain < yield_strain, strain, yield_strain + slope * (strain - yield_strain))


def cyclic_stress(strain: Floats, yield_strain: float, hardening_ratio: float) -> Floats:
    """Stress over E along a path of strains, each step flowing to the yield surface that grows with
    the plastic strain, alike in both directions (isotropic hardening)."""
    plastic, amount, found = 0.0, 0.0, []
    for value in strain:
        trial = value - plastic
        over = abs(trial) - yield_strain - hardening_ratio * amount
        if over > 0:
            step = over / (1 + hardening_ratio)
            plastic, amount = plastic + np.sign(trial) * step, amount + step
        found.append(value - plastic)
    return np.array(found)


def scaled_offset_stress(strain: Floats, yield_strain: float, hardening_ratio: float) -> Floats:
    """Stress over E along a path of strains by the scaled offset of Terreros 2013: where the strain
    is the largest so far, the monotonic curve in its direction; elsewhere elastic with the offset
    that was left there."""
    largest, offset, found = yield_strain, 0.0, []
    for value in strain:
        if abs(value) > largest:
            largest = abs(value)
            stress = bilinear_stress(np.array(largest), yield_strain, hardening_ratio)
            offset = np.sign(value) * (largest - float(stress))
        found.append(value - offset)
    return np.array(found)
