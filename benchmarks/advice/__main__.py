# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that no study contains: what advice promises, against the limit of other packings, finer than
what is proposed where that is coarse, and what it foretells of time, against the time that the
processor takes.

    python3 -m benchmarks.advice [--scenes heat_ring elastic_hole] [--errors 5% 1%]

advice.csv stands in results/advice_kept/; runs that are there are not made again.
"""

from __future__ import annotations

import argparse
import csv
import os
import re
import sys
from dataclasses import asdict, dataclass, fields
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")  # the processor's time is then that of the work

ROOT = Path(__file__).resolve().parents[2]
SCENES = Path(__file__).with_name("scenes")
sys.path.insert(0, os.environ.get("SOLIDEM_PYTHON", str(ROOT / "build" / "release" / "python")))

import numpy as np  # noqa: E402
from solidem import Scene  # noqa: E402
from solidem.advise import advise, share  # noqa: E402
from solidem.foretold import LIKELY, ErrorModel  # noqa: E402
from solidem.level import Level  # noqa: E402
from solidem.pilots import Pilots  # noqa: E402
from solidem.proposal import Advice, Proposal  # noqa: E402
from solidem.refinement import refinement_of  # noqa: E402
from solidem.series import Series, run_series  # noqa: E402

FINER = 2.0  #: times the elements of what is proposed that a reference has, where that is affordable
APART = 2.5  #: of the levels of a reference, in elements; coarser ones have twice the packings
LEVELS = 5  #: of a reference
STEPS_GROW = 4 / 3  #: power of the elements that the time of steps goes as
OTHERS = 500  #: number of the first packing of a reference: none of those of small runs and series


@dataclass(frozen=True)
class Row:
    """What became of one promise."""

    scene: str
    kind: str
    figure: str
    asked: float
    reachable: bool  #: whether something that is allowed keeps what is asked
    proposed: str  #: "body", or the packings and elements of a series
    promised: float  #: of what is proposed; else of what comes nearest
    expected: float
    elements: int  #: of the finest body of what is proposed
    reference: str  #: packings and elements of the runs whose limit it is
    reference_known: float  #: half of the interval of that limit (95 %), as a share
    error: float
    verdict: str  #: "kept", "broken", or "not told" where the reference may be off by what is too much
    pilot_seconds: float
    foretold_seconds: float  #: of the processor
    taken_seconds: float  #: of the processor
    time_ratio: float
    largest: float  #: elements that were allowed
    longest: float  #: s, that were allowed


def asked_of(path: Path) -> tuple[str, str]:
    """Figure and moment, in the first lines of a scene."""
    text = path.read_text(encoding="utf-8")
    of, at = (re.search(rf"^# {word}: (.*)$", text, re.MULTILINE) for word in ("of", "at"))
    assert of is not None
    return of.group(1), at.group(1) if at else "end"


class Trial:
    """Promises about one scene."""

    def __init__(self, path: Path, folder: Path, given: argparse.Namespace) -> None:
        self.path, self.folder, self.given = path, folder / path.stem, given
        self.of, self.at = asked_of(path)
        self.scene = Scene(path)
        self.refinement = refinement_of(self.scene.tables)
        self.own = sum(body.elements or 0 for body in self.refinement.bodies)

    def pilots(self, folder: str) -> Pilots:
        """Runs of the scene in a folder."""
        return Pilots(self.scene, self.refinement, self.of, self.at, self.folder / folder)

    def rows(self) -> list[Row]:
        """One for each error; all are compared with one reference."""
        found: list[tuple[Advice, Proposal | Series]] = []
        for error in self.given.errors:
            advice = advise(self.scene, error, of=self.of, at=self.at, largest=self.given.largest,
                            seconds=self.given.pilot_seconds, longest=self.given.longest,
                            folder=self.folder / "pilots")
            best = advice.proposed
            if best is None:
                assert advice.least is not None and advice.series is not None
                best = (advice.series if advice.series.promised < advice.least.errors.promised
                        else advice.least)
            found.append((advice, best))
        limit, known, packings = self._reference(found)
        return [self._row(advice, best, limit, known, packings) for advice, best in found]

    def _reference(self, found: list[tuple[Advice, Proposal | Series]]) -> tuple[float, float, str]:
        """Limit of other packings, half of its interval, and what they are."""
        most = max(best.elements if isinstance(best, Proposal) else best.asked()[-1].elements
                   for _, best in found)
        advice, pilots, levels, packings = found[-1][0], self.pilots("reference"), [], []
        finest = min(max(FINER * most, self.given.coarsest_reference), self.given.finest_reference,
                     self._affordable(advice))
        for coarser in range(LEVELS - 1, -1, -1):
            count = self.given.packings * 2**coarser
            runs = [pilots.run(finest / APART**coarser / self.own, advice.choices.changes, OTHERS + packing)
                    for packing in range(count)]
            levels.append(Level(runs[0].elements, 0, np.array([run.figure for run in runs]), 0))
            packings.append(f"{count} × {runs[0].elements}")
        posterior = ErrorModel(levels, advice.scale, advice.study).posterior
        return posterior.limit, posterior.half_width(LIKELY) / advice.scale, ", ".join(packings)

    def _affordable(self, advice: Advice) -> float:
        """Elements of the finest level of a reference that takes no longer than is given for it."""
        last = advice.levels[-1].value
        elements, grown = last, APART**(1 / 4)

        def taken(finest: float) -> float:
            return sum(self.given.packings * 2**coarser * advice.costs[-1].times(
                finest / APART**coarser / last, STEPS_GROW).processor for coarser in range(LEVELS))

        while taken(grown * elements) <= self.given.reference_seconds:
            elements *= grown
        return elements

    def _row(self, advice: Advice, best: Proposal | Series, limit: float, known: float,
             packings: str) -> Row:
        reachable = advice.proposed is not None
        if isinstance(best, Series):
            assert advice.model is not None
            told = run_series(self.pilots("pilots"), best, advice.model, advice.error)
            figure, taken, foretold = told.figure, told.processor, best.processor
            parts = [part for part in best.asked()]
            proposed = ", ".join(f"{part.packings} × {part.elements:.0f}" for part in parts)
            elements, promised, expected = int(parts[-1].elements), best.promised, best.expected
        else:
            # Another packing than any of the small runs.
            run = self.pilots("runs").run(best.elements / self.own, {**advice.choices.changes, **{
                key: value for key, value in best.changes.items() if key == "conduction.every"}}, 30)
            figure, taken, foretold = run.figure, run.cost.processor, best.cost.processor
            proposed, elements = "body", run.elements
            promised, expected = best.errors.promised, best.errors.expected
        promised = advice.error if reachable else promised
        error = abs(figure - limit) / advice.scale
        verdict = ("kept" if error <= promised else "broken" if error - known > promised else "not told")
        return Row(self.path.stem, advice.kind, self.of, advice.error, reachable, proposed, promised,
                   expected, elements, packings, known, error, verdict, advice.pilot_seconds,
                   foretold, taken, taken / foretold if foretold else 1.0, self.given.largest,
                   self.given.longest)


def told(row: Row) -> str:
    """For a person to read."""
    promise = f"{100 * row.promised:.2g} %" + ("" if row.reachable else " (all that it can)")
    what = f"{row.elements} elements" if row.proposed == "body" else row.proposed
    return (f"{row.scene}, {100 * row.asked:g} %: {what}, promised {promise}, error "
            f"{100 * row.error:.2g} % ± {100 * row.reference_known:.2g} % {row.verdict}; foretold "
            f"{row.foretold_seconds:.2g} s, took {row.taken_seconds:.2g} s (× {row.time_ratio:.2f})")


def write(rows: list[Row], path: Path) -> None:
    """A CSV."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, [field.name for field in fields(Row)], lineterminator="\n")
        table.writeheader()
        table.writerows({key: f"{value:.4g}" if isinstance(value, float) else value
                         for key, value in asdict(row).items()} for row in rows)


def main() -> int:
    """1: a promise was broken."""
    parser = argparse.ArgumentParser(description=__doc__)
    known = sorted(path.stem for path in SCENES.glob("*.toml"))
    parser.add_argument("--scenes", nargs="+", choices=known, default=known)
    parser.add_argument("--errors", nargs="+", type=share, default=[0.05, 0.01])
    parser.add_argument("--largest", type=float, default=80_000, help="elements that may be proposed")
    parser.add_argument("--longest", type=float, default=180, help="s, that what is proposed may take")
    parser.add_argument("--pilot-seconds", type=float, default=20)
    parser.add_argument("--packings", type=int, default=3, help="of the finest level of a reference")
    parser.add_argument("--coarsest-reference", type=float, default=12_000, metavar="ELEMENTS")
    parser.add_argument("--finest-reference", type=float, default=80_000, metavar="ELEMENTS")
    parser.add_argument("--reference-seconds", type=float, default=240, help="of the processor, that the runs "
                        "of a reference may take, about")
    parser.add_argument("--folder", type=Path, default=ROOT / "results" / "advice_kept")
    given = parser.parse_args()
    rows: list[Row] = []
    given.folder.mkdir(parents=True, exist_ok=True)
    for name in given.scenes:
        for row in Trial(SCENES / f"{name}.toml", given.folder, given).rows():
            rows.append(row)
            print(told(row), flush=True)
        write(rows, given.folder / "advice.csv")
    # Where nothing that is allowed keeps either error, both rows are about what comes nearest.
    each = list({(row.scene, row.promised, row.error): row for row in rows}.values())
    kept, broken = (sum(row.verdict == verdict for row in each) for verdict in ("kept", "broken"))
    near = sum(1 / 1.5 <= row.time_ratio <= 1.5 for row in each)
    print(f"{kept} of {len(each)} promises kept, {broken} broken; time within a factor 1.5 in {near}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
