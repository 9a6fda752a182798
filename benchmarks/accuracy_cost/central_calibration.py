# SPDX-License-Identifier: GPL-2.0-or-later
"""Constants of a law of central force for a solid of a given Young's modulus.

The stiffness of a body is in proportion to that of its pairs, so slow pulls of other packings tell by what to
multiply the constants that a scene has. What `[calibration]` of such a scene says: `young_modulus`, how many
`specimens`, `given_for` (elements of the body that the scene's constants belong to), `elements` (of the bodies
that are pulled; those of the scene if it says nothing), `velocity` and `duration` of the pull, which has to be slow
and short of what is not linear for bodies with the scene's own constants.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Callable

import numpy as np

from compare.codes.standalone import Standalone
from compare.result import CodeFailure, read_result
from compare.runs import replace_words, table_text

#: A constant, and the power of the size of elements that it goes with where the material stays (Terreros 2013,
#: annex C).
POWERS = {"stiffness": 1, "attraction": 2, "energy": 3, "beyond_energy": 3}
#: Part of the pull before what the modulus is read from.
BEFORE = 0.3
UNITS = {"MPa": 1e6, "GPa": 1e9, "TPa": 1e12}

#: Ends one mean diameter deep, free across: as `solidem calibrate` pulls beams.
PULL = """\
[[grips]]
name = "left"
region = {{ axis = "x", side = "low", layers = 1 }}
velocity = ["0 m/s", "free", "free"]

[[grips]]
name = "right"
region = {{ axis = "x", side = "high", layers = 1 }}
velocity = ["{velocity}", "free", "free"]

[run]
duration = "{duration}"

[output]
frames = 1
"""

#: File of the specimen of a scene, and the seconds that it took.
Packing = Callable[[str, float], tuple[Path, float]]


def scaled(scene: str, size: float, factor: float = 1.0) -> str:
    """The scene with constants for elements `size` times as large, all forces times `factor`."""
    def more(found: re.Match[str]) -> str:
        return f'{found[1]} = "{float(found[2]) * factor * size**POWERS[found[1]]:.12g} {found[3]}"'
    forces = table_text(scene, "central_forces")
    constants = re.compile(rf'^({"|".join(POWERS)}) = "(\S+) ([^"]+)"', re.MULTILINE)
    return scene.replace(forces, constants.sub(more, forces))


def _size(given_for: int, elements: int) -> float:
    """Of elements of a body of so many, over that of the body which the constants are given for."""
    return float((given_for / elements)**(1 / 3))


def pulled_scene(scene: str, seed: int) -> str:
    """The scene of the pull of the first packing, and [calibration] with its constants' own elements."""
    known = tomllib.loads(scene)
    table, elements = known["calibration"], known["specimen"]["elements"]
    wanted = table.get("elements", elements)
    text = "".join(table_text(scene, name).rstrip() + "\n\n"
                   for name in ("specimen", "material", "central_forces", "gauge"))
    # Pairs that come into range are no elasticity: they pull with a force that no strain goes with.
    text = replace_words(text, {f"elements = {elements}": f"elements = {wanted}",
                                f'neighbours = "{known["central_forces"]["neighbours"]}"': 'neighbours = "fixed"'})
    text = re.sub(r"^seed = \d+$", f"seed = {seed}", text, flags=re.MULTILINE)
    asked = f'[calibration]\nyoung_modulus = "{table["young_modulus"]}"\nspecimens = {table["specimens"]}\n'
    return scaled(text, _size(table["given_for"], wanted)) + PULL.format(**table) + "\n" + asked


def with_forces(scene: str, factor: float) -> str:
    """The scene with constants for its own number of elements, and nothing left to calibrate."""
    known = tomllib.loads(scene)
    scene = scene.replace(table_text(scene, "calibration"), "")
    return scaled(scene, _size(known["calibration"]["given_for"], known["specimen"]["elements"]), factor)


def _modulus(text: str, standalone: Standalone, folder: Path, timeout: float) -> float:
    """Young's modulus of the gauge section of a body that is pulled, Pa."""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "scene.toml"
    file.write_text(text)
    standalone.call(["run", file, "--output", folder / "results", "--overwrite", "--threads", "1"],
                    folder, timeout)
    history = read_result("standalone", folder / "results").history
    rows = history["time"] >= BEFORE * history["time"][-1]
    return float(np.polyfit(history["gauge.strain"][rows], history["gauge.stress"][rows], 1)[0])


def factor_of(text: str, standalone: Standalone, packing: Packing, folder: Path,
              timeout: float) -> tuple[float, float]:
    """By what to multiply the constants of pulled_scene, and the seconds of its packings."""
    known = tomllib.loads(text)
    number, unit = known["calibration"]["young_modulus"].split()
    if unit not in UNITS:
        raise CodeFailure(f"young_modulus in {unit}; known: {', '.join(UNITS)}")
    recipe, asked = table_text(text, "specimen"), table_text(text, "calibration")
    moduli, seconds = [], 0.0
    for seed in range(known["specimen"]["seed"], known["specimen"]["seed"] + known["calibration"]["specimens"]):
        own = re.sub(r"^seed = \d+$", f"seed = {seed}", recipe, flags=re.MULTILINE)
        file, took = packing(own, timeout)
        seconds += took
        scene = text.replace(asked, "").replace(recipe, f'[specimen]\nfile = "{file}"\n\n')
        moduli.append(_modulus(scene, standalone, folder / str(seed), timeout))
    return float(number) * UNITS[unit] / float(np.mean(moduli)), seconds
