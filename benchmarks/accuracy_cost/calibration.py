# SPDX-License-Identifier: GPL-2.0-or-later
"""Bonds, or constants of central forces, for the solid that a scene asks for in [calibration], each set found
once, and the time it took."""

from __future__ import annotations

import hashlib
import json
import re
import time
import tomllib
from pathlib import Path
from typing import Any

from benchmarks.accuracy_cost.central_calibration import Packing, factor_of, pulled_scene, with_forces
from compare.codes.standalone import Standalone
from compare.result import CodeFailure
from compare.runs import table_text

#: Seed of the first of several packings that are calibrated: none of those that are run.
OTHER_PACKINGS = 1001
#: What `solidem calibrate` reads of a scene, and what it writes.
READS = ("specimen", "bonds", "material", "beams", "plasticity", "rupture", "gauge",
         "calibration", "calibration.curve")
WRITES = ("beams", "plasticity", "rupture")


def calibration_scene(scene: str) -> str:
    """The scene of the calibration alone: of the very packing where `specimens = 1`, else of others."""
    known = tomllib.loads(scene)
    tables = [table_text(scene, name) for name in READS if f"\n[{name}]" in f"\n{scene}"]
    text = "".join(table.rstrip() + "\n\n" for table in tables)
    if known["calibration"].get("specimens", 3) != 1:
        text = re.sub(r"^seed = \d+$", f"seed = {OTHER_PACKINGS}", text, flags=re.MULTILINE)
    return text


def with_bonds(scene: str, found: str) -> str:
    """The scene with what was found in place of its own, and nothing left to calibrate."""
    for name in ("calibration.curve", "calibration"):
        if f"\n[{name}]" in f"\n{scene}":
            scene = scene.replace(table_text(scene, name), "")
    for name in WRITES:
        if f"\n[{name}]" in f"\n{found}":
            scene = scene.replace(table_text(scene, name), table_text(found, name).rstrip() + "\n\n")
    return scene


class Calibrations:
    """Sets of bonds, or of constants, by scene."""

    def __init__(self, folder: Path, standalone: Standalone, program: str, packing: Packing):
        """`program` names the very build, so that another one finds its own."""
        self.folder, self._standalone, self._program = folder, standalone, program
        self._packing = packing
        self._failed: dict[str, CodeFailure] = {}
        folder.mkdir(parents=True, exist_ok=True)

    def get(self, scene: str, timeout: float) -> tuple[str, float]:
        """The scene with what was found, and the seconds that took; as it is if it does not ask for any."""
        known = tomllib.loads(scene)
        if "calibration" not in known:
            return scene, 0.0
        central = "central_forces" in known
        text = pulled_scene(scene, OTHER_PACKINGS) if central else calibration_scene(scene)
        name = hashlib.sha256(f"{text}\0{self._program}".encode()).hexdigest()[:16]
        if name in self._failed:
            raise self._failed[name]
        told = self.folder / f"{name}.json"
        if not told.exists():
            try:
                found = (self._pull if central else self._calibrate)(name, text, timeout)
                told.write_text(json.dumps(found))
            except CodeFailure as failure:
                self._failed[name] = CodeFailure(f"no calibration: {failure}")
                raise self._failed[name] from failure
        found = json.loads(told.read_text())
        scene = with_forces(scene, found["factor"]) if central else with_bonds(scene, found["bonds"])
        return scene, float(found["seconds"])

    def _pull(self, name: str, text: str, timeout: float) -> dict[str, Any]:
        start = time.perf_counter()
        factor, packings = factor_of(text, self._standalone, self._packing, self.folder / name, timeout)
        return {"factor": factor, "seconds": packings + time.perf_counter() - start}

    def _calibrate(self, name: str, text: str, timeout: float) -> dict[str, Any]:
        file, output = self.folder / f"{name}.toml", self.folder / name
        file.write_text(text)
        found = output / "calibrated.toml"
        start = time.perf_counter()
        try:
            self._standalone.call(["calibrate", file, "--output", output, "--overwrite", "--threads",
                                   "1"], self.folder / f"{name}.log", timeout)
        except CodeFailure:
            # Ends with status 1 where it came near and no nearer, and writes the nearest.
            if not found.exists():
                raise
        return {"bonds": found.read_text(), "seconds": time.perf_counter() - start}
