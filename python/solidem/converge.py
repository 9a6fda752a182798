# SPDX-License-Identifier: GPL-2.0-or-later
"""Richardson extrapolation of any scene: what a figure tends to as bodies or steps are refined, at which
order, how far each run is from it, and what each costs.

Of bodies of several packings the limit is that of all orders which the runs and the studies of such scenes
leave possible, as in `solidem advise` (foretold.py); of steps, which do not scatter, that of the order which
fits best.

    solidem converge tension.toml --of gauge.stress --elements 500,1000,2000 --seeds 3
    solidem converge tension.toml --of gauge.stress --key run.time_step_ratio --values 0.8,0.4,0.2
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from ._core import InputError, RunError
from .foretold import ErrorModel
from .level import Floats, Level
from .results import Results
from .scene import Scene, Source
from .studies import Study, kind_of, study_of

ORDERS = np.arange(0.5, 4.001, 0.01)  #: that are tried
USUAL_ORDER = 1.0  #: of packings, whose surfaces err by their share of the body
WIDEST = 2.0  #: interval of an order that still tells something
DRAWS = 2000  #: of means, from which the interval comes
ELEMENTS, SEED = "specimen.elements", "specimen.seed"


@dataclass(frozen=True)
class Convergence:
    """What a figure tends to: Q(h) = Q_0 + C h^p."""

    of: str
    key: str
    levels: list[Level]  #: from the coarsest to the finest
    limit: float  #: Q_0
    constant: float  #: C, for sizes over the coarsest
    order: float  #: p
    interval: tuple[float, float]  #: of Q_0, in which it lies with a probability of 95 %
    order_interval: tuple[float, float] | None  #: of p, likewise; None: p was taken, not found
    scatter: float  #: standard deviation over specimens, of the coarsest level; 0: one specimen only
    strays: int = 0  #: figures far from all others, left out

    def error(self, level: Level) -> float:
        """How far the mean of a level is from the limit, as a share of it."""
        return abs(level.mean / self.limit - 1) if self.limit else abs(level.mean)

    def table(self) -> str:
        """For a person to read."""
        rows = [f"{self.key:>20}  {self.of:>14}  {'scatter':>9}  {'error':>8}  {'s a run':>8}"]
        for level in self.levels:
            spread = float(level.figures.std(ddof=1)) if len(level.figures) > 1 else 0.0
            rows.append(f"{level.value:>20g}  {level.mean:>14.6g}  {spread:>9.2g}  "
                        f"{100 * self.error(level):>6.2f} %  {level.seconds:>8.2f}")
        low, high = self.interval
        rows.append(f"limit {self.limit:.6g}, between {low:.6g} and {high:.6g} (95 %)")
        if self.order_interval is None:
            rows.append(f"order {self.order:g}, taken: these runs do not tell it")
        else:
            rows.append(f"order {self.order:.2f}, between {self.order_interval[0]:.2f} and "
                        f"{self.order_interval[1]:.2f}")
        if self.strays:
            rows.append(f"left out: {self.strays} of the figures, far from all others")
        if self.scatter and self.interval[1] - self.interval[0] > abs(
                self.levels[0].mean - self.levels[-1].mean):
            rows.append("specimens differ more than refinements: take more seeds, or levels farther "
                        "apart")
        return "\n".join(rows)

    def _repr_html_(self) -> str:
        return f"<pre>{self.table()}</pre>"


def fits(sizes: Floats, means: Floats, weights: Floats,
         orders: Floats) -> tuple[Floats, Floats, Floats]:
    """Q_0, C and p of least squares for many sets of means (draws, levels), one p of `orders` for
    each."""
    limit, constant, best_order = np.zeros((3, len(means)))
    least = np.full(len(means), np.inf)
    for order in orders:
        columns = np.stack([np.ones_like(sizes), sizes**order], axis=1) * weights[:, None]
        found, *_ = np.linalg.lstsq(columns, (means * weights).T, rcond=None)
        missed = (((columns @ found).T - means * weights)**2).sum(axis=1)
        better = missed < least
        limit[better], constant[better] = found[:, better]
        best_order[better] = order
        least[better] = missed[better]
    return limit, constant, best_order


def of_packings(of: str, levels: Sequence[Level], study: Study | None) -> Convergence:
    """The limit of bodies, from all orders that are possible: its mean, and that of the order."""
    scale = abs(levels[-1].mean) or max(abs(level.mean) for level in levels)
    model = ErrorModel(levels, scale or 1.0, study)
    limit, low, high = model.limit
    order, least, most = model.order
    sizes = np.array([level.size for level in levels]) / levels[0].size
    weights = np.array([len(level.figures) for level in levels]) * sizes**order
    off = np.array([level.mean for level in model.levels]) - limit
    constant = float(weights @ off / (weights @ sizes**order))
    return Convergence(of, ELEMENTS, list(levels), limit, constant, order, (low, high), (least, most),
                       model.scatter(levels[0].value) * model.scale, model.strays)


def extrapolated(of: str, key: str, levels: Sequence[Level], order: float | None = None,
                 study: Study | None = None) -> Convergence:
    """The limit of two levels or more. Of bodies of several packings all orders count, as the runs and
    `study` leave them likely. Else the order is sought where there are three levels, unless it is given or
    the runs do not tell it; its uncertainty and that of the means, from the scatter of specimens, make the
    interval. Without scatter the interval is as far as the finest level is from the limit."""
    if len(levels) < 2:
        raise InputError("one refinement tells no limit; expected two or more")
    levels = sorted(levels, key=lambda level: -level.size)
    if key == ELEMENTS and order is None and any(len(level.figures) > 1 for level in levels):
        return of_packings(of, levels, study)
    sizes = np.array([level.size for level in levels]) / levels[0].size
    means = np.array([level.mean for level in levels])
    counts = np.array([len(level.figures) for level in levels])
    weights = np.sqrt(counts)
    freedom = int((counts - 1).sum())
    squares = sum(float(((level.figures - level.mean)**2).sum()) for level in levels)
    scatter = float(np.sqrt(squares / freedom)) if freedom else 0.0
    many = means[None, :]
    if freedom:
        draws = np.random.default_rng(1).standard_t(freedom, (DRAWS, len(levels)))
        many = np.concatenate([many, means + draws * scatter / weights])

    def convergence(orders: Floats) -> Convergence:
        limits, constants, found = fits(sizes, many, weights, orders)
        if freedom:
            low, high = np.percentile(limits, [2.5, 97.5])
        else:
            apart = abs(means[-1] - limits[0])
            low, high = limits[0] - apart, limits[0] + apart
        ends = np.percentile(found, [2.5, 97.5])
        told = (float(ends[0]), float(ends[1])) if len(orders) > 1 else None
        return Convergence(of, key, list(levels), float(limits[0]), float(constants[0]),
                           float(found[0]), (float(low), float(high)), told, scatter)

    if order is None and len(levels) > 2:
        found = convergence(ORDERS)
        assert found.order_interval is not None
        if found.order_interval[1] - found.order_interval[0] < WIDEST:
            return found
    return convergence(np.array([order or USUAL_ORDER]))


def figure_of(results: Results, of: str, at: str = "end") -> float:
    """A column of the history at the end, at its largest magnitude ("peak"), or at a time in s."""
    history = results.history
    if of not in history:
        raise InputError(f"{of}: no column of {results.folder / 'history.csv'}; there are "
                         f"{', '.join(history)}")
    column = history[of]
    if at == "end":
        return float(column[-1])
    if at == "peak":
        return float(column[np.abs(column).argmax()])
    try:
        moment = float(at)
    except ValueError:
        raise InputError(f"at {at}: neither end nor peak nor a time in s") from None
    return float(np.interp(moment, history["time"], column))


class Taken(NamedTuple):
    """What a run took, s."""

    seconds: float  #: by the clock
    processor: float  #: of the processor, in all threads


def ran(scene: Scene, folder: Path) -> tuple[Results, Taken]:
    """Runs a scene, unless its results are there; with the time that it took, its packing too."""
    told = folder / "asked.json"
    asked = json.dumps([scene.text, scene.changes], sort_keys=True, default=str)
    if told.exists():
        before = json.loads(told.read_text())
        if before["asked"] == asked and Results(folder).summary["completed"]:
            return Results(folder), Taken(*before["taken"])
    start, start_of_processor = time.perf_counter(), time.process_time()
    results = scene.run(folder, overwrite=True)
    taken = Taken(time.perf_counter() - start, time.process_time() - start_of_processor)
    told.write_text(json.dumps({"asked": asked, "taken": taken}))
    return results, taken


def converge(source: Source | Scene, of: str, *, values: Sequence[float], key: str = ELEMENTS,
             seeds: int = 3, at: str = "end", order: float | None = None,
             folder: str | os.PathLike[str] = "results/converge") -> Convergence:
    """Runs a scene with several `values` of a key, each with `seeds` specimens, and extrapolates a
    figure of them. `of`: a column of the history; `at`: "end", "peak" or a time in s; `order`: taken,
    not sought. Runs stand in `folder`; those that are there already are not run again."""
    scene = source if isinstance(source, Scene) else Scene(source)
    levels = []
    for value in values:
        figures, seconds = [], []
        for seed in range(1, seeds + 1):
            whole = int(value) if float(value).is_integer() else value
            changes = {key: whole, **({SEED: seed} if seeds > 1 else {})}
            results, _ = ran(scene.changed(changes), Path(folder) / f"{key}_{value:g}_{seed}")
            figures.append(figure_of(results, of, at))
            seconds.append(sum(results.summary["wall_seconds"].values()))
        size = float(value)**(-1 / 3) if key == ELEMENTS else float(value)
        levels.append(Level(float(value), size, np.array(figures), float(np.mean(seconds))))
    law = scene.tables.get("conduction", {}).get("law", "platonic")
    return extrapolated(of, key, levels, order, study_of(kind_of(scene.tables), law))


def write(found: Convergence, folder: Path) -> None:
    """convergence.csv, and convergence.png where matplotlib is."""
    with (folder / "convergence.csv").open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow([found.key, "size", found.of, "specimens", "error", "seconds"])
        for level in found.levels:
            rows.writerow([level.value, level.size, level.mean, len(level.figures),
                           found.error(level), level.seconds])
        rows.writerow(["limit", 0, found.limit, "", "", ""])
    from matplotlib.figure import Figure  # type: ignore[import]

    figure = Figure(figsize=(5.5, 4), layout="constrained")
    axes = figure.add_subplot()
    largest = found.levels[0].size
    for level in found.levels:
        axes.plot(np.full(len(level.figures), level.size / largest), level.figures, ".",
                  color="silver")
    sizes = np.linspace(0, 1, 100)
    axes.plot(sizes, found.limit + found.constant * sizes**found.order, lw=1)
    axes.plot([level.size / largest for level in found.levels],
              [level.mean for level in found.levels], "o")
    low, high = found.interval
    axes.errorbar([0], [found.limit], [[found.limit - low], [high - found.limit]], fmt="s", capsize=4)
    axes.set(xlabel=f"size over the coarsest ({found.key})", ylabel=found.of,
             title=f"order {found.order:.2g}")
    figure.savefig(folder / "convergence.png", dpi=150)


def numbers(text: str) -> list[float]:
    """Numbers with commas between."""
    return [float(word) for word in text.split(",")]


def main(words: Sequence[str] | None = None) -> int:
    """The command; 2 where something given cannot be used, 1 where a run cannot go on."""
    parser = argparse.ArgumentParser(prog="solidem converge",
                                     description="What a figure of a scene tends to.")
    add = parser.add_argument
    add("scene", type=Path)
    add("--of", required=True, metavar="COLUMN", help="of the history, for example gauge.stress")
    add("--at", default="end", help="end, peak (largest magnitude) or a time in s (default: end)")
    add("--elements", type=numbers, metavar="N,N,N", help="of the specimen")
    add("--key", help="another key of the scene that is refined, with --values")
    add("--values", type=numbers, metavar="X,X,X", help="of that key: sizes or steps, which go to 0")
    add("--seeds", type=int, default=0, metavar="N", help="specimens of each (default: 3, of another "
        "key 1)")
    add("--order", type=float, metavar="P", help="taken, not sought")
    add("-o", "--output", type=Path, default=Path("results/converge"), metavar="DIR",
        help="runs that are there are not run again (default: results/converge)")
    given = parser.parse_args(words)
    if bool(given.elements) == bool(given.key) or bool(given.key) != bool(given.values):
        parser.error("expected either --elements, or --key with --values")
    key = given.key or ELEMENTS
    try:
        found = converge(given.scene, given.of, values=given.elements or given.values, key=key,
                         seeds=given.seeds or (3 if key == ELEMENTS else 1), at=given.at,
                         order=given.order, folder=given.output)
        write(found, given.output)
    except (InputError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except RunError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(found.table())
    print(given.output / "convergence.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
