# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat conduction with any conductance for each pair, scripted: numpy called by YADE every step.

YADE's ThermalEngine takes no conductance for a single pair, so laws with other areas (faces of
Voronoi cells, say) come this way. YADE then only drives the steps; law and sums are numpy's.
Temperatures live in numpy arrays and are not part of YADE's own saved states.
"""

from __future__ import annotations

import numpy as np
from prepared import Floats, Parameters, Specimen
from results import Recorder
from visible import make_visible
from yade import O, PyRunner


class ScriptedHeatScene:
    """A conducting body stepped by numpy inside YADE."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        if parameters.conduction is None:
            raise ValueError("the scene has no conduction")
        O.reset()
        make_visible(self)
        self.recorder: Recorder | None = None
        count = len(specimen.radius)
        self._first, self._second = specimen.conductors.T
        stored = specimen.columns.get("conduction/conductance")
        self._conductance = (parameters.conduction.conductance(specimen) if stored is None
                             else stored)
        self._capacity = specimen.column("conduction/heat_capacity")
        self._temperature = np.full(count, parameters.conduction.initial_temperature)
        self._exchanges = {name: (specimen.exchanges[name], outside)
                           for name, outside in parameters.exchanges.items()}
        self._source = np.zeros(count)
        for name in parameters.powers:
            np.add.at(self._source, specimen.powers[name].elements, specimen.powers[name].values)
        self._held = {name: (specimen.sets[f"temperature.{name}"], value)
                      for name, value in parameters.temperatures.items()}
        self._heat = dict.fromkeys(
            [*(f"temperature.{name}" for name in self._held), *self._exchanges], 0.0)
        self._hold()
        O.engines = [PyRunner(iterPeriod=1, initRun=True, command="scene.step()")]
        O.dt = parameters.time_step

    def _hold(self) -> None:
        """Sets what is held and counts the heat this takes."""
        for name, (elements, value) in self._held.items():
            self._heat[f"temperature.{name}"] += float(
                self._capacity[elements] @ (value - self._temperature[elements]))
            self._temperature[elements] = value

    def set_temperatures(self, temperature: Floats) -> None:
        """Overwrites the temperatures (N,) of all elements, K."""
        self._temperature[:] = temperature

    def temperatures(self) -> Floats:
        """(N,) temperatures now, K."""
        return self._temperature.copy()

    def _row(self) -> dict[str, float]:
        return {"thermal_energy": float(self._capacity @ self._temperature),
                **{f"{name}.heat": heat for name, heat in self._heat.items()}}

    def step(self) -> None:
        """Observes the state, then advances it by explicit Euler."""
        if self.recorder is not None:
            self.recorder.observe(O.iter, O.iter * O.dt, self._row,
                                  lambda: {"temperature": self._temperature.copy()})
        drop = self._temperature[self._second] - self._temperature[self._first]
        flow, count = self._conductance * drop, len(self._temperature)
        power = np.bincount(self._first, flow, count) - np.bincount(self._second, flow, count)
        power += self._source
        for name, (contact, outside) in self._exchanges.items():
            gain = contact.values * (outside - self._temperature[contact.elements])
            np.add.at(power, contact.elements, gain)
            self._heat[name] += float(O.dt * gain.sum())
        self._temperature += O.dt * power / self._capacity
        self._hold()

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        O.run(steps + 1, True)
