# SPDX-License-Identifier: GPL-2.0-or-later
"""Units of what histories and cases name, for the axes of plots."""

from __future__ import annotations

import re

#: What a name ends with (its last word, or the component after it) and the unit; "" is a count or a
#: ratio.
UNITS = (
    (r"energy_balance|strain\d*|ratio|step|steps|elements|seed|broken_bonds|bonds_formed|removed"
     r"|removed_elements|interactions|crack_faces|largest_interpenetration", ""),
    (r".*energy|.*work|.*heat", "J"),
    (r"force(_[xyz])?", "N"),
    (r"(torque|moment)(_[xyz])?", "N m"),
    (r"(displacement|position)(_[xyz])?|mean_radius|spacing", "m"),
    (r"velocity(_[xyz])?", "m/s"),
    (r"time|time_step|duration", "s"),
    (r"temperature", "K"),
    (r".*stress|young_modulus", "Pa"),
)


def unit_of(name: str) -> str | None:
    """The unit of a column or value, "" for a count or a ratio; None when it is not known."""
    word = name.rsplit(".", 1)[-1]
    return next((unit for pattern, unit in UNITS if re.fullmatch(pattern, word)), None)


def with_unit(name: str) -> str:
    """A name for an axis: `grip.right.force_x` becomes `grip.right.force_x, N`."""
    unit = unit_of(name)
    return f"{name}, {unit}" if unit else name
