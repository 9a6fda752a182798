# SPDX-License-Identifier: GPL-2.0-or-later
"""The verification table for the terminal, as Markdown and as JSON."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from compare.provenance import Provenance
from compare.row import Row, RunLine

HEADER = ("case", "variant", "quantity", "class", "code", "reference", "law", "error", "tolerance", "",
          "time/s")
RUN_HEADER = ("case", "variant", "code", "elements", "bonds", "steps", "time/s", "ns/bond-step")


def number(value: float | None) -> str:
    """Three digits, a dash for none."""
    return "–" if value is None else f"{value:.3g}"


def cells(row: Row) -> tuple[str, ...]:
    """What the table shows of a row."""
    return (row.case, row.variant, row.quantity, row.label, row.code, row.reference, row.law,
            number(row.error), number(row.tolerance), "pass" if row.passed else "FAIL",
            number(row.wall_seconds))


CLASSES = "Class: A analytic, P published, C other code, R regression."
LAW = ("Law of class C: independent, or shared where both codes compute it by the same source, so that "
       "geometry, sums and integration alone are compared.")


def matrix(rows: list[Row], codes: list[str]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Cases by codes: header, and for each case how many of the checks that look at a code passed."""
    named = {name for row in rows for name in (row.code, row.reference)}
    known = [code for code in codes if code in named]
    lines = []
    for case in dict.fromkeys(row.case for row in rows):
        cells_of_case = []
        for code in known:
            passed = [row.passed for row in rows
                      if row.case == case and code in (row.code, row.reference)]
            cells_of_case.append(f"{sum(passed)}/{len(passed)}" if passed else "")
        lines.append((case, *cells_of_case))
    return ("case", *known), lines


def run_cells(line: RunLine) -> tuple[str, ...]:
    """What the table of runs shows of a run."""
    return (line.case, line.variant, line.code, str(line.elements), str(line.bonds),
            str(line.steps), number(line.wall_seconds), number(line.nanoseconds_per_bond_step))


def _aligned(header: tuple[str, ...], lines: list[tuple[str, ...]]) -> str:
    widths = [max(len(line[k]) for line in [header, *lines]) for k in range(len(header))]
    return "\n".join("  ".join(word.ljust(width) for word, width in zip(line, widths)).rstrip()
                     for line in [header, tuple("-" * w for w in widths), *lines])


def _markdown(header: tuple[str, ...], lines: list[tuple[str, ...]]) -> str:
    def escaped(line: tuple[str, ...]) -> str:
        return "| " + " | ".join(word.replace("|", "\\|") for word in line) + " |"

    return "\n".join([escaped(header), "|" + "---|" * len(header), *map(escaped, lines)])


def verdict(rows: list[Row]) -> str:
    """One sentence."""
    failed = sum(not row.passed for row in rows)
    if not rows:
        return "No check was made: that is a failure."
    return f"{len(rows) - failed} of {len(rows)} checks passed" + (
        f", {failed} FAILED." if failed else ".")


def failures(rows: list[Row]) -> list[str]:
    """A sentence for each row that failed."""
    return [f"FAIL {row.case} / {row.variant}: {row.quantity} ({row.code}): " + (
        row.note if row.error is None else f"{row.error:.3g} > {row.tolerance:.3g}; {row.reason}")
        for row in rows if not row.passed]


def terminal(rows: list[Row], lines: list[RunLine]) -> str:
    """The tables in aligned columns, failures last."""
    parts = [_aligned(HEADER, [cells(row) for row in rows])]
    if lines:
        parts.append(_aligned(RUN_HEADER, [run_cells(line) for line in lines]))
    return "\n\n".join([*parts, "\n".join([*failures(rows), verdict(rows)])])


def markdown(rows: list[Row], lines: list[RunLine], made: Provenance) -> str:
    """The tables as a Markdown page."""
    parts = ["# Verification", verdict(rows), "\n".join(f"- {words}" for words in made.lines()),
             _markdown(*matrix(rows, list(made.versions))), CLASSES, LAW,
             _markdown(HEADER, [cells(row) for row in rows])]
    parts += ["\n".join(f"- {words}" for words in failures(rows))] if failures(rows) else []
    if lines:
        parts += ["## Runs", _markdown(RUN_HEADER, [run_cells(line) for line in lines])]
    return "\n\n".join(parts) + "\n"


def write(rows: list[Row], lines: list[RunLine], made: Provenance, directory: Path) -> None:
    """Writes table.md and table.json."""
    (directory / "table.md").write_text(markdown(rows, lines, made))
    plain = [{**{k: v for k, v in vars(row).items() if k != "plot"}, "passed": row.passed}
             for row in rows]
    (directory / "table.json").write_text(json.dumps(
        {"made": asdict(made), "rows": plain, "runs": [asdict(line) for line in lines]}, indent=1) + "\n")
