# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat conduction between bonded elements by YADE's native ThermalEngine.

The engine conducts  2 (k_1 + k_2) r_1 r_2 / d  between two touching spheres. With one conductivity
k = λ and  r_i = sqrt(S_i) / 2  this is  λ sqrt(S_i S_j) / d,  the platonic law; S_i is the
transmission area that `solidem prepare` stores. A capacity is Cp × density × sphere volume, so Cp
carries C_i. Areas and capacities come from the specimen; summing fluxes and integrating in time are
YADE's own.
"""

from __future__ import annotations

import numpy as np
from prepared import Floats, Parameters, Specimen
from results import Recorder
from visible import make_visible
from yade import (FlowEngine, FrictMat, Ig2_Sphere_Sphere_ScGeom, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, O,
                  PyRunner, ThermalEngine, utils)


class HeatScene:
    """A conducting body in YADE, ready to run; one at a time (YADE has one global scene)."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        if parameters.conduction is None:
            raise ValueError("the scene has no conduction")
        if any(specimen.periodic):
            raise ValueError(f"{specimen.path}: periodic bodies are not supported in YADE")
        O.reset()
        make_visible(self)
        self.specimen, self.parameters = specimen, parameters
        self.recorder: Recorder | None = None
        self._add_bodies()
        self._add_pairs()
        self._start(parameters.conduction.conductivity, parameters.conduction.initial_temperature)

    def _add_bodies(self) -> None:
        radius = 0.5 * np.sqrt(self.specimen.column("conduction/transmission_area"))
        self._volume = 4 / 3 * np.pi * radius**3
        material = O.materials.append(FrictMat(density=1))
        O.bodies.append([utils.sphere(p, r, material=material, fixed=True)
                         for p, r in zip(self.specimen.position.tolist(), radius.tolist())])

    def _add_pairs(self) -> None:
        shortest = 0.5 * np.sqrt(self.specimen.column("conduction/transmission_area").min())
        reach = float(self.specimen.rest_length.max() / shortest)
        O.engines = [InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=reach)],
            [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])]
        for i, j in self.specimen.pairs.tolist():
            utils.createInteraction(i, j)

    def _start(self, conductivity: float, initial_temperature: float) -> None:
        engine = ThermalEngine(
            conduction=True, advection=False, fluidConduction=False, thermoMech=False,
            solidThermoMech=False, fluidThermoMech=False, boundarySet=True, tsSafetyFactor=0,
            particleT0=initial_temperature, particleK=conductivity, particleCp=1)
        native = [engine, FlowEngine(dead=True)]  # one is looked for, even with no fluid
        O.engines = native
        O.dt = self.parameters.time_step
        # The first step overwrites every state with the engine's own values; at uniform temperature
        # it changes nothing else.
        O.run(1, True)
        self._first_iteration = O.iter
        O.engines = [PyRunner(iterPeriod=1, initRun=True, label="observer",
                              command="scene.observe()"), *native]
        self._states = [body.state for body in O.bodies]
        capacity = self.specimen.column("conduction/heat_capacity") / self._volume
        for state, c in zip(self._states, capacity.tolist()):
            state.Cp = c
        for name, temperature in self.parameters.temperatures.items():
            for index in self.specimen.sets[f"temperature.{name}"].tolist():
                self._states[index].temp, self._states[index].Tcondition = temperature, True

    def set_temperatures(self, temperature: Floats) -> None:
        """Overwrites the temperatures (N,) of all elements, K."""
        for state, value in zip(self._states, temperature.tolist()):
            state.temp = value

    def temperatures(self) -> Floats:
        """(N,) temperatures now, K."""
        return np.array([state.temp for state in self._states])

    def observe(self) -> None:
        """The state before the step."""
        if self.recorder is not None:
            step = O.iter - self._first_iteration
            self.recorder.observe(step, step * O.dt, self._row, self._frame)

    def _row(self) -> dict[str, float]:
        heat = self.specimen.column("conduction/heat_capacity") @ self.temperatures()
        return {"thermal_energy": float(heat)}

    def _frame(self) -> dict[str, Floats]:
        return {"temperature": self.temperatures()}

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        observer = next(e for e in O.engines if e.label == "observer")
        observer.iterPeriod = self.recorder.period if self.recorder else steps
        O.run(steps + 1, True)
