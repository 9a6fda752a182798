# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that no study contains: what advice promises, against much finer runs, and what it foretells
of time, against the time that the processor takes.

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
from solidem.advise import Advice, Proposal, advise, share  # noqa: E402
from solidem.pilots import Pilots  # noqa: E402
from solidem.refinement import refinement_of  # noqa: E402

FINER = 2.0  #: times the elements of what is proposed that a reference has at least


@dataclass(frozen=True)
class Row:
    """What became of one promise."""

    scene: str
    kind: str
    figure: str
    asked: float
    reachable: bool  #: whether a body keeps what is asked
    promised: float  #: of the body that is proposed; else of the largest
    expected: float
    elements: int
    reference_elements: int
    reference_packings: int
    reference_spread: float  #: standard deviation of the reference's mean, as a share
    error: float
    kept: bool
    pilot_seconds: float
    foretold_seconds: float  #: of the processor
    taken_seconds: float  #: of the processor
    time_ratio: float


def asked_of(path: Path) -> tuple[str, str]:
    """Figure and moment, in the first lines of a scene."""
    text = path.read_text(encoding="utf-8")
    of, at = (re.search(rf"^# {word}: (.*)$", text, re.MULTILINE) for word in ("of", "at"))
    assert of is not None
    return of.group(1), at.group(1) if at else "end"


class Trial:
    """Promises about one scene."""

    def __init__(self, path: Path, folder: Path, largest: float, seconds: float, packings: int) -> None:
        self.path, self.folder = path, folder / path.stem
        self.largest, self.seconds, self.packings = largest, seconds, packings
        self.of, self.at = asked_of(path)
        self.scene = Scene(path)

    def rows(self, errors: list[float]) -> list[Row]:
        """One for each error; all are compared with one reference, finer than any proposal."""
        found: list[tuple[Advice, Proposal]] = []
        for error in errors:
            advice = advise(self.scene, error, of=self.of, at=self.at, largest=self.largest,
                            seconds=self.seconds, folder=self.folder / "pilots")
            best = advice.proposal or advice.least
            assert best is not None
            found.append((advice, best))
        most = max(best.elements for _, best in found)
        own = sum(body.elements or 0 for body in refinement_of(self.scene.tables).bodies)
        pilots = Pilots(self.scene, refinement_of(self.scene.tables), self.of, self.at,
                        self.folder / "runs")
        finest = found[-1][0].choices.changes
        reference = [pilots.run(FINER * most / own, finest, packing + 50)
                     for packing in range(self.packings)]
        figures = np.array([run.figure for run in reference])
        return [self._row(advice, best, pilots, own, figures, reference[0].elements)
                for advice, best in found]

    def _row(self, advice: Advice, best: Proposal, pilots: Pilots, own: int, figures: np.ndarray,
             reference_elements: int) -> Row:
        # Another packing than any of the small runs.
        run = pilots.run(best.elements / own, {**advice.choices.changes, **{
            key: value for key, value in best.changes.items() if key == "conduction.every"}}, 30)
        error = abs(run.figure - float(figures.mean())) / advice.scale
        spread = float(figures.std(ddof=1) / np.sqrt(len(figures))) if len(figures) > 1 else 0.0
        promised = advice.error if advice.proposal else best.errors.promised
        return Row(self.path.stem, advice.kind, self.of, advice.error, advice.proposal is not None,
                   promised, best.errors.expected, run.elements, reference_elements, len(figures),
                   spread / advice.scale, error, error <= promised, advice.pilot_seconds,
                   best.cost.processor, run.cost.processor, run.cost.processor / best.cost.processor)


def told(row: Row) -> str:
    """For a person to read."""
    promise = f"{100 * row.promised:.2g} %" + ("" if row.reachable else " (all that it can)")
    return (f"{row.scene}, {100 * row.asked:g} %: {row.elements} elements, promised {promise}, error "
            f"{100 * row.error:.2g} % {'kept' if row.kept else 'BROKEN'}; foretold "
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
    parser.add_argument("--largest", type=float, default=20_000, help="elements that may be proposed")
    parser.add_argument("--pilot-seconds", type=float, default=20)
    parser.add_argument("--packings", type=int, default=2, help="of a reference")
    parser.add_argument("--folder", type=Path, default=ROOT / "results" / "advice_kept")
    given = parser.parse_args()
    rows: list[Row] = []
    given.folder.mkdir(parents=True, exist_ok=True)
    for name in given.scenes:
        trial = Trial(SCENES / f"{name}.toml", given.folder, given.largest, given.pilot_seconds,
                      given.packings)
        for row in trial.rows(given.errors):
            rows.append(row)
            print(told(row), flush=True)
        write(rows, given.folder / "advice.csv")
    # Where no body that is allowed keeps either error, both rows are about the largest one.
    each = list({(row.scene, row.promised, row.error): row for row in rows}.values())
    kept = sum(row.kept for row in each)
    near = sum(1 / 1.5 <= row.time_ratio <= 1.5 for row in each)
    print(f"{kept} of {len(each)} promises kept; time within a factor 1.5 in {near}")
    return 0 if kept == len(each) else 1


if __name__ == "__main__":
    sys.exit(main())
