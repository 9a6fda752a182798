# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and films of runs: what the painter shows, and that fields reach it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = os.environ.get("SOLIDEM_PYTHON", str(ROOT / "build" / "release" / "python"))
PROGRAM = os.environ.get("SOLIDEM_PROGRAM", str(ROOT / "build" / "release" / "solidem"))
sys.path.insert(0, PACKAGES)
from solidem.picture import Picture, blurred, view_axes  # noqa: E402
from solidem.fields import mean_of_bonds  # noqa: E402
from solidem.view import View, paint, shots_of, write_film  # noqa: E402

RED, BLUE, GREY = np.eye(3)[0], np.eye(3)[2], np.full(3, 0.5)
BOX = np.array([[-2.0, -2.0, -2.0], [2.0, 2.0, 2.0]])


def picture(azimuth: float = 0, elevation: float = 0) -> Picture:
    return Picture(*BOX, azimuth, elevation, width=200)


def share_of(colour: int, image: np.ndarray) -> float:
    """Of the picture: where one colour stands out of the three."""
    others = [k for k in range(3) if k != colour]
    return float((image[..., colour] > 2 * image[..., others].max(axis=-1)).mean())


def area(shown: Picture) -> float:
    """Of the whole picture, in the units of the scene."""
    height, width, _ = shown.image().shape
    return height * width / shown.pixels_per_metre**2


@pytest.mark.parametrize("azimuth, elevation", [(0, 0), (-60, 25), (120, -40)])
def test_axes_of_the_view_are_at_right_angles(azimuth: float, elevation: float) -> None:
    axes = view_axes(azimuth, elevation)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1)


@pytest.mark.parametrize("azimuth, elevation", [(0, 0), (-60, 25)])
def test_a_sphere_is_a_disc_from_everywhere(azimuth: float, elevation: float) -> None:
    shown = picture(azimuth, elevation)
    shown.spheres(np.zeros((1, 3)), np.ones(1), RED[None])
    assert share_of(0, shown.image()) * area(shown) == pytest.approx(np.pi, rel=0.02)


def test_what_stands_nearer_is_seen() -> None:
    """The viewer stands at high x; it does not matter what is painted first."""
    places, radii = np.array([[1.0, 0, 0], [-1.0, 0, 0]]), np.array([0.5, 0.5])
    for order in ([0, 1], [1, 0]):
        shown = picture()
        shown.spheres(places[order], radii[order], np.array([RED, BLUE])[order])
        assert share_of(0, shown.image()) > 0
        assert share_of(2, shown.image()) == 0


def test_a_tool_is_glass_before_a_body_and_hidden_behind_it() -> None:
    square = np.array([[0, -2, -2], [0, 2, -2], [0, 2, 2], [0, -2, 2]], float)
    facets = np.array([[0, 1, 2], [0, 2, 3]])
    middles = []
    for x in (-1.5, 1.5):
        shown = picture()
        shown.spheres(np.array([[x, 0.0, 0.0]]), np.array([0.5]), RED[None])
        shown.triangles(square, facets, GREY)
        height, width, _ = shown.image().shape
        middles.append(shown.image()[height // 2, width // 2])
    before, behind = middles
    assert before[1] > 0.05 and before[0] > before[1]
    assert behind[1] == 0


def test_a_mean_over_squares_keeps_what_is_linear() -> None:
    row = np.arange(40.0)
    values = np.add.outer(2 * row, 3 * row)
    assert blurred(values, 3)[5:-5, 5:-5] == pytest.approx(values[5:-5, 5:-5])


def test_a_mean_over_bonds_is_that_of_each_element() -> None:
    pairs = np.array([[0, 1], [1, 2]])
    assert mean_of_bonds(np.array([1.0, 3.0]), pairs, 4) == pytest.approx([1, 2, 3, 0])


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bar that is pulled by 1 m/s and grows warm at one end."""
    import solidem
    folder = tmp_path_factory.mktemp("view") / "bar"
    bar = {"specimen": {"shape": "crystal", "lattice": "simple_cubic", "cells": [8, 3, 3],
                        "element_radius": "0.1 mm"},
           "material": {"density": "2790 kg/m^3", "conductivity": "100 W/(m K)",
                        "specific_heat_capacity": "900 J/(kg K)"},
           "beams": {"young_modulus": "3.5 TPa", "poisson_ratio": 0.3, "radius_ratio": 0.27},
           "plasticity": {"yield_strain": 1e-4},
           "conduction": {"law": "platonic", "initial_temperature": "300 K"},
           "temperatures": [{"name": "hot", "region": {"axis": "x", "side": "low", "layers": 1},
                             "value": "400 K"}],
           "grips": [{"name": side, "region": {"axis": "x", "side": side, "layers": 1},
                      "velocity": [speed, "free", "free"]}
                     for side, speed in (("low", "0 m/s"), ("high", "1 m/s"))],
           "run": {"steps": 100},
           "output": {"frames": 3, "fields": ["stress", "temperature_gradient"]}}
    solidem.Scene(bar).run(folder)
    return folder


def test_fields_are_those_of_the_frames(run: Path) -> None:
    """In the units of their labels; the last layer has moved by speed times time."""
    import solidem
    last = solidem.Results(run).frames[-1]
    moved = shots_of(run, View(field="displacement_x"), [-1])[0].values
    assert moved.max() == pytest.approx(1e3 * last.time * 1.0, rel=1e-9)
    assert moved.min() == pytest.approx(0, abs=1e-9)
    warm = shots_of(run, View(field="temperature"), [-1])[0].values
    assert warm == pytest.approx(last["temperature"])
    flowed = shots_of(run, View(field="bonds/plastic_strain"), [-1])[0].values
    first = (solidem.Results(run).rest["bonds"] == 0).any(axis=1)
    assert flowed.max() > 0
    assert flowed[0] == pytest.approx(last["bonds/plastic_strain"][first].mean())
    cold = shots_of(run, View(field="temperature", shift=-273.15, cut=((-1, "any", "any"),
                                                                       (0.8, "any", "any"))), [0])[0]
    assert len(cold.values) == 72 - 4 * 9 and cold.values == pytest.approx(26.85)


def test_fields_with_components_go_by_their_names(run: Path) -> None:
    import solidem
    last = solidem.Results(run).frames[-1]
    shear = shots_of(run, View(field="stress_xz"), [-1])[0]
    assert shear.values == pytest.approx(1e-6 * last["stress"][:, 5])
    assert View(field="stress_xz").title == "stress xz, MPa"
    slope = shots_of(run, View(field="temperature_gradient"), [-1])[0].values
    assert slope == pytest.approx(1e-3 * np.linalg.norm(last["temperature_gradient"], axis=1))


def test_a_profile_is_the_mean_of_slices(run: Path, solidem: ModuleType) -> None:
    """Layers of equal spheres: each slice holds one, hot at the low end; empty ones are no number."""
    results = solidem.Results(run)
    place, mean = results.profile("temperature", "x", bins=3)
    rest, last = results.rest["position"][:, 0], results.frames[-1]["temperature"]
    edges = np.linspace(rest.min(), rest.max(), 4)
    assert place == pytest.approx(0.5 * (edges[1:] + edges[:-1]))
    assert mean[0] == pytest.approx(last[rest < edges[1]].mean())
    assert mean[2] == pytest.approx(last[rest >= edges[2]].mean()) and mean[0] > mean[2]
    assert np.isnan(results.profile("temperature", "x", bins=1000)[1]).any()
    for words, said in ((("warmth", "x"), "field warmth: none of this run"),
                        (("temperature", "r"), "expected x, y or z")):
        with pytest.raises(solidem.InputError, match=said):
            results.profile(*words)


def test_a_picture_and_a_film_show_the_bar(run: Path, tmp_path: Path) -> None:
    """What is hot is where the colours say, and each frame is there."""
    from PIL import Image
    image = np.asarray(paint(run, View(field="temperature", colours="coolwarm", azimuth=-90,
                                       elevation=0), width=300))
    bodies = image[:image.shape[0] - 75].astype(float)  # above the bar of colours
    red, blue = ((bodies[..., a] > 1.5 * bodies[..., b]).nonzero()[1] for a, b in ((0, 2), (2, 0)))
    assert len(red) > 100 and len(blue) > 100 and red.max() < blue.min()
    write_film(run, View(field="displacement"), tmp_path / "bar.gif", width=120)
    with Image.open(tmp_path / "bar.gif") as film:
        assert film.n_frames == 4


def view(*words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([PROGRAM, "view", *map(str, words)], text=True, capture_output=True,
                          check=False)


def test_the_command_says_what_it_made_or_what_there_is(run: Path, tmp_path: Path) -> None:
    done = view(run, "--width", "200")
    assert done.stdout.strip() == str(run / "temperature.png") and (run / "temperature.png").exists()
    for words, said in (((run, "--field", "heat"), "field heat: none of this run; there are bonds/"),
                        ((run, "--frame", "9"), "frame 9: none of this run; there are 4, 0 to 3"),
                        ((run, "--colours", "mud"), "colours mud: no map of matplotlib"),
                        ((tmp_path,), "trajectory.h5: no such file")):
        done = view(*words)
        assert done.returncode == 2 and said in done.stderr, done.stderr


def test_results_paint_themselves(run: Path, solidem: ModuleType) -> None:
    image = solidem.Results(run).view("speed", width=150)
    assert image.size[0] == 150
