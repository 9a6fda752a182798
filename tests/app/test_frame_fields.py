# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields that a scene asks its frames for, as a user reads them."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np
import pytest
from scene_parts import ALUMINIUM, HELD, HIGH_END, LOW_END, STIFF_BEAMS, grip

ROOT = Path(__file__).resolve().parents[2]
TABLE = re.compile(r"\| field \| what it shows.*\n(?:\|.*\n)+")

BAR = ("""\
[specimen]
shape = "box"
size = ["5 mm", "2 mm", "2 mm"]
elements = 700
seed = 1
""" + ALUMINIUM + STIFF_BEAMS + grip("left", LOW_END, HELD)
       + grip("right", HIGH_END, 'velocity = [{ time = ["0 us", "20 us"], value = ["0 m/s", "1 m/s"] }, '
                                 '"free", "free"]') + """\
[gauge]
axis = "x"
lower = "1 mm"
upper = "4 mm"
[damping]
viscous = "2e5 1/s"
[run]
duration = "40 us"
[output]
frames = 1
fields = ["stress", "von_mises_stress", "strain", "displacement", "bond_force"]
""")


def test_the_page_lists_all_that_there_are(solidem) -> None:
    solidem.scene("bar.toml", BAR.replace('"bond_force"', '"bond_forces"'))
    done = solidem("run", "bar.toml")
    assert done.returncode == 2 and "(did you mean bond_force?)" in done.stderr
    assert "bar.toml" in done.stderr and "[output] fields[4]" in done.stderr
    told = done.stderr[done.stderr.index("any of"):]
    table = TABLE.search((ROOT / "docs/results.md").read_text()).group()
    assert re.findall(r'"(\w+)"', told) == re.findall(r"^\| `(\w+)`", table, re.MULTILINE)
    assert table in solidem("keys", "fields").stdout


@pytest.mark.parametrize("old, new, said", [
    ('"stress", "von', '"orientation", "temperature_gradient", "von', "nothing conducts heat"),
    ('"stress", "von', '"plastic_strain", "von', "bonds do not flow"),
    ('"stress", "von', '"strain", "von', "given twice"),
    ("frames = 1", "frames = 0", "no frames to show them"),
])
def test_what_cannot_be_shown_is_refused(solidem, old: str, new: str, said: str) -> None:
    solidem.scene("bar.toml", BAR.replace(old, new))
    done = solidem("run", "bar.toml")
    assert done.returncode == 2 and said in done.stderr, done.stderr
    assert "[output] fields" in done.stderr
    assert not (solidem.folder / "results" / "bar" / "trajectory.h5").exists()


def test_the_mean_of_the_stress_over_the_gauge_is_the_gauges(solidem) -> None:
    """Of elements whose centres lie in the gauge length; the scatter of single ones is that of a
    packing."""
    solidem.scene("bar.toml", BAR)
    done = solidem("run", "bar.toml", "--output", "results")
    assert done.returncode == 0, done.stderr
    results = solidem.folder / "results"
    with h5py.File(results / "trajectory.h5") as file:
        place, radius = file["elements/position"][:], file["elements/radius"][:]
        frame = file["frames/000001"]
        stress, strain, mises = (frame[name][:] for name in ("stress", "strain", "von_mises_stress"))
        moved = frame["displacement"][:]
        assert moved == pytest.approx(frame["position"][:] - place)
        force, pairs = frame["bonds/force"][:], file["bonds/pairs"][:]
    inside = (place[:, 0] > 1e-3) & (place[:, 0] < 4e-3)
    mean, mean_strain = (np.average(values[inside, 0], weights=radius[inside]**3)
                         for values in (stress, strain))
    history = np.genfromtxt(results / "history.csv", delimiter=",", names=True)
    gauge, stretch = history["gaugestress"][-1], history["gaugestrain"][-1]
    assert gauge > 20e6
    assert mean == pytest.approx(gauge, rel=0.02)
    assert mean_strain == pytest.approx(stretch, rel=0.08)
    assert np.average(mises[inside]) > 0.8 * gauge
    # What bonds do to the elements between the grips is balanced, in a body that hardly moves.
    total = np.zeros_like(place)
    np.add.at(total, pairs[:, 0], force)
    np.add.at(total, pairs[:, 1], -force)
    free = (place[:, 0] > 1e-3) & (place[:, 0] < 4e-3)
    assert np.abs(total[free]).max() < 0.02 * np.abs(force).max()
    index = ElementTree.parse(results / "trajectory.xdmf")
    kinds = {a.get("Name"): a.get("AttributeType") for a in index.iter("Attribute")}
    assert (kinds["stress"], kinds["displacement"]) == ("Matrix", "Vector")


def test_frames_without_fields_are_as_before(solidem) -> None:
    solidem.scene("bar.toml", re.sub(r"fields = .*\n", "", BAR).replace("40 us", "2 us"))
    assert solidem("run", "bar.toml", "--output", "results").returncode == 0
    with h5py.File(Path(solidem.folder / "results" / "trajectory.h5")) as file:
        assert set(file["frames/000001"]) == {"position", "velocity"}
