# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields of the frames of a trajectory, by the names that pictures and profiles know them by."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import InputError

Array = npt.NDArray[Any]

#: Names of the columns of a field, by their number: a vector, a quaternion, a symmetric tensor, a tensor.
COMPONENTS = {
    3: ("x", "y", "z"),
    4: ("w", "x", "y", "z"),
    6: ("xx", "yy", "zz", "xy", "yz", "xz"),
    9: ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"),
}


def place_of(frame: Any, rest: Array) -> Array:
    """Where the elements are; where nothing moves frames do not tell."""
    return np.asarray(frame["position"][:]) if "position" in frame else rest


def mean_of_bonds(values: Array, pairs: Array, count: int) -> Array:
    """Of each element over its bonds; 0 where it has none."""
    ends = pairs.ravel()
    bonds = np.bincount(ends, minlength=count)
    return np.asarray(np.bincount(ends, np.repeat(values, 2), count) / np.maximum(bonds, 1))


def names_of(name: str, dataset: Any) -> list[str]:
    """What a dataset shows: itself, where it has one column; its length and its components, where it is
    a vector; else its components."""
    if len(dataset.shape) == 1:
        return [name]
    components = [f"{name}_{of}" for of in COMPONENTS.get(dataset.shape[1], ())]
    return [name, *components] if dataset.shape[1] == 3 else components


def fields_of(frame: Any, has_bonds: bool) -> list[str]:
    """Names that there are in a frame."""
    found: set[str] = set()
    for name in frame:
        if name not in ("bonds", "tools", "position", "velocity"):
            found.update(names_of(name, frame[name]))
    if "position" in frame:
        found.update(["displacement", *(f"displacement_{axis}" for axis in "xyz")])
    if "velocity" in frame:
        found.add("speed")
    if has_bonds and "bonds" in frame:
        for name in frame["bonds"]:
            found.update(names_of(f"bonds/{name}", frame["bonds"][name]))
    return sorted(found)


def column_of(frame: Any, name: str) -> Array:
    """A column of a dataset, or the length of a vector."""
    if name in frame:
        values = np.asarray(frame[name][:], float)
        return values if values.ndim == 1 else np.asarray(np.linalg.norm(values, axis=1))
    whole, component = name.rsplit("_", 1)
    values = np.asarray(frame[whole][:], float)
    return np.asarray(values[:, COMPONENTS[values.shape[1]].index(component)])


def field_of(frame: Any, name: str, rest: Array, pairs: Array) -> Array:
    """A number for each element, in SI units; of what bonds have, the mean over an element's. `rest`:
    where elements are at rest; `pairs`: the bonds, (0, 2) where none are drawn. InputError names the
    fields that there are."""
    known = fields_of(frame, len(pairs) > 0)
    if name not in known:
        raise InputError(f"field {name}: none of this run; there are {', '.join(known)}")
    if name == "speed":
        return np.asarray(np.linalg.norm(frame["velocity"][:], axis=1))
    if name.startswith("displacement"):
        moved = place_of(frame, rest) - rest
        return np.asarray(moved[:, "xyz".index(name[-1])] if "_" in name
                          else np.linalg.norm(moved, axis=1))
    values = column_of(frame, name)
    return mean_of_bonds(values, pairs, len(rest)) if name.startswith("bonds/") else values
