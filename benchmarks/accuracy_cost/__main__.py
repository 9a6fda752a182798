# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures what accuracy costs in time, and writes tables, plots and a page.

    /usr/bin/python3 -m benchmarks.accuracy_cost [study ...] [--output results/accuracy_cost]

Writes runs.csv, points.csv, references.csv, omissions.csv, a picture for each study, page.md and index.html.
Runs one at a time on one core: measure on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import csv
import math
import os
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.accuracy_cost.known import Figures
from benchmarks.accuracy_cost.page import write_page
from benchmarks.accuracy_cost.results import Median, medians
from benchmarks.accuracy_cost.runs import Bench, Omission, Run
from benchmarks.accuracy_cost.study import Study, StudyError, read_study
from compare.codes import all_codes
from compare.provenance import commit
from compare.result import CodeFailure

HERE = Path(__file__).resolve().parent


def _write(path: Path, rows: list[dict[str, Any]]) -> None:
    """A CSV file with the union of the rows' columns."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def _run_row(run: Run, reading: str) -> dict[str, Any]:
    said = run.summary
    work = said.get("integrator") or {}
    return {
        "study": run.study, **run.labels, "repetition": run.repetition, "order": run.order,
        "reading": reading, "error": f"{run.error(reading):.6g}",
        "steps_seconds": f"{run.seconds:.6g}",
        "set_up_seconds": "" if run.set_up_seconds is None else f"{run.set_up_seconds:.6g}",
        "packing_seconds": f"{run.packing_seconds:.4g}",
        "program_seconds": f"{run.program_seconds:.6g}", "bonds": run.bonds, "steps": run.steps,
        "inner_steps": work.get("inner_steps", ""), "evaluations": work.get("evaluations", ""),
        "threads": said.get("threads", 1), "instruction_set": said.get("instruction_set", ""),
        "precision": said.get("precision", "double"), "load": f"{run.load:.2f}",
        **{name: f"{error:.6g}" for name, error in run.errors[reading].items()}}


def _point_row(m: Median) -> dict[str, Any]:
    row = {f.name: getattr(m, f.name) for f in fields(m) if f.name not in ("labels", "elements")}
    head = {"study": row.pop("study"), "reading": row.pop("reading"), **m.labels}
    return head | {k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()}


def write_tables(folder: Path, runs: list[Run], points: list[Median],
                 omissions: list[Omission]) -> None:
    """Writes runs.csv, points.csv and omissions.csv."""
    ordered = sorted(runs, key=lambda run: (run.study, run.order))
    _write(folder / "runs.csv", [_run_row(run, reading) for run in ordered
                                 for reading in run.errors])
    _write(folder / "points.csv", [_point_row(m) for m in points])
    _write(folder / "omissions.csv", [{"study": o.study, **o.labels, "repetition": o.repetition,
                                       "reason": o.reason} for o in omissions])


def write_references(path: Path, known: dict[str, dict[str, Figures]]) -> None:
    """What readings are held against that no run gave: value, its own error, where it comes from."""
    _write(path, [{"study": study, "reference": name, "value": of, "in_si_units": f"{figure.value:.8g}",
                   "own_error": "" if math.isnan(figure.error) else f"{figure.error:.3g}",
                   "source": figure.source}
                  for study, references in known.items() for name, figures in references.items()
                  for of, figure in figures.items()])


def _first_line(command: list[str]) -> str:
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False,
                              stdin=subprocess.DEVNULL)
    except (OSError, subprocess.TimeoutExpired):
        return "not there"
    return next(iter((done.stdout + done.stderr).strip().splitlines()), "does not say")


def machine(bench: Bench, runs: list[Run]) -> list[str]:
    """Where and with what was measured."""
    loads = sorted(run.load for run in runs)
    said = next((r.summary for r in runs if r.summary), {})
    hardware = said.get("hardware", {})
    codes = {run.labels.get("code", "standalone") for run in runs}
    lines = [
        f"Machine: {hardware.get('processor', 'unknown processor')}, "
        f"{hardware.get('processors', '?')} processors, one of them used, "
        f"{hardware.get('memory_bytes', 0) / 2**30:.0f} GiB; {hardware.get('system', '')}; load "
        f"before a run {loads[len(loads) // 2]:.1f} (median; {loads[0]:.1f} to {loads[-1]:.1f}; the run before it "
        f"is 1 of it); instruction set {said.get('instruction_set', '?')}, "
        f"{said.get('precision', 'double')} precision.",
        f"solidem {said.get('solidem', '?')}, commit {commit()} (program {bench.program})"]
    if "yade" in codes:
        lines.append(f"YADE: {_first_line(['yade', '--version'])}")
    if "liggghts" in codes:
        lines.append("LIGGGHTS-PUBLIC 3.8.0, Debian's library")
    lines.append(f"Python {sys.version.split()[0]}, numpy {np.__version__}; {len(runs)} runs.")
    return lines


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python3 -m benchmarks.accuracy_cost",
                                     description=(__doc__ or "").splitlines()[0])
    known = sorted(path.stem for path in (HERE / "studies").glob("*.toml"))
    parser.add_argument("study", nargs="*",
                        help=f"{', '.join(known)}, or a study file; all if none")
    parser.add_argument("--output", type=Path, default=Path("results/accuracy_cost"))
    parser.add_argument("--scratch", type=Path, help="folder for specimens and runs, kept for "
                        "--resume (default: in the output folder)")
    parser.add_argument("--quick", action="store_true", help="a few small points, once each")
    parser.add_argument("--repetitions", type=int, help="at most so many")
    parser.add_argument("--resume", action="store_true", help="keep what was measured already")
    options = parser.parse_args()
    options.study = [HERE / "studies" / f"{name}.toml" if name in known else Path(name)
                     for name in options.study or known]
    return options


def main() -> int:
    """Measures and writes everything; 1 when a run failed, 2 when nothing could be measured."""
    options = _arguments()
    output: Path = options.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    os.environ.update(OMP_NUM_THREADS="1", OMP_WAIT_POLICY="passive")
    try:
        studies = [read_study(path) for path in options.study]
        bench = Bench((options.scratch or output / "scratch").resolve(), all_codes(),
                      options.resume, lambda words: print(words, flush=True))
    except (StudyError, CodeFailure) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    repetitions = 1 if options.quick else options.repetitions
    runs, omissions = bench.all(studies, options.quick, repetitions)
    points = medians(runs)
    known = bench.all_known(studies)
    write_tables(output, runs, points, omissions)
    write_references(output / "references.csv", known)
    write_page(output, studies, points, omissions, machine(bench, runs), known)
    print(f"{len(runs)} runs, {len(omissions)} gave nothing; {output / 'page.md'}")
    return 2 if not runs else 1 if omissions else 0


if __name__ == "__main__":
    sys.exit(main())
