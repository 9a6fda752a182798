# SPDX-License-Identifier: GPL-2.0-or-later
"""Beam bonds that flow and break, scripted: the loads are numpy's, the motion is YADE's.

YADE has no bond with von Mises plasticity, so its law is `beam_law.py`. YADE integrates positions and
orientations. Histories live in numpy arrays and are no part of YADE's own saved states. Bodies are
read one by one: some hundred elements, not more.
"""

from __future__ import annotations

import numpy as np
from beam_law import BeamLaw, Floats, law_of
from beams import BeamScene
from motion import bulk_positions
from prepared import Beams, Parameters, PreparedError, Specimen
from yade import Engine, O, PyRunner, utils

#: More are a matter of hours.
MOST_ELEMENTS = 1000


def orientations() -> Floats:
    """(N, 4) orientations of all bodies, w, x, y, z."""
    turned = np.array([list(b.state.ori) for b in O.bodies])  # x, y, z, w
    return np.roll(turned, 1, axis=1)


class ScriptedBeamScene(BeamScene):
    """A bonded body whose loads are found by numpy inside YADE."""

    def __init__(self, specimen: Specimen, parameters: Parameters):
        if len(specimen.radius) > MOST_ELEMENTS:
            raise PreparedError(f"{specimen.path}: {len(specimen.radius)} elements; scripted beams "
                                f"take {MOST_ELEMENTS} at most")
        if parameters.contact is not None:
            raise PreparedError("[contact] is not supported in YADE")
        if parameters.rupture is not None and parameters.rupture.minimal_bonds:
            raise PreparedError("minimal_bonds of [rupture] is not supported in YADE")
        if parameters.rupture is not None and parameters.rupture.law != "strain-limit":
            raise PreparedError(f"law \"{parameters.rupture.law}\" of [rupture] is not supported in "
                                "YADE, only \"strain-limit\"")
        if parameters.plasticity is not None and parameters.plasticity.hardening != "linear":
            raise PreparedError(f"hardening \"{parameters.plasticity.hardening}\" of [plasticity] is "
                                "not supported in YADE, only \"linear\"")
        if parameters.plasticity is not None and parameters.plasticity.law == "associated":
            raise PreparedError("law \"associated\" of [plasticity] is not supported in YADE")
        for name, law in (("plasticity", parameters.plasticity), ("rupture", parameters.rupture)):
            if law is not None and law.section != "middle":
                raise PreparedError(f"section \"{law.section}\" of [{name}] is not supported in YADE, "
                                    "only \"middle\"")
        super().__init__(specimen, parameters)

    def _add_beams(self, beams: Beams, incremental: bool) -> None:
        parameters = self.parameters
        self.law: BeamLaw = law_of(self.specimen, beams, parameters.plasticity, parameters.rupture)
        self._add_engines(PyRunner(iterPeriod=1, initRun=True, command="scene.load()"))

    def load(self) -> None:
        """Puts the bonds' loads on the bodies and lets the bonds flow and break."""
        place, turned = bulk_positions(), orientations()
        i, j = self.specimen.pairs.T
        found = self.law.respond(place[j] - place[i], turned[i], turned[j])
        self.law.keep(found)
        self.flowed(found.plastic_work)
        # What a bond still stores when it breaks is counted as fracture energy.
        self.elastic_energy = float(found.energy[self.law.intact].sum())
        force, moment = np.zeros((len(place), 3)), np.zeros((len(place), 3))
        np.add.at(force, i, found.force)
        np.add.at(force, j, -found.force)
        np.add.at(moment, i, found.moment_i)
        np.add.at(moment, j, found.moment_j)
        share = self._share()
        for body, (f, m) in enumerate(zip((share * force).tolist(), (share * moment).tolist())):
            O.forces.addF(body, f)
            O.forces.addT(body, m)

    def _share(self) -> float:
        """Of the loads that YADE is given: half in the first step, as velocities stand half a step
        behind from then on."""
        return 1.0 if O.iter else 0.5

    def _force_on(self, elements: list[int]) -> Floats:
        weight = self.weight_of(elements)
        return np.asarray((super()._force_on(elements) - weight) / self._share() + weight)

    def flowed(self, work: Floats) -> None:
        """Takes in the plastic work (B,) of this pose, J: nothing to do where it heats nobody."""

    def _row(self) -> dict[str, float]:
        row = super()._row()
        row["kinetic_energy"] = float(utils.kineticEnergy())
        row["elastic_energy"] = self.elastic_energy
        if self.parameters.plasticity is not None:
            row["plastic_work"] = self.law.plastic_work
        if self.parameters.rupture is not None:
            row["fracture_energy"] = self.law.fracture_energy
            row["broken_bonds"] = self.law.broken
        return row
