# SPDX-License-Identifier: GPL-2.0-or-later
"""Central forces for a solid of a given modulus: exact where the body is a crystal."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from benchmarks.accuracy_cost.calibration import Calibrations
from benchmarks.accuracy_cost.central_calibration import factor_of, pulled_scene, scaled, with_forces
from compare.codes.standalone import Standalone
from compare.result import CodeFailure
from contrib.prepared import read_specimen

SCENE = """\
[specimen]
shape = "box"
size = ["2 mm", "0.8 mm", "0.8 mm"]
elements = 100
seed = 1
[material]
density = "2790 kg/m^3"
[central_forces]
law = "piecewise"
stiffness = "1500 kN/m"
attraction = "25 N"
range = 1.2
neighbours = "changing"
[calibration]
young_modulus = "73 GPa"
specimens = 2
given_for = 800
velocity = "0.1 m/s"
duration = "20 us"
[gauge]
axis = "x"
lower = "0.7 mm"
upper = "1.3 mm"
[run]
steps = 10
"""
#: Spheres of .2 mm that touch.
CRYSTAL = """\
[specimen]
shape = "crystal"
lattice = "simple_cubic"
element_radius = "0.1 mm"
cells = [10, 4, 4]
"""


def forces(scene: str) -> dict[str, str]:
    found: dict[str, str] = tomllib.loads(scene)["central_forces"]
    return found


def test_constants_go_with_the_size_of_elements_as_annex_c_says() -> None:
    other = SCENE.replace('stiffness = "1500 kN/m"', 'energy = "8 mJ"\nbeyond_energy = "0.8 mJ"')
    found = forces(scaled(SCENE, 0.5, 3)) | forces(scaled(other, 0.5, 3))
    assert found["stiffness"] == "2250 kN/m" and found["attraction"] == "18.75 N"
    assert found["energy"] == "3 mJ" and found["beyond_energy"] == "0.3 mJ"
    # 100 elements are twice as large as the 800 that the constants are given for.
    own = pulled_scene(SCENE, 1001)
    fine = pulled_scene(SCENE.replace("given_for", "elements = 6400\ngiven_for"), 1001)
    assert forces(own)["stiffness"] == "3000 kN/m" and forces(fine)["stiffness"] == "750 kN/m"
    assert tomllib.loads(fine)["specimen"]["elements"] == 6400
    assert tomllib.loads(own)["specimen"]["seed"] == 1001 and forces(own)["neighbours"] == "fixed"
    done = with_forces(SCENE, 2.0)
    assert forces(done)["stiffness"] == "6000 kN/m" and "calibration" not in tomllib.loads(done)
    assert forces(done)["neighbours"] == "changing"


def test_a_crystal_has_the_modulus_of_its_rows(tmp_path: Path) -> None:
    standalone, crystal = Standalone(), tmp_path / "crystal.h5"
    (tmp_path / "crystal.toml").write_text(CRYSTAL)
    standalone.call(["specimen", tmp_path / "crystal.toml", "--output", crystal], tmp_path / "log", 60)
    scene = SCENE.replace("given_for = 800", "given_for = 100")
    found, seconds = factor_of(pulled_scene(scene, 1), standalone, lambda recipe, timeout: (crystal, 2.0), tmp_path, 60)
    # Rows of springs along the pull, one for each square of a diameter: E = K / d.
    assert found == pytest.approx(73e9 / (1.5e6 / 0.2e-3), rel=2e-3)
    assert seconds == 4.0


class Packings:
    """Made as they are asked for."""

    def __init__(self, folder: Path):
        self.folder, self.seeds = folder, list[int]()

    def __call__(self, recipe: str, timeout: float) -> tuple[Path, float]:
        """File, and a second."""
        self.seeds.append(tomllib.loads(recipe)["specimen"]["seed"])
        path, text = self.folder / f"{self.seeds[-1]}.h5", self.folder / "recipe.toml"
        text.write_text(recipe)
        Standalone().call(["specimen", text, "--output", path, "--overwrite"], self.folder / "log", timeout)
        return path, 1.0


def test_packings_get_what_is_asked_for_once(tmp_path: Path) -> None:
    standalone, packings = Standalone(), Packings(tmp_path)
    kept = Calibrations(tmp_path / "kept", standalone, "a program", packings)
    first, seconds = kept.get(SCENE, 60)
    again = kept.get(SCENE.replace("seed = 1", "seed = 2"), 60)
    assert packings.seeds == [1001, 1002] and seconds > 2.0
    assert again == (first.replace("seed = 1", "seed = 2"), seconds)
    # With what was found nothing is left to find: bodies are linear.
    table = SCENE[SCENE.index("[calibration]"):SCENE.index("[gauge]")].replace("800", "100")
    factor, _ = factor_of(pulled_scene(first + table, 1001), standalone, packings, tmp_path, 60)
    assert factor == pytest.approx(1, abs=5e-3)


def affine_modulus(file: Path, stiffness: float, lower: float, upper: float, section: float) -> float:
    """Young's modulus of an isotropic body of springs, if all elements move as one continuum: λ = μ =
    Σ K l² / (15 V), E = 5/2 μ. No body is stiffer."""
    body = read_specimen(file)
    i, j = np.triu_indices(len(body.radius), 1)
    length = np.linalg.norm(body.position[i] - body.position[j], axis=1)
    middle = (body.position[i, 0] + body.position[j, 0]) / 2
    inside = (length <= 1.2 * (body.radius[i] + body.radius[j])) & (middle > lower) & (middle < upper)
    return float(2.5 / 15 * stiffness * (length[inside]**2).sum() / ((upper - lower) * section))


def test_a_packing_is_a_little_softer_than_a_continuum_of_its_springs(tmp_path: Path) -> None:
    scene = SCENE.replace("elements = 100", "elements = 800")
    factor, _ = factor_of(pulled_scene(scene, 1), Standalone(), Packings(tmp_path), tmp_path, 60)
    affine = np.mean([affine_modulus(tmp_path / f"{seed}.h5", 1.5e6, 0.7e-3, 1.3e-3, 0.64e-6) for seed in (1, 2)])
    assert 0.8 < 73e9 / factor / affine < 1


def test_a_modulus_without_a_unit_of_moduli_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CodeFailure, match="in kN; known: MPa, GPa, TPa"):
        factor_of(pulled_scene(SCENE.replace("73 GPa", "73 kN"), 1), Standalone(), lambda *_: (tmp_path, 0.0),
                  tmp_path, 60)
