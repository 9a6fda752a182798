#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Young's modulus of wood at an angle to its grain: measured, exact transformation, Hankinson.

    docs/images/wood_off_axis.py build/release/solidem docs/examples/wood.toml docs/images

The grain of the scene is turned in the plane of L and T, with its fibres, in three packings, and
`solidem constants` measures each body anew. Writes wood_off_axis.png and wood_off_axis.csv.
"""

from __future__ import annotations

import csv
import json
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

ANGLES = np.arange(0, 91, 15)  # degree, between grain and load
SEEDS = (1, 2, 3)


def measured(program: Path, scene: str, angle: float, seed: int) -> tuple[float, list[list[float]]]:
    """E along x of a body whose grain stands at an angle to x, Pa, and its compliance in L, R, T."""
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turned = re.sub(r"(?m)^grain = .*", f"grain = [{c:.15g}, 0, {s:.15g}]", scene)
    turned = turned.replace("elements =", f"seed = {seed}\nelements =")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(turned)
        run = subprocess.run([program, "constants", path, "--json"], check=True,
                             capture_output=True, text=True)
    result = json.loads(run.stdout)
    compliance = result["compliance"]
    x = [result["axes"][axis][0] for axis in "LRT"]
    return modulus_along(np.array(x), np.array(compliance)), compliance


def modulus_along(n: NDArray[np.float64], compliance: NDArray[np.float64]) -> float:
    """1 / (v · S v) with v the products of the direction's components in Voigt's order."""
    v = np.array([n[0] ** 2, n[1] ** 2, n[2] ** 2, n[1] * n[2], n[0] * n[2], n[0] * n[1]])
    return float(1 / (v @ compliance @ v))


def hankinson(along: float, across: float, angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """E_L E_T / (E_L sin² + E_T cos²)."""
    return along * across / (along * np.sin(angle) ** 2 + across * np.cos(angle) ** 2)


def of_targets(scene: str, angle: NDArray[np.float64]) -> NDArray[np.float64]:
    """What a body that met every target of the scene would have in the plane of L and T, GPa."""
    targets = tomllib.loads(scene)["calibration"]
    gigapascal = {name: float(text.removesuffix(" GPa"))
                  for group in ("young_moduli", "shear_moduli")
                  for name, text in targets[group].items()}
    c2, s2 = np.cos(angle) ** 2, np.sin(angle) ** 2
    mixed = 1 / gigapascal["LT"] - 2 * targets["poisson_ratios"]["LT"] / gigapascal["L"]
    return 1 / (c2**2 / gigapascal["L"] + s2**2 / gigapascal["T"] + c2 * s2 * mixed)


def main(program: Path, scene_file: Path, folder: Path) -> None:
    scene = scene_file.read_text()
    moduli = np.empty((len(ANGLES), len(SEEDS)))
    compliances = []
    for k, angle in enumerate(ANGLES):
        for m, seed in enumerate(SEEDS):
            moduli[k, m], compliance = measured(program, scene, angle, seed)
            if angle == 0:
                compliances.append(compliance)
    mean, spread = moduli.mean(axis=1) / 1e9, moduli.std(axis=1, ddof=1) / 1e9
    compliance = np.mean(compliances, axis=0)

    def exact(angle: NDArray[np.float64]) -> NDArray[np.float64]:
        rad = np.radians(angle)
        return np.array([modulus_along(np.array([np.cos(a), 0, np.sin(a)]), compliance)
                         for a in rad]) / 1e9

    def by_hankinson(angle: NDArray[np.float64]) -> NDArray[np.float64]:
        return hankinson(mean[0], mean[-1], np.radians(angle))

    with (folder / "wood_off_axis.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["angle_degree", "measured_GPa", "deviation_GPa", "transformed_GPa",
                         "targets_GPa", "hankinson_GPa"])
        for row in zip(ANGLES, mean, spread, exact(ANGLES), of_targets(scene, np.radians(ANGLES)),
                       by_hankinson(ANGLES)):
            writer.writerow([f"{row[0]:d}", *(f"{value:.4g}" for value in row[1:])])

    fine = np.linspace(0, 90, 181)
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    axes.plot(fine, exact(fine), label="orthotropic transformation of the body at 0°")
    axes.plot(fine, of_targets(scene, np.radians(fine)), ":", label="the same of the targets")
    axes.plot(fine, by_hankinson(fine), "--", label="Hankinson, between the ends")
    axes.errorbar(ANGLES, mean, spread, fmt="ko", capsize=3, ms=4,
                  label="measured, grain turned (three packings)")
    axes.set(xlabel="angle of grain and load (degree)", ylabel="E (GPa)", yscale="log",
             xticks=ANGLES)
    axes.set_yticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(folder / "wood_off_axis.png", dpi=110)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]), Path(sys.argv[3]))
