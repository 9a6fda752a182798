# SPDX-License-Identifier: GPL-2.0-or-later
"""What a few small runs foretell of a larger one: its error and its time.

Orders are weighed by how well they fit and by what the studies found of scenes of this kind. What is
not known stays in: errors are drawn from all that the runs leave possible (posterior.py).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Sequence

import numpy as np
import numpy.typing as npt

from ._core import InputError
from .level import Level
from .posterior import ORDERS, Posterior, scatter_of, without_strays
from .studies import Study

Floats = npt.NDArray[np.float64]

DRAWS = 4000  #: of limits, constants and orders
LIKELY = 0.95  #: with which an error stays below what is promised
UNKNOWN_ORDERS = (0.3, 2.25)  #: between which any is possible where there is no study
#: Orders count as this power of 1 / p besides. What is left from the finest body to the limit goes as
#: 1 / p: without it promises for orders below .75, which runs tell badly, would be broken more often.
LOW_ORDERS_COUNT = 0.25


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
    density = ORDERS**-LOW_ORDERS_COUNT
    if study is None:
        low, high = UNKNOWN_ORDERS
        density *= (ORDERS >= low - 1e-9) & (ORDERS <= high + 1e-9)
    else:
        density *= np.exp(-0.5 * ((ORDERS - study.order) / study.spread)**2)
    return density


class ErrorModel:
    """Errors by number of elements, from levels of several packings."""

    def __init__(self, levels: Sequence[Level], scale: float, study: Study | None,
                 step_error: float = 0.0) -> None:
        """`levels`: `value` is the number of elements. `scale`: what errors are shares of.
        `step_error`: share that the steps of the finest level err by."""
        if len(levels) < 2:
            raise InputError("one refinement tells no limit; expected two or more")
        levels = sorted(levels, key=lambda level: level.value)
        self.scale, self.study, self.step_error = scale, study, step_error
        self._first = levels[0].value
        sizes = np.array([self.size(level.value) for level in levels])
        kept = without_strays(sizes, [level.figures for level in levels])
        self.levels = [replace(level, figures=figures) for level, figures in zip(levels, kept)]
        #: Packings whose figures are far from all others.
        self.strays = sum(len(level.figures) for level in levels) - sum(map(len, kept))
        self._scatter = scatter_of(sizes, [level.figures for level in self.levels])
        self.posterior = Posterior(
            sizes, np.array([level.mean for level in self.levels]),
            np.array([float(len(level.figures)) for level in self.levels]), self._scatter, scale,
            prior(study))
        noise = np.random.default_rng(1)
        self.limits, self.constants, self.orders = self.posterior.drawn(DRAWS, noise)
        self._normal = noise.standard_t(max(self._scatter.freedom, 2), DRAWS)

    def size(self, elements: float) -> float:
        """h, over that of the coarsest level."""
        return float((elements / self._first)**(-1 / 3))

    @property
    def limit(self) -> tuple[float, float, float]:
        """What finer and finer bodies tend to: mean and the ends of its interval."""
        middle, half = self.posterior.limit, self.posterior.half_width(LIKELY)
        return middle, middle - half, middle + half

    @property
    def order(self) -> tuple[float, float, float]:
        """Median and the ends of its interval."""
        low, middle, high = np.percentile(self.orders, [2.5, 50, 97.5])
        return float(middle), float(low), float(high)

    def scatter(self, elements: float) -> float:
        """Standard deviation over packings, as a share."""
        return float(self._scatter.of(self.size(elements)) / self.scale)

    def errors(self, elements: float, packings: int = 1) -> Errors:
        """Of the mean of so many packings."""
        bias = self.constants * self.size(elements)**self.orders / self.scale
        scatter = self.scatter(elements) / np.sqrt(packings)
        drawn = np.abs(bias + scatter * self._normal) + self.step_error
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
