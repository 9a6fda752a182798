# SPDX-License-Identifier: GPL-2.0-or-later
"""Beams that flow and heat their ends, and that are longer and softer when they are warm: scripted.

The loads are those of `scripted_beams.py`, the temperatures those of `heat_body.py`. Heat steps before
the bonds act in a new pose: what flow has made comes to the elements, heat is conducted over the step,
and the bonds see the temperatures of their pose.

An element has the thermal strain ε(T) = ∫ α dT from the reference temperature; a bond is two halves,
l = l₀ (1 + ½ (ε_i + ε_j)), and two springs in series, of the ratio 2 r_i r_j / (r_i + r_j).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from heat_body import HeatBody
from beam_law import Floats
from prepared import OverTemperature, Parameters, PreparedError, Specimen
from scripted_beams import ScriptedBeamScene
from yade import O


def value_at(known: OverTemperature, temperature: Floats) -> Floats:
    """A property at temperatures (N,)."""
    return np.interp(temperature, known.temperature, known.value)


def integral(known: OverTemperature, start: float, end: Floats) -> Floats:
    """∫ of a property from a temperature to others (N,), piece by piece."""
    knots = np.array(known.temperature)

    def from_first(temperature: Floats) -> Floats:
        ends = np.clip(knots[None, 1:], None, np.maximum(temperature, knots[0])[:, None])
        starts = np.minimum(knots[None, :-1], ends)
        inner = 0.5 * (ends - starts) * (np.interp(starts, knots, known.value)
                                         + np.interp(ends, knots, known.value))
        below = np.minimum(temperature - knots[0], 0) * known.value[0]
        return inner.sum(axis=1) + below + np.maximum(temperature - knots[-1], 0) * known.value[-1]

    return np.asarray(from_first(end) - from_first(np.array([start])))


class CoupledScene(ScriptedBeamScene):
    """A bonded body whose motion and heat act on each other."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        if parameters.rupture is not None:
            raise PreparedError("bonds that break cannot conduct heat as well in YADE")
        self.heat = HeatBody(specimen, parameters)
        self.waiting = np.zeros(len(specimen.radius))  #: heat of flow, not yet given, J
        super().__init__(specimen, parameters)
        self._cold = self.law.bonds
        self._follow()

    def _follow(self) -> None:
        """Makes the bonds as long and as stiff as their ends' temperatures ask."""
        i, j = self.specimen.pairs.T
        warm = self.heat.temperature
        length, rigidity = self._cold.rest_length, self._cold.rigidity
        if expansion := self.parameters.expansion:
            strain = integral(expansion.coefficient, expansion.reference_temperature, warm)
            length = length * (1 + 0.5 * (strain[i] + strain[j]))
        if self.parameters.softening:
            ratio = value_at(self.parameters.softening, warm)
            rigidity = rigidity * (2 * ratio[i] * ratio[j] / (ratio[i] + ratio[j]))[:, None]
        self.law.history.last.extension = (
            self.law.history.last.extension - (length - self.law.bonds.rest_length))
        self.law.bonds = replace(self._cold, rest_length=length, rigidity=rigidity)

    def _step_heat(self) -> None:
        self.heat.temperature += self.waiting / self.heat.capacity
        self.waiting[:] = 0
        self.heat.hold()
        self.heat.step(O.dt)
        self._follow()

    def load(self) -> None:
        """Heat over the step that led to this pose, then the loads in it."""
        if O.iter:
            self._step_heat()
        super().load()

    def flowed(self, work: Floats) -> None:
        """Takes in the plastic work (B,) of this pose, half of it for either end."""
        for ends in self.specimen.pairs.T:
            np.add.at(self.waiting, ends, 0.5 * self.parameters.plastic_heat * work)

    def _row(self) -> dict[str, float]:
        return {**super()._row(), **self.heat.row(), "waiting_heat": float(self.waiting.sum())}

    def _frame(self) -> dict[str, Floats]:
        return {**super()._frame(), "temperature": self.heat.temperature.copy()}
