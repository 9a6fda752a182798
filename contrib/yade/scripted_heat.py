# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat conduction with any conductance for each pair, scripted: numpy called by YADE every step.

YADE's ThermalEngine takes no conductance for a single pair, so laws with other areas (faces of
Voronoi cells, say) come this way. YADE then only drives the steps; law and sums are numpy's.
Temperatures live in numpy arrays and are not part of YADE's own saved states.
"""

from __future__ import annotations

from heat_body import HeatBody
from prepared import Floats, Parameters, Specimen
from results import Recorder
from visible import make_visible
from yade import O, PyRunner


class ScriptedHeatScene:
    """A conducting body stepped by numpy inside YADE."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        self._body = HeatBody(specimen, parameters)
        O.reset()
        make_visible(self)
        self.recorder: Recorder | None = None
        O.engines = [PyRunner(iterPeriod=1, initRun=True, command="scene.step()")]
        O.dt = parameters.time_step

    def set_temperatures(self, temperature: Floats) -> None:
        """Overwrites the temperatures (N,) of all elements, K."""
        self._body.temperature[:] = temperature

    def temperatures(self) -> Floats:
        """(N,) temperatures now, K."""
        return self._body.temperature.copy()

    def step(self) -> None:
        """Observes the state, then advances it by explicit Euler."""
        if self.recorder is not None:
            self.recorder.observe(O.iter, O.iter * O.dt, self._body.row,
                                  lambda: {"temperature": self.temperatures()})
        self._body.step(O.dt)

    def run(self, steps: int) -> None:
        """Runs until the state after `steps` steps has been observed."""
        O.run(steps + 1, True)
