# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE, through the scripts of contrib/yade."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

from compare.codes.base import ROOT, Job, TwoSpheres, read_loads, run_program
from compare.result import CodeFailure, Floats, Result, read_result

SCRIPTS = ROOT / "contrib" / "yade"


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
        """Moves the two spheres steadily to each place and reads the bond's loads there."""
        directory.mkdir(parents=True, exist_ok=True)
        (directory / "motions.json").write_text(json.dumps({
            "position": spheres.position.tolist(), "radius": spheres.radius,
            "beam_radius": spheres.beam_radius, "young_modulus": spheres.young_modulus,
            "shear_modulus": spheres.shear_modulus, "motions": spheres.motions.tolist()}))
        loads = directory / "loads.txt"
        self._run("two_spheres.py", [directory / "motions.json", loads], directory, timeout)
        return read_loads(loads, len(spheres.motions), self.name)
