# SPDX-License-Identifier: GPL-2.0-or-later
"""What a plunge came to: forces, work, heat, and where its elements are."""

from __future__ import annotations

import csv
import json
from dataclasses import asdict, dataclass
from pathlib import Path

import h5py  # type: ignore[import]
import numpy as np
from numpy.typing import NDArray

from .scene import DEPTH, TAYLOR_QUINNEY, THICKNESS, Case

Floats = NDArray[np.float64]
WINDOW = 0.1e-3  #: of depth, over which forces are averaged, m


@dataclass(frozen=True)
class Books:
    """One run, in SI units."""

    elements: int
    factor: float
    rubs: bool
    seed: int
    ratio: float
    bonds: int
    steps: int
    processor_seconds: float
    force_half: float  #: on the pin, mean over the WINDOW up to half of the depth
    force: float  #: the same up to the whole depth
    torque: float  #: about the axis of the pin, likewise
    work: float  #: of the pin
    plastic: float  #: share of it that bonds took
    friction: float  #: share that slip took
    kinetic: float  #: share that was in motion, at most over the second half of the plunge
    energy_gap: float  #: of all energies from the work, over the work
    heat_gap: float  #: of all heats from what made them, over the work
    tool_heat: float  #: that went into the pin
    hottest: float  #: mean rise of the hottest hundredth of the elements
    mean_rise: float  #: of all
    broken: int
    formed: int
    loose: int  #: elements that lost all bonds they had at the start
    strays: int  #: elements outside of the plate and its rim, by more than a mean diameter
    deepest: float  #: of an element's centre above the tip of the pin, within it, m


def history_of(folder: Path) -> dict[str, Floats]:
    """Columns of a history."""
    with (folder / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def column(history: dict[str, Floats], name: str) -> Floats:
    """Zero where the effect does not act."""
    return history.get(name, np.zeros_like(history["time"]))


def mean_over(depth: Floats, values: Floats, end: float) -> float:
    """Over the WINDOW that ends there."""
    inside = (depth > end - WINDOW) & (depth <= end * (1 + 1e-9))
    return float(values[inside].mean())


def heat_gap(history: dict[str, Floats]) -> float:
    """Of the heat in elements, waiting and in the pin, from what plastic work and slip made."""
    found = (column(history, "thermal_energy") + column(history, "waiting_heat")
             + column(history, "tool.pin.heat") - column(history, "tool.pin.conducted_heat"))
    made = TAYLOR_QUINNEY * history["plastic_work"] + column(history, "friction_heat")
    return float(np.abs(found - made).max() / history["external_work"][-1])


def elements_of(folder: Path) -> tuple[dict[str, float], dict[str, Floats]]:
    """How many have left, and how warm all are, in the last frame."""
    with h5py.File(folder / "trajectory.h5") as file:
        rest, radius = file["elements/position"][:], file["elements/radius"][:]
        pairs = file["bonds/pairs"][:]
        last = file["frames"][sorted(file["frames"])[-1]]
        place, warm, lost = (last[key][:] for key in ("position", "temperature", "broken_bonds"))
    bonded = np.isin(np.arange(len(rest)), pairs)
    rim = 2 * radius.mean()
    low, high = rest.min(axis=0) - rim, rest.max(axis=0) + rim
    high[2] += 0.5 * DEPTH  # what the pin displaces rises around it
    outside = ((place < low) | (place > high)).any(axis=1) | ~np.isfinite(place).all(axis=1)
    rise = np.sort(warm[bonded] - 296.0)
    counts = {"loose": int((bonded & (lost >= 1)).sum()), "strays": int((bonded & outside).sum()),
              "hottest": float(rise[-max(1, len(rise) // 100):].mean()),
              "mean_rise": float(rise.mean())}
    return counts, {"place": place, "rest": rest, "radius": radius, "rise": warm - 296.0}


def books_of(case: Case, folder: Path) -> Books:
    """Read from what a run has written."""
    summary = json.loads((folder / "summary.json").read_text())
    history = history_of(folder)
    depth, work = -history["tool.pin.displacement_z"], history["external_work"]
    counts, state = elements_of(folder)
    late = depth > DEPTH / 2
    under = np.hypot(*(state["place"][:, :2] - 3e-3).T) < 1e-3
    tip = THICKNESS - DEPTH
    return Books(
        elements=case.elements, factor=case.factor, rubs=case.rubs, seed=case.seed,
        ratio=case.ratio, bonds=summary["bonds"], steps=summary["steps"],
        processor_seconds=float((folder / "processor_seconds").read_text()),
        force_half=mean_over(depth, history["tool.pin.force_z"], DEPTH / 2),
        force=mean_over(depth, history["tool.pin.force_z"], DEPTH),
        torque=mean_over(depth, history["tool.pin.torque_z"], DEPTH),
        work=float(work[-1]), plastic=float(history["plastic_work"][-1] / work[-1]),
        friction=float(column(history, "friction")[-1] / work[-1]),
        kinetic=float((history["kinetic_energy"][late] / work[late]).max()),
        energy_gap=float(np.abs(history["energy_balance"]).max() / work[-1]),
        heat_gap=heat_gap(history),
        tool_heat=float(column(history, "tool.pin.heat")[-1]
                        - column(history, "tool.pin.conducted_heat")[-1]),
        broken=int(history["broken_bonds"][-1]), formed=int(history["bonds_formed"][-1]),
        deepest=float(max(0.0, (state["place"][under, 2] - tip).max())),
        **counts)  # type: ignore[arg-type]


def write_books(rows: list[Books], path: Path) -> None:
    """One line for each run."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(asdict(rows[0])))
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)
