# SPDX-License-Identifier: GPL-2.0-or-later
"""A prepared specimen (`solidem prepare`), and what a scene may do to it (read by explained.py).

Everything is in SI units. This file needs no simulation program: numpy and h5py only.
"""

from __future__ import annotations

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


@dataclass(frozen=True)
class Values:
    """A value for each of some elements."""

    elements: Integers  #: (n,) zero-based
    values: Floats  #: (n,)


@dataclass(frozen=True)
class Surface:
    """Triangles."""

    vertices: Floats  #: (V, 3) m
    facets: Integers  #: (F, 3)


@dataclass
class Specimen:
    """Elements and bonds of bodies; the order of elements is that of the file, in every code."""

    path: Path
    position: Floats  #: (N, 3) m
    radius: Floats  #: (N,) m
    pairs: Integers  #: (B, 2), i < j
    sets: dict[str, Integers] = field(default_factory=dict)
    columns: dict[str, Floats] = field(default_factory=dict)  #: "mechanics/mass" -> (N,)
    periodic: tuple[bool, bool, bool] = (False, False, False)
    lower: Floats = field(default_factory=lambda: np.zeros(3))  #: corner of the body's box, m
    upper: Floats = field(default_factory=lambda: np.zeros(3))  #: the opposite corner, m
    volume: float = 0.0  #: of the body, m³
    exchanges: dict[str, Values] = field(default_factory=dict)  #: conductances to the outside, W/K
    powers: dict[str, Values] = field(default_factory=dict)  #: constant heat sources, W
    conducting: Integers | None = None  #: (C, 2), i < j; None: the bonded pairs
    bodies: int = 1  #: how many there are
    surfaces: dict[str, Surface] = field(default_factory=dict)  #: of tools by name, at the start

    @property
    def conductors(self) -> Integers:
        """(C, 2) pairs that heat passes between, i < j."""
        return self.pairs if self.conducting is None else self.conducting

    @property
    def rest_length(self) -> Floats:
        """(B,) distance of the bonded centres, m."""
        return self._distance(self.pairs)

    @property
    def conductor_length(self) -> Floats:
        """(C,) distance that heat goes between the centres of a pair, m."""
        stored = self.columns.get("conduction/distance")
        return self._distance(self.conductors) if stored is None else stored

    def _distance(self, pairs: Integers) -> Floats:
        chord = self.position[pairs[:, 1]] - self.position[pairs[:, 0]]
        return np.sqrt(np.einsum("ij,ij->i", chord, chord))

    def column(self, name: str) -> Floats:
        """A value for each element, or for each pair of conductors; PreparedError when `solidem
        prepare` did not store it."""
        if name not in self.columns:
            raise PreparedError(
                f"{self.path}: /{name} is missing; prepare the specimen from a scene that uses it"
            )
        return self.columns[name]


@dataclass(frozen=True)
class Beams:
    """Law, material and thickness of the beam bonds."""

    young_modulus: float  #: E, Pa
    shear_modulus: float  #: G, Pa
    radius_ratio: float
    radius_from: str  #: "mean" or "pair"
    mean_radius: float  #: R_m, m
    law: str = "euler-bernoulli"  #: or "timoshenko", "spring"
    shear_coefficient: float = 0.9  #: κ of "timoshenko": shear force κ G S times the shear angle

    def radius(self, specimen: Specimen) -> Floats:
        """(B,) radius of each beam, m."""
        if self.radius_from == "pair":
            return self.radius_ratio * specimen.radius[specimen.pairs].mean(axis=1)
        return np.full(len(specimen.pairs), self.radius_ratio * self.mean_radius)

    def rigidity(self, specimen: Specimen) -> Floats:
        """(B, 4) axial E S, N; bending 2 E I, shear 2 E I / (1 + Φ) and torsion G I_0, N m².

        PreparedError when `solidem prepare` stored others: then beams differ in more than law and
        radius, which is not understood.
        """
        area = np.pi * self.radius(specimen) ** 2
        second_moment = area**2 / (4 * np.pi)
        bending = 2 * self.young_modulus * second_moment
        slack = np.zeros_like(area)
        if self.law == "timoshenko":
            slack = (12 * self.young_modulus * second_moment
                     / (self.shear_coefficient * self.shear_modulus * area
                        * specimen.rest_length**2))
        found = np.stack([self.young_modulus * area, bending, bending / (1 + slack),
                          2 * self.shear_modulus * second_moment], axis=1)
        if self.law == "spring":
            found[:, 1:] = 0
        stored = specimen.columns.get("mechanics/rigidity")
        if stored is not None and len(stored):
            off = float((np.abs(stored - found) / found.max(axis=0).clip(1e-300)).max())
            if off > 1e-9:
                raise PreparedError(f"{specimen.path}: /mechanics/rigidity differs by {off:g} from "
                                    f"that of {self.law} beams of one material; only such are "
                                    "understood")
        return found


@dataclass(frozen=True)
class OverTemperature:
    """A property over temperature: linear between points, held outside; one point is a constant."""

    temperature: tuple[float, ...]  #: K, increasing
    value: tuple[float, ...]


@dataclass(frozen=True)
class Expansion:
    """How bonds grow as they warm."""

    coefficient: OverTemperature  #: 1/K
    reference_temperature: float  #: at which the body is as large as its specimen, K


@dataclass(frozen=True)
class Plasticity:
    """When beams flow; strains are stresses over the beams' E."""

    law: str  #: "radial-return", "scaled-offset" or "associated"
    yield_strain: float = np.nan  #: σ_y / E, of "linear"
    hardening_ratio: float = 0.0  #: H / E, of "linear"
    hardening: str = "linear"  #: the yield law
    parameters: dict[str, float] = field(default_factory=dict)  #: of the yield law by name
    section: str = "middle"  #: where a beam is judged: "middle", "ends" or "worst"
    rate_time: float | None = None  #: over which the rate of flow is averaged, if it counts, s


@dataclass(frozen=True)
class Rupture:
    """When beams break; infinite: not by this."""

    elastic_strain: float = np.inf  #: bound of σ_e / E, of "strain-limit"
    strain: float = np.inf  #: bound of σ_e / E + plastic strain, of "strain-limit"
    minimal_bonds: int = 0  #: elements that lost bonds and keep fewer are removed; 0: never
    law: str = "strain-limit"
    parameters: dict[str, float] = field(default_factory=dict)  #: of the law by name
    section: str = "middle"  #: where a beam is judged: "middle", "ends" or "worst"


@dataclass(frozen=True)
class Contact:
    """How elements that no bond joins push each other."""

    stiffness_ratio: float = 1.0  #: of E S / l, with beams
    rebonding_pressure: float | None = None  #: Pa, above which a new bond is made
    normal_stiffness: float | None = None  #: k_n of every contact, N/m
    young_modulus: float | None = None  #: E of k_n = 2 E R_i R_j / (R_i + R_j), Pa
    tangential_stiffness_ratio: float = 0.8  #: k_t / k_n
    friction: float = 0.0  #: Coulomb's coefficient
    restitution: float = 1.0  #: e
    damping_ratio: float = 0.0  #: ζ that gives e where the dashpot does not pull

    def of_beams_alone(self) -> bool:
        """Whether contacts are as stiff as bonds, smooth and elastic."""
        return (self.normal_stiffness is None and self.young_modulus is None
                and self.friction == 0 and self.restitution == 1)


@dataclass(frozen=True)
class CentralForces:
    """Central law between elements, and between which of them it acts."""

    law: str  #: "piecewise", "lennard-jones", "shifted-lennard-jones", "mie" or "threshold"
    parameters: dict[str, float]  #: of the law by name
    range: float  #: α: pairs nearer than α (R_i + R_j) interact
    equilibrium: str = "initial"  #: distance of equilibrium: "initial", or R_i + R_j: "radii"
    neighbours: str = "changing"  #: or "fixed": the initial pairs alone
    interpenetration: float = 0.1  #: a: below (1 − a) δ_eq the force goes on along its tangent
    dissipation: float = 0.0  #: c, N s/m
    skin: float = 0.1  #: of neighbour lists, mean radii
    bond_tolerance: float | None = None  #: initial pairs: d <= (1 + t)(R_i + R_j); None: range - 1


@dataclass(frozen=True)
class Damage:
    """How bodies of central forces crack."""

    #: C: an element is on a crack face when its barycentre is farther than C R_i.
    crack_threshold: float | None = None
    every: int = 1  #: steps between looks at the barycentres
    minimal_neighbours: int = 0  #: elements that lost neighbours and keep fewer are removed
    removal_every: int = 100  #: steps between removals


@dataclass(frozen=True)
class Conduction:
    """Law and material of the conducting body."""

    conductivity: float  #: λ, W/(m K)
    initial_temperature: float  #: K
    specific_heat_capacity: float = float("nan")  #: c_p, J/(kg K)
    law: str = "platonic"  #: or "platonic-calibrated", "voronoi"
    area_factor: float = 1.0  #: of platonic-calibrated
    every: int = 1  #: steps of the motion from one step of heat to the next

    def conductance(self, specimen: Specimen) -> Floats:
        """(C,) conductance of each pair, W/K, in one material."""
        if self.law == "voronoi":
            area = specimen.column("conduction/area")
        else:
            sides = specimen.column("conduction/transmission_area")[specimen.conductors]
            area = np.sqrt(sides[:, 0] * sides[:, 1])
        return self.conductivity * area / specimen.conductor_length

    def require_one_material(self, specimen: Specimen, remedy: str = "") -> None:
        """PreparedError when some pair conducts other than this material does."""
        stored = specimen.columns.get("conduction/conductance")
        if stored is None or not len(stored):
            return
        off = float(np.abs(stored / self.conductance(specimen) - 1).max())
        if off > 1e-9:
            raise PreparedError(f"{specimen.path}: /conduction/conductance differs by {off:g} from "
                                f"that of {self.conductivity} W/(m K) everywhere; only one material "
                                f"is understood{remedy}")


@dataclass(frozen=True)
class ContactConduction:
    """How well heat passes where elements and tools touch; one of the two is given."""

    coefficient: float | None = None  #: of the circle of overlap, W/(m² K)
    conductance: float | None = None  #: of each touch, W/K


@dataclass(frozen=True)
class Grip:
    """Elements held or moved at constant velocity; an axis that is None is free."""

    name: str
    velocity: tuple[float | None, float | None, float | None]  #: m/s
    rotation_fixed: bool


@dataclass(frozen=True)
class Tool:
    """A rigid body that elements touch, at rest or in steady motion."""

    name: str
    shape: str  #: "plane", "box", "sphere", "cylinder" or "mesh"
    origin: tuple[float, float, float]  #: m
    axis: tuple[float, float, float]  #: of a plane its normal, of a cylinder its axis; unit
    stiffness: float  #: k_n, N/m
    tangential_stiffness: float  #: k_t, N/m
    friction: float  #: Coulomb's coefficient
    restitution: float  #: e
    damping_ratio: float  #: ζ that gives e where the dashpot does not pull
    velocity: tuple[float, float, float]  #: m/s
    angular_velocity: float  #: rad/s
    rotation_axis: tuple[float, float, float]  #: unit
    rotation_point: tuple[float, float, float]  #: of that axis at the start, m
    elements_that_overlap_at_the_start: int
    deepest_overlap_at_the_start: float  #: m
    effusivity: float = 0.0  #: of its material, W s^½/(m² K); 0: it takes no heat of friction
    temperature: float | None = None  #: that what touches it exchanges heat with, K


@dataclass(frozen=True)
class Parameters:
    """What a scene asks for."""

    time_step: float  #: s
    steps: int
    beams: Beams | None
    conduction: Conduction | None
    grips: tuple[Grip, ...]
    temperatures: dict[str, float]  #: name -> imposed temperature, K
    exchanges: dict[str, float] = field(default_factory=dict)  #: name -> outer temperature, K
    powers: tuple[str, ...] = ()  #: names of constant heat sources
    unsupported: tuple[str, ...] = ()  #: what the scene asks of solidem alone
    plasticity: Plasticity | None = None
    rupture: Rupture | None = None
    contact: Contact | None = None
    central_forces: CentralForces | None = None
    damage: Damage | None = None
    gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)  #: acceleration of free fall, m/s²
    local_damping: float = 0.0  #: Cundall's coefficient
    bond_damping: float = 0.0  #: critical ratio of the dashpots of bonds
    tools: tuple[Tool, ...] = ()
    initial_velocities: bool = False  #: whether elements move when a run begins
    expansion: Expansion | None = None
    softening: OverTemperature | None = None  #: moduli over those of the beams
    plastic_heat: float = 0.0  #: of the plastic work of bonds that heats their ends
    friction_heat: float = 0.0  #: of the work of slip in contacts that heats both sides
    contact_conduction: ContactConduction | None = None

    @property
    def joins_heat_and_motion(self) -> bool:
        """Whether motion heats, or bonds look at temperatures."""
        yields_warm = (self.plasticity is not None
                       and self.plasticity.parameters.get("melting_temperature") is not None)
        return bool(self.expansion or self.softening or self.plastic_heat or yields_warm)

    @property
    def is_loose(self) -> bool:
        """Whether contacts are all that elements do to each other."""
        return self.contact is not None and self.beams is None and self.central_forces is None

    def require_support(self) -> None:
        """PreparedError when the scene asks for what other codes are not given."""
        if self.unsupported:
            raise PreparedError("; ".join(self.unsupported))


def _values(group: Any, name: str) -> dict[str, Values]:
    """Values of some elements by the names of the groups that hold them."""
    return {key: Values(np.asarray(entry["elements"][:], dtype=np.int64),
                        np.asarray(entry[name][:], dtype=float)) for key, entry in group.items()}


def _surfaces(group: Any) -> dict[str, Surface]:
    """Of tools, by name."""
    return {name: Surface(np.asarray(own["vertices"][:], dtype=float),
                          np.asarray(own["facets"][:], dtype=np.int64))
            for name, own in group.items()}


def read_specimen(path: str | Path) -> Specimen:
    """Reads a prepared specimen; PreparedError names what is missing."""
    path = Path(path)
    try:
        with h5py.File(path) as file:
            if "elements/position" not in file or "elements/radius" not in file:
                raise PreparedError(f"{path}: no /elements/position and /elements/radius")
            groups = [name for name in ("mechanics", "conduction") if name in file]
            loads = file.get("conduction", {})
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
                 for k, v in file[g].items() if isinstance(v, h5py.Dataset) and k != "pairs"},
                (periodic[0], periodic[1], periodic[2]),
                np.array(domain.get("lower", np.zeros(3)), dtype=float),
                np.array(domain.get("upper", np.zeros(3)), dtype=float),
                float(domain.get("volume", 0.0)),
                _values(loads.get("exchanges", {}), "conductance"),
                _values(loads.get("powers", {}), "power"),
                np.asarray(loads["pairs"][:], dtype=np.int64) if "pairs" in loads else None,
                len(file["bodies"]) if "bodies" in file else 1,
                _surfaces(file.get("tools", {})),
            )
    except OSError as error:
        raise PreparedError(f"{path}: cannot be read as HDF5 ({error})") from error
