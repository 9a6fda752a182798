# SPDX-License-Identifier: GPL-2.0-or-later
"""AA6082 as Terreros 2013 has it (tables 4.1 and 4.2), and its law alone, in one point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

DENSITY, CAPACITY, MODULUS, TAYLOR_QUINNEY = 2700.0, 900.0, 70e9, 0.9
A, B, N, C, M, REFERENCE, MELTING = 219e6, 276e6, 0.249, 0.025, 1.36, 296.0, 855.0


@dataclass(frozen=True)
class Test:
    """Rows of one start and rate."""

    start: float  #: K
    rate: float  #: 1/s
    strain: tuple[float, ...]
    measured: tuple[float, ...]  #: K
    thesis: tuple[float, ...]  #: K

    @property
    def label(self) -> str:
        """In tables and pictures."""
        return f"{self.start:g} K, {self.rate:g} /s"


TESTS = (Test(296, 600, (0.014, 0.027, 0.046), (1.4, 3.0, 5.8), (1.05, 3.30, 6.44)),
         Test(296, 1000, (0.026, 0.047, 0.070, 0.092), (3.1, 6.1, 9.7, 13.0),
              (3.31, 7.18, 11.17, 14.92)),
         Test(373, 1500, (0.038, 0.127, 0.195), (3.5, 15.0, 20.0), (5.83, 22.87, 37.64)))


def softening(temperature: float) -> float:
    """What temperature leaves of the stress."""
    return 1 - (max(temperature - REFERENCE, 0) / (MELTING - REFERENCE)) ** M


def quickening(rate: float) -> float:
    """What a rate makes of the stress."""
    return 1 + C * math.log(max(rate, 1))


def adiabatic(test: Test, count: int = 20000) -> tuple[Any, Any, Any]:
    """(K,) strain, true stress, Pa, and rise, K, of a point that is strained and keeps its heat."""
    plastic, warm, fast = 0.0, test.start, quickening(test.rate)
    strains = np.linspace(0, test.strain[-1], count + 1)[1:]
    stress, rise = np.empty(count), np.empty(count)
    for n, strain in enumerate(strains):
        soft = softening(warm)
        low, high = plastic, max(strain, plastic)
        for _ in range(45):
            middle = 0.5 * (low + high)
            flows = MODULUS * (strain - middle) > (A + B * middle**N) * fast * soft
            low, high = (middle, high) if flows else (low, middle)
        stress[n] = MODULUS * (strain - low)
        warm += TAYLOR_QUINNEY * stress[n] * (low - plastic) / (DENSITY * CAPACITY)
        plastic, rise[n] = low, warm - test.start
    return strains, stress, rise


def law_alone(test: Test) -> Any:
    """Rises at the strains of the table, K."""
    strains, _, rise = adiabatic(test)
    return np.interp(test.strain, strains, rise)


def energies_alone(test: Test) -> tuple[Any, Any]:
    """Work and elastic energy at the strains of the table, J/m³."""
    strains, stress, _ = adiabatic(test)
    before, least = np.append(0, stress[:-1]), np.diff(strains, prepend=0)
    work = np.cumsum(0.5 * (before + stress) * least)
    return (np.interp(test.strain, strains, work),
            np.interp(test.strain, strains, stress) ** 2 / (2 * MODULUS))
