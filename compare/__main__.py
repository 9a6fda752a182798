# SPDX-License-Identifier: GPL-2.0-or-later
"""python3 -m compare [cases...]: runs cases in several codes and writes the verification table."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import Sequence

from compare import page, table
from compare.case import Case, CaseError, find_cases, read_case
from compare.codes import all_codes
from compare.codes.base import Code
from compare.evaluate import run_cases
from compare.provenance import provenance

CASES = Path(__file__).parent / "cases"


def _arguments(words: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="compare", description="Runs cases in several codes and says where they agree. "
        "Exit status 0 only when every check passed.")
    parser.add_argument("cases", nargs="*", help="names of cases; default: all but the long ones")
    parser.add_argument("--long", action="store_true", help="the long cases too")
    parser.add_argument("--list", action="store_true", help="list the cases and the codes")
    parser.add_argument("--output", type=Path, default=Path("results/compare"),
                        help="directory of the results (results/compare)")
    parser.add_argument("--case-directory", type=Path, default=CASES, help="where case files are")
    return parser.parse_args(words)


def _read(paths: dict[str, Path]) -> dict[str, Case]:
    """The cases that can be read; the others fail when they are run."""
    cases = {}
    for name, path in paths.items():
        try:
            cases[name] = read_case(path)
        except (CaseError, TypeError, ValueError):
            pass
    return cases


def _list(paths: dict[str, Path], codes: dict[str, Code]) -> None:
    cases = _read(paths)
    for name in paths:
        case = cases.get(name)
        words = "cannot be read" if case is None else case.title + (" (long)" * case.long)
        print(f"{name:24} {words}")
    print()
    for name, code in codes.items():
        print(f"{name:24} {code.missing() or 'ready'}")


def main(words: Sequence[str] | None = None, codes: dict[str, Code] | None = None) -> int:
    """Runs the harness; returns the exit status."""
    arguments = _arguments(words)
    codes = all_codes() if codes is None else codes
    paths = find_cases(arguments.case_directory)
    if arguments.list:
        _list(paths, codes)
        return 0
    if unknown := [name for name in arguments.cases if name not in paths]:
        print(f"no case {unknown[0]!r}; there are: {', '.join(paths)}", file=sys.stderr)
        return 2
    cases = _read(paths)
    chosen = {name: path for name, path in paths.items() if name in arguments.cases or (
        not arguments.cases and (arguments.long or name not in cases or not cases[name].long))}
    start = time.perf_counter()
    output = arguments.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    rows, lines = run_cases(chosen, codes, output / "runs",
                            lambda text: print(text, flush=True))
    print("\n" + table.terminal(rows, lines))
    made = provenance(rows, codes)
    table.write(rows, lines, made, output)
    written = page.write(rows, lines, {n: (c.title, c.about) for n, c in cases.items()}, made, output)
    print(f"{time.perf_counter() - start:.0f} s; tables and plots: {written}")
    return 0 if rows and all(row.passed for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
