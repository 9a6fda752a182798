# SPDX-License-Identifier: GPL-2.0-or-later
"""solidem: continuous solids as compact packings of spheres, from Python.

    import solidem

    scene = solidem.Scene("tension.toml", {"beams.young_modulus": "3 TPa"})
    results = scene.run("results/tension")            # as `solidem run`
    results.history["gauge.stress"].max()

    simulation = scene.simulation()                   # step by step
    simulation.step(100)
    simulation.positions                              # numpy, no copy

All numbers are in SI units. What cannot be used raises InputError, what cannot go on RunError, in
the words of the program.
"""

from __future__ import annotations

import os as _os

# As the program does: threads that wait for the next loop spin only shortly. OpenMP reads this when
# it is loaded.
if "OMP_WAIT_POLICY" not in _os.environ and "GOMP_SPINCOUNT" not in _os.environ:
    _os.environ["OMP_WAIT_POLICY"] = "passive"
    _os.environ["GOMP_SPINCOUNT"] = "2000"

from ._core import InputError, RunError, instruction_set, set_threads, threads  # noqa: E402
from ._core import version as _version, version_and_build  # noqa: E402
from .results import Frame, History, Results  # noqa: E402
from .scene import Scene  # noqa: E402
from .scene_text import toml_text  # noqa: E402
from .simulation import Motion, Simulation, by_element  # noqa: E402
from .specimen import Specimen  # noqa: E402

__version__: str = _version()
__all__ = ["Frame", "History", "InputError", "Motion", "Results", "RunError", "Scene", "Simulation",
           "Specimen", "by_element", "instruction_set", "set_threads", "threads", "toml_text",
           "version_and_build"]
