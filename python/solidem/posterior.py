# SPDX-License-Identifier: GPL-2.0-or-later
"""What runs leave possible of the limit Q_0, the constant C and the order p of

    Q(h) = Q_0 + C h^p + scatter of packings + what is off the power,

h the size of an element over that of the coarsest body. For each order, each extent of C and each
extent of what is off the power Q_0 and C are normally distributed (least squares); these are weighed
by how likely they make the runs. C has extents for where it had none, low orders, of which Q_0 and C
can both be as large as they like, would seem the likeliest of all.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import erf
from typing import NamedTuple, Sequence

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

ORDERS = np.arange(0.2, 3.001, 0.1)  #: that are weighed
#: How far a coarse body may be off the power, over how far it is off the finest; and how likely.
OFF_THE_POWER = ((0.07, 0.6), (0.25, 0.3), (0.8, 0.1))
#: Standard deviations of C, over the scale, one as likely as another: bodies of 200 elements of the
#: studies of motion err by 2 to 46 %.
EXTENTS = (0.03, 0.1, 0.3, 1.0)
#: Share of the scatter of one packing that stays however many there are: edges of regions, readings
#: and walls cut through elements of this size alike in all packings.
STAYS = 0.15
FALLS = np.arange(0.4, 1.801, 0.05)  #: powers of the size that scatter may fall with
USUAL_FALL, FALL_SPREAD = 1.3, 0.3  #: as found of packings; 1.5 is as independent elements
STRAY = 8.0  #: robust standard deviations from the median, beyond which a figure says nothing of scatter
_AT = np.linspace(-6.0, 6.0, 1201)
_BELOW = np.array([0.5 * (1 + erf(value / np.sqrt(2))) for value in _AT])


def _below(values: Floats) -> Floats:
    """Of a normal distribution of mean 0 and standard deviation 1."""
    return np.interp(values, _AT, _BELOW)


@dataclass(frozen=True)
class Scatter:
    """From packing to packing."""

    first: float  #: standard deviation of the coarsest body
    falls: float  #: as this power of the size
    freedom: int  #: packings that tell it; 0: none do

    def of(self, size: float | Floats) -> float | Floats:
        """Standard deviation of one packing."""
        return self.first * size**self.falls

    @property
    def widened(self) -> float:
        """Few packings tell it badly: how much wider what depends on it is."""
        return float(np.sqrt(1 + 4 / self.freedom)) if self.freedom else 1.0


def scatter_of(sizes: Floats, figures: Sequence[Floats]) -> Scatter:
    """The likeliest of several packings of each size."""
    freedoms = np.array([len(level) - 1 for level in figures])
    squares = np.array([float(((level - level.mean())**2).sum()) for level in figures])
    freedom = int(freedoms.sum())
    if not freedom or not squares.any():
        return Scatter(0.0, USUAL_FALL, freedom)
    variance = (squares * sizes**(-2 * FALLS[:, None])).sum(axis=1) / freedom
    likely = (-0.5 * freedom * np.log(variance) - FALLS * (freedoms * np.log(sizes)).sum()
              - 0.5 * ((FALLS - USUAL_FALL) / FALL_SPREAD)**2)
    best = int(likely.argmax())
    return Scatter(float(np.sqrt(variance[best])), float(FALLS[best]), freedom)


def without_strays(sizes: Floats, figures: Sequence[Floats]) -> list[Floats]:
    """Figures without those that are far from all others of their level, whether the scatter is that of
    the level or of all levels together: of a sensor whose nearest element hangs on no bond."""
    away = [np.abs(level - np.median(level)) for level in figures]
    scaled = np.concatenate([off / size**USUAL_FALL for off, size in zip(away, sizes)])
    if not scaled.any():
        return list(figures)
    usual = 1.4826 * np.median(scaled[scaled > 0])  # a median itself is no deviation
    return [level[off <= STRAY * max(usual * size**USUAL_FALL, 1.4826 * float(np.median(off)))]
            for level, off, size in zip(figures, away, sizes)]


class Drawn(NamedTuple):
    """Of what is possible."""

    limits: Floats
    constants: Floats
    orders: Floats


class Posterior:
    """A mixture of normal distributions of Q_0 and C, each with its order."""

    def __init__(self, sizes: Floats, means: Floats, counts: Floats, scatter: Scatter, scale: float,
                 prior: Floats) -> None:
        """From the coarsest level to the finest. `counts`: packings of each; `scale`: what shares are
        of; `prior`: how likely each of ORDERS is before."""
        self.scale = scale
        self._sizes, self._means, self._counts = sizes, means, counts
        self._scatter, self._prior = scatter, prior
        # Away from the finest mean, which is a number of any magnitude.
        rest = means - means[-1]
        off = np.maximum.accumulate(np.abs(rest)[::-1])[::-1]
        off[-1] = off[-2] / 3
        one = np.asarray(scatter.of(sizes))
        spread = np.hypot(scatter.widened * one / np.sqrt(counts), STAYS * one)
        powers = sizes**ORDERS[:, None]  # (orders, levels); all below (off the power, extent, order)
        apart, as_likely = (np.array(column)[:, None, None] for column in zip(*OFF_THE_POWER))
        extents = np.array(EXTENTS)[None, :, None] * scale
        weights = np.maximum(np.hypot(spread, apart * off), 1e-9 * scale)[:, 0]**-2
        whole, moved = weights.sum(axis=1)[:, None, None], (weights @ rest)[:, None, None]
        first, second = (weights @ powers.T)[:, None], (weights @ (powers**2).T)[:, None]
        tilted = ((weights * rest) @ powers.T)[:, None]
        held = second + extents**-2
        determinant = whole * held - first**2
        limits = (held * moved - first * tilted) / determinant
        constants = (whole * tilted - first * moved) / determinant
        missed = (weights @ rest**2)[:, None, None] - limits * moved - constants * tilted
        likely = (np.log(np.maximum(prior, 1e-300) * as_likely / extents)
                  + 0.5 * np.log(weights).sum(axis=1)[:, None, None]
                  - 0.5 * np.log(determinant) - 0.5 * missed)
        table = [limits + means[-1], constants, held / determinant, whole / determinant,
                 -first / determinant, ORDERS]
        shares = np.exp(likely - likely.max())
        chosen = shares > 1e-5
        self.shares = shares[chosen] / shares[chosen].sum()
        (self._limits, self._constants, self._of_limits, self._of_constants, self._together,
         self._orders) = (np.broadcast_to(column, likely.shape)[chosen]
                                            for column in table)
        self.limit = float(self.shares @ self._limits)  #: mean

    def half_width(self, probability: float) -> float:
        """Of the interval round the mean limit, in which it lies with this probability."""
        deviation = np.sqrt(self._of_limits)
        variance = self.shares @ (self._of_limits + (self._limits - self.limit)**2)
        narrow, wide = 0.0, 8 * float(np.sqrt(variance))
        for _ in range(24):
            middle = 0.5 * (narrow + wide)
            inside = self.shares @ (_below((self.limit + middle - self._limits) / deviation)
                                    - _below((self.limit - middle - self._limits) / deviation))
            narrow, wide = (narrow, middle) if inside > probability else (middle, wide)
        return wide

    def drawn(self, number: int, noise: np.random.Generator) -> Drawn:
        """So many of what is possible."""
        chosen = noise.choice(len(self.shares), number, p=self.shares)
        normal = noise.standard_normal((2, number))
        root = np.sqrt(self._of_limits[chosen])
        along = self._together[chosen] / root
        across = np.sqrt(np.maximum(self._of_constants[chosen] - along**2, 0.0))
        return Drawn(self._limits[chosen] + root * normal[0],
                     self._constants[chosen] + along * normal[0] + across * normal[1],
                     self._orders[chosen])

    def expected(self, size: float) -> float:
        """Mean of a level of this size."""
        return float(self.shares @ (self._limits + self._constants * size**self._orders))

    def foreseen(self, sizes: Floats, counts: Floats) -> Posterior:
        """As it becomes with so many packings of each size, of which those that there are keep their
        figures and all others are as expected."""
        known = dict(zip(self._sizes.tolist(), zip(self._means.tolist(), self._counts.tolist())))
        means = np.empty_like(sizes)
        for number, (size, count) in enumerate(zip(sizes.tolist(), counts.tolist())):
            mean, before = known.get(size, (0.0, 0.0))
            means[number] = (before * mean + (count - before) * self.expected(size)) / count
        freedom = self._scatter.freedom + int(counts.sum() - self._counts.sum())
        scatter = Scatter(self._scatter.first, self._scatter.falls, freedom)
        return Posterior(sizes, means, counts, scatter, self.scale, self._prior)
