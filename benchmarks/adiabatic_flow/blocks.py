# SPDX-License-Identifier: GPL-2.0-or-later
"""Blocks of elements: how they are calibrated, loaded and read."""

from __future__ import annotations

import csv
import json
import math
import os
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py  # type: ignore[import]
import numpy as np

from . import law
from .law import TAYLOR_QUINNEY, TESTS, Test

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))
SEEDS = (1, 2, 3)
LENGTH, GRIPS = 5e-3, 0.6e-3  #: m

#: The slow and cold curve.
CURVE = f"""\
yield_stress = "{1e-6 * law.A:g} MPa"
hardening_stress = "{1e-6 * law.B:g} MPa"
hardening_exponent = {law.N:g}
"""
BODY = f"""\
[specimen]
shape = "box"
size = ["5 mm", "4.5 mm", "4.5 mm"]
elements = ELEMENTS
seed = SEED
[material]
density = "{law.DENSITY:g} kg/m^3"
specific_heat_capacity = "{law.CAPACITY:g} J/(kg K)"
conductivity = "180 W/(m K)"
"""
BEAMS = f"""\
[beams]
young_modulus = "3 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
[plasticity]
section = "SECTION"
hardening = "johnson-cook"
{CURVE}rate_sensitivity = {law.C:g}
softening_exponent = {law.M:g}
reference_temperature = "{law.REFERENCE:g} K"
melting_temperature = "{law.MELTING:g} K"
"""
CALIBRATION = f"""\
[calibration]
young_modulus = "{1e-9 * law.MODULUS:g} GPa"
fit = "each"
specimens = 3
tension_tests = 8
[calibration.curve]
load = "LOAD"
{CURVE}strains = STRAINS
tolerance = TOLERANCE
"""
RUN = """\
[conduction]
law = "voronoi"
initial_temperature = "START K"
largest_change = "0.05 K"
[plastic_heat]
fraction = 0.9
[[grips]]
name = "low"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "free", "free"]
rotation = "free"
[[grips]]
name = "high"
region = { axis = "x", side = "high", layers = 1 }
velocity = ["SPEED m/s", "free", "free"]
rotation = "free"
[[initial_velocities]]
region = { all = true }
velocity = ["HALF m/s", "0 m/s", "0 m/s"]
stretching = ["RATE 1/s", "THIN 1/s", "THIN 1/s"]
[gauge]
axis = "x"
lower = "1.5 mm"
upper = "3.5 mm"
SCALING[run]
duration = "DURATION s"
time_step_ratio = RATIO
observe_every = 20
[output]
frames = 80
"""


@dataclass(frozen=True)
class Flow:
    """What one block showed in a test."""

    rises: Any  #: heat of the gauge section over its capacity at the strains of the table, K
    strain: Any  #: logarithmic, of the gauge section
    stress: Any  #: true, on the section of a constant volume, Pa
    work: Any  #: of the stress along the strain of the gauge section at the same strains, J/m³
    stored: Any  #: elastic energy of the bonds over the volume between the grips, likewise
    heat_gap: float  #: between heat and β times the plastic work, over the work done
    energy_gap: float  #: between all energies and the work, over the work done
    in_motion: float  #: energy of motion at the end, over the work done


def solidem(folder: Path, *words: str) -> None:
    """Runs it in the folder; 1 is what a calibration ends with that comes near, but not near enough."""
    done = subprocess.run([PROGRAM, *words], check=False, cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr)


def scene(text: str, **values: object) -> str:
    """The text with values in place of the words in capitals."""
    for word, value in values.items():
        text = text.replace(word.upper(), str(value))
    return text


def calibrated(folder: Path, elements: int, section: str,
               load: str) -> tuple[list[str], list[Any]]:
    """Beams and flow of each packing, and how they meet the curve in "tension" or "compression"."""
    strains = sorted({strain for test in TESTS for strain in test.strain})
    text = scene(BODY + BEAMS + CALIBRATION, elements=elements, seed=SEEDS[0], section=section,
                 load=load, strains=strains, tolerance=0.01)
    (folder / "calibration.toml").write_text(text)
    solidem(folder, "calibrate", "calibration.toml", "-o", "found")
    results = json.loads((folder / "found" / "calibration.json").read_text())["results"]
    return [(folder / "found" / f"calibrated_{seed}.toml").read_text() for seed in SEEDS], results


def without_softening(beams: str) -> str:
    """The law hardens alone: no rate, no temperature."""
    words = ("rate_sensitivity", "reference_rate", "softening_exponent", "reference_temperature",
             "melting_temperature")
    return "".join(line for line in beams.splitlines(keepends=True) if not line.startswith(words))


def loaded(folder: Path, name: str, body: str, test: Test, load: str, ratio: float = 0.5,
           factor: float = 1) -> Flow:
    """Pulls or compresses a block; `ratio` of the stable time step, masses times `factor`."""
    sign = -1 if load == "compression" else 1
    rate = sign * test.rate
    speed = rate * (LENGTH - GRIPS)
    text = scene(body + RUN, start=test.start, speed=speed, half=0.5 * speed, rate=rate,
                 thin=-0.33 * rate, duration=1.15 * math.expm1(sign * test.strain[-1]) / rate,
                 ratio=ratio, scaling=f"[mass_scaling]\nfactor = {factor:g}\n" if factor > 1 else "")
    (folder / f"{name}.toml").write_text(text)
    solidem(folder, "prepare", f"{name}.toml", "-o", f"{name}.h5")
    solidem(folder, "run", f"{name}.toml", "-o", name)
    with h5py.File(folder / f"{name}.h5") as file:
        cells = np.array(file["conduction/volume"])
    return read_flow(folder / name, test, sign, cells)


def read_flow(folder: Path, test: Test, sign: int, cells: Any) -> Flow:
    """From what a run has written; strain and stress count above 0 along the load.

    `cells`: (N,) volumes of the elements' cells. Those at the surface are larger and stay colder, so that a mean
    that counts elements is not that of the heat.
    """
    with (folder / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    column = {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}
    strain = sign * np.log1p(column["gauge.strain"])
    with h5py.File(folder / "trajectory.h5") as file:
        frames = [file["frames"][key] for key in sorted(file["frames"])]
        x = np.array(frames[0]["position"])[:, 0]
        inside = (x > 1.5e-3) & (x < 3.5e-3)
        moments = np.array([frame.attrs["time"] for frame in frames])
        means = np.array([np.average(np.array(frame["temperature"])[inside], weights=cells[inside])
                          for frame in frames])
    reached = np.interp(test.strain, strain, column["time"])
    at = np.interp(reached, moments, means)
    stress = sign * column["gauge.stress"] * (1 + column["gauge.strain"])
    spent = np.append(0, np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(strain)))
    stored = column["elastic_energy"] / (cells.sum() * (1 - GRIPS / LENGTH))
    work = column["external_work"][-1]
    heat = column["thermal_energy"] + column["waiting_heat"]
    heat -= heat[0] - TAYLOR_QUINNEY * column["plastic_work"][0]
    return Flow(at - test.start, strain, stress,
                *(np.interp(reached, column["time"], values) for values in (spent, stored)),
                float(np.abs(heat - TAYLOR_QUINNEY * column["plastic_work"]).max() / work),
                float(np.abs(column["energy_balance"]).max() / work),
                float(column["kinetic_energy"][-1] / work))
