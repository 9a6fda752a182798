# SPDX-License-Identifier: GPL-2.0-or-later
"""Laws of central force, in numpy.

They are those of solidem (standalone/laws/), written a second time from the equations of their
sources. `central_body.py` lets a body interact by them, `scripted_central_forces.py` in YADE.

Symbols: δ distance of two centres, δ_eq where the law has no force, F > 0 pushes apart and is −dΦ/dδ,
K = −dF/dδ. A law acts within the range δ_lim = α (R_i + R_j) and goes on along its tangent below
(1 − a) δ_eq.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from contrib.prepared import CentralForces

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]


class Law(Protocol):
    """A central law; distances and results are of the same shape, SI."""

    def force(self, distance: Floats, equilibrium: Floats) -> Floats:
        """F, N."""

    def slope(self, distance: Floats, equilibrium: Floats) -> Floats:
        """K, N/m."""

    def potential(self, distance: Floats, equilibrium: Floats) -> Floats:
        """Φ of any zero, J."""


@dataclass(frozen=True)
class Mie:
    """The (m,n) potential (Gado 2017, equations 1 and 2)."""

    energy: float  #: ε, J
    repulsive_exponent: float  #: m
    attractive_exponent: float  #: n

    def force(self, distance: Floats, equilibrium: Floats) -> Floats:
        """mnε/((m−n)δ_eq) [(δ_eq/δ)^(m+1) − (δ_eq/δ)^(n+1)]."""
        m, n = self.repulsive_exponent, self.attractive_exponent
        s = equilibrium / distance
        return m * n * self.energy / ((m - n) * equilibrium) * (s**(m + 1) - s**(n + 1))

    def slope(self, distance: Floats, equilibrium: Floats) -> Floats:
        """mnε/((m−n)δ²) [(m+1)(δ_eq/δ)^m − (n+1)(δ_eq/δ)^n]."""
        m, n = self.repulsive_exponent, self.attractive_exponent
        s = equilibrium / distance
        return (m * n * self.energy / ((m - n) * distance**2)
                * ((m + 1) * s**m - (n + 1) * s**n))

    def potential(self, distance: Floats, equilibrium: Floats) -> Floats:
        """ε/(m−n) [n (δ_eq/δ)^m − m (δ_eq/δ)^n]."""
        m, n = self.repulsive_exponent, self.attractive_exponent
        s = equilibrium / distance
        return self.energy / (m - n) * (n * s**m - m * s**n)


@dataclass(frozen=True)
class LennardJones:
    """F = 12ε (δ_eq¹²/δ¹³ − δ_eq⁶/δ⁷) (Terreros 2013, section 3.1.1)."""

    energy: float  #: ε, J

    def force(self, distance: Floats, equilibrium: Floats) -> Floats:
        """F, N."""
        return 12 * self.energy * (equilibrium**12 / distance**13 - equilibrium**6 / distance**7)

    def slope(self, distance: Floats, equilibrium: Floats) -> Floats:
        """K, N/m."""
        return 12 * self.energy * (13 * equilibrium**12 / distance**14
                                   - 7 * equilibrium**6 / distance**8)

    def potential(self, distance: Floats, equilibrium: Floats) -> Floats:
        """Φ, J."""
        s = equilibrium / distance
        return self.energy * (s**12 - 2 * s**6)


@dataclass(frozen=True)
class ShiftedLennardJones:
    """F = D [δ_eq¹²/u¹³ − δ_eq⁶/u⁷], u = Bδ − C (Terreros 2013, annex D)."""

    attraction: float  #: γ, N, at δ_max
    peak_separation: float  #: δ_max / δ_eq

    def _constants(self, distance: Floats, equilibrium: Floats) -> tuple[float, Floats, Floats]:
        """B, D and u."""
        q = (13 / 7) ** (1 / 6)
        b = (q - 1) / (self.peak_separation - 1)
        d = self.attraction * equilibrium / (q**-7 - q**-13)
        return b, d, b * distance - equilibrium * (b - 1)

    def force(self, distance: Floats, equilibrium: Floats) -> Floats:
        """F, N."""
        _, d, u = self._constants(distance, equilibrium)
        return d * (equilibrium**12 / u**13 - equilibrium**6 / u**7)

    def slope(self, distance: Floats, equilibrium: Floats) -> Floats:
        """K, N/m."""
        b, d, u = self._constants(distance, equilibrium)
        return b * d * (13 * equilibrium**12 / u**14 - 7 * equilibrium**6 / u**8)

    def potential(self, distance: Floats, equilibrium: Floats) -> Floats:
        """Φ, J."""
        b, d, u = self._constants(distance, equilibrium)
        return d / b * (equilibrium**12 / (12 * u**12) - equilibrium**6 / (6 * u**6))


@dataclass(frozen=True)
class Piecewise:
    """F = K (δ_eq − δ), no less than −γ (Terreros 2013, section 3.1.3)."""

    stiffness: float  #: K, N/m
    attraction: float  #: γ, N

    def force(self, distance: Floats, equilibrium: Floats) -> Floats:
        """F, N."""
        return np.maximum(self.stiffness * (equilibrium - distance), -self.attraction)

    def slope(self, distance: Floats, equilibrium: Floats) -> Floats:
        """K, on the plateau 0, N/m."""
        elastic = self.stiffness * (distance - equilibrium) <= self.attraction
        return np.where(elastic, self.stiffness, 0.0)

    def potential(self, distance: Floats, equilibrium: Floats) -> Floats:
        """Φ, J, 0 at δ_eq."""
        stretch, end = distance - equilibrium, self.attraction / self.stiffness
        return np.where(stretch <= end, 0.5 * self.stiffness * stretch**2,
                        self.attraction * (stretch - 0.5 * end))


@dataclass(frozen=True)
class Threshold:
    """Two (m,n) potentials (Gado 2017, equation 8): F_I up to δ_s = (1 ± ξ_s) δ_eq, beyond it
    F_II(δ − δ_s + δ_eq) + F_I(δ_s)."""

    energy: float
    repulsive_exponent: float
    attractive_exponent: float
    beyond_energy: float
    beyond_repulsive_exponent: float
    beyond_attractive_exponent: float
    threshold_strain: float  #: ξ_s

    @property
    def _first(self) -> Mie:
        return Mie(self.energy, self.repulsive_exponent, self.attractive_exponent)

    @property
    def _second(self) -> Mie:
        return Mie(self.beyond_energy, self.beyond_repulsive_exponent,
                   self.beyond_attractive_exponent)

    def _parts(self, distance: Floats, equilibrium: Floats) -> tuple[Flags, Floats, Floats]:
        """Whether beyond the threshold, δ_s on that side, and δ − δ_s + δ_eq."""
        beyond = np.abs(distance - equilibrium) > self.threshold_strain * equilibrium
        side = np.sign(distance - equilibrium)
        end = (1 + side * self.threshold_strain) * equilibrium
        return beyond, end, np.where(beyond, distance - end, 0) + equilibrium

    def force(self, distance: Floats, equilibrium: Floats) -> Floats:
        """F, N."""
        beyond, end, further = self._parts(distance, equilibrium)
        return np.where(beyond, self._second.force(further, equilibrium)
                        + self._first.force(end, equilibrium),
                        self._first.force(distance, equilibrium))

    def slope(self, distance: Floats, equilibrium: Floats) -> Floats:
        """K, N/m."""
        beyond, _, further = self._parts(distance, equilibrium)
        return np.where(beyond, self._second.slope(further, equilibrium),
                        self._first.slope(distance, equilibrium))

    def potential(self, distance: Floats, equilibrium: Floats) -> Floats:
        """Φ, J, continuous."""
        beyond, end, further = self._parts(distance, equilibrium)
        past = (self._second.potential(further, equilibrium) + self.beyond_energy
                + self._first.potential(end, equilibrium)
                - self._first.force(end, equilibrium) * (distance - end))
        return np.where(beyond, past, self._first.potential(distance, equilibrium))


LAWS: dict[str, type] = {
    "piecewise": Piecewise,
    "lennard-jones": LennardJones,
    "shifted-lennard-jones": ShiftedLennardJones,
    "mie": Mie,
    "threshold": Threshold,
}


def law_named(name: str, parameters: dict[str, float]) -> Law:
    """A law from its name and its parameters by name; ValueError says what does not fit."""
    if name not in LAWS:
        raise ValueError(f"no central law is called {name!r}; known: {', '.join(LAWS)}")
    wanted = [f.name for f in fields(LAWS[name])]
    if sorted(wanted) != sorted(parameters):
        raise ValueError(f"law {name!r} needs {', '.join(wanted)}; found {', '.join(parameters)}")
    found: Law = LAWS[name](*(float(parameters[key]) for key in wanted))
    return found


@dataclass(frozen=True)
class Interaction:
    """A law with what all laws share."""

    law: Law
    interpenetration: float  #: a

    def force(self, distance: Floats, equilibrium: Floats, limit: Floats) -> Floats:
        """F, N, 0 from the range `limit` = δ_lim on."""
        nearest = (1 - self.interpenetration) * equilibrium
        kept = np.maximum(distance, nearest)
        found = self.law.force(kept, equilibrium)
        if (distance < nearest).any():
            found = found + self.law.slope(nearest, equilibrium) * (kept - distance)
        return np.where(distance < limit, found, 0.0)

    def potential(self, distance: Floats, equilibrium: Floats, limit: Floats) -> Floats:
        """Φ, J, 0 from the range on."""
        nearest = (1 - self.interpenetration) * equilibrium
        kept = np.maximum(distance, nearest)
        deeper = kept - distance
        along = deeper * (self.law.force(nearest, equilibrium)
                          + 0.5 * deeper * self.law.slope(nearest, equilibrium))
        end = self.law.potential(limit, equilibrium)
        return np.where(distance < limit, self.law.potential(kept, equilibrium) + along - end, 0.0)


def interaction_of(forces: CentralForces) -> Interaction:
    """What a scene's central forces do to a pair."""
    return Interaction(law_named(forces.law, forces.parameters), forces.interpenetration)
