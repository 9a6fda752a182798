# SPDX-License-Identifier: GPL-2.0-or-later
"""The pin plunge of Terreros 2013 (figure 4.12): a threaded pin goes half a millimetre into a plate
of aluminium at 1000 rev/min and .25 m/s, smooth and rubbing.

    /usr/bin/python3 -m benchmarks.pin_plunge [--elements 20000] [--factor 6400] [--ratio 0.5]
        [--study 2600] [--threads 2] [--output results/pin_plunge]

Bonds are calibrated first, then the plate of the given size is run, smooth and rubbing, with a time
step of `--ratio` of the stable one, and a smaller one with other factors of mass, time steps and
packings, which tells what the factor and the step err by. Runs that
were finished are kept, those that were stopped go on from their checkpoint. Needs the Python module.
In the folder: books.csv (a line for each run), force_depth.png, temperature.png, plunge.gif, and a
folder for each run.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [os.environ.get("SOLIDEM_PYTHON", str(ROOT / "build/release/python"))]
from . import pictures  # noqa: E402
from .books import Books, books_of, write_books  # noqa: E402
from .scene import CALIBRATION, Case  # noqa: E402

PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))


def solidem(folder: Path, *words: str) -> None:
    """Runs it in the folder; ends where it fails."""
    if subprocess.run([PROGRAM, *words], check=False, cwd=folder).returncode:
        raise SystemExit(f"solidem {' '.join(words)}: failed")


def seconds_of_children() -> float:
    """Processor time of all programs that were run up to now."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def calibrated(folder: Path, threads: int) -> str:
    """Beams and flow of the aluminium, found once."""
    found = folder / "calibration" / "calibrated.toml"
    if not found.exists():
        (folder / "calibration.toml").write_text(CALIBRATION)
        solidem(folder, "calibrate", "calibration.toml", "-o", "calibration", "-t", str(threads))
    return found.read_text()


def finished(case: Case, folder: Path, beams: str, threads: int) -> Path:
    """The folder of its run, which is made, or ended, where that is still to be done."""
    results, scene = folder / case.name, folder / f"{case.name}.toml"
    if not scene.exists() or scene.read_text() != case.text(beams):
        scene.write_text(case.text(beams))
        (results / "processor_seconds").unlink(missing_ok=True)
        how = "--overwrite"
    elif (results / "processor_seconds").exists():
        return results
    else:
        how = "--resume" if (results / "checkpoint.h5").exists() else "--overwrite"
    print(f"{case.name} ({how})", flush=True)
    before = seconds_of_children()
    solidem(folder, "run", scene.name, "-o", case.name, "-t", str(threads), how)
    (results / "processor_seconds").write_text(f"{seconds_of_children() - before:.1f}")
    return results


def cases(elements: int, factor: float, ratio: float, study: int) -> list[Case]:
    """The two that count, then those that tell how far they can be trusted."""
    large = [Case(elements, factor, rubs=rubs, ratio=ratio) for rubs in (False, True)]
    lighter = [Case(study, factor / change, frames=10) for change in (1, 4, 16)]
    finer = [Case(study, factor, rubs=rubs, ratio=fine, frames=10)
             for rubs in (False, True) for fine in (0.5, 0.25, 0.125, 0.1)]
    return [*large, *lighter, *finer[1:],  # the first is one of the lighter
            *(Case(study, factor, seed=seed, frames=10) for seed in (2, 3))]


def line(row: Books) -> str:
    """Of the table."""
    kind = "rubbing" if row.rubs else "smooth"
    return (f"| {row.elements} {kind}, packing {row.seed} | {row.factor:g} | {row.ratio:g} | "
            f"{row.steps} | {row.processor_seconds:.0f} | {row.force_half / 1e3:.2f} | "
            f"{row.force / 1e3:.2f} | {row.work:.3f} | {100 * row.kinetic:.3f} | "
            f"{row.mean_rise:.2f} | {row.hottest:.0f} | {row.energy_gap:.1e} | {row.heat_gap:.0e} | "
            f"{row.broken} | {row.formed} | {row.loose} | {row.strays} |")


HEAD = ("| plate | s² | step ratio | steps | processor, s | force at .25 mm, kN | at .5 mm | "
        "work, J | in motion, % | mean rise, K | hottest 1 %, K | energy gap | heat gap | broken | "
        "formed | loose | strays |\n|" + "---|" * 17)


def main() -> None:
    """Runs what is to be run, and tells."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--elements", type=int, default=20000)
    parser.add_argument("--factor", type=float, default=6400, help="of the masses")
    parser.add_argument("--ratio", type=float, default=0.5, help="time step over the stable one")
    parser.add_argument("--study", type=int, default=2600, help="elements of the smaller plate")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "pin_plunge")
    words = parser.parse_args()
    folder = words.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    beams = calibrated(folder, words.threads)
    rows, folders = [], {}
    print(HEAD)
    for case in cases(words.elements, words.factor, words.ratio, words.study):
        folders[case] = finished(case, folder, beams, words.threads)
        rows.append(books_of(case, folders[case]))
        print(line(rows[-1]), flush=True)
        write_books(rows, folder / "books.csv")
    pictures.force_over_depth(pictures.labelled(folders, words.factor, words.ratio),
                              folder / "force_depth.png")
    large = pictures.largest(folders)
    pictures.warm_plates(large, folder / "temperature.png")
    pictures.film(large[0], folder / "plunge.gif")


if __name__ == "__main__":
    main()
