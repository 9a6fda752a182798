# SPDX-License-Identifier: GPL-2.0-or-later
"""What `solidem explain --json` says of a scene, as the parameters that other codes are given.

What they cannot do is listed in Parameters.unsupported, never left out in silence.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

# Scripts for YADE find their neighbours by the path, all else by the package.
if TYPE_CHECKING or __package__:
    from contrib.prepared import (Beams, CentralForces, Conduction, Contact, ContactConduction, Damage, Expansion,
                                  Grip, OverTemperature, Parameters, Plasticity, PreparedError, Rupture, Tool)
else:
    from prepared import (Beams, CentralForces, Conduction, Contact, ContactConduction, Damage, Expansion,
                          Grip, OverTemperature, Parameters, Plasticity, PreparedError, Rupture, Tool)


def _vector(values: Any) -> tuple[float, float, float]:
    x, y, z = map(float, values)
    return x, y, z


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
