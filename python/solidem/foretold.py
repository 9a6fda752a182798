# SPDX-License-Identifier: GPL-2.0-or-later
"""What a few small runs foretell of a larger one: its error and its time.

A figure of one run is Q = Q_0 + C h^p + scatter of its packing + error of its steps, h the size of an
element. Q_0 and C are sought for each order p, which is weighed by how well it fits and by what the
studies found of scenes of this kind. What is not known stays in: errors are drawn from all that the
runs leave possible.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np
import numpy.typing as npt

from ._core import InputError
from .converge import Level
from .studies import Study

Floats = npt.NDArray[np.float64]

DRAWS = 4000  #: of limits, constants and orders
LIKELY = 0.95  #: with which an error stays below what is promised
#: How far a coarse body may be off the power, over how far its figure is off that of the finest.
OFF_THE_POWER = 0.07
ORDERS = np.arange(0.3, 3.001, 0.05)  #: that are weighed
UNKNOWN_ORDERS = (0.75, 2.25)  #: between which all are alike where there is no study


@dataclass(frozen=True)
class Errors:
    """Of a run, as shares of the figure's scale."""

    bias: float  #: of bodies of this fineness, whatever the packing: median
    bias_upper: float  #: stays below it with a probability of LIKELY
    scatter: float  #: standard deviation from packing to packing (of the mean of several)
    expected: float  #: median of all together
    promised: float  #: stays below it with a probability of LIKELY


def prior(study: Study | None) -> Floats:
    """How likely each of ORDERS is before these runs."""
    if study is None:
        low, high = UNKNOWN_ORDERS
        return ((ORDERS >= low - 1e-9) & (ORDERS <= high + 1e-9)).astype(float)
    density: Floats = np.exp(-0.5 * ((ORDERS - study.order) / study.spread)**2) * (
        (ORDERS >= UNKNOWN_ORDERS[0] - 1e-9) & (ORDERS <= UNKNOWN_ORDERS[1] + 1e-9))
    return density


class ErrorModel:
    """Errors by number of elements, from levels of several packings."""

    def __init__(self, levels: Sequence[Level], scale: float, study: Study | None,
                 step_error: float = 0.0) -> None:
        """`levels`: `value` is the number of elements. `scale`: what errors are shares of.
        `step_error`: share that the steps of the finest level err by."""
        if len(levels) < 2:
            raise InputError("one refinement tells no limit; expected two or more")
        self.levels = sorted(levels, key=lambda level: level.value)
        self.scale, self.study, self._step_error = scale, study, step_error
        self._first = self.levels[0].value
        self._noise = np.random.default_rng(1)
        counts = np.array([len(level.figures) for level in self.levels])
        self.freedom = int((counts - 1).sum())
        squares = sum(float(((level.figures - level.mean)**2).sum()) * level.value / self._first
                      for level in self.levels)
        #: Standard deviation over packings of the coarsest body; finer ones, as the root of their
        #: number of elements.
        self._scatter = np.sqrt(squares / self.freedom) if self.freedom else 0.0
        self._fit(counts)

    def size(self, elements: float) -> float:
        """h, over that of the coarsest level."""
        return float((elements / self._first)**(-1 / 3))

    def _fit(self, counts: npt.NDArray[np.int64]) -> None:
        sizes = np.array([self.size(level.value) for level in self.levels])
        means = np.array([level.mean for level in self.levels])
        off = np.abs(means - means[-1])
        off[-1] = off[-2] / 3
        widened = np.sqrt(1 + 4 / self.freedom) if self.freedom else 1.0  # few packings tell it badly
        spread = widened * self._scatter * sizes**1.5 / np.sqrt(counts)
        weights = 1 / np.maximum(np.hypot(spread, OFF_THE_POWER * off), 1e-9 * self.scale)
        likely, found, roots = [], [], []
        for order, before in zip(ORDERS, prior(self.study)):
            columns = np.stack([np.ones_like(sizes), sizes**order], axis=1) * weights[:, None]
            covariance = np.linalg.inv(columns.T @ columns)
            best = covariance @ (columns.T @ (means * weights))
            missed = float(((columns @ best - means * weights)**2).sum())
            likely.append(np.log(max(before, 1e-300)) - 0.5 * missed
                          + 0.5 * np.linalg.slogdet(covariance)[1])
            found.append(best)
            roots.append(np.linalg.cholesky(covariance))
        shares = np.exp(np.array(likely) - max(likely)) * (prior(self.study) > 1e-12)
        chosen = self._noise.choice(len(ORDERS), DRAWS, p=shares / shares.sum())
        normal = self._noise.standard_normal((DRAWS, 2))
        drawn = np.array(found)[chosen] + np.einsum("dij,dj->di", np.array(roots)[chosen], normal)
        self.limits, self.constants = drawn.T
        self.orders = ORDERS[chosen]
        self._normal = self._noise.standard_t(max(self.freedom, 2), DRAWS)

    @property
    def limit(self) -> tuple[float, float, float]:
        """What finer and finer bodies tend to: median and the ends of its interval."""
        low, middle, high = np.percentile(self.limits, [2.5, 50, 97.5])
        return float(middle), float(low), float(high)

    @property
    def order(self) -> tuple[float, float, float]:
        """Median and the ends of its interval."""
        low, middle, high = np.percentile(self.orders, [2.5, 50, 97.5])
        return float(middle), float(low), float(high)

    def scatter(self, elements: float) -> float:
        """Standard deviation over packings, as a share."""
        return float(self._scatter * self.size(elements)**1.5 / self.scale)

    def errors(self, elements: float, packings: int = 1) -> Errors:
        """Of the mean of so many packings."""
        bias = self.constants * self.size(elements)**self.orders / self.scale
        scatter = self.scatter(elements) / np.sqrt(packings)
        drawn = np.abs(bias + scatter * self._normal) + self._step_error
        return Errors(float(np.median(np.abs(bias))),
                      float(np.quantile(np.abs(bias), LIKELY)), float(scatter),
                      float(np.median(drawn)), float(np.quantile(drawn, LIKELY)))

    def elements_for(self, error: float, largest: float, packings: int = 1) -> float | None:
        """The fewest elements that keep an error; None: no more than `largest` do not."""
        def kept(elements: float) -> bool:
            return self.errors(elements, packings).promised <= error

        few, many = self._first, max(largest, self._first)
        if kept(few):
            return float(few)
        if not kept(many):
            return None
        while many > 1.02 * few:
            middle = float(np.sqrt(few * many))
            few, many = (few, middle) if kept(middle) else (middle, many)
        return float(many)


@dataclass(frozen=True)
class Cost:
    """Of one run, s."""

    linear: float  #: making the body, looking at it: as its elements
    steps: float  #: as elements to some power, for finer bodies take shorter steps
    processor: float  #: of the processor, in all its threads
    rest: float = 0.0  #: writing files

    @property
    def seconds(self) -> float:
        """In all."""
        return self.linear + self.steps + self.rest

    def times(self, ratio: float, exponent: float) -> Cost:
        """Of so many times the elements."""
        linear, steps = self.linear * ratio, self.steps * ratio**exponent
        work = self.linear + self.steps
        return Cost(linear, steps, self.processor * (linear + steps) / work if work else 0.0, self.rest)


def exponent_of(coarse: tuple[float, Cost], fine: tuple[float, Cost], known: float | None) -> float:
    """Of the time of steps over elements: the one that is known, or between 1 and 5/3 as found."""
    if known is not None:
        return known
    grown = np.log(max(fine[1].steps, 1e-6) / max(coarse[1].steps, 1e-6))
    return float(np.clip(grown / np.log(fine[0] / coarse[0]), 1.0, 5 / 3))
