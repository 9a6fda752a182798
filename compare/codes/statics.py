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
from contrib.prepared import Parameters

#: Sections that a body is cut into to tell bending from twisting and stretching.
SECTIONS = 12


def motion_of_sections(path: Path, radius: Floats) -> dict[str, Floats]:
    """mode_x, mode_y, mode_z (see Statics) of a file of vibrations."""
    shares = []
    with h5py.File(path) as file:
        for _, group in sorted(file["frames"].items()):
            place, moved = np.asarray(group["position"]), np.asarray(group["displacement"])
            along = place[:, int(np.argmax(np.ptp(place, axis=0)))]
            section = np.minimum(((along - along.min()) / np.ptp(along) * SECTIONS).astype(int),
                                 SECTIONS - 1)
            mass = radius**3
            total = np.maximum(np.bincount(section, mass, SECTIONS), 1e-9 * mass.sum())
            mean = np.stack([np.bincount(section, mass * moved[:, axis], SECTIONS) / total
                             for axis in range(3)], axis=1)
            shares.append((total @ mean**2) / (mass @ (moved**2).sum(axis=1)))
    return {f"mode_{axis}": column for axis, column in zip("xyz", np.transpose(shares))}


@dataclass
class Statics:
    """The solver of the standalone program. The case's [options] may ask for `modes` vibrations.

    The history of its result has one row for what sensors, grips and a gauge show at rest, and
    columns `frequency` (Hz) and `mode_x`, `mode_y`, `mode_z` with a row for each vibration: how much of
    its motion is that of whole sections along an axis (sections across the longest side).
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
        for quantity in ("stress", "strain", "lateral_strain"):
            if quantity in (gauge := summary.get("gauge") or {}):
                history[f"gauge.{quantity}"] = np.array([gauge[quantity]])
        if (vibrations := results / "modes.h5").exists():
            history |= motion_of_sections(vibrations, job.specimen.radius)
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
