# SPDX-License-Identifier: GPL-2.0-or-later
"""From cases to rows: runs what a case needs and holds every check against its tolerance."""

from __future__ import annotations

from pathlib import Path

from compare import beam_modes  # noqa: F401  (makes its measures known)
from compare.case import Case, CaseError, Check, Variant, read_case
from compare.codes.base import Code
from compare.measures import MEASURES
from compare.result import CodeFailure
from compare.row import Row, RunLine
from compare.runs import CaseRuns, Say, View


def _rows(runs: CaseRuns, check: Check) -> list[Row]:
    variants = runs.case.variants_of(check)
    # A slope is one figure of all variants.
    return [_row(runs, check, v) for v in (variants[:1] if check.measure == "slope" else variants)]


def _row(runs: CaseRuns, check: Check, variant: Variant) -> Row:
    factor = variant.values.get(check.tolerance_times, 1.0)
    name = "all" if check.measure == "slope" else variant.name
    row = Row(runs.case.name, name, check.quantity, check.label, check.code, check.reference,
              None, check.tolerance * factor, None, "", check.reason)
    try:
        if check.measure not in MEASURES:
            raise CodeFailure(f"no measure is called {check.measure!r}; known: "
                              f"{', '.join(sorted(MEASURES))}")
        view = View(runs, check, variant)
        found = MEASURES[check.measure](view)
        row.error, row.note, row.plot = float(found.error), found.note, found.plot
        if runs.case.scene is not None:
            row.wall_seconds = view.tested.wall_seconds
    except CodeFailure as failure:
        row.note = str(failure)
    # A measure that breaks on what it was given has not shown agreement.
    except Exception as error:  # noqa: BLE001
        row.note = f"{type(error).__name__}: {error}"
    return row


def run_case(case: Case, codes: dict[str, Code], directory: Path,
             say: Say = print) -> tuple[list[Row], list[RunLine]]:
    """Runs a case; every check gives at least one row, whatever happens."""
    say(f"{case.name}: {case.title}")
    runs = CaseRuns(case, codes, directory, say)
    rows = [row for check in case.checks for row in _rows(runs, check)]
    return rows, runs.lines()


def run_cases(paths: dict[str, Path], codes: dict[str, Code], directory: Path,
              say: Say = print) -> tuple[list[Row], list[RunLine]]:
    """Runs case files; one that cannot be read is a failing row."""
    rows: list[Row] = []
    lines: list[RunLine] = []
    for name, path in paths.items():
        try:
            case = read_case(path)
        except (CaseError, TypeError, ValueError) as error:
            rows.append(Row(name, "", "case file", "R", "", "", None, 0, None, str(error), ""))
            continue
        found, ran = run_case(case, codes, directory / name, say)
        rows += found
        lines += ran
    return rows, lines
