# SPDX-License-Identifier: GPL-2.0-or-later
"""Exact temperature fields that a case names in its table [options.solution], all in SI units.

    kind = "rod"        length, hot: one end (position 0) held, the rest insulated
    kind = "cooling_bar"  length, coefficient (W/(m² K)), fluid: its temperature; one end (position 0) in it,
                        the rest insulated
    kind = "warming_bar"  as "rod", but conductivity and specific_heat_capacity are proportional tables
                        {temperature = [...], value = [...]}
    kind = "layers"     layers = [{length, conductivity, density, specific_heat_capacity}, ...],
                        low, high: temperatures of the ends (left out: insulated), contacts = [...]
    kind = "annulus"    inner, outer: radii; inner_temperature, outer_temperature (the same)
    kind = "wedge"      inner, outer, angle; first, last: temperatures of the planes

and of all: axis (0, 1, 2: along a bar, or that of the round body), initial; but for layers also
conductivity, density, specific_heat_capacity. The round bodies' axis goes through the origin.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable

import numpy as np

from compare.references import (Layer, Table, cooling_bar_temperature, layers_temperature,
                                rod_temperature, warming_bar_temperature, wedge_temperature)
from compare.result import CodeFailure, Floats

Field = Callable[[Floats, float], Floats]


@dataclass(frozen=True)
class Solution:
    """A field, and the coordinate along which profiles are drawn."""

    temperature: Field  #: positions (N, 3), m, and time, s -> (N,) K
    coordinate: Field  #: positions, time -> (N,) fraction of the way through the body, 0 to 1
    label: str  #: of that coordinate
    time_scale: float  #: L²/α, s
    scale: float  #: largest temperature difference, K


def _round(position: Floats, axis: int) -> tuple[Floats, Floats]:
    """Distance from an axis and angle round it, counted from the next axis."""
    a, b = position[:, (axis + 1) % 3], position[:, (axis + 2) % 3]
    return np.hypot(a, b), np.arctan2(b, a) % (2 * np.pi)


def _layer(lower: float, upper: float, material: dict[str, Any]) -> Layer:
    return Layer(lower, upper, material["conductivity"],
                 material["density"] * material["specific_heat_capacity"])


def _scale(*temperatures: float | None) -> float:
    known = [t for t in temperatures if t is not None]
    return max(known) - min(known)


def _rod(t: dict[str, Any], axis: int, initial: float) -> Solution:
    length, hot = t["length"], t["hot"]
    scale = length**2 / (t["conductivity"] / (t["density"] * t["specific_heat_capacity"]))
    return Solution(
        lambda x, time: rod_temperature(x[:, axis], length, time / scale, initial, hot),
        lambda x, time: x[:, axis] / length, "distance from the hot end / L", scale,
        _scale(initial, hot))


def _cooling_bar(t: dict[str, Any], axis: int, initial: float) -> Solution:
    length, fluid = t["length"], t["fluid"]
    scale = length**2 / (t["conductivity"] / (t["density"] * t["specific_heat_capacity"]))
    biot = t["coefficient"] * length / t["conductivity"]
    return Solution(
        lambda x, time: cooling_bar_temperature(x[:, axis], length, time / scale, biot, initial, fluid),
        lambda x, time: x[:, axis] / length, "distance from the cooled end / L", scale,
        _scale(initial, fluid))


def _warming_bar(t: dict[str, Any], axis: int, initial: float) -> Solution:
    length, hot = t["length"], t["hot"]
    conductivity, capacity = (Table(**t[name]) for name in ("conductivity", "specific_heat_capacity"))
    rows = np.union1d(conductivity.temperature, capacity.temperature)
    diffusivity = conductivity.at(rows) / (t["density"] * capacity.at(rows))
    if np.ptp(diffusivity) > 1e-12 * diffusivity.max():
        raise CodeFailure("[options.solution]: conductivity and specific_heat_capacity are not proportional")
    scale = length**2 / float(diffusivity[0])
    return Solution(
        lambda x, time: warming_bar_temperature(x[:, axis], length, time / scale, conductivity, initial,
                                                hot),
        lambda x, time: x[:, axis] / length, "distance from the hot end / L", scale,
        _scale(initial, hot))


def _layers(t: dict[str, Any], axis: int, initial: float) -> Solution:
    layers, start = [], 0.0
    for part in t["layers"]:
        layers.append(_layer(start, start + part["length"], part))
        start = layers[-1].upper
    ends = (t.get("low"), t.get("high"))
    return Solution(
        lambda x, time: layers_temperature(x[:, axis], time, layers, initial, ends,
                                           t.get("contacts", [])),
        lambda x, time: x[:, axis] / start, "x / L",
        start**2 * layers[0].capacity / layers[0].conductivity, _scale(initial, *ends))


def _annulus(t: dict[str, Any], axis: int, initial: float) -> Solution:
    ring = _layer(t["inner"], t["outer"], t)
    ends = (t.get("inner_temperature"), t.get("outer_temperature"))
    across = ring.upper - ring.lower
    return Solution(
        lambda x, time: layers_temperature(_round(x, axis)[0], time, [ring], initial, ends,
                                           radial=True),
        lambda x, time: (_round(x, axis)[0] - ring.lower) / across,
        "(r − inner) / (outer − inner)", across**2 * ring.capacity / ring.conductivity,
        _scale(initial, *ends))


def _wedge(t: dict[str, Any], axis: int, initial: float) -> Solution:
    ring, opening = _layer(t["inner"], t["outer"], t), t["angle"]
    kept: dict[float, tuple[Floats, Floats, Floats]] = {}

    def temperature(x: Floats, time: float) -> Floats:
        # The series is summed on a fine grid, and read between its points.
        if time not in kept:
            r, a = np.linspace(ring.lower, ring.upper, 65), np.linspace(0, opening, 257)
            kept[time] = r, a, wedge_temperature(
                *(g.ravel() for g in np.meshgrid(r, a, indexing="ij")), time, ring, opening,
                initial, t["first"], t["last"]).reshape(65, 257)
        return _bilinear(*kept[time], *_round(x, axis))

    middle = (ring.lower + ring.upper) / 2 * opening
    return Solution(temperature, lambda x, time: _round(x, axis)[1] / opening,
                    "angle / opening", middle**2 * ring.capacity / ring.conductivity,
                    _scale(initial, t["first"], t["last"]))


def _bilinear(r: Floats, a: Floats, values: Floats, radius: Floats, angle: Floats) -> Floats:
    u = np.clip((radius - r[0]) / (r[1] - r[0]), 0, len(r) - 1.000001)
    v = np.clip((angle - a[0]) / (a[1] - a[0]), 0, len(a) - 1.000001)
    i, j = u.astype(int), v.astype(int)
    u, v = u - i, v - j
    return ((1 - u) * ((1 - v) * values[i, j] + v * values[i, j + 1])
            + u * ((1 - v) * values[i + 1, j] + v * values[i + 1, j + 1]))


KINDS = {"rod": _rod, "cooling_bar": _cooling_bar, "warming_bar": _warming_bar, "layers": _layers,
         "annulus": _annulus, "wedge": _wedge}


def solution(options: dict[str, Any]) -> Solution:
    """The exact field of a case's options; CodeFailure names what is missing."""
    table = options.get("solution", {})
    if table.get("kind") not in KINDS:
        raise CodeFailure(f"[options.solution] kind {table.get('kind')!r}; known: "
                          f"{', '.join(KINDS)}")
    try:
        return KINDS[table["kind"]](table, int(table["axis"]), float(table["initial"]))
    except KeyError as error:
        raise CodeFailure(f"[options.solution] has no {error}") from error
