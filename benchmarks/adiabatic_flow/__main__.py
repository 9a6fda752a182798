# SPDX-License-Identifier: GPL-2.0-or-later
"""How warm aluminium (AA6082) gets by its own plastic work: ten rows of Terreros 2013, table 4.1, by
blocks of elements, by the law alone in one point, and measured.

    /usr/bin/python3 -m benchmarks.adiabatic_flow [--elements 2000] [--load compression] [--section ends]
        [--beams FOLDER] [--workers 2] [--steps] [--output results/adiabatic_flow]

Bonds are calibrated to the curve of Johnson and Cook first, slow and cold; then blocks of three packings are
compressed, or pulled, at the rates and temperatures of the table, with and without what rate and
temperature do to the law. Writes tables in Markdown, seconds included, and in the folder rises.csv,
rises.png and stresses.png (table 4.1, figures 4.3 and 4.4 of the source drawn anew), and what was calibrated
(beams_N.toml, which `--beams` takes). `--steps` loads one packing by other time steps and with other masses
instead, and writes steps.csv.
"""

from __future__ import annotations

import argparse
import csv
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Callable

import numpy as np

from . import pictures
from .blocks import BODY, ROOT, SEEDS, Flow, calibrated, loaded, scene, without_softening
from .law import TESTS, energies_alone, law_alone

#: Time step over the stable one, and factor of the masses.
STEPS = [(ratio, 1.0) for ratio in (0.1, 0.3, 0.5, 0.7, 0.9)] + [(0.5, 4.0), (0.5, 16.0), (0.5, 64.0)]


def all_flows(folder: Path, elements: int, beams: list[str], load: str,
              workers: int) -> dict[tuple[str, int, int], Flow]:
    """Every test of every packing, with the whole law and with its hardening alone."""
    kinds: tuple[tuple[str, Callable[[str], str]], ...] = (("law", str), ("hard", without_softening))
    with ThreadPoolExecutor(workers) as pool:
        jobs = {(kind, t, seed): pool.submit(
                    loaded, folder, f"{kind}_{t}_{seed}",
                    scene(BODY, elements=elements, seed=seed) + change(own), test, load)
                for kind, change in kinds for t, test in enumerate(TESTS)
                for seed, own in zip(SEEDS, beams)}
        return {key: job.result() for key, job in jobs.items()}


def rises_of(found: dict[tuple[str, int, int], Flow], kind: str) -> Any:
    """(packings, 10) rises, K."""
    return np.array([np.concatenate([found[kind, t, seed].rises for t in range(len(TESTS))])
                     for seed in SEEDS])


def root_mean_square(found: Any, measured: Any) -> float:
    """Of the difference, K."""
    return float(np.sqrt(np.mean((found - measured) ** 2)))


def tell_rises(bodies: Any, hard: Any, path: Path) -> None:
    """The table in Markdown, and as CSV."""
    measured, thesis = (np.concatenate([getattr(test, name) for test in TESTS])
                        for name in ("measured", "thesis"))
    alone = np.concatenate([law_alone(test) for test in TESTS])
    mean, scatter = bodies.mean(axis=0), bodies.std(axis=0, ddof=1)
    print("\n| start, rate | strain | measured, K | thesis | law alone | blocks | blocks over law | "
          "blocks that only harden |\n|" + "---|" * 8)
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["start_K", "rate_per_s", "strain", "measured_K", "thesis_K", "law_K",
                        "blocks_K", "scatter_K", "blocks_that_only_harden_K"])
        for k, (test, strain) in enumerate((t, e) for t in TESTS for e in t.strain):
            print(f"| {test.label} | {strain:g} | {measured[k]:.1f} | {thesis[k]:.2f} | "
                  f"{alone[k]:.2f} | {mean[k]:.2f} ± {scatter[k]:.2f} | "
                  f"{100 * (mean[k] / alone[k] - 1):+.1f} % | {hard[:, k].mean():.2f} |")
            table.writerow([test.start, test.rate, strain, measured[k], thesis[k],
                            *(f"{value[k]:.4f}" for value in (alone, mean, scatter)),
                            f"{hard[:, k].mean():.4f}"])
    print("| root mean square | | | " + " | ".join(
        f"{root_mean_square(values, measured):.2f}" for values in (thesis, alone, mean))
        + f" | | {root_mean_square(hard.mean(axis=0), measured):.2f} |")


def tell_account(found: dict[tuple[str, int, int], Flow]) -> None:
    """Why blocks warm otherwise than the law alone, of the plastic work of that."""
    print("\n| start, rate | strain | blocks over law | by work of the middle | stored in bonds | left | "
          "stored over that of the mean stress |\n|" + "---|" * 7)
    for t, test in enumerate(TESTS):
        work, elastic = energies_alone(test)
        plastic = work - elastic
        flows = [found["law", t, seed] for seed in SEEDS]
        rises, spent, stored = (np.mean([getattr(one, name) for one in flows], axis=0)
                                for name in ("rises", "work", "stored"))
        over = rises / law_alone(test) - 1
        by_work, by_store = (spent - work) / plastic, (elastic - stored) / plastic
        for k, strain in enumerate(test.strain):
            print(f"| {test.label} | {strain:g} | " + " | ".join(
                f"{100 * part[k]:+.1f} %" for part in (over, by_work, by_store,
                                                       over - by_work - by_store))
                + f" | {stored[k] / elastic[k]:.2f} |")


def tell_steps(folder: Path, body: str, load: str, path: Path) -> None:
    """Rises of one packing at the end of each test, by time step and by factor of the masses."""
    print("\n| step over the stable one | masses | " + " | ".join(test.label for test in TESTS)
          + " | largest change | energy gap | in motion |\n|" + "---|" * (5 + len(TESTS)))
    first = None
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["time_step_ratio", "mass_factor",
                        *(f"rise_{test.rate:g}_per_s_K" for test in TESTS),
                        "largest_change", "energy_gap", "in_motion"])
        for ratio, factor in STEPS:
            flows = [loaded(folder, f"steps_{t}_{ratio}_{factor:g}", body, test, load, ratio, factor)
                     for t, test in enumerate(TESTS)]
            rises = np.concatenate([one.rises for one in flows])
            first = rises if first is None else first
            change = float(np.abs(rises / first - 1).max())
            gap, motion = (max(getattr(one, name) for one in flows)
                           for name in ("energy_gap", "in_motion"))
            print(f"| {ratio} | {factor:g} | " + " | ".join(f"{one.rises[-1]:.3f}" for one in flows)
                  + f" | {100 * change:.2f} % | {gap:.1e} | {100 * motion:.3f} % |", flush=True)
            table.writerow([ratio, factor, *(f"{one.rises[-1]:.5f}" for one in flows),
                            f"{change:.3e}", f"{gap:.3e}", f"{motion:.3e}"])
            file.flush()


def main() -> None:
    """Calibrates, loads and tells."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split(":", maxsplit=1)[0])
    parser.add_argument("--elements", type=int, default=2000)
    parser.add_argument("--load", choices=("tension", "compression"), default="compression")
    parser.add_argument("--section", default="ends", help="where bending counts in a bond")
    parser.add_argument("--beams", type=Path, help="folder of beams_N.toml that were calibrated before")
    parser.add_argument("--workers", type=int, default=2, help="runs at a time")
    parser.add_argument("--steps", action="store_true", help="how the time step matters, alone")
    parser.add_argument("--output", type=Path, default=ROOT / "results" / "adiabatic_flow")
    words = parser.parse_args()
    began = time.monotonic()
    words.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        if words.beams:
            beams = [(words.beams / f"beams_{seed}.toml").read_text() for seed in SEEDS]
        else:
            beams, results = calibrated(folder, words.elements, words.section, words.load)
            print(f"calibrated in {time.monotonic() - began:.0f} s; the curve is missed by, %:")
            for seed, found, result in zip(SEEDS, beams, results):
                (words.output / f"beams_{seed}.toml").write_text(found)
                print(f"  packing {seed}: " + " ".join(
                    f"{100 * point['miss']:+.1f}" for point in result["curve"]), flush=True)
        if words.steps:
            tell_steps(folder, scene(BODY, elements=words.elements, seed=SEEDS[0]) + beams[0], words.load,
                       words.output / "steps.csv")
            return
        found = all_flows(folder, words.elements, beams, words.load, words.workers)
    bodies = rises_of(found, "law")
    tell_rises(bodies, rises_of(found, "hard"), words.output / "rises.csv")
    tell_account(found)
    pictures.draw_rises(bodies.mean(axis=0), bodies.std(axis=0, ddof=1),
                        words.output / "rises.png")
    pictures.draw_stresses(found, words.output / "stresses.png")
    heat, energy = (max(getattr(one, name) for one in found.values())
                    for name in ("heat_gap", "energy_gap"))
    print(f"\nat worst heat misses β times the plastic work by {heat:.1e} of the work, energies miss "
          f"the work by {energy:.1e}; {words.elements} elements, packings {SEEDS}, in all "
          f"{time.monotonic() - began:.0f} s")


if __name__ == "__main__":
    main()
