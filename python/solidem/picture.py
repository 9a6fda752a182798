# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of bodies of spheres and of the tools beside them, without a display.

A pixel shows what stands nearest: each sphere and each triangle is entered into a buffer of depths.
Parallel projection; light comes from the viewer's upper left, and what lies deeper than what is
round it is darker. Tools are glass where they stand before a body.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Facets = NDArray[np.int64]

LIGHT = np.array([-0.4, 0.5, 0.77])
AMBIENT = 0.4
GLASS = 0.3  #: how much of its own colour a tool shows before a body
SAMPLES = 2  #: of each pixel, along either side


def view_axes(azimuth: float, elevation: float) -> Array:
    """Rows: right, up and towards the viewer, who looks from these angles, degrees; z is up."""
    a, e = np.radians([azimuth, elevation])
    towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return np.array([right, np.cross(towards, right), towards])


def blurred(values: Array, reach: int) -> Array:
    """Means over squares of 2 reach + 1 pixels, (height, width); edges are led on."""
    for axis in (0, 1):
        margins = [(reach + 1, reach) if a == axis else (0, 0) for a in (0, 1)]
        padded = np.pad(values, margins, "edge")
        sums = np.cumsum(padded, axis=axis)
        size = values.shape[axis]
        ahead = np.take(sums, np.arange(2 * reach + 1, 2 * reach + 1 + size), axis=axis)
        values = (ahead - np.take(sums, np.arange(size), axis=axis)) / (2 * reach + 1)
    return values


@dataclass
class Layer:
    """What stands nearest to the viewer: its depth, m (−inf: nothing), and its colour, 0 to 1."""

    height: int
    width: int
    depth: Array = field(init=False)
    colour: Array = field(init=False)

    def __post_init__(self) -> None:
        self.depth = np.full((self.height, self.width), -np.inf)
        self.colour = np.ones((self.height, self.width, 3))

    def enter(self, place: tuple[slice, slice], depth: Array, colour: Array,
              inside: NDArray[np.bool_]) -> None:
        """Something that fills the pixels `inside` of the rectangle `place`."""
        nearer = inside & (depth > self.depth[place])
        self.depth[place][nearer] = depth[nearer]
        self.colour[place][nearer] = colour[nearer]


@dataclass
class Picture:
    """A picture that is being painted. `lower`, `upper`: corners of what must be seen, m."""

    lower: Array
    upper: Array
    azimuth: float = -60
    elevation: float = 25
    width: int = 900

    def __post_init__(self) -> None:
        self.axes = view_axes(self.azimuth, self.elevation)
        box = np.array([self.lower, self.upper])
        corners = np.array([[box[i, 0], box[j, 1], box[k, 2]]
                            for i in (0, 1) for j in (0, 1) for k in (0, 1)]) @ self.axes.T
        self.low = corners[:, :2].min(axis=0)
        size = corners[:, :2].max(axis=0) - self.low
        margin = 0.03 * size.max()
        self.low -= margin
        size = size + 2 * margin
        self.scale = self.width * SAMPLES / size[0]  #: samples in a metre
        height = SAMPLES * max(1, round(size[1] * self.scale / SAMPLES))
        self.bodies = Layer(height, self.width * SAMPLES)
        self.tools = Layer(height, self.width * SAMPLES)

    @property
    def pixels_per_metre(self) -> float:
        """Of the image."""
        return float(self.scale / SAMPLES)

    def _patch(self, low: Array, high: Array) -> tuple[tuple[slice, slice], Array, Array]:
        """The samples of a rectangle of the view, and where their middles lie, m."""
        height, width = self.bodies.depth.shape
        ends = np.array([width, height])
        first = np.clip(np.floor((low - self.low) * self.scale).astype(int), 0, ends)
        last = np.clip(np.ceil((high - self.low) * self.scale).astype(int) + 1, first, ends)
        x = (np.arange(first[0], last[0]) + 0.5) / self.scale + self.low[0]
        y = (np.arange(first[1], last[1]) + 0.5) / self.scale + self.low[1]
        return (slice(first[1], last[1]), slice(first[0], last[0])), x[None, :], y[:, None]

    def spheres(self, position: Array, radius: Array, colour: Array) -> None:
        """`position` (N,3) and `radius` (N) in m, `colour` (N,3) from 0 to 1."""
        for centre, r, c in zip(position @ self.axes.T, radius, colour):
            place, x, y = self._patch(centre[:2] - r, centre[:2] + r)
            u, v = (x - centre[0]) / r, (y - centre[1]) / r
            square = 1 - u * u - v * v
            w = np.sqrt(np.maximum(square, 0))
            towards = np.clip(u * LIGHT[0] + v * LIGHT[1] + w * LIGHT[2], 0, 1)
            light = AMBIENT + (1 - AMBIENT) * towards
            self.bodies.enter(place, centre[2] + r * w, light[..., None] * c, square > 0)

    def triangles(self, vertices: Array, facets: Facets, colour: Array) -> None:
        """The surface of a tool, of one colour; `facets` (F,3) number the `vertices` (V,3), m."""
        for a, b, c in (vertices @ self.axes.T)[facets]:
            normal = np.cross(b - a, c - a)
            length = np.linalg.norm(normal)
            if abs(normal[2]) <= 1e-12 * length:  # seen from its edge
                continue
            corners = np.array([a, b, c])[:, :2]
            place, x, y = self._patch(corners.min(axis=0), corners.max(axis=0))
            # Shares of the corners at each sample.
            p = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / normal[2]
            q = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / normal[2]
            s = 1 - p - q
            inside = (p >= 0) & (q >= 0) & (s >= 0)
            facing = normal / length * np.sign(normal[2])
            light = AMBIENT + (1 - AMBIENT) * max(0.0, float(facing @ LIGHT))
            shown = np.broadcast_to(light * colour, (*inside.shape, 3))
            self.tools.enter(place, p * a[2] + q * b[2] + s * c[2], shown, inside)

    def _shaded(self) -> Array:
        """The bodies' colours, darker where they lie deeper than what is round them."""
        depth = self.bodies.depth
        filled = np.isfinite(depth)
        if not filled.any():
            return self.bodies.colour
        ground = np.where(filled, depth, depth[filled].min())
        hidden = np.zeros_like(depth)
        for share in (0.006, 0.025):
            reach = max(1, int(share * depth.shape[1]))
            below = (blurred(ground, reach) - ground) * self.scale / reach
            hidden += np.clip(below, 0, 1.5)
        light = np.where(filled, np.exp(-0.55 * hidden), 1)[..., None]
        return np.asarray(self.bodies.colour * light)

    def image(self) -> Array:
        """(height, width, 3), from 0 to 1, the first row on top."""
        colour = self._shaded()
        before = self.tools.depth > self.bodies.depth
        glass = np.where(np.isfinite(self.bodies.depth), GLASS, 1)[before][:, None]
        colour[before] = glass * self.tools.colour[before] + (1 - glass) * colour[before]
        height, width, _ = colour.shape
        samples = colour.reshape(height // SAMPLES, SAMPLES, width // SAMPLES, SAMPLES, 3)
        return np.asarray(samples.mean(axis=(1, 3)))[::-1]
