# SPDX-License-Identifier: GPL-2.0-or-later
"""What each effect costs: one scene, its effects switched on one by one, for beams and for central forces.

    /usr/bin/python3 -m benchmarks.effects [--elements N] [--steps N] [--rounds N] [--effects EFFECT ...]
        [--liggghts] [--liggghts-steps N]

Time is that of the processor, of a long run less that of a short one, so that reading and writing do
not count; effects are run in turn, medians over the rounds of the ratio to the base of the same round.
In LIGGGHTS it is the wall time of the step loop. Memory is what `solidem explain` says of the columns.
effects.csv stands in results/effects/.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import subprocess
import sys
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.effects.scenes import (BEAM_EFFECTS, BEAMS, CENTRAL, CENTRAL_EFFECTS, COUPLED_EFFECTS, FLOWING,
                                       MAY_FLOW, SPECIMEN, scene)

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))
BASES = {"beams": (BEAMS, BEAM_EFFECTS),
         "beams that may flow": (MAY_FLOW, COUPLED_EFFECTS),
         "beams that flow": (FLOWING, COUPLED_EFFECTS),
         "central forces": (CENTRAL, CENTRAL_EFFECTS)}


def processor_seconds(words: list[str], folder: Path) -> float:
    """Of a command, user and system."""
    with (folder / "log").open("w") as log:
        child = subprocess.Popen([PROGRAM, *words], cwd=folder, stdout=log, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        raise SystemExit(f"solidem {' '.join(words)}: {(folder / 'log').read_text()}")
    return used.ru_utime + used.ru_stime


def step_seconds(base: str, effect: str, steps: int, folder: Path) -> float:
    """Processor time of one step."""
    taken = []
    for count in (steps // 10, steps):
        (folder / "scene.toml").write_text(scene(base, effect, count))
        taken.append(processor_seconds(["run", "scene.toml", "--output", "run", "--overwrite"], folder))
    return (taken[1] - taken[0]) / (steps - steps // 10)


def bytes_of(base: str, effect: str, folder: Path) -> tuple[float, float]:
    """Bytes an element, all in all; bonds an element."""
    (folder / "scene.toml").write_text(scene(base, effect, 100))
    told = json.loads(subprocess.run([PROGRAM, "explain", "scene.toml", "--json", "--quick"], cwd=folder,
                                     capture_output=True, text=True, check=True).stdout)
    return told["bytes"] / told["elements"], told["bonds"] / told["elements"]


def chosen(name: str, only: list[str] | None) -> tuple[str, dict[str, str]]:
    """A base and its effects, or those of them that are asked for."""
    base, effects = BASES[name]
    return base, {effect: text for effect, text in effects.items() if only is None or effect in only}


def measured(name: str, only: list[str] | None, steps: int, rounds: int, folder: Path) -> list[dict[str, Any]]:
    """Rows of one base."""
    base, effects = chosen(name, only)
    times: dict[str, list[float]] = {effect: [] for effect in effects}
    bases: dict[str, list[float]] = {effect: [] for effect in effects}
    for number in range(rounds):
        order = list(effects.items())
        for effect, text in order if number % 2 else reversed(order):
            before = step_seconds(base, "", steps, folder)
            times[effect].append(step_seconds(base, text, steps, folder))
            bases[effect].append((before + step_seconds(base, "", steps, folder)) / 2)
    own_bytes, _ = bytes_of(base, "", folder)
    rows = []
    for effect, text in effects.items():
        ratios = [time / own for time, own in zip(times[effect], bases[effect])]
        more, _ = bytes_of(base, text, folder)
        rows.append({"code": "standalone", "base": name, "effect": effect, "rounds": rounds,
                     "base_us_per_step": 1e6 * median(bases[effect]),
                     "us_per_step": 1e6 * median(times[effect]), "time_ratio": median(ratios),
                     "least_ratio": min(ratios), "most_ratio": max(ratios),
                     "bytes_per_element": more, "more_bytes_per_element": more - own_bytes})
    return rows


def in_liggghts(name: str, only: list[str] | None, steps: int, rounds: int,
                folder: Path) -> list[dict[str, Any]]:
    """Rows of one base, of the effects that it takes; what it refuses is told."""
    from benchmarks.effects.liggghts import measured_in_liggghts  # needs h5py
    rows = []
    for effect, times in measured_in_liggghts(*chosen(name, only), steps, rounds, folder).items():
        if isinstance(times, str):
            print(f"liggghts, {name}, {effect}: not measured: {times}", flush=True)
            continue
        ratios = [time / own for time, own in zip(*times)]
        rows.append({"code": "liggghts", "base": name, "effect": effect, "rounds": rounds,
                     "base_us_per_step": 1e6 * median(times[1]), "us_per_step": 1e6 * median(times[0]),
                     "time_ratio": median(ratios), "least_ratio": min(ratios), "most_ratio": max(ratios),
                     "bytes_per_element": "", "more_bytes_per_element": ""})
    return rows


def told(row: dict[str, Any]) -> str:
    """One line."""
    memory = row["more_bytes_per_element"]
    return (f"{row['code']}, {row['base']}, {row['effect']}: × {row['time_ratio']:.3f} ({row['least_ratio']:.3f} – "
            f"{row['most_ratio']:.3f})" + ("" if memory == "" else f", {memory:+.1f} bytes an element"))


def write(rows: list[dict[str, Any]], path: Path) -> None:
    """A table, in which rows that are there and were not measured anew stay in their places."""
    new = {(row["code"], row["base"], row["effect"]): {
        key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()} for row in rows}
    if path.exists():
        with path.open(newline="", encoding="utf-8") as file:
            there = {(row["code"], row["base"], row["effect"]): row for row in csv.DictReader(file)}
        new = {**there, **new}
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(new.values())


def main() -> int:
    """Prints a table and writes it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--elements", type=int, default=4000)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("bases", nargs="*", metavar="BASE", help=", ".join(BASES) + "; all if none is named")
    parser.add_argument("--effects", nargs="+", metavar="EFFECT", help="these alone; other rows of the table stay")
    parser.add_argument("--liggghts", action="store_true", help="in LIGGGHTS as well")
    parser.add_argument("--liggghts-steps", type=int, help="steps there (default: a tenth of those of solidem)")
    parser.add_argument("--folder", type=Path, default=ROOT / "results" / "effects")
    given = parser.parse_args()
    if unknown := [name for name in given.bases if name not in BASES]:
        parser.error(f"unknown base {unknown[0]!r}; known: {', '.join(BASES)}")
    known = {effect: None for _, effects in BASES.values() for effect in effects}
    if unknown := [name for name in given.effects or [] if name not in known]:
        parser.error(f"unknown effect {unknown[0]!r}; known: {', '.join(known)}")
    os.environ["OMP_NUM_THREADS"] = "1"
    given.folder.mkdir(parents=True, exist_ok=True)
    (given.folder / "body.toml").write_text(SPECIMEN.replace("$elements", str(given.elements)))
    processor_seconds(["specimen", "body.toml", "--output", "bar.h5", "--overwrite"], given.folder)
    rows = []
    for name in given.bases or BASES:
        found = measured(name, given.effects, given.steps, given.rounds, given.folder)
        if given.liggghts:
            found += in_liggghts(name, given.effects, given.liggghts_steps or max(1, given.steps // 10), given.rounds,
                                 given.folder.resolve())
        rows += found
        print(*map(told, found), sep="\n", flush=True)
    write(rows, given.folder / "effects.csv")
    return 0


if __name__ == "__main__":
    sys.exit(main())
