# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads of one YADE beam whose two ends are moved steadily to prescribed places.

    yade -n -x -j1 two_spheres.py motions.json loads.txt

motions.json: "position" (2, 3), "beam_radius", "young_modulus", "shear_modulus", "law",
"shear_coefficient", and "motions" (M, 4, 3): displacement of i and j in m, rotation vector of i and j in rad. loads.txt: a line for
each motion, forces on i and j in N, then moments on i and j in N·m.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

# YADE runs a script as its own __main__, so __file__ is the program, not this file.
_HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(_HERE), str(_HERE.parent)]

import numpy as np  # noqa: E402
from beams import BeamScene  # noqa: E402
from prepared import Beams, Floats, Parameters, Specimen  # noqa: E402
from yade import O  # noqa: E402

STEPS = 200  #: of one motion; YADE integrates shear and needs some


class TwoSpheres(BeamScene):
    """One beam whose ends move at constant velocity and angular velocity."""

    def __init__(self, specimen: Specimen, beams: Beams, motion: Floats):
        super().__init__(specimen, Parameters(1.0, STEPS, beams, None, (), {}))
        self.speed = motion / STEPS

    def start_motion(self) -> None:
        """Blocks everything and sets the velocities."""
        for end in (0, 1):
            state = O.bodies[end].state
            state.blockedDOFs = "xyzXYZ"
            state.vel, state.angVel = tuple(self.speed[end]), tuple(self.speed[2 + end])

    def loads(self) -> Floats:
        """(12,) forces on both ends, then moments, after all steps."""
        O.run(STEPS + 1, True)
        forces = [list(O.forces.f(end)) for end in (0, 1)]
        return np.concatenate([*forces, *[list(O.forces.t(end)) for end in (0, 1)]])


def main() -> None:
    task = json.loads(Path(sys.argv[1]).read_text())
    ones = np.ones(2)
    specimen = Specimen(Path(sys.argv[1]), np.array(task["position"]), ones,
                        np.array([[0, 1]]),
                        columns={"mechanics/mass": ones, "mechanics/inertia": ones})
    beams = Beams(task["young_modulus"], task["shear_modulus"], 1.0, "mean", task["beam_radius"],
                  task["law"], task["shear_coefficient"])
    loads = [TwoSpheres(specimen, beams, motion).loads() for motion in np.array(task["motions"])]
    np.savetxt(sys.argv[2], loads, fmt="%.17g")


main()
