# SPDX-License-Identifier: GPL-2.0-or-later
"""A plate heated through its thickness in a disc that moves: Terreros 2013, section 2.5.2."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.references.bessel import bessel_j1
from compare.result import Floats


@dataclass(frozen=True)
class MovingDisc:
    """A plate, insulated all round, and its source; x from 0 to length, y from −width/2 to width/2.

    Uniform through the thickness, so the problem is plane.
    """

    length: float  #: m
    width: float  #: m
    thickness: float  #: m
    density: float  #: kg/m³
    specific_heat_capacity: float  #: J/(kg K)
    conductivity: float  #: W/(m K)
    initial_temperature: float  #: K
    disc_radius: float  #: m
    power_density: float  #: W/m³ inside the disc
    start: tuple[float, float]  #: centre of the disc at time 0, m
    speed: float  #: along x, m/s
    duration: float  #: s; the disc lies inside the plate all the time

    def __post_init__(self) -> None:
        for time in (0.0, self.duration):
            x, y = self.start[0] + self.speed * time, self.start[1]
            margin = min(x, self.length - x, self.width / 2 - abs(y)) - self.disc_radius
            if margin < -1e-9 * self.length:
                raise ValueError(f"at {time} s the disc leaves the plate by {-margin} m")

    @property
    def diffusivity(self) -> float:
        """α, m²/s."""
        return self.conductivity / (self.density * self.specific_heat_capacity)

    def fraction_heated(self, time: float, lower: Floats, upper: Floats) -> Floats:
        """(N,) fraction of each rectangle from `lower` to `upper` (N, 2), m, inside the disc."""
        centre = np.array([self.start[0] + self.speed * time, self.start[1]])
        return disc_fraction(lower - centre, upper - centre, self.disc_radius)


def disc_fraction(lower: Floats, upper: Floats, radius: float, lines: int = 32) -> Floats:
    """(N,) fraction of each rectangle from `lower` to `upper` (N, 2) inside a disc about 0.

    Chords of the disc along x, Gauss points across.
    """
    points, weights = np.polynomial.legendre.leggauss(lines)
    y = (lower[:, 1:] + upper[:, 1:] + (upper - lower)[:, 1:] * points) / 2
    half = np.sqrt(np.maximum(0.0, radius**2 - y**2))
    x, across = lower[:, :1], (upper - lower)[:, :1]
    chord = np.clip(half, x, x + across) - np.clip(-half, x, x + across)
    return (chord / across) @ weights / 2


def moving_disc_temperature(plate: MovingDisc, time: Floats, points: Floats,
                            modes: int = 800) -> Floats:
    """(T, P) temperature, K, at times (T,), s, and points (P, 2), m.

    The double cosine series of the insulated plate, integrated in time exactly. A disc of radius a
    drives the mode of wave number k with 2πa J₁(ka)/k times the mode's value at its centre. `modes`
    along x; across, as many as reach the same wave number. The rest falls as k^-2.5: with 800 modes
    of the thesis' plate it is below 1e-6 of the temperatures.
    """
    x0, y0 = plate.start[0], plate.start[1] + plate.width / 2
    across = max(1, round(modes * plate.width / plate.length))
    kx, ky = np.meshgrid(np.pi / plate.length * np.arange(modes),
                         np.pi / plate.width * np.arange(across), indexing="ij")
    inside = np.hypot(kx / np.pi * plate.length / modes, ky / np.pi * plate.width / across) < 1
    drive = np.cos(ky * y0)
    kept = inside & (np.abs(drive) > 1e-12)
    kx, ky, drive = kx[kept], ky[kept], drive[kept]
    k = np.hypot(kx, ky)
    disc = np.full_like(k, np.pi * plate.disc_radius**2)
    wave = k > 0
    disc[wave] = 2 * np.pi * plate.disc_radius * bessel_j1(k[wave] * plate.disc_radius) / k[wave]
    norm = np.where(kx > 0, 2.0, 1.0) * np.where(ky > 0, 2.0, 1.0) / (plate.length * plate.width)
    heat = plate.power_density / (plate.density * plate.specific_heat_capacity)
    points = np.asarray(points, dtype=float)
    shape = (np.cos(np.multiply.outer(kx, points[:, 0]))
             * np.cos(np.multiply.outer(ky, points[:, 1] + plate.width / 2))
             * (heat * norm * disc * drive)[:, None])
    decay, turn = plate.diffusivity * k**2, kx * plate.speed
    rate = np.where(wave, decay + 1j * turn, 1.0)
    found = np.empty((len(time), len(points)))
    for row, t in enumerate(np.asarray(time, dtype=float)):
        # ∫ exp(−decay (t − s)) cos(kx x(s)) ds, the cosine as a real part.
        swing = np.exp(1j * kx * x0) * (np.exp(1j * turn * t) - np.exp(-decay * t)) / rate
        found[row] = np.where(wave, swing.real, t) @ shape
    return plate.initial_temperature + found
