# SPDX-License-Identifier: GPL-2.0-or-later
"""solidem's tools in YADE: a plane across an axis as its wall, an oblique plane as one large facet,
boxes and meshes as a facet for each of their triangles.

YADE lets each facet push by itself, so that what touches the side of two is pushed twice. Where
that happens a run ends, by name: solidem pushes once. Friction on a facet acts at the middle of the
overlap in YADE, on the surface in solidem (as on YADE's walls): facets must be smooth.
"""

from __future__ import annotations

import math
from collections import defaultdict

import numpy as np
from prepared import Floats, Parameters, PreparedError, Specimen, Tool
from yade import Body, FrictMat, O, utils

ONE_PLACE = math.cos(math.radians(15))  #: normals that are nearer are of one place in solidem
REACH = 20.0  #: of a facet that stands for a plane, in lengths that the body and its way take


def _is_wall(tool: Tool) -> bool:
    """Whether it is a plane across an axis."""
    return tool.shape == "plane" and max(map(abs, tool.axis)) >= 1 - 1e-14


def _check(tool: Tool) -> None:
    where = f"tool {tool.name}"
    if tool.shape not in ("plane", "box", "mesh"):
        raise PreparedError(f"{where}: planes, boxes and meshes are understood in YADE, not a "
                            f"{tool.shape}")
    if tool.angular_velocity:
        raise PreparedError(f"{where}: tools that do not turn are understood in YADE")
    if tool.restitution != 1:
        raise PreparedError(f"{where}: restitution: YADE's native law has no dashpot")
    if tool.friction and not _is_wall(tool):
        raise PreparedError(f"{where}: friction on facets: its lever ends at the middle of the "
                            "overlap in YADE, at the surface in solidem; expected friction = 0, or "
                            "a plane across an axis")
    if tool.deepest_overlap_at_the_start > 1e-12:
        raise PreparedError(f"{where}: elements overlap it at the start, by "
                            f"{tool.deepest_overlap_at_the_start:g} m at most; YADE would push them")


def _large_triangle(tool: Tool, specimen: Specimen, duration: float) -> Floats:
    """(3, 3) corners of a facet in a plane, around the body's place, so large that nothing that
    touches the plane meets its edges."""
    normal, origin = np.array(tool.axis), np.array(tool.origin)
    low, high = specimen.position.min(axis=0), specimen.position.max(axis=0)
    way = duration * float(np.linalg.norm(tool.velocity))
    size = REACH * (float(np.linalg.norm(high - low)) + float(specimen.radius.max()) + way)
    middle = (low + high) / 2
    middle = middle - normal * float(normal @ (middle - origin))
    first = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    angles = 2 * math.pi / 3 * np.arange(3)
    return np.asarray(middle + size * (np.outer(np.cos(angles), first)
                                       + np.outer(np.sin(angles), second)))


def _bodies(tool: Tool, specimen: Specimen, duration: float) -> list[Body]:
    material = O.materials.append(FrictMat(young=1, poisson=1, frictionAngle=0, density=1))
    if _is_wall(tool):
        axis = int(np.argmax(np.abs(tool.axis)))
        return [utils.wall(tool.origin, axis, sense=int(np.sign(tool.axis[axis])),
                           material=material)]
    if tool.shape == "plane":
        triangles = _large_triangle(tool, specimen, duration)[None]
    else:
        surface = specimen.surfaces[tool.name]
        triangles = surface.vertices[surface.facets]
    return [utils.facet(corners, material=material) for corners in triangles.tolist()]


class RigidTools:
    """The tools of a scene among YADE's bodies, at rest or in steady motion; to be added after the
    elements."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        """PreparedError for what is not understood."""
        self._tool_of: dict[int, str] = {}
        self.fault = ""  #: why a run ended
        for tool in parameters.tools:
            _check(tool)
            bodies = _bodies(tool, specimen, parameters.steps * parameters.time_step)
            for number in O.bodies.append(bodies):
                O.bodies[number].state.vel = tool.velocity
                if len(bodies) > 1:
                    self._tool_of[number] = tool.name

    @property
    def have_edges(self) -> bool:
        """Whether an element can touch two facets of a tool at once."""
        return bool(self._tool_of)

    def check_edges(self) -> None:
        """Ends the run where an element is pushed twice in one place."""
        normals: dict[tuple[int, str], list[Floats]] = defaultdict(list)
        for contact in O.interactions:
            element, facet = sorted((contact.id1, contact.id2))
            if facet not in self._tool_of or contact.geom.penetrationDepth <= 0:
                continue
            normal = np.array(contact.geom.normal) * (1 if contact.id1 == facet else -1)
            before = normals[element, self._tool_of[facet]]
            if any(normal @ other > ONE_PLACE for other in before):
                self.fault = (f"tool {self._tool_of[facet]}: element {element} touches two of its "
                              f"facets in one place, in step {O.iter}: YADE pushes it twice there; "
                              "expected elements that touch faces, away from the sides of facets")
                O.pause()
                return
            before.append(normal)
