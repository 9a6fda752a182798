# SPDX-License-Identifier: GPL-2.0-or-later
"""One elastic beam."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from compare.result import Floats


def beam_stiffness(chord: Sequence[float] | Floats, radius: float, young_modulus: float,
                   shear_modulus: float) -> Floats:
    """(12, 12) stiffness matrix of an Euler–Bernoulli beam of circular section, textbook form.

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
        b = sign * 6 * ei / length**2
        k, m = 12 * ei / length**3, 2 * ei / length
        add([u_i[across], r_i[turn], u_j[across], r_j[turn]],
            np.array([[k, b, -k, b], [b, 2 * m, -b, m], [-k, -b, k, -b], [b, m, -b, 2 * m]]))
    x = chord / length
    helper = np.eye(3)[int(np.argmin(np.abs(x)))]
    y = np.cross(helper, x)
    y /= np.linalg.norm(y)
    axes = np.stack([x, y, np.cross(x, y)])
    turn_all = np.kron(np.eye(4), axes)
    return turn_all.T @ local @ turn_all
