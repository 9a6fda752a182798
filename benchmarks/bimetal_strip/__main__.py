# SPDX-License-Identifier: GPL-2.0-or-later
"""How far a strip of two metals curls when it is warmed, over Timoshenko's curvature.

    /usr/bin/python3 -m benchmarks.bimetal_strip [--elements 1500 5000 12000] [--seeds 1 2]
        [--length MM] [--output results/bimetal_strip]

Solves docs/examples/bimetal.toml at rest, warm, and the same strip cold: pulled at its end, and bent by a
force there. What it bears in both tells how thick it is to its own stiffness, √(12 EI/EA), and so what it
should curl by. Writes a table in Markdown and strip.csv.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import tempfile
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import h5py  # type: ignore[import]
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))
SCENE = ROOT / "docs" / "examples" / "bimetal.toml"
WIDTH, THICKNESS = 1e-3, 1.6e-3  #: of the scene's strip, m
MISMATCH = (23e-6 - 12e-6) * 100  #: of thermal strains
TIMOSHENKO = 1.5 * MISMATCH / THICKNESS  #: of halves of one modulus, 1/m
FORCE, STRETCH = 1.0, 1e-6  #: across the end, N; of the end, m
END = """
[[grips]]
name = "end"
region = {{ axis = "x", side = "high", layers = 1 }}
{motion}
"""
PULLED = f'displacement = ["{STRETCH} m", "free", "free"]'
BENT = f'force = ["free", "free", "{FORCE} N"]\nrotation = "free"'


@dataclass(frozen=True)
class Strip:
    """What a packing shows."""

    elements: int
    seed: int
    across: float  #: elements over the thickness
    curvature: float  #: of the middle, over Timoshenko's
    thickness: float  #: √(12 EI/EA) over the mould's
    own: float  #: curvature over Timoshenko's of a strip of that thickness


def scene(elements: int, seed: int, length: float, motion: str = "") -> str:
    """Warm, or cold with something done to its end; `length` in mm."""
    text = SCENE.read_text()
    words = {"elements = 1500": f"elements = {elements}\nseed = {seed}",
             'size = ["12 mm"': f'size = ["{length:g} mm"',
             'point = ["12 mm"': f'point = ["{length:g} mm"'}
    if motion:
        words['"20 °C", "120 °C"'] = '"20 °C", "20 °C"'
    for old, new in words.items():
        if text.count(old) != 1:
            raise SystemExit(f"{SCENE.name}: {old!r} stands there {text.count(old)} times")
        text = text.replace(old, new)
    return text + (END.format(motion=motion) if motion else "")


def at_rest(folder: Path, text: str) -> tuple[Any, Any, dict[str, Any]]:
    """(N, 3) places of the start and displacements, m, and the summary."""
    (folder / "scene.toml").write_text(text)
    done = subprocess.run([PROGRAM, "solve", "scene.toml", "-o", "found", "--overwrite", "--quiet",
                           "-t", "1"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stderr)
    with h5py.File(folder / "found" / "trajectory.h5") as file:
        frame = next(iter(file["frames"].values()))
        moved = np.array(frame["displacement"])
        return np.array(frame["position"]) - moved, moved, json.loads(
            (folder / "found" / "summary.json").read_text())


def middle(place: Any) -> Any:
    """Which elements are far from both ends."""
    x = place[:, 0]
    return (x > 0.25 * x.max()) & (x < 0.75 * x.max())


def last_of_fit(shapes: list[Any], values: Any) -> float:
    """The coefficient of the last shape of a fit by least squares."""
    return float(np.linalg.lstsq(np.stack(shapes, axis=1), values, rcond=None)[0][-1])


def curvature(place: Any, moved: Any) -> float:
    """Of the middle, 1/m."""
    x, z = (place[middle(place), k] for k in (0, 2))
    return last_of_fit([np.ones_like(x), x, z, x**2 / 2], moved[middle(place), 2])


def tension_stiffness(place: Any, moved: Any, summary: dict[str, Any]) -> float:
    """EA, N."""
    x, y, z = place[middle(place)].T
    strain = last_of_fit([np.ones_like(x), y, z, x], moved[middle(place), 0])
    return float(summary["grips"]["end"]["force"][0]) / strain


def bending_stiffness(place: Any, moved: Any) -> float:
    """EI, N m²: where a force bends it whose moment grows from the end, and shears it evenly."""
    x, _, z = place[middle(place)].T
    end = place[:, 0] > place[:, 0].max() - 1e-9
    lever = float(place[end, 0].mean())
    shape = lever * x**2 / 2 - x**3 / 6
    return FORCE / last_of_fit([np.ones_like(x), x, z, shape], moved[middle(place), 2])


def strip(folder: Path, elements: int, seed: int, length: float) -> Strip:
    """Of one packing."""
    place, moved, _ = at_rest(folder, scene(elements, seed, length))
    warm = curvature(place, moved)
    tension = tension_stiffness(*at_rest(folder, scene(elements, seed, length, PULLED)))
    bending = bending_stiffness(*at_rest(folder, scene(elements, seed, length, BENT))[:2])
    own = float(np.sqrt(12 * bending / tension)) / THICKNESS
    diameter = (0.63 * length * 1e-3 * WIDTH * THICKNESS * 6 / (np.pi * elements)) ** (1 / 3)
    return Strip(elements, seed, THICKNESS / diameter, abs(warm) / TIMOSHENKO, own, 1 / own)


def main() -> None:
    """Solves and tells."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--elements", type=int, nargs="+", default=[1500, 5000, 12000])
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--length", type=float, default=12, help="of the strip, mm")
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "bimetal_strip")
    words = parser.parse_args()
    words.output.mkdir(parents=True, exist_ok=True)
    print("| elements | across the thickness | packing | curvature | own thickness | its curvature | "
          "curvature over that |\n|" + "---|" * 7)
    with (words.output / "strip.csv").open("w", newline="") as file, \
            tempfile.TemporaryDirectory() as scratch:
        table = csv.writer(file)
        table.writerow([field.name for field in fields(Strip)])
        for elements in words.elements:
            for seed in words.seeds:
                one = strip(Path(scratch), elements, seed, words.length)
                print(f"| {elements} | {one.across:.1f} | {seed} | {one.curvature:.3f} | "
                      f"{one.thickness:.3f} | {one.own:.3f} | {one.curvature / one.own:.3f} |",
                      flush=True)
                table.writerow(asdict(one).values())


if __name__ == "__main__":
    main()
