# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE, through the scripts of contrib/yade."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from compare.codes.base import ROOT, Job, TwoSpheres, read_loads, run_program, said_version
from compare.result import CodeFailure, Floats, Result, read_result
from contrib.yade.beam_law import law_of, path_loads
from contrib.prepared import Beams, Parameters, Plasticity, Specimen

SCRIPTS = ROOT / "contrib" / "yade"


def _scripted_loads(spheres: TwoSpheres, place: Path, plasticity: Plasticity) -> Floats:
    """Loads of the beam law that is scripted in YADE."""
    beams = Beams(spheres.young_modulus, spheres.shear_modulus, 1.0, "mean", spheres.beam_radius,
                  spheres.law, spheres.shear_coefficient)
    specimen = Specimen(place, spheres.position, np.full(2, spheres.radius), np.array([[0, 1]]))
    return path_loads(law_of(specimen, beams, plasticity), spheres.position, spheres.motions)


@dataclass
class Yade:
    """YADE as Debian packages it."""

    name: str = "yade"
    program: str = "yade"
    law: str | None = None  #: --law of contrib/yade/run.py; None: its default

    def missing(self) -> str | None:
        """Why YADE cannot be used."""
        if shutil.which(self.program) is None:
            return f"no program {self.program!r} on the path (Debian package yade)"
        return None

    def _run(self, script: str, arguments: list[str | Path], directory: Path,
             timeout: float) -> None:
        # One thread: YADE's sums are repeatable only then. -x ends it after the script.
        run_program([self.program, "-n", "-x", "-j1", SCRIPTS / script, *arguments], directory,
                    timeout, {"OMP_WAIT_POLICY": "passive"})

    def version(self) -> str:
        """What the program says it is."""
        return said_version([self.program, "--version"], r"version: *(\S+)")

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """Its own, or a second writing; law voronoi has conductances of solidem's."""
        return bool(parameters and parameters.conduction and parameters.conduction.law == "voronoi")

    def run(self, job: Job, directory: Path) -> Result:
        """Runs a job."""
        law = ["--law", self.law] if self.law else []
        self._run("run.py", [
            job.prepared, job.explained, directory / "results", *law,
            "--observe-every", str(job.observe_every), "--frame-every", str(job.frame_every),
        ], directory, job.timeout)
        if not (directory / "results" / "summary.json").exists():
            raise CodeFailure(f"yade wrote no result; see {directory / 'output.log'}")
        return read_result(self.name, directory / "results")

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """Moves the two spheres steadily to each place and reads the bond's loads there.

        A beam that flows is scripted; its law is then asked directly.
        """
        directory.mkdir(parents=True, exist_ok=True)
        if spheres.plasticity:
            return _scripted_loads(spheres, directory, spheres.plasticity)
        (directory / "motions.json").write_text(json.dumps({
            "position": spheres.position.tolist(), "radius": spheres.radius,
            "beam_radius": spheres.beam_radius, "young_modulus": spheres.young_modulus,
            "shear_modulus": spheres.shear_modulus, "law": spheres.law,
            "shear_coefficient": spheres.shear_coefficient, "motions": spheres.motions.tolist()}))
        loads = directory / "loads.txt"
        self._run("two_spheres.py", [directory / "motions.json", loads], directory, timeout)
        return read_loads(loads, len(spheres.motions), self.name)
