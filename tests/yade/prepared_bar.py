# SPDX-License-Identifier: GPL-2.0-or-later
"""A bar of 112 elements on a shaken lattice, prepared by hand, and YADE runs of it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from compare.codes.base import ROOT, run_program
from compare.result import Result, read_result
from contrib.prepared import Specimen, read_specimen

RADIUS = 1e-4
YOUNG, SHEAR, RATIO = 3.5e12, 1.35e12, 0.3
CONDUCTIVITY = 134.0
CELLS = (7, 4, 4)


@dataclass
class Bar:
    """A prepared bar and what is asked of it."""

    path: Path
    specimen: Specimen
    beam_step: float  #: stable time step of the beams, s
    heat_step: float  #: stable time step of the conduction, s


@pytest.fixture(scope="session")
def bar(tmp_path_factory: pytest.TempPathFactory) -> Bar:
    """The bar; grips and imposed temperature at its ends."""
    random = np.random.default_rng(7)
    cell = np.indices(CELLS).reshape(3, -1).T
    position = 2 * RADIUS * cell + random.uniform(-0.1, 0.1, cell.shape) * RADIUS
    radius = RADIUS * random.uniform(0.875, 1.125, len(cell))
    distance = np.linalg.norm(position[:, None] - position[None], axis=2)
    pairs = np.argwhere(np.triu(distance < 2.5 * RADIUS, 1))
    mass = 2790 * 4 / 3 * np.pi * radius**3
    path = tmp_path_factory.mktemp("bar") / "prepared.h5"
    with h5py.File(path, "w") as file:
        file["elements/position"], file["elements/radius"] = position, radius
        file["bonds/pairs"] = pairs.astype("i4")
        file["mechanics/mass"], file["mechanics/inertia"] = mass, 0.4 * mass * radius**2
        file["conduction/transmission_area"] = radius**2 * random.uniform(2, 6, len(cell))
        file["conduction/heat_capacity"] = 880 * 1.9 * mass
        file["conduction/area"] = RADIUS**2 * random.uniform(0.1, 4, len(pairs))
        file["conduction/distance"] = distance[pairs[:, 0], pairs[:, 1]]
        for name, layer in (("left", 0), ("top", CELLS[0] - 1)):
            elements = np.flatnonzero(cell[:, 0] == layer)
            exchange = file.create_group(f"conduction/exchanges/{name}")
            exchange["elements"] = elements
            exchange["conductance"] = CONDUCTIVITY * RADIUS * random.uniform(0.1, 4, len(elements))
        file["conduction/powers/laser/elements"] = np.arange(50, 70)
        file["conduction/powers/laser/power"] = random.uniform(1, 5, 20)
        file["conduction/powers/lamp/elements"] = np.arange(8, 24)  # some of them are held
        file["conduction/powers/lamp/power"] = random.uniform(1, 5, 16)
        file["sets/grip.left"] = np.flatnonzero(cell[:, 0] == 0)
        file["sets/grip.right"] = np.flatnonzero(cell[:, 0] == CELLS[0] - 1)
        file["sets/temperature.hot"] = np.flatnonzero(cell[:, 0] == 0)
    axial = YOUNG * np.pi * (RATIO * RADIUS) ** 2 / (2 * RADIUS)
    inertia, bending = 0.4 * mass * radius**2, YOUNG * np.pi * (RATIO * RADIUS) ** 4 / (2 * RADIUS)
    beam_step = 0.3 * float(min(np.sqrt(mass / axial).min(), np.sqrt(inertia / bending).min()))
    return Bar(path, read_specimen(path), beam_step, 0.1 * RADIUS**2 / 5.46e-5)


def steady(velocity: float) -> dict[str, Any]:
    """A constant velocity imposed along one axis."""
    return {"kind": "velocity", "function": {"time": [0.0], "value": [velocity]}}


def beam_task(bar: Bar, speed: float, steps: int) -> dict[str, Any]:
    """The left end held, the right end pulled along x and pushed along y."""
    still = [steady(0.0)] * 3
    pulled = [steady(v) for v in (speed, 0.3 * speed, 0.0)]
    return {
        "time_step": {"value": bar.beam_step}, "steps": steps,
        "laws": {"beams": {"young_modulus": YOUNG, "shear_modulus": SHEAR, "radius_ratio": RATIO,
                           "radius_from": "mean", "mean_radius": RADIUS}},
        "grips": [{"name": "left", "axes": still, "rotation": "fixed"},
                  {"name": "right", "axes": pulled, "rotation": "fixed"}]}


def heat_task(bar: Bar, steps: int, law: str = "platonic") -> dict[str, Any]:
    """One end at 798 K, all else from 298 K."""
    return {
        "time_step": {"value": bar.heat_step}, "steps": steps,
        "laws": {"conduction": {"law": law, "conductivity": CONDUCTIVITY,
                                "initial_temperature": 298.0}},
        "temperatures": [{"name": "hot", "value": {"time": [0.0], "value": [798.0]}}]}


def loaded_task(bar: Bar, steps: int, law: str) -> dict[str, Any]:
    """Both ends of the bar exchange heat with the outside, its middle is heated."""
    return {**heat_task(bar, steps, law), "temperatures": [],
            "exchanges": [{"name": "left", "temperature": 798.0},
                          {"name": "top", "temperature": 350.0}],
            "powers": [{"name": "laser", "constant": True}]}


def run_yade(bar: Path, task: dict[str, Any], directory: Path, *words: str) -> Result:
    """Runs contrib/yade/run.py."""
    directory.mkdir(parents=True, exist_ok=True)
    explained = directory / "explained.json"
    explained.write_text(json.dumps(task))
    run_program(["yade", "-n", "-x", "-j1", ROOT / "contrib/yade/run.py", bar, explained,
                 directory / "results", *words], directory, 300)
    return read_result("yade", directory / "results")
