# SPDX-License-Identifier: GPL-2.0-or-later
"""`solidem solve`: the body at rest and its natural vibrations, without time steps."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from compare.codes.base import Job, TwoSpheres
from compare.codes.standalone import Standalone
from compare.result import CodeFailure, Floats, Frame, Result


@dataclass
class Statics:
    """The solver of the standalone program. The case's [options] may ask for `modes` vibrations.

    The history of its result has one row for what sensors, grips and a gauge show at rest, and a
    column `frequency` (Hz) with a row for each vibration.
    """

    name: str = "statics"
    standalone: Standalone = field(default_factory=Standalone)

    def missing(self) -> str | None:
        """Why the program cannot be used."""
        return self.standalone.missing()

    def version(self) -> str:
        """What the program says it is."""
        return self.standalone.version()

    def shares_laws(self, parameters: Parameters | None) -> bool:
        """These are solidem's own."""
        return True

    def run(self, job: Job, directory: Path) -> Result:
        """Solves a scene for the loads at its end."""
        results = directory / "results"
        self.standalone.call(["solve", job.scene, "--output", results, "--overwrite", "--threads",
                              "1", "--modes", str(job.options.get("modes", 0))], directory,
                             job.timeout)
        try:
            return self._result(job, results)
        except (OSError, KeyError, TypeError, ValueError) as error:
            raise CodeFailure(f"solidem solve wrote no usable result: {error}") from error

    def _result(self, job: Job, results: Path) -> Result:
        summary = json.loads((results / "summary.json").read_text())
        history: dict[str, Floats] = {"frequency": np.array(summary.get("frequencies") or [])}
        for kind in ("sensors", "grips"):
            for name, shown in (summary.get(kind) or {}).items():
                for quantity in ("displacement", "force"):
                    for axis, value in zip("xyz", shown.get(quantity) or []):
                        history[f"{kind[:-1]}.{name}.{quantity}_{axis}"] = np.array([value])
        for quantity in ("stress", "strain"):
            if quantity in (gauge := summary.get("gauge") or {}):
                history[f"gauge.{quantity}"] = np.array([gauge[quantity]])
        with h5py.File(results / "trajectory.h5") as file:
            group = next(iter(file["frames"].values()))
            frame = Frame(int(group.attrs["step"]), float(group.attrs["time"]),
                          {name: np.asarray(group[name][:], dtype=float)
                           for name in ("position", "stress", "temperature") if name in group})
        return Result(self.name, int(summary["elements"]), int(summary["bonds"]), frame.step,
                      job.parameters.time_step, float(sum(summary["wall_seconds"].values())),
                      history, [frame])

    def beam_loads(self, spheres: TwoSpheres, directory: Path, timeout: float) -> Floats:
        """Two held spheres have nothing to solve for."""
        raise CodeFailure("solidem solve finds no loads of spheres that are both held")
