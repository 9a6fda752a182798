# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat conduction between bonded elements by YADE's native ThermalEngine.

The engine conducts  2 (k_1 + k_2) r_1 r_2 / d  between two touching spheres. With one conductivity
k = λ and  r_i = sqrt(S_i) / 2  this is  λ sqrt(S_i S_j) / d,  the platonic law; S_i is the
transmission area that `solidem prepare` stores, calibrated or not. A capacity is Cp × density ×
sphere volume, so Cp carries C_i. Areas and capacities come from the specimen; summing fluxes and
integrating in time are YADE's own.

What exchanges heat with the outside through a conductance G touches a sphere of its own, held at
the outer temperature: of radius G / (4 λ), its centre on the rim of the element's sphere.
"""

from __future__ import annotations

import numpy as np
from prepared import Floats, Parameters, PreparedError, Specimen
from results import Recorder
from visible import make_visible
from yade import (FlowEngine, FrictMat, Ig2_Sphere_Sphere_ScGeom, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, O,
                  PyRunner, ThermalEngine, utils)


#: YADE counts the heat of held spheres under so many numbers.
COUNTERS = 6


class HeatScene:
    """A conducting body in YADE, ready to run; one at a time (YADE has one global scene)."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        if parameters.conduction is None:
            raise ValueError("the scene has no conduction")
        if parameters.conduction.law == "voronoi":
            raise PreparedError(f"{specimen.path}: ThermalEngine takes no areas of faces; "
                                "law voronoi needs --law scripted")
        if any(specimen.periodic):
            raise PreparedError(f"{specimen.path}: periodic bodies are not supported in YADE")
        parameters.conduction.require_one_material(specimen, " (--law scripted takes any)")
        O.reset()
        make_visible(self)
        self.specimen, self.parameters = specimen, parameters
        self.recorder: Recorder | None = None
        self._count = len(specimen.radius)
        self._add_elements()
        self._walls = {name: self._add_wall(name, parameters.conduction.conductivity)
                       for name in parameters.exchanges}
        self._add_pairs()
        self._start(parameters.conduction.conductivity, parameters.conduction.initial_temperature)
        self._hold()
        self._heat_sources()

    def _add_elements(self) -> None:
        self._radius = 0.5 * np.sqrt(self.specimen.column("conduction/transmission_area"))
        self._material = O.materials.append(FrictMat(density=1))
        self._add_bodies(self.specimen.position, self._radius)

    def _add_bodies(self, position: Floats, radius: Floats) -> list[int]:
        return O.bodies.append([utils.sphere(p, r, material=self._material, fixed=True)
                                for p, r in zip(position.tolist(), radius.tolist())])

    def _add_wall(self, name: str, conductivity: float) -> list[int]:
        """Spheres that stand for the outside; their numbers."""
        contacts = self.specimen.exchanges[name]
        position = self.specimen.position[contacts.elements].copy()
        position[:, 0] += self._radius[contacts.elements]
        return self._add_bodies(position, contacts.values / (4 * conductivity))

    def _add_pairs(self) -> None:
        shortest = float(self._radius.min())
        reach = float(self.specimen.conductor_length.max() / shortest)
        O.engines = [InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=reach)],
            [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])]
        for i, j in self.specimen.conductors.tolist():
            utils.createInteraction(i, j)
        for name, bodies in self._walls.items():
            for i, j in zip(self.specimen.exchanges[name].elements.tolist(), bodies):
                utils.createInteraction(i, j)

    def _start(self, conductivity: float, initial_temperature: float) -> None:
        self._engine = ThermalEngine(
            conduction=True, advection=False, fluidConduction=False, thermoMech=False,
            solidThermoMech=False, fluidThermoMech=False, boundarySet=True, tsSafetyFactor=0,
            particleT0=initial_temperature, particleK=conductivity, particleCp=1)
        native = [self._engine, FlowEngine(dead=True)]  # one is looked for, even with no fluid
        O.engines = native
        O.dt = self.parameters.time_step
        # The first step overwrites every state with the engine's own values; at uniform temperature
        # it changes nothing else.
        O.run(1, True)
        self._first_iteration = O.iter
        O.engines = [PyRunner(iterPeriod=1, initRun=True, label="observer",
                              command="scene.observe()"),
                     PyRunner(iterPeriod=1, initRun=True, label="sources",
                              command="scene.heat()", dead=not self.parameters.powers),
                     *native,
                     PyRunner(iterPeriod=1, initRun=True, command="scene.count_heat()")]
        everything = [body.state for body in O.bodies]
        self._states, self._outside = everything[:self._count], everything
        volume = 4 / 3 * np.pi * self._radius**3
        capacity = self.specimen.column("conduction/heat_capacity") / volume
        for state, c in zip(self._states, capacity.tolist()):
            state.Cp = c

    def _hold(self) -> None:
        """Fixes temperatures; the engine counts the heat of each load under a number of its own."""
        held = {f"temperature.{name}": (self.specimen.sets[f"temperature.{name}"].tolist(), value)
                for name, value in self.parameters.temperatures.items()}
        held |= {name: (self._walls[name], value)
                 for name, value in self.parameters.exchanges.items()}
        if len(held) > COUNTERS:
            raise PreparedError(f"{len(held)} temperatures and exchanges; YADE counts the heat of "
                                f"{COUNTERS} at most")
        self._heat = dict.fromkeys(held, 0.0)
        capacity = self.specimen.column("conduction/heat_capacity")
        for number, (name, (bodies, value)) in enumerate(held.items()):
            for index in bodies:
                state = self._outside[index]
                if index < self._count:
                    self._heat[name] += capacity[index] * (value - state.temp)
                state.temp, state.Tcondition, state.boundaryId = value, True, number

    def _heat_sources(self) -> None:
        power = np.zeros(self._count)
        for name in self.parameters.powers:
            np.add.at(power, self.specimen.powers[name].elements,
                      self.specimen.powers[name].values)
        self._heated = [(self._states[i], float(power[i])) for i in np.flatnonzero(power).tolist()]
        # What a source gives to a held element leaves the body at once.
        self._lost = {name: float(power[self.specimen.sets[name]].sum()) if name in self.specimen.sets
                      else 0.0 for name in self._heat}

    def heat(self) -> None:
        """Heat sources: the engine adds what it conducts to the flux it finds."""
        for state, power in self._heated:
            state.stepFlux = power

    def count_heat(self) -> None:
        """What held spheres gave in this step."""
        for number, name in enumerate(self._heat):
            self._heat[name] -= O.dt * (self._engine.thermalBndFlux[number] + self._lost[name])

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
        energy = self.specimen.column("conduction/heat_capacity") @ self.temperatures()
        return {"thermal_energy": float(energy),
                **{f"{name}.heat": heat for name, heat in self._heat.items()}}

    def _frame(self) -> dict[str, Floats]:
        return {"temperature": self.temperatures()}

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        observer = next(e for e in O.engines if e.label == "observer")
        observer.iterPeriod = self.recorder.period if self.recorder else steps
        O.run(steps + 1, True)
