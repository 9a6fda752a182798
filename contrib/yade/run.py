# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a prepared specimen in YADE.

    solidem prepare scene.toml --output prepared.h5
    solidem explain scene.toml --json > explained.json
    yade -n -x -j1 run.py prepared.h5 explained.json results/

writes results/history.csv, results/trajectory.h5 and results/summary.json.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

# YADE runs a script as its own __main__, so __file__ is the program, not this file.
_HERE = Path(sys.argv[0]).resolve().parent
sys.path[:0] = [str(_HERE), str(_HERE.parent)]

from explained import read_parameters  # noqa: E402
from prepared import Parameters, Specimen, read_specimen  # noqa: E402
from results import Recorder  # noqa: E402
from yade import config  # noqa: E402


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="run.py", description=__doc__)
    parser.add_argument("specimen", type=Path, help="prepared specimen, HDF5")
    parser.add_argument("parameters", type=Path, help="output of solidem explain --json")
    parser.add_argument("directory", type=Path, help="where results go")
    parser.add_argument("--steps", type=int, help="instead of the scene's")
    parser.add_argument("--observe-every", type=int, help="steps between rows (1/200 of the run)")
    parser.add_argument("--frame-every", type=int, help="steps between frames (1/10 of the run)")
    parser.add_argument("--law", choices=["native", "incremental", "scripted"],
                        help="default: native; scripted for conduction of law voronoi, for beams that "
                        "flow, break or conduct heat and for central forces")
    return parser.parse_args(sys.argv[1:])


def _default_law(parameters: Parameters) -> str:
    """YADE's own laws, where it has them."""
    has_faces = parameters.conduction is not None and parameters.conduction.law == "voronoi"
    beams_change = (parameters.plasticity is not None or parameters.rupture is not None
                    or parameters.beams is not None and parameters.conduction is not None)
    central = parameters.central_forces is not None
    return "scripted" if has_faces or beams_change or central else "native"


def _scene(specimen: Specimen, parameters: Parameters, law: str):
    parameters.require_support()
    if parameters.tools and not parameters.is_loose:
        raise SystemExit("run.py: [[tools]] are understood of loose elements alone")
    if parameters.initial_velocities and not parameters.is_loose:
        raise SystemExit("run.py: initial velocities are understood of loose elements alone")
    if parameters.contact and not parameters.is_loose and law != "scripted":
        raise SystemExit("run.py: [contact] is understood of loose elements alone")
    if parameters.friction_heat:
        raise SystemExit("run.py: [friction_heat] is not supported in YADE")
    if parameters.contact_conduction:
        raise SystemExit("run.py: [contact_conduction] is not supported in YADE")
    if parameters.conduction and parameters.conduction.every > 1:
        raise SystemExit("run.py: heat that waits for several steps of the motion is not supported in "
                         "YADE")
    if parameters.bond_damping:
        raise SystemExit("run.py: [damping] bonds is not supported in YADE")
    if parameters.central_forces:
        from scripted_central_forces import CentralForceScene

        if law != "scripted":
            raise SystemExit("run.py: central forces need --law scripted")
        return CentralForceScene(specimen, parameters)
    if parameters.beams and parameters.conduction:
        from scripted_coupled import CoupledScene

        if law != "scripted":
            raise SystemExit("run.py: beams that conduct heat need --law scripted")
        return CoupledScene(specimen, parameters)
    if parameters.beams and law == "scripted":
        from scripted_beams import ScriptedBeamScene

        return ScriptedBeamScene(specimen, parameters)
    if parameters.beams:
        from beams import BeamScene

        if _default_law(parameters) == "scripted":
            raise SystemExit("run.py: beams that flow or break need --law scripted")
        return BeamScene(specimen, parameters, incremental=law == "incremental")
    if parameters.is_loose:
        from loose_grains import LooseGrainScene

        if law != "native":
            raise SystemExit("run.py: loose elements need --law native")
        return LooseGrainScene(specimen, parameters)
    if parameters.conduction and law == "scripted":
        from scripted_heat import ScriptedHeatScene

        return ScriptedHeatScene(specimen, parameters)
    if parameters.conduction:
        from heat import HeatScene

        return HeatScene(specimen, parameters)
    raise SystemExit("run.py: the scene has neither beams nor conduction, central forces nor contact")


def main() -> None:
    arguments = _arguments()
    started = time.perf_counter()
    specimen = read_specimen(arguments.specimen)
    parameters = read_parameters(arguments.parameters)
    steps = arguments.steps or parameters.steps
    law = arguments.law or _default_law(parameters)
    scene = _scene(specimen, parameters, law)
    scene.recorder = recorder = Recorder(
        arguments.directory, arguments.observe_every or max(1, steps // 200),
        arguments.frame_every or max(1, steps // 10), steps)
    prepared = time.perf_counter()
    scene.run(steps)
    wall = time.perf_counter() - prepared - recorder.observing_seconds
    bonds = len(specimen.conductors if parameters.conduction else specimen.pairs)
    recorder.write({
        "program": f"YADE {config.version}", "law": law,
        "elements": len(specimen.radius), "bonds": bonds, "steps": steps,
        "time_step": parameters.time_step, "simulated_time": steps * parameters.time_step,
        "wall_seconds": {"set_up": prepared - started, "steps": wall},
        "nanoseconds_per_bond_step": 1e9 * wall / max(1, steps * bonds),
    })


main()
