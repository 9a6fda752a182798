# SPDX-License-Identifier: GPL-2.0-or-later
"""Every figure of docs/accuracy_cost.md and of the pages behind it: studies, effects, advice, pages.

    /usr/bin/python3 -m benchmarks.accuracy_cost.everything

Goes on where it was stopped: runs that the very program has made are not made again, nor are effects and
advice whose tables are younger than the program.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

from benchmarks.accuracy_cost.front_page import DOCS, ROOT, STUDIES
from benchmarks.accuracy_cost.study import Study, read_study
from compare.codes.standalone import Standalone

#: Kinds of studies that have a page of their own; all others share MECHANICS.
PAGES = {"heat": "heat", "central forces": "central_forces"}
MECHANICS = "mechanics"
TABLES = ("points.csv", "runs.csv", "references.csv")


def page_of(study: Study) -> str:
    """Folder below docs/accuracy_cost."""
    return PAGES.get(study.kind, MECHANICS)


def pages() -> dict[str, list[str]]:
    """Folder -> its studies."""
    found: dict[str, list[str]] = {}
    for path in sorted(STUDIES.glob("*.toml")):
        found.setdefault(page_of(read_study(path)), []).append(path.stem)
    return found


def ran(words: list[str]) -> None:
    """A command of this Python, in the root; SystemExit where it gave nothing."""
    done = subprocess.run([sys.executable, "-m", *words], cwd=ROOT, check=False).returncode
    if done > 1:
        raise SystemExit(f"python3 -m {' '.join(words)} ended with status {done}")


def collect(folder: Path, page: Path) -> None:
    """Page, pictures and tables of studies into docs."""
    shutil.rmtree(page, ignore_errors=True)
    page.mkdir(parents=True)
    for path in sorted(folder.iterdir()):
        if path.name in TABLES or path.suffix in (".md", ".png"):
            shutil.copy(path, page)


def is_fresh(table: Path) -> bool:
    """Whether it is younger than the program."""
    return table.exists() and table.stat().st_mtime > Standalone().program.stat().st_mtime


def main() -> int:
    """The exit status of the front page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--results", type=Path, default=ROOT / "results" / "accuracy_cost",
                        help="what is kept of runs (default: results/accuracy_cost)")
    parser.add_argument("--repetitions", type=int, help="at most so many of each point")
    given = parser.parse_args()
    results: Path = given.results.resolve()
    fewer = ["--repetitions", str(given.repetitions)] if given.repetitions else []
    for name, studies in pages().items():
        ran(["benchmarks.accuracy_cost", *studies, "--resume", "--output", str(results / name), *fewer])
        collect(results / name, DOCS / name)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    for name, words in (("effects", ["--steps", "3000", "--rounds", "7", "--liggghts", "--liggghts-steps", "100"]),
                        ("advice", [])):
        table = results / name / f"{name}.csv"
        if not is_fresh(table):
            ran([f"benchmarks.{name}", "--folder", str(results / name), *words])
        shutil.copy(table, DOCS)
    return subprocess.run([sys.executable, "-m", "benchmarks.accuracy_cost.front_page"], cwd=ROOT,
                          check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
