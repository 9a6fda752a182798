# SPDX-License-Identifier: GPL-2.0-or-later
"""The gallery: its page, its list and its pictures belong together."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

import numpy as np
import pytest
from matplotlib import image as images

ROOT = Path(__file__).resolve().parents[2]
GALLERY = ROOT / "docs" / "gallery"


def share_of(colour: int, image: np.ndarray) -> float:
    """Of the picture: where one colour stands out of the three."""
    others = [k for k in range(3) if k != colour]
    return float((image[..., colour] > 2 * image[..., others].max(axis=-1)).mean())


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
