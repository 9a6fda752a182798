# SPDX-License-Identifier: GPL-2.0-or-later
"""The standalone program; it also prepares the specimen that every code reads."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

from compare.codes.base import ROOT, Job, TwoSpheres, read_loads, run_program, said_version
from compare.result import CodeFailure, Floats, Result, read_result
from contrib.prepared import Parameters, Plasticity


def _default_program() -> Path:
    """The program built by the release preset, or what SOLIDEM_PROGRAM names."""
    return Path(os.environ.get("SOLIDEM_PROGRAM",
                               ROOT / "build" / "release" / "solidem"))


@dataclass
class Standalone:
    """solidem's own program."""

    name: str = "standalone"
    program: Path = field(default_factory=_default_program)
    threads: int = 1
    environment: dict[str, str] = field(default_factory=dict)  #: more variables

    def missing(self) -> str | None:
        """Why the program cannot be used."""
        if not os.access(self.program, os.X_OK):
            return f"{self.program} is not there; build it (cmake --preset release)"
        return None

    def call(self, words: list[str | Path], directory: Path, timeout: float) -> Path:
        """Runs `solidem words...`; returns the file of what it printed."""
        if reason := self.missing():
            raise CodeFailure(reason)
        run_program([self.program, *words], directory, timeout, self.environment)
        return directory / "output.log"

    def version(self) -> str:
        """What the program says it is."""
        return said_version([self.program, "--version"], r"(\S+)")

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """These are solidem's own."""
        return True

    def run(self, job: Job, directory: Path) -> Result:
        """Runs a job."""
        self.call(["run", job.scene, "--output", directory / "results", "--overwrite", "--threads",
                   str(self.threads)], directory, job.timeout)
        return read_result(self.name, directory / "results")

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """Loads of the law that the program's beams use, compiled on its own."""
        directory.mkdir(parents=True, exist_ok=True)
        source = ROOT / "compare" / "programs" / "beam_loads.cpp"
        program = directory / "beam_loads"
        run_program([os.environ.get("CXX", "g++"), "-std=c++17", "-O1", f"-I{ROOT / 'standalone'}",
                     source, "-o", program], directory / "build", timeout)
        flow = spheres.plasticity or Plasticity("elastic", 1.0)
        head = [*spheres.position.ravel(), spheres.beam_radius, spheres.young_modulus,
                spheres.shear_modulus, spheres.law, spheres.shear_coefficient, flow.law,
                flow.yield_strain, flow.hardening_ratio]
        lines = [head, *spheres.motions.reshape(-1, 12)]
        motions, loads = directory / "motions.txt", directory / "loads.txt"
        motions.write_text("".join(" ".join(
            x if isinstance(x, str) else f"{x:.17g}" for x in line) + "\n" for line in lines))
        run_program([program, motions, loads], directory, timeout)
        return read_loads(loads, len(spheres.motions), self.name)
