# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures ns per bond-step of every code on one core, on the same specimen.

    /usr/bin/python3 -m benchmarks.speed [EFFECT ...] [--repetitions 5] [--output results/speed]

A repetition runs the codes in turn, so that a machine that is slow for a while is slow for all of them;
the table shows medians and, for each code, the median of its ratio to the standalone program within a
repetition. Time is that of the step loop alone, as each code reports it. Left out: set-up, output,
several cores, YADE without rotations (faster, but another model).
"""

from __future__ import annotations

import argparse
import csv
import json
import statistics
import sys
from dataclasses import dataclass, replace
from pathlib import Path

from compare.codes.base import Code, Job
from compare.codes.lammps import Lammps
from compare.codes.liggghts import Liggghts
from compare.codes.standalone import Standalone
from compare.codes.yade import Yade
from compare.result import CodeFailure
from contrib.explained import parse_parameters
from contrib.prepared import read_specimen

from .document import HERE, processor

#: Steps of one measurement: enough to see, few enough to repeat. Codes that are not named have no
#: such scene.
STEPS = {"beams": {"standalone": 2000, "liggghts": 200, "yade": 40},
         "conduction": {"standalone": 10000, "liggghts": 1000, "yade": 300},
         "central_fixed": {"standalone": 4000},
         "central_changing": {"standalone": 4000, "liggghts": 400, "yade": 20},
         "central_crystal": {"standalone": 4000, "liggghts": 400, "lammps nm/cut": 400,
                             "lammps mie/cut": 400}}

#: Targets of the standalone program, ns per bond-step.
TARGETS = {"beams": 25.0, "conduction": 2.0, "central_fixed": 5.0, "central_changing": 8.0,
           "central_crystal": 8.0}


@dataclass(frozen=True)
class Measurement:
    """One run of one code."""

    effect: str
    code: str
    repetition: int
    elements: int
    bonds: int
    steps: int
    nanoseconds: float  #: per bond-step


def prepare(effect: str, standalone: Standalone, folder: Path) -> Job:
    """The job that every code runs, its specimen made once."""
    folder.mkdir(parents=True, exist_ok=True)
    text = (HERE / f"{effect}.toml").read_text()
    recipe = text[text.index("[specimen]"):text.index("[material]")]
    specimen, scene, prepared = (folder / n for n in ("specimen.h5", "scene.toml", "prepared.h5"))
    standalone.call(["specimen", HERE / f"{effect}.toml", "-o", specimen, "--overwrite"],
                    folder / "specimen", 600)
    scene.write_text(text.replace(recipe, f'[specimen]\nfile = "{specimen}"\n\n'))
    standalone.call(["prepare", scene, "-o", prepared, "--overwrite"], folder / "prepare", 600)
    explained = standalone.call(["explain", scene, "--json", "--quick"], folder / "explain", 600)
    parameters = parse_parameters(json.loads(explained.read_text()))
    return Job(scene, prepared, explained, read_specimen(prepared), parameters, 10**6, 10**6, 1800)


def with_steps(job: Job, steps: int, folder: Path) -> Job:
    """The same job, so many steps long, with one look at its end."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.toml"
    scene.write_text(job.scene.read_text().replace("= 1000", f"= {steps}"))
    return replace(job, scene=scene, parameters=replace(job.parameters, steps=steps),
                   explained=_explained(job, steps, folder), observe_every=steps, frame_every=steps)


def _explained(job: Job, steps: int, folder: Path) -> Path:
    meaning = json.loads(job.explained.read_text())
    path = folder / "explained.json"
    path.write_text(json.dumps({**meaning, "steps": steps}))
    return path


def measure(effect: str, repetitions: int, folder: Path) -> tuple[list[Measurement], list[str]]:
    """All runs of one effect, and what failed."""
    standalone = Standalone()
    known: dict[str, Code] = {"standalone": standalone, "liggghts": Liggghts(), "yade": Yade(),
                              "lammps nm/cut": Lammps(style="nm/cut"), "lammps mie/cut": Lammps(style="mie/cut")}
    codes = {name: known[name] for name in STEPS[effect]}
    failures = [f"{name}: {reason}" for name, c in codes.items() if (reason := c.missing())]
    codes = {name: c for name, c in codes.items() if not c.missing()}
    job = prepare(effect, standalone, folder / effect)
    found = []
    for repetition in range(repetitions):
        for name, code in codes.items():
            here = folder / effect / f"{name.replace('/', '_').replace(' ', '_')}_{repetition}"
            try:
                short = with_steps(job, STEPS[effect][name], here)
                result = code.run(short, here).check()
            except CodeFailure as failure:
                failures.append(f"{effect}, {name}: {failure}")
                continue
            found.append(Measurement(effect, name, repetition, result.elements, result.bonds,
                                     result.steps, result.nanoseconds_per_bond_step))
            print(f"{effect:<16} {name:<14} {found[-1].nanoseconds:8.2f} ns per bond-step",
                  flush=True)
    return found, failures


def table(measurements: list[Measurement]) -> str:
    """Markdown: median, range, ratio to the standalone program, target."""
    lines = ["| effect | code | ns per bond-step | least – most | times the standalone | target |",
             "|---|---|---|---|---|---|"]
    for effect in dict.fromkeys(m.effect for m in measurements):
        own = {m.repetition: m.nanoseconds for m in measurements
               if m.effect == effect and m.code == "standalone"}
        for code in dict.fromkeys(m.code for m in measurements if m.effect == effect):
            runs = [m for m in measurements if m.effect == effect and m.code == code]
            times = [m.nanoseconds for m in runs]
            ratios = [m.nanoseconds / own[m.repetition] for m in runs if m.repetition in own]
            ratio = f"{statistics.median(ratios):.1f}" if ratios else "–"
            target = f"≤ {TARGETS[effect]:g}" if code == "standalone" else ""
            lines.append(f"| {effect} | {code} | {statistics.median(times):.2f} | "
                         f"{min(times):.2f} – {max(times):.2f} | {ratio} | {target} |")
    return "\n".join(lines)


def main() -> int:
    """Measures, prints the table, writes speed.csv and speed.md; 1 when a code failed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("effects", nargs="*", metavar="EFFECT", help=", ".join(STEPS))
    parser.add_argument("--output", type=Path, default=Path("results/speed"))
    options = parser.parse_args()
    if unknown := [e for e in options.effects if e not in STEPS]:
        parser.error(f"unknown effect {unknown[0]!r}; known: {', '.join(STEPS)}")
    output = options.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    measurements: list[Measurement] = []
    failures: list[str] = []
    for effect in options.effects or STEPS:
        found, failed = measure(effect, options.repetitions, output)
        measurements += found
        failures += failed
    with open(output / "speed.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Measurement.__dataclass_fields__)
        writer.writerows([getattr(m, f) for f in Measurement.__dataclass_fields__]
                         for m in measurements)
    text = (f"{processor()}, one core, {options.repetitions} repetitions in turn, medians\n\n"
            + table(measurements) + "".join(f"\n\nFAILED {f}" for f in failures) + "\n")
    (output / "speed.md").write_text(text)
    print("\n" + text)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
