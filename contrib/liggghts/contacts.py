# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts and tools in LIGGGHTS' own words: `gran` models, walls, meshes that move.

The linear spring with Coulomb friction is `model hooke/stiffness tangential history` there. It
takes its constants from matrices over pairs of atom types, so what tells contacts apart becomes a
type: radius and mass of the elements as far as stiffness and dashpot hang on them, and each tool.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from contrib.prepared import (Beams, Contact, Floats, Integers, Parameters, PreparedError, Specimen,
                              Tool)

#: More types of elements make matrices that nobody can read.
MOST_TYPES = 24
#: Of the smallest radius: spheres that overlap by less merely touch.
TOUCHES = 1e-9
#: Of a mesh's size: corners that are nearer are one.
SAME_CORNER = 1e-12
#: What both pair style and walls say. The dashpot does not pull, and there is none in sliding.
MODEL = "model hooke/stiffness tangential history"
SETTINGS = "absolute_damping on tangential_damping off limitForce on"


def full(value: float) -> str:
    """A number with all its digits."""
    return f"{value:.17g}"


@dataclass(frozen=True)
class Types:
    """Atom types: one for each kind of element, then one for each tool."""

    of_element: Integers  #: (N,) counted from 1
    radius: Floats  #: (K,) m, of each kind
    mass: Floats  #: (K,) kg
    held: Integers  #: (K,) 1 where grips impose all motion
    tools: int = 0

    @property
    def count(self) -> int:
        """Of all types."""
        return len(self.radius) + self.tools

    def of_tool(self, number: int) -> int:
        """Counted from 1."""
        return len(self.radius) + number + 1


def has_contacts(parameters: Parameters) -> bool:
    """Whether elements, or elements and tools, push each other in LIGGGHTS' own words."""
    return bool(parameters.tools) or acts_between_elements(parameters)


def has_meshes(parameters: Parameters) -> bool:
    """Whether some tool is a mesh in LIGGGHTS."""
    return any(_standing_across(tool) is None for tool in parameters.tools)


def acts_between_elements(parameters: Parameters) -> bool:
    """Whether LIGGGHTS' pair style acts. Contacts that are as stiff as bonds that break go with the
    bonds."""
    return parameters.contact is not None and not (parameters.beams and parameters.rupture)


def types_of(specimen: Specimen, parameters: Parameters) -> Types:
    """One type where all contacts are alike; PreparedError where there are too many."""
    contact = parameters.contact if acts_between_elements(parameters) else None
    count = len(specimen.radius)
    of_radius = contact is not None and contact.normal_stiffness is None
    of_mass = any(one.restitution < 1 for one in [contact, *parameters.tools] if one)
    radius = specimen.radius if of_radius else np.full(count, float(specimen.radius.mean()))
    mass = specimen.column("mechanics/mass") if of_mass else np.ones(count)
    held = np.zeros(count, dtype=np.int64)
    for grip in parameters.grips if of_mass else ():
        if all(v is not None for v in grip.velocity):
            held[specimen.sets[f"grip.{grip.name}"]] = 1
    same = np.stack([_in_12_digits(radius), _in_12_digits(mass), held], axis=1)
    _, first, of_element = np.unique(same, axis=0, return_index=True, return_inverse=True)
    if len(first) > MOST_TYPES:
        raise PreparedError(
            f"{specimen.path}: the contacts are of elements of {len(first)} different "
            f"{'masses' if of_mass else 'radii'}; LIGGGHTS has one stiffness and one dashpot for a "
            f"pair of atom types, of which {MOST_TYPES} are written at most. Give normal_stiffness "
            "and restitution = 1, or elements of few sizes")
    return Types(of_element.ravel() + 1, radius[first], mass[first], held[first],
                 len(parameters.tools))


def _in_12_digits(values: Floats) -> Floats:
    scale = 10.0 ** (11 - np.floor(np.log10(values)))
    return np.asarray(np.round(values * scale) / scale)


def _stiffness(contact: Contact, beams: Beams | None, radius: Floats) -> Floats:
    """(K, K) k_n between kinds of elements, N/m."""
    r_i, r_j = radius[:, None], radius[None, :]
    if contact.normal_stiffness is not None:
        return np.full((len(radius),) * 2, contact.normal_stiffness)
    if contact.young_modulus is not None:
        return np.asarray(2 * contact.young_modulus * r_i * r_j / (r_i + r_j))
    if beams is None:
        raise PreparedError("[contact]: nothing says how stiff contacts are")
    mean = (0.5 * (r_i + r_j) if beams.radius_from == "pair"
            else np.full((len(radius),) * 2, beams.mean_radius))
    area = np.pi * (beams.radius_ratio * mean) ** 2
    return np.asarray(contact.stiffness_ratio * beams.young_modulus * area / (r_i + r_j))


def _dashpot(ratio: float, stiffness: Floats, inverse_mass: Floats) -> Floats:
    """c_n = 2 ζ √(k_n m*), N·s/m; none between two that are held."""
    return np.asarray(2 * ratio * np.sqrt(stiffness / np.where(inverse_mass > 0, inverse_mass,
                                                               np.inf)))


def constants(types: Types, parameters: Parameters) -> dict[str, Floats]:
    """LIGGGHTS' global properties, each a matrix over all pairs of types."""
    kinds, count = len(types.radius), types.count
    names = ("kn", "kt", "gamman_abs", "gammat_abs", "coefficientFriction")
    found = {name: np.zeros((count, count)) for name in names}
    if parameters.contact and acts_between_elements(parameters):
        contact = parameters.contact
        normal = _stiffness(contact, parameters.beams, types.radius)
        inverse = np.where(types.held, 0, 1 / types.mass)
        between = (slice(0, kinds), slice(0, kinds))
        found["kn"][between] = normal
        found["kt"][between] = contact.tangential_stiffness_ratio * normal
        found["gamman_abs"][between] = _dashpot(contact.damping_ratio, normal,
                                                inverse[:, None] + inverse[None, :])
        found["coefficientFriction"][between] = contact.friction
    for number, tool in enumerate(parameters.tools):
        at = types.of_tool(number) - 1
        values = {"kn": tool.stiffness, "kt": tool.tangential_stiffness,
                  "gamman_abs": _dashpot(tool.damping_ratio, np.full(kinds, tool.stiffness),
                                         1 / types.mass),
                  "coefficientFriction": tool.friction}
        for name, value in values.items():
            found[name][at, :kinds] = found[name][:kinds, at] = value
    return found


def require_same_law(specimen: Specimen, parameters: Parameters) -> None:
    """PreparedError, with names, where LIGGGHTS' contacts would not be those of the scene."""
    contact = parameters.contact
    if parameters.beams and parameters.rupture and contact:
        if not contact.of_beams_alone():
            raise PreparedError(
                "[contact] with friction, restitution or a stiffness of its own, beside [rupture]: a "
                "pair whose bond broke touches where the bond left it, in LIGGGHTS where its radii "
                "say. Take contacts as stiff as the bonds, smooth and elastic, or leave out [rupture]")
        if specimen.bodies > 1:
            raise PreparedError(
                f"[contact] beside [rupture], with {specimen.bodies} bodies: in LIGGGHTS contacts "
                "are then those of broken bonds alone, and bodies would pass through each other")
    if acts_between_elements(parameters):
        _require_apart(specimen)
    for tool in parameters.tools:
        _require_tool(specimen, tool)


def differences(specimen: Specimen, parameters: Parameters) -> list[str]:
    """Where LIGGGHTS' contacts are those of the scene nearly, in words."""
    found = []
    contact, tools = parameters.contact, parameters.tools
    if contact and not acts_between_elements(parameters):
        found.append("[contact] beside [rupture]: contacts are those of broken bonds alone; two "
                     "elements that no bond ever joined pass through each other")
    if contact and contact.friction:
        found.append("[contact] friction: its force does not turn about the normal when both spin")
    heat_leads = parameters.joins_heat_and_motion or (parameters.conduction
                                                      and parameters.conduction.every > 1)
    rubs = any(one.friction for one in [contact, *tools] if one)
    if parameters.friction_heat and rubs and heat_leads:
        found.append("[friction_heat] where heat steps before contacts act, as it does beside bonds that "
                     "give heat or look at temperatures, and with every: heat of friction comes to the "
                     "elements one step later")
    if parameters.contact_conduction and heat_leads:
        found.append("[contact_conduction] where heat steps before contacts act, as above: heat passes "
                     "through the touches of one step before")
    found += [f"tool {tool.name}: friction acts at the middle of the overlap, not at the tool's "
              "surface: levers differ by half the overlap; it does not turn about the normal with what "
              "spins" for tool in tools if tool.friction]
    found += [f"tool {tool.name}: over a face, nearer to its edge than the ball's footprint, the edge "
              "pushes besides" for tool in tools if _has_edges(specimen, tool)]
    if any(one.restitution < 1 for one in [contact, *tools] if one):
        found.append("restitution: dashpots see the velocity half a step before the pose: other by "
                     "the first order of the step")
    return found


def _has_edges(specimen: Specimen, tool: Tool) -> bool:
    """Whether facets meet at angles; LIGGGHTS takes those within a quarter of a degree for one."""
    normal = _normals(_corners(specimen, tool))
    return bool((np.abs(normal @ normal[0]) < 1 - 1e-5).any())


def _require_tool(specimen: Specimen, tool: Tool) -> None:
    if tool.shape not in ("plane", "box", "mesh"):
        raise PreparedError(f"tool {tool.name}: a {tool.shape} has no wall in LIGGGHTS; plane, box "
                            "and mesh are understood")
    if tool.deepest_overlap_at_the_start > TOUCHES * float(specimen.radius.min()):
        raise PreparedError(
            f"tool {tool.name}: {tool.elements_that_overlap_at_the_start} elements overlap it at the "
            f"start, the deepest by {tool.deepest_overlap_at_the_start:g} m; they touch it where "
            "they stand, in LIGGGHTS they would be pushed. Move it away by so much")


def deepest_overlap(specimen: Specimen) -> tuple[float, int, int]:
    """The largest overlap of two spheres that no bond joins, m, and their numbers; negative: none
    overlap."""
    axis = int(np.argmax(np.ptp(specimen.position, axis=0)))
    order = np.argsort(specimen.position[:, axis], kind="stable")
    at, radius = specimen.position[order], specimen.radius[order]
    count, reach = len(order), 2 * float(radius.max())
    bonded = np.sort(specimen.pairs.min(axis=1) * count + specimen.pairs.max(axis=1))
    deepest = (-np.inf, 0, 0)
    for ahead in range(1, count):
        near = np.flatnonzero(at[ahead:, axis] - at[:-ahead, axis] < reach)
        if not len(near):
            break
        overlap = radius[near] + radius[near + ahead] - np.linalg.norm(at[near + ahead] - at[near],
                                                                       axis=1)
        pair = np.sort(np.stack([order[near], order[near + ahead]], axis=1), axis=1)
        free = ~np.isin(pair[:, 0] * count + pair[:, 1], bonded)
        if free.any():
            most = int(np.argmax(np.where(free, overlap, -np.inf)))
            deepest = max(deepest, (float(overlap[most]), int(pair[most, 0]), int(pair[most, 1])))
    return deepest


def _require_apart(specimen: Specimen) -> None:
    overlap, i, j = deepest_overlap(specimen)
    if overlap > TOUCHES * float(specimen.radius.min()):
        raise PreparedError(
            f"{specimen.path}: elements {i} and {j}, which no bond joins, overlap by {overlap:g} m at "
            "the start, the deepest of all; they touch where they stand, in LIGGGHTS they would be "
            "pushed. Take elements that stand apart")


def pair_lines(types: Types, parameters: Parameters) -> str:
    """The constants, and the pair style where elements push each other."""
    lines = "".join(
        f"fix {name} all property/global {name} peratomtypepair {types.count} "
        f"{' '.join(map(full, values.ravel()))}\n"
        for name, values in constants(types, parameters).items())
    if acts_between_elements(parameters):
        lines += f"pair_style gran {MODEL} {SETTINGS}\npair_coeff * *\n"
    return lines


def tool_lines(specimen: Specimen, parameters: Parameters, types: Types, directory: Path) -> str:
    """Walls, and meshes with their motions, whose files toolN.stl go to the directory.

    The fixes are called tool0 ... in the order of the scene, the wall of all meshes is called meshes.
    """
    lines, meshes = "", []
    for number, tool in enumerate(parameters.tools):
        name, type_ = f"tool{number}", types.of_tool(number)
        axis = _standing_across(tool)
        if axis is not None:
            lines += (f"fix {name} all wall/gran {MODEL} primitive type {type_} {'xyz'[axis]}plane "
                      f"{full(tool.origin[axis])} {SETTINGS}\n")
            continue
        meshes.append(name)
        corners = _corners(specimen, tool)
        write_stl(directory / f"{name}.stl", name, corners)
        # LIGGGHTS counts a ball twice while it is nearer than this to a side that two facets share.
        precision = SAME_CORNER * float(np.ptp(corners.reshape(-1, 3), axis=0).max())
        lines += (f"fix {name} all mesh/surface file {name}.stl type {type_} precision "
                  f"{full(precision)}\n") + _motion_lines(name, tool)
    if meshes:
        lines += (f"fix meshes all wall/gran {MODEL} mesh n_meshes {len(meshes)} meshes "
                  f"{' '.join(meshes)} {SETTINGS}\n")
    return lines


def friction_lines(parameters: Parameters) -> str:
    """The command for heat of friction, if something rubs. Heat of tools is f_friction[1] ... in the
    order of the scene."""
    tools = parameters.tools
    rubs = [one.friction for one in [parameters.contact, *tools] if one]
    if not parameters.friction_heat or not any(rubs):
        return ""
    lines = f"fix friction all solidem/friction fraction {full(parameters.friction_heat)}"
    for number, tool in enumerate(tools):
        lines += f" &\n  tool tool{number} {full(tool.effusivity)}"
    return lines + "\n"


def touch_lines(parameters: Parameters) -> str:
    """The command for heat through what touches tools: f_touch[1] ... is that of those that have a
    temperature, in the order of the scene."""
    law = parameters.contact_conduction
    if law is None:
        return ""
    lines = "fix touch all solidem/touch " + (
        f"coefficient {full(law.coefficient)}" if law.coefficient is not None
        else f"conductance {full(law.conductance or 0)}")
    for number, tool in enumerate(parameters.tools):
        if tool.temperature is not None:
            lines += f" &\n  tool tool{number} {full(tool.temperature)}"
    return lines + "\n"


def _motion_lines(name: str, tool: Tool) -> str:
    """Along and about an axis that goes with the tool."""
    lines = ""
    if any(tool.velocity):
        lines += f"fix {name}_moves all move/mesh mesh {name} linear {_words(tool.velocity)}\n"
    if tool.angular_velocity:
        axis = np.array(tool.rotation_axis) * np.sign(tool.angular_velocity)
        lines += (f"fix {name}_turns all move/mesh mesh {name} rotate origin "
                  f"{_words(tool.rotation_point)} axis {_words(axis)} period "
                  f"{full(2 * np.pi / abs(tool.angular_velocity))}\n")
    return lines


def _words(vector: Floats | tuple[float, ...]) -> str:
    return " ".join(full(float(value)) for value in vector)


def _standing_across(tool: Tool) -> int | None:
    """The axis that a plane at rest stands across; None of any other tool."""
    axis = int(np.argmax(np.abs(tool.axis)))
    is_across = abs(tool.axis[axis]) > 1 - 1e-14
    stands = not any(tool.velocity) and not tool.angular_velocity
    return axis if tool.shape == "plane" and is_across and stands else None


def _corners(specimen: Specimen, tool: Tool) -> Floats:
    """(F, 3, 3) corners of the tool's facets, m."""
    if tool.shape == "plane":
        return _square(specimen, tool)
    if tool.name not in specimen.surfaces:
        raise PreparedError(f"{specimen.path}: /tools/{tool.name} is missing; prepare the specimen "
                            "from the scene")
    surface = specimen.surfaces[tool.name]
    return np.asarray(surface.vertices[surface.facets])


def _square(specimen: Specimen, tool: Tool) -> Floats:
    """(2, 3, 3) two facets of a plane, beside the body and four times as large, m."""
    lower, upper = specimen.position.min(axis=0), specimen.position.max(axis=0)
    middle, normal = 0.5 * (lower + upper), np.array(tool.axis)
    middle = middle - np.dot(middle - tool.origin, normal) * normal
    half = 2 * float(np.linalg.norm(upper - lower)) + 10 * float(specimen.radius.max())
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    first *= half / np.linalg.norm(first)
    second = np.cross(normal, first)
    a, b, c, d = (middle + x * first + y * second for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return np.array([[a, b, c], [a, c, d]])


def tool_places(specimen: Specimen, parameters: Parameters) -> Floats | None:
    """(P, 3) places of tools at the start and at the end, m; None: there are none."""
    places = []
    for tool in parameters.tools:
        if (axis := _standing_across(tool)) is not None:
            place = specimen.position.mean(axis=0)
            place[axis] = tool.origin[axis]
            places.append(place[None, :])
            continue
        corners = _corners(specimen, tool).reshape(-1, 3)
        way = np.array(tool.velocity) * parameters.steps * parameters.time_step
        places += [corners, corners + way]
    return np.concatenate(places) if places else None


def _normals(corners: Floats) -> Floats:
    """(F, 3) unit normals of facets."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.asarray(normal / np.linalg.norm(normal, axis=1)[:, None])


def write_stl(path: Path, name: str, corners: Floats) -> None:
    """Facets as text, with all digits."""
    normal = _normals(corners)
    with open(path, "w") as file:
        file.write(f"solid {name}\n")
        for n, facet in zip(normal, corners):
            file.write(f"facet normal {_words(n)}\nouter loop\n")
            for corner in facet:
                file.write(f"vertex {_words(corner)}\n")
            file.write("endloop\nendfacet\n")
        file.write(f"endsolid {name}\n")
