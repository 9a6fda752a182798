# SPDX-License-Identifier: GPL-2.0-or-later
"""A prepared specimen (`solidem prepare`) and what a scene does to it (`solidem explain --json`).

Everything is in SI units. This file needs no simulation program: numpy and h5py only.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field, replace
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


def _vector(values: Any) -> tuple[float, float, float]:
    x, y, z = map(float, values)
    return x, y, z


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


def _grips(entries: list[dict[str, Any]], unsupported: list[str]) -> tuple[Grip, ...]:
    """Grips held or moved steadily; others are unsupported."""
    found = []
    for entry in entries:
        try:
            x, y, z = (_axis_velocity(axis, f"grip {entry['name']}") for axis in entry["axes"])
            found.append(Grip(entry["name"], (x, y, z), entry["rotation"] == "fixed"))
        except PreparedError as error:
            unsupported.append(str(error))
    return tuple(found)


def _tool(entry: dict[str, Any]) -> Tool:
    """A tool whose motion is steady; PreparedError of others."""
    where = f"tool {entry['name']}"
    if entry["motion"] != "velocity":
        raise PreparedError(f"{where}: is moved by a {entry['motion']}; only steady velocities are "
                            "understood")
    known = {name: entry[name] for name in Tool.__dataclass_fields__ if name in entry}
    for name in ("origin", "axis", "rotation_axis", "rotation_point"):
        known[name] = _vector(entry[name])
    known["velocity"] = _vector([_steady(along, where) for along in entry["along"]])
    known["angular_velocity"] = _steady(entry["angular_velocity"], where)
    if "temperature" in entry:
        known["temperature"] = _constant(entry["temperature"], f"{where}: temperature")
    return Tool(**known)


def _steady(function: dict[str, Any], where: str) -> float:
    """Like _constant; zero of a function that is not given."""
    return _constant(function, where) if function["value"] or function["amplitude"] else 0.0


def _tools(entries: list[dict[str, Any]], unsupported: list[str]) -> tuple[Tool, ...]:
    """Tools at rest or in steady motion; others are unsupported."""
    found = []
    for entry in entries:
        try:
            found.append(_tool(entry))
        except PreparedError as error:
            unsupported.append(str(error))
    return tuple(found)


def _known(kind: type, law: dict[str, Any] | None) -> Any:
    """A dataclass from the keys it knows that are there and not null; None from nothing."""
    if not law:
        return None
    return kind(**{k: law[k] for k in kind.__dataclass_fields__ if law.get(k) is not None})


def _beams(law: dict[str, Any] | None, unsupported: list[str]) -> Beams | None:
    """Beams of one material; moduli that depend on direction or place are unsupported."""
    for name in ("anisotropy", "fibres", "materials"):
        if law and law.get(name):
            unsupported.append(f"beams with {name} are not understood")
    if law and law.get("shear_modulus") is None:  # of a spring
        law = {**law, "shear_modulus": 0.0}
    found: Beams | None = _known(Beams, law)
    return found


def _conduction(law: dict[str, Any], unsupported: list[str]) -> Conduction:
    """Law and material; what is not one number is unsupported, and nan."""
    def number(name: str) -> float:
        value = law.get(name)
        if isinstance(value, (int, float)):
            return float(value)
        unsupported.append(f"{name} is {value}; only one number for the whole body is understood")
        return float("nan")

    if law.get("integrator", "explicit") != "explicit":
        unsupported.append(f"integrator {law['integrator']!r}; only 'explicit' is understood")
    if law.get("largest_change") is not None:
        unsupported.append("largest_change: heat that chooses for itself how many steps of the motion "
                           "it waits is not understood; give every")
    return Conduction(
        number("conductivity"), number("initial_temperature"),
        number("specific_heat_capacity") if "specific_heat_capacity" in law else float("nan"),
        law.get("law", "platonic"), float(law.get("area_factor") or 1.0),
        int(law.get("every") or 1))


def _over_temperature(value: Any, name: str, unsupported: list[str]) -> OverTemperature | None:
    """A property as `solidem explain` tells it; one that differs from place to place is
    unsupported."""
    if isinstance(value, (int, float)):
        return OverTemperature((0.0,), (float(value),))
    if isinstance(value, dict):
        return OverTemperature(tuple(map(float, value["temperature"])),
                               tuple(map(float, value["value"])))
    unsupported.append(f"{name} is {value}; only one for the whole body is understood")
    return None


def _expansion(laws: dict[str, Any], unsupported: list[str]) -> Expansion | None:
    """Expansion from what the scene says of it and of conduction."""
    if not laws.get("expansion"):
        return None
    law = laws["expansion"]
    alpha = _over_temperature(law.get("expansion_coefficient"), "expansion_coefficient", unsupported)
    reference = law.get("reference_temperature")
    if reference is None:
        reference = laws["conduction"]["initial_temperature"]
    return None if alpha is None else Expansion(alpha, float(reference))


def _softening(law: dict[str, Any] | None, unsupported: list[str]) -> OverTemperature | None:
    return _over_temperature(law["modulus_ratio"], "modulus_ratio", unsupported) if law else None


def _temperatures(entries: list[dict[str, Any]], unsupported: list[str]) -> dict[str, float]:
    """Imposed temperatures that stay the same; others are unsupported."""
    found = {}
    for entry in entries:
        try:
            found[entry["name"]] = _constant(entry["value"], f"temperature {entry['name']}")
        except PreparedError as error:
            unsupported.append(str(error))
    return found


def _exchanges(entries: list[dict[str, Any]], unsupported: list[str]) -> dict[str, float]:
    """Outer temperatures that stay the same; others are unsupported."""
    for entry in entries:
        if entry["temperature"] is None:
            unsupported.append(f"exchange {entry['name']}: varies with time; only constants are "
                               "understood")
    return {entry["name"]: float(entry["temperature"]) for entry in entries
            if entry["temperature"] is not None}


def _law_of_bonds(kind: type, law: dict[str, Any] | None) -> Any:
    """A law of bonds with its parameters by name too, but for those without limit."""
    if law is None:
        return None
    parameters = {name: float(value) for name, value in law.items()
                  if isinstance(value, (int, float))
                  and name not in ("minimal_bonds", "rate_time")}
    return replace(_known(kind, law), parameters=parameters)


#: Sections of effects of which other codes are told, each with what they cannot do refused below; a
#: test holds them to the sections of the program.
KNOWN_SECTIONS = {"beams", "plasticity", "rupture", "contact", "damage", "central_forces", "grips",
                  "gravity", "damping", "conduction", "thermal_contacts", "heat_sources",
                  "heat_fluxes", "convections", "temperatures", "initial_velocities", "tools",
                  "plastic_heat", "expansion", "softening", "friction_heat", "contact_conduction"}


def _unknown_sections(effects: list[dict[str, str]]) -> list[str]:
    """What to say of effects that act in solidem and that no other code is told of."""
    asked = {name for effect in effects for name in re.findall(r"\[([a-z_]+)\]", effect["reason"])}
    return [f"[{name}] is not understood" for name in sorted(asked - KNOWN_SECTIONS)]


def _friction_heat(law: dict[str, Any] | None, unsupported: list[str]) -> float:
    """The fraction of the work of slip; what dashpots take is unsupported."""
    if not law:
        return 0.0
    if law.get("damping_fraction"):
        unsupported.append("[friction_heat] damping_fraction: heat of dashpots is not understood")
    return float(law["fraction"])


def _contact_conduction(law: dict[str, Any] | None, contact: Contact | None,
                        unsupported: list[str]) -> ContactConduction | None:
    """Of tools; heat that passes between elements that touch is unsupported."""
    if law and contact:
        unsupported.append("[contact_conduction] beside [contact]: heat that passes between elements "
                           "that touch is not understood, only that of tools")
    found: ContactConduction | None = _known(ContactConduction, law)
    return found


def _state_of_yield(law: dict[str, Any]) -> list[str]:
    """What to say of a yield law that looks at the rate of flow."""
    if law.get("rate_sensitivity", 0) > 0 and law.get("rate_time") is None:
        return ["plasticity that depends on the rate of flow needs rate_time in [plasticity]"]
    return []


def parse_parameters(explained: dict[str, Any]) -> Parameters:
    """Parameters from the object that `solidem explain --json` prints."""
    laws = explained.get("laws", {})
    conduction = None
    unsupported: list[str] = []
    if laws.get("conduction"):
        conduction = _conduction(laws["conduction"], unsupported)
    contact = _known(Contact, laws.get("contact"))
    if laws.get("central_forces"):
        unsupported += [f"{what} are not understood beside [central_forces]"
                        for what, there in (("initial velocities", "initial_velocities"),
                                            ("[[tools]]", "tools")) if explained.get(there)]
    unsupported += _state_of_yield(laws.get("plasticity") or {})
    unsupported += _unknown_sections(explained.get("effects") or [])
    if (laws.get("damage") or {}).get("free_faces") == "left_out":
        unsupported.append("free faces that are no cracks are not understood")
    if laws.get("damage") and laws.get("beams"):
        unsupported.append("cracks among bonded elements are not understood")
    if laws.get("damping", {}).get("viscous") is not None:
        unsupported.append("viscous damping is not understood")
    tools = _tools(explained.get("tools") or [], unsupported)
    for entry in explained.get("powers") or []:
        if not entry["constant"]:
            unsupported.append(f"heat source {entry['name']}: varies; only constants in elements "
                               "that stay the same are understood")
    expansion = _expansion(laws, unsupported)
    softening = _softening(laws.get("softening"), unsupported)
    friction_heat = _friction_heat(laws.get("friction_heat"), unsupported)
    through_contacts = _contact_conduction(laws.get("contact_conduction"), contact, unsupported)
    return Parameters(
        float(explained["time_step"]["value"]),
        int(explained["steps"]),
        _beams(laws.get("beams"), unsupported),
        conduction,
        _grips(explained.get("grips") or [], unsupported),
        _temperatures(explained.get("temperatures") or [], unsupported),
        _exchanges(explained.get("exchanges") or [], unsupported),
        tuple(entry["name"] for entry in explained.get("powers") or []),
        tuple(unsupported),
        _law_of_bonds(Plasticity, laws.get("plasticity")),
        _law_of_bonds(Rupture, laws.get("rupture")),
        contact,
        _known(CentralForces, laws.get("central_forces")),
        _known(Damage, laws.get("damage")),
        _vector(laws.get("gravity", {}).get("acceleration", (0, 0, 0))),
        float(laws.get("damping", {}).get("local") or 0.0),
        float(laws.get("damping", {}).get("bonds") or 0.0),
        tools,
        bool(explained.get("initial_velocities")),
        expansion,
        softening,
        float((laws.get("plastic_heat") or {}).get("fraction") or 0.0),
        friction_heat,
        through_contacts,
    )


def read_parameters(path: str | Path) -> Parameters:
    """Parameters from a file; PreparedError names what is missing."""
    try:
        return parse_parameters(json.loads(Path(path).read_text()))
    except (KeyError, TypeError, json.JSONDecodeError) as error:
        raise PreparedError(f"{path}: {type(error).__name__} {error}") from error
