# SPDX-License-Identifier: GPL-2.0-or-later
"""The gallery: its painter, and that its page, its list and its pictures belong together."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from matplotlib import image as images

ROOT = Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs" / "gallery"
sys.path.insert(0, str(GALLERY))
from picture import Picture, blurred, view_axes  # noqa: E402

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


def entries() -> dict[str, dict[str, object]]:
    return tomllib.loads((GALLERY / "gallery.toml").read_text())


def test_every_picture_is_on_the_page_with_its_cost() -> None:
    page = (ROOT / "docs" / "gallery.md").read_text()
    sections = re.split(r"^## ", page, flags=re.M)[1:]
    assert len(sections) == len(entries()) >= 12
    for name, entry in entries().items():
        (section,) = [text for text in sections if f"](gallery/{name}.png)" in text]
        cost = re.search(r"^\*.*?(\d+) elements, (\d+) steps: (\d+) s of one processor\.\*$",
                         section, re.M)
        assert cost, name
        assert int(cost.group(2)) > 1, f"{name} was not run"
        assert (ROOT / str(entry["scene"])).exists()
        assert 5_000 < (GALLERY / f"{name}.png").stat().st_size < 120_000
        if "film" in entry:
            assert (GALLERY / f"{name}.gif").stat().st_size < 800_000


@pytest.mark.slow
def test_a_picture_is_made_anew_as_it_is(tmp_path: Path) -> None:
    """Processors round apart: not each pixel, but size, mean colour and what is empty agree."""
    subprocess.run([GALLERY / "make_gallery", "crack", "--images", tmp_path], check=True)
    made, kept = (images.imread(folder / "crack.png")[..., :3] for folder in (tmp_path, GALLERY))
    assert np.abs(np.subtract(made.shape, kept.shape)).max() <= 4
    assert made.mean(axis=(0, 1)) == pytest.approx(kept.mean(axis=(0, 1)), abs=0.02)
    empty = [(shown == 1).all(axis=-1).mean() for shown in (made, kept)]
    assert empty[0] == pytest.approx(empty[1], abs=0.03)
    assert share_of(0, made) > 0.001  # the crack
