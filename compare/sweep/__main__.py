# SPDX-License-Identifier: GPL-2.0-or-later
"""python3 -m compare.sweep NAME...: runs parameter sweeps and says what came of them."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import time
from pathlib import Path
from typing import Sequence

from compare.codes.standalone import Standalone
from compare.sweep import report
from compare.sweep.results import groups, judge, read_point, table
from compare.sweep.runner import Runner
from compare.sweep.sweep import SWEEPS, SweepError, find_sweeps, read_sweep


def _arguments(words: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="compare.sweep", description="Runs parameter sweeps, several runs side by side. Runs "
        "that are there and were made of the same scene by the same program are not made again. "
        "Exit status 0 when every run gave a result and every check passed.")
    parser.add_argument("sweeps", nargs="*", help="names of sweeps; none: lists them")
    parser.add_argument("--quick", action="store_true", help="small bodies, one specimen")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1,
                        help="runs at a time, each with one thread (default: one a processor)")
    parser.add_argument("--any-program", action="store_true",
                        help="accept results that another build of the program has made")
    parser.add_argument("--output", type=Path, default=Path("results/sweeps"),
                        help="directory of the results (results/sweeps)")
    parser.add_argument("--sweep-directory", type=Path, default=SWEEPS,
                        help="where sweep files are")
    return parser.parse_args(words)


def run_sweep(path: Path, program: Path, arguments: argparse.Namespace) -> bool:
    """Runs one sweep, prints and writes its results; whether all is well."""
    sweep = read_sweep(path, arguments.quick)
    folder = arguments.output.resolve() / (sweep.name + ("_quick" if arguments.quick else ""))
    print(f"{sweep.title}: {len(sweep.points)} points", flush=True)
    start = time.perf_counter()
    runner = Runner(program, folder, arguments.jobs, arguments.any_program,
                    lambda text: print(text, flush=True))
    outcomes = runner.run(sweep.points)
    readings = [read_point(sweep, outcome) for outcome in outcomes if outcome.folder is not None]
    found = groups(sweep, readings)
    verdicts = [judge(sweep, check, found) for check in sweep.checks]
    written = report.write(sweep, found, verdicts, readings, folder)
    print("\n" + report.terminal(table(sweep, found)))
    if verdicts:
        print("\n" + report.terminal(report.verdict_rows(sweep, verdicts)))
    failures = sum(outcome.folder is None for outcome in outcomes)
    print(f"\n{time.perf_counter() - start:.0f} s; {failures} of {len(outcomes)} points failed; "
          f"{written[0]} and beside it\n")
    return failures == 0 and all(verdict.passed for verdict in verdicts)


def main(words: Sequence[str] | None = None, program: Path | None = None) -> int:
    """Runs the sweeps; returns the exit status."""
    arguments = _arguments(words)
    paths = find_sweeps(arguments.sweep_directory)
    if not arguments.sweeps:
        for name, path in paths.items():
            try:
                print(f"{name:24} {read_sweep(path).title}")
            except SweepError as error:
                print(f"{name:24} cannot be read: {error}")
        return 0
    if unknown := [name for name in arguments.sweeps if name not in paths]:
        print(f"no sweep {unknown[0]!r}; there are: {', '.join(paths)}", file=sys.stderr)
        return 2
    standalone = Standalone() if program is None else Standalone(program=program)
    if reason := standalone.missing():
        print(reason, file=sys.stderr)
        return 2
    # An end from outside is an interrupt, too: runs write their checkpoints. Ctrl-C is one also where
    # the shell that started this had it ignored, which Python would leave so.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    try:
        results = [run_sweep(paths[name], standalone.program, arguments)
                   for name in arguments.sweeps]
    except SweepError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted; the same command goes on", file=sys.stderr)
        return 130
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
