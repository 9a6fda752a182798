# SPDX-License-Identifier: GPL-2.0-or-later
"""From cases to rows: runs what a case needs and holds every check against its tolerance."""

from __future__ import annotations

from pathlib import Path

# Imported so that their measures are known.
from compare import (beam_modes, beam_yield, central, cyclic, heat_measures,  # noqa: F401
                     slender_beams, stress_measures, tension)
from compare.case import Case, CaseError, Check, Variant, read_case
from compare.codes.base import Code
from compare.measures import MEASURES
from compare.result import CodeFailure
from compare.row import Row, RunLine
from compare.runs import CaseRuns, Say, Specimens, View


def _needed(case: Case, codes: dict[str, Code]) -> list[tuple[str, str]]:
    """Variants and codes that the checks of a case look at."""
    return [(v.name, code) for check in case.checks for v in case.variants_of(check)
            for code in (check.code, check.reference) if code in codes and code in v.codes]


def _law(runs: CaseRuns, check: Check, variant: Variant) -> str:
    """Whether two codes compute a law by the same source."""
    if check.reference not in runs.codes:
        return "independent"
    parameters = runs.job(variant.name).parameters if runs.case.scene else None
    both = all(runs.code(name).shares_laws(parameters) for name in (check.code, check.reference))
    return "shared" if both else "independent"


def _row(runs: CaseRuns, check: Check, group: list[Variant]) -> Row:
    variant = group[0]
    factor = variant.values[check.tolerance_times] if check.tolerance_times else 1.0
    name = variant.name_over(check.over, group) if check.over else variant.name
    row = Row(runs.case.name, name, check.quantity, check.label, check.code, check.reference,
              None, check.tolerance * factor, None, "", check.reason)
    try:
        if check.measure not in MEASURES:
            raise CodeFailure(f"no measure is called {check.measure!r}; known: "
                              f"{', '.join(sorted(MEASURES))}")
        view = View(runs, check, variant, tuple(group))
        if check.label == "C":
            row.law = _law(runs, check, variant)
        found = MEASURES[check.measure](view)
        row.error, row.note, row.plot = float(found.error), found.note, found.plot
        if row.plot:
            row.plot.figure = check.options.get("figure", "")
        if runs.case.scene is not None and runs.case.timed:
            row.wall_seconds = view.tested.wall_seconds
    except CodeFailure as failure:
        row.note = str(failure)
    # A measure that breaks on what it was given has not shown agreement.
    except Exception as error:  # noqa: BLE001
        row.note = f"{type(error).__name__}: {error}"
    return row


def run_case(case: Case, codes: dict[str, Code], directory: Path, specimens: Specimens,
             say: Say = print) -> tuple[list[Row], list[RunLine]]:
    """Runs a case; every check gives at least one row, whatever happens."""
    say(f"{case.name}: {case.title}")
    runs = CaseRuns(case, codes, directory, specimens, say)
    if not case.timed:
        runs.run_ahead(_needed(case, codes))
    rows = [_row(runs, check, group) for check in case.checks for group in case.groups_of(check)]
    return rows, runs.lines()


def run_cases(paths: dict[str, Path], codes: dict[str, Code], directory: Path,
              say: Say = print) -> tuple[list[Row], list[RunLine]]:
    """Runs case files; one that cannot be read is a failing row."""
    rows: list[Row] = []
    lines: list[RunLine] = []
    specimens = Specimens(directory / "specimens")
    for name, path in paths.items():
        try:
            case = read_case(path)
        except (CaseError, TypeError, ValueError) as error:
            rows.append(Row(name, "", "case file", "R", "", "", None, 0, None, str(error), ""))
            continue
        found, ran = run_case(case, codes, directory / name, specimens, say)
        rows += found
        lines += ran
    return rows, lines
