# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures the hot loops against what the machine can do: every instruction set, size and number of threads.

    /usr/bin/python3 -m benchmarks.speed.kernels [EFFECT ...] [--elements 1000 20000 100000]
        [--repetitions 5] [--output results/speed]

A repetition measures the machine (bench_floors) and then each way in turn; medians are told, with their range.
The least time of a bond-step is the larger of two floors: the arithmetic of the law, counted, at the machine's rate
of fused products and sums (of divisions and roots, where these are slower), and the bytes of all columns, each
moved once, at the rate of a triad as large as the body. Needs -DSOLIDEM_BENCHMARKS=ON; specimens are kept in the
folder.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from compare.codes.standalone import Standalone

from .document import HERE, processor

FLOORS = Path(__file__).resolve().parents[2] / "build" / "release" / "benchmarks" / "bench_floors"
#: Bond-steps of a measurement, and whose arithmetic, as bench_floors counts it, an effect does at least.
BOND_STEPS = 1e7
ARITHMETIC = {"beams": "beams", "beams_below_limits": "beams", "beams_flowing": "beams_flowing",
              "conduction": "conduction", "central_fixed": "central_fixed",
              "central_changing": "central_changing"}
EFFECTS = ("beams", "beams_below_limits", "beams_flowing", "conduction", "central_fixed", "central_changing")
#: Steps in which what the scene's title says stays true.
MOST_STEPS = {"beams_below_limits": 4000, "beams_flowing": 600, "central_changing": 20000}
NAMES = {"x86_64_v4": "AVX-512", "x86_64_v3": "AVX2", "baseline": "baseline"}


@dataclass(frozen=True)
class Body:
    """What is run, and what a step of it must move."""

    effect: str
    elements: int
    scene: str
    bonds: int
    bytes: int  #: of all columns


@dataclass(frozen=True)
class Measurement:
    """One run, and the floors of the machine in the same minute; times in ns for a step and a bond."""

    effect: str
    elements: int
    instruction_set: str
    threads: int
    repetition: int
    nanoseconds: float
    arithmetic_floor: float
    bytes_floor: float


def body(effect: str, elements: int, standalone: Standalone, folder: Path) -> Body:
    """The scene with so many elements of the same size; its specimen is made once."""
    text = (HERE / f"{effect}.toml").read_text()
    side = 10 * (elements / 20000) ** (1 / 3)
    recipe = text[text.index("[specimen]"):text.index("[material]")]
    specimen = folder / f"packing_{elements}.h5"
    if not specimen.exists():
        scene = folder / f"packing_{elements}.toml"
        scene.write_text(text.replace("elements = 20000", f"elements = {elements}")
                         .replace('"10 mm"', f'"{side:.6g} mm"'))
        standalone.call(["specimen", scene, "-o", specimen], folder / "specimen", 3600)
    scene_text = text.replace(recipe, f'[specimen]\nfile = "{specimen}"\n\n')
    scene = folder / f"{effect}_{elements}.toml"
    scene.write_text(scene_text)
    told = standalone.call(["explain", scene, "--json", "--quick"], folder / "explain", 600)
    report = json.loads(told.read_text())
    return Body(effect, elements, scene_text, report["bonds"], report["bytes"])


def floors(sizes: list[int]) -> dict[str, Any]:
    """What the machine does at most, now."""
    done = subprocess.run([str(FLOORS), *map(str, sizes)], check=True, capture_output=True, text=True,
                          env={**os.environ, "OMP_WAIT_POLICY": "passive"})
    return dict(json.loads(done.stdout))


def arithmetic_floor(told: dict[str, Any], of: Body, instruction_set: str, threads: int) -> float:
    """ns for a step and a bond, of both its sides; fused two by two, as if all could be."""
    needed = told["slot"][ARITHMETIC[of.effect]]
    rate = told["threads"][str(threads)]["arithmetic"][instruction_set]
    fused = needed["simple"] / 2 / rate["fused"]
    slow = needed["divisions"] / rate["divisions"] + needed["roots"] / rate["roots"]
    return float(2e9 * max(fused, slow))


def bytes_floor(told: dict[str, Any], of: Body, threads: int) -> float:
    """ns for a step and a bond."""
    return float(1e9 * of.bytes / told["threads"][str(threads)]["triad"][str(of.bytes)] / of.bonds)


def measure(of: Body, ways: list[tuple[str, int]], told: dict[str, Any], repetition: int,
            folder: Path) -> list[Measurement]:
    """Each way once, in turn."""
    steps = min(max(100, int(BOND_STEPS / of.bonds)), MOST_STEPS.get(of.effect, 10**9))
    scene = folder / "run.toml"
    scene.write_text(of.scene.replace("= 1000", f"= {steps}"))
    found = []
    for instruction_set, threads in ways:
        code = Standalone(threads=threads, environment={"SOLIDEM_INSTRUCTION_SET": instruction_set})
        code.call(["run", scene, "-o", folder / "run", "--overwrite", "--threads", str(threads)],
                  folder / "run_log", 3600)
        summary = json.loads((folder / "run" / "summary.json").read_text())
        found.append(Measurement(
            of.effect, of.elements, instruction_set, threads, repetition,
            summary["nanoseconds_per_bond_step"],
            arithmetic_floor(told, of, instruction_set, threads), bytes_floor(told, of, threads)))
        m = found[-1]
        print(f"{m.effect:<20}{m.elements:>8} {NAMES[m.instruction_set]:<9}{m.threads:>2} "
              f"{m.nanoseconds:8.2f} ns; floors {m.arithmetic_floor:.2f}, {m.bytes_floor:.2f}", flush=True)
    return found


def table(measurements: list[Measurement]) -> str:
    """Markdown: medians and ranges, times the larger floor, and three ratios within a repetition."""
    by = {(m.effect, m.elements, m.instruction_set, m.threads, m.repetition): m for m in measurements}
    best = measurements[0].instruction_set
    lines = ["| effect | elements | instructions | threads | ns | least – most | floor: arithmetic, bytes | times the "
             "larger | over the best instructions | over elastic beams | over one thread |", "|" + "---|" * 11]

    def ratio(own: list[Measurement], **other: object) -> str:
        pairs = [(m, by.get(tuple({**vars(m), **other}[key] for key in  # type: ignore[arg-type]
                                  ("effect", "elements", "instruction_set", "threads", "repetition"))))
                 for m in own]
        found = [m.nanoseconds / o.nanoseconds for m, o in pairs if o is not None and o is not m]
        return f"{statistics.median(found):.2f}" if found else ""

    for key in dict.fromkeys((m.effect, m.elements, m.instruction_set, m.threads) for m in measurements):
        own = [m for m in measurements
               if (m.effect, m.elements, m.instruction_set, m.threads) == key]
        times = [m.nanoseconds for m in own]
        arithmetic, moved = (statistics.median(getattr(m, f) for m in own)
                             for f in ("arithmetic_floor", "bytes_floor"))
        far = statistics.median(m.nanoseconds / max(m.arithmetic_floor, m.bytes_floor) for m in own)
        told = f"{arithmetic:.1f}, {moved:.1f}"
        elastic = ratio(own, effect="beams") if key[0].startswith("beams_") else ""
        lines.append(f"| {key[0]} | {key[1]} | {NAMES[key[2]]} | {key[3]} | {statistics.median(times):.2f} | "
                     f"{min(times):.2f} – {max(times):.2f} | {told} | {far:.1f} | "
                     f"{ratio(own, instruction_set=best)} | {elastic} | {ratio(own, threads=1)} |")
    return "\n".join(lines)


def main() -> int:
    """Measures, prints the table, writes kernels.csv and kernels.md."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--elements", type=int, nargs="+", default=[1000, 20000, 100000])
    parser.add_argument("effects", nargs="*", metavar="EFFECT", help=", ".join(EFFECTS))
    parser.add_argument("--output", type=Path, default=Path("results/speed"))
    options = parser.parse_args()
    if unknown := [e for e in options.effects if e not in EFFECTS]:
        parser.error(f"unknown effect {unknown[0]!r}; known: {', '.join(EFFECTS)}")
    if not FLOORS.exists():
        parser.error(f"{FLOORS} is not there; build it (cmake --preset release -DSOLIDEM_BENCHMARKS=ON)")
    folder = options.output.resolve() / "kernels"
    folder.mkdir(parents=True, exist_ok=True)
    told = floors([10**6])
    threads = [int(n) for n in told["threads"]]
    ways = [(name, n) for name in NAMES for n in threads if name in told["threads"]["1"]["arithmetic"]]
    standalone = Standalone()
    bodies = [body(effect, n, standalone, folder)
              for effect in options.effects or EFFECTS for n in options.elements]
    measurements: list[Measurement] = []
    for repetition in range(options.repetitions):
        told = floors(sorted({of.bytes for of in bodies}))
        for of in bodies:
            measurements += measure(of, ways, told, repetition, folder)
    measurements.sort(key=lambda m: (EFFECTS.index(m.effect), m.elements, list(NAMES).index(m.instruction_set),
                                     m.threads))
    with open(options.output / "kernels.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Measurement.__dataclass_fields__)
        writer.writerows(vars(m).values() for m in measurements)
    text = (f"{processor()}, {options.repetitions} repetitions in turn, medians; ns for a step and a bond\n\n"
            + table(measurements) + "\n")
    (options.output / "kernels.md").write_text(text)
    print("\n" + text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
