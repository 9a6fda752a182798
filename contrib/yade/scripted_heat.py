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


def platonic_conductance(specimen: Specimen, conductivity: float) -> Floats:
    """(B,) λ sqrt(S_i S_j) / d of each pair, W/K."""
    area = specimen.column("conduction/transmission_area")[specimen.pairs]
    return conductivity * np.sqrt(area[:, 0] * area[:, 1]) / specimen.rest_length


class ScriptedHeatScene:
    """A conducting body stepped by numpy inside YADE."""

    def __init__(self, specimen: Specimen, parameters: Parameters,
                 conductance: Floats | None = None):
        """`conductance` (B,) in W/K replaces the platonic law."""
        if parameters.conduction is None:
            raise ValueError("the scene has no conduction")
        O.reset()
        make_visible(self)
        self.recorder: Recorder | None = None
        if conductance is None:
            conductance = platonic_conductance(specimen, parameters.conduction.conductivity)
        self._first, self._second = specimen.pairs.T
        self._conductance = conductance
        self._capacity = specimen.column("conduction/heat_capacity")
        self._temperature = np.full(len(specimen.radius),
                                    parameters.conduction.initial_temperature)
        self._free = np.ones(len(specimen.radius))
        for name, temperature in parameters.temperatures.items():
            self._temperature[specimen.sets[f"temperature.{name}"]] = temperature
            self._free[specimen.sets[f"temperature.{name}"]] = 0
        O.engines = [PyRunner(iterPeriod=1, initRun=True, command="scene.step()")]
        O.dt = parameters.time_step

    def set_temperatures(self, temperature: Floats) -> None:
        """Overwrites the temperatures (N,) of all elements, K."""
        self._temperature[:] = temperature

    def temperatures(self) -> Floats:
        """(N,) temperatures now, K."""
        return self._temperature.copy()

    def step(self) -> None:
        """Observes the state, then advances it by explicit Euler."""
        if self.recorder is not None:
            self.recorder.observe(
                O.iter, O.iter * O.dt,
                lambda: {"thermal_energy": float(self._capacity @ self._temperature)},
                lambda: {"temperature": self._temperature.copy()})
        drop = self._temperature[self._second] - self._temperature[self._first]
        power, count = self._conductance * drop, len(self._temperature)
        gain = np.bincount(self._first, power, count) - np.bincount(self._second, power, count)
        self._temperature += O.dt * self._free * gain / self._capacity

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        O.run(steps + 1, True)
