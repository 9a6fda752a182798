# SPDX-License-Identifier: GPL-2.0-or-later
"""A prepared specimen (`solidem prepare`) and what a scene does to it (`solidem explain --json`).

Everything is in SI units. This file needs no simulation program: numpy and h5py only.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class PreparedError(ValueError):
    """A prepared specimen or its parameters cannot be used; says file, place, value and remedy."""


@dataclass
class Specimen:
    """Elements and bonds of one body; the order of elements is that of the file, in every code."""

    path: Path
    position: Floats  #: (N, 3) m
    radius: Floats  #: (N,) m
    pairs: Integers  #: (B, 2), i < j
    sets: dict[str, Integers] = field(default_factory=dict)
    columns: dict[str, Floats] = field(default_factory=dict)  #: "mechanics/mass" -> (N,)
    periodic: tuple[bool, bool, bool] = (False, False, False)
    lower: Floats = field(default_factory=lambda: np.zeros(3))  #: corner of the body's box, m
    upper: Floats = field(default_factory=lambda: np.zeros(3))  #: the opposite corner, m

    @property
    def rest_length(self) -> Floats:
        """(B,) distance of the bonded centres, m."""
        chord = self.position[self.pairs[:, 1]] - self.position[self.pairs[:, 0]]
        return np.sqrt(np.einsum("ij,ij->i", chord, chord))

    def column(self, name: str) -> Floats:
        """A value for each element; PreparedError when `solidem prepare` did not store it."""
        if name not in self.columns:
            raise PreparedError(
                f"{self.path}: /{name} is missing; prepare the specimen from a scene that uses it"
            )
        return self.columns[name]


@dataclass(frozen=True)
class Beams:
    """Material and thickness of the beam bonds."""

    young_modulus: float  #: E, Pa
    shear_modulus: float  #: G, Pa
    radius_ratio: float
    radius_from: str  #: "mean" or "pair"
    mean_radius: float  #: R_m, m

    def radius(self, specimen: Specimen) -> Floats:
        """(B,) radius of each beam, m."""
        if self.radius_from == "pair":
            return self.radius_ratio * specimen.radius[specimen.pairs].mean(axis=1)
        return np.full(len(specimen.pairs), self.radius_ratio * self.mean_radius)


@dataclass(frozen=True)
class Conduction:
    """Material of the conducting body."""

    conductivity: float  #: λ, W/(m K)
    initial_temperature: float  #: K


@dataclass(frozen=True)
class Grip:
    """Elements held or moved at constant velocity; an axis that is None is free."""

    name: str
    velocity: tuple[float | None, float | None, float | None]  #: m/s
    rotation_fixed: bool


@dataclass(frozen=True)
class Parameters:
    """What a scene asks for."""

    time_step: float  #: s
    steps: int
    beams: Beams | None
    conduction: Conduction | None
    grips: tuple[Grip, ...]
    temperatures: dict[str, float]  #: name -> imposed temperature, K


def read_specimen(path: str | Path) -> Specimen:
    """Reads a prepared specimen; PreparedError names what is missing."""
    path = Path(path)
    try:
        with h5py.File(path) as file:
            if "elements/position" not in file or "elements/radius" not in file:
                raise PreparedError(f"{path}: no /elements/position and /elements/radius")
            groups = [name for name in ("mechanics", "conduction") if name in file]
            domain = dict(file["domain"].attrs) if "domain" in file else {}
            periodic = [bool(p) for p in domain.get("periodic", (0, 0, 0))]
            pairs = file["bonds/pairs"][:] if "bonds/pairs" in file else np.zeros((0, 2))
            return Specimen(
                path,
                np.ascontiguousarray(file["elements/position"][:], dtype=float),
                np.ascontiguousarray(file["elements/radius"][:], dtype=float),
                np.asarray(pairs, dtype=np.int64),
                {k: np.asarray(v[:], dtype=np.int64) for k, v in file.get("sets", {}).items()},
                {f"{g}/{k}": np.asarray(v[:], dtype=float) for g in groups
                 for k, v in file[g].items()},
                (periodic[0], periodic[1], periodic[2]),
                np.array(domain.get("lower", np.zeros(3)), dtype=float),
                np.array(domain.get("upper", np.zeros(3)), dtype=float),
            )
    except OSError as error:
        raise PreparedError(f"{path}: cannot be read as HDF5 ({error})") from error


def _constant(function: dict[str, Any], where: str) -> float:
    """The value of a function of time that does not vary; PreparedError otherwise."""
    values = {float(v) for v in function["value"]}
    if len(values) != 1 or function.get("amplitude"):
        raise PreparedError(f"{where}: {function} varies with time; only constants are understood")
    return values.pop()


def _axis_velocity(axis: dict[str, Any], where: str) -> float | None:
    """Velocity imposed along one axis, None when free; a displacement must be constant zero."""
    if axis["kind"] == "free":
        return None
    if axis["kind"] not in ("velocity", "displacement"):
        raise PreparedError(f"{where}: {axis}; expected free, a velocity or a zero displacement")
    value = _constant(axis["function"], where)
    if axis["kind"] == "displacement" and value != 0:
        raise PreparedError(f"{where}: a jump of {value} m at the start; impose a velocity")
    return value


def _grip(entry: dict[str, Any]) -> Grip:
    x, y, z = (_axis_velocity(axis, f"grip {entry['name']}") for axis in entry["axes"])
    return Grip(entry["name"], (x, y, z), entry["rotation"] == "fixed")


def parse_parameters(explained: dict[str, Any]) -> Parameters:
    """Parameters from the object that `solidem explain --json` prints."""
    laws = explained.get("laws", {})
    beams = conduction = None
    if laws.get("beams"):
        beams = Beams(**{k: laws["beams"][k] for k in Beams.__dataclass_fields__})
    if laws.get("conduction"):
        conduction = Conduction(
            **{k: laws["conduction"][k] for k in Conduction.__dataclass_fields__})
    return Parameters(
        float(explained["time_step"]["value"]),
        int(explained["steps"]),
        beams,
        conduction,
        tuple(_grip(entry) for entry in explained.get("grips") or []),
        {t["name"]: _constant(t["value"], f"temperature {t['name']}")
         for t in explained.get("temperatures") or []},
    )


def read_parameters(path: str | Path) -> Parameters:
    """Parameters from a file; PreparedError names what is missing."""
    try:
        return parse_parameters(json.loads(Path(path).read_text()))
    except (KeyError, TypeError, json.JSONDecodeError) as error:
        raise PreparedError(f"{path}: {type(error).__name__} {error}") from error
