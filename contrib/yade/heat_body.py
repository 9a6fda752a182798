# SPDX-License-Identifier: GPL-2.0-or-later
"""A conducting body through time: all its pairs at once, in numpy, by explicit Euler steps.

It needs no simulation program; `scripted_heat.py` and `scripted_coupled.py` step it in YADE.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from contrib.prepared import Parameters, Specimen

Floats = NDArray[np.float64]


class HeatBody:
    """Temperatures of elements, with all that heats them but motion."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        """What is held has its temperature from the start."""
        if parameters.conduction is None:
            raise ValueError("the scene has no conduction")
        self._first, self._second = specimen.conductors.T
        stored = specimen.columns.get("conduction/conductance")
        self._conductance = (parameters.conduction.conductance(specimen) if stored is None
                             else stored)
        self.capacity = specimen.column("conduction/heat_capacity")  #: (N,) J/K
        #: (N,) K
        self.temperature = np.full(len(specimen.radius), parameters.conduction.initial_temperature)
        self._exchanges = {name: (specimen.exchanges[name], outside)
                           for name, outside in parameters.exchanges.items()}
        self._source = np.zeros(len(specimen.radius))
        for name in parameters.powers:
            np.add.at(self._source, specimen.powers[name].elements, specimen.powers[name].values)
        self._held = {name: (specimen.sets[f"temperature.{name}"], value)
                      for name, value in parameters.temperatures.items()}
        self._heat = dict.fromkeys(
            [*(f"temperature.{name}" for name in self._held), *self._exchanges], 0.0)
        self.hold()

    def hold(self) -> None:
        """Sets what is held and counts the heat this takes."""
        for name, (elements, value) in self._held.items():
            self._heat[f"temperature.{name}"] += float(
                self.capacity[elements] @ (value - self.temperature[elements]))
            self.temperature[elements] = value

    def row(self) -> dict[str, float]:
        """What a history says of heat."""
        return {"thermal_energy": float(self.capacity @ self.temperature),
                **{f"{name}.heat": heat for name, heat in self._heat.items()}}

    def step(self, time_step: float) -> None:
        """Conducts and heats for so long, s."""
        drop = self.temperature[self._second] - self.temperature[self._first]
        flow, count = self._conductance * drop, len(self.temperature)
        power = np.bincount(self._first, flow, count) - np.bincount(self._second, flow, count)
        power += self._source
        for name, (contact, outside) in self._exchanges.items():
            gain = contact.values * (outside - self.temperature[contact.elements])
            np.add.at(power, contact.elements, gain)
            self._heat[name] += float(time_step * gain.sum())
        self.temperature += time_step * power / self.capacity
        self.hold()
