# SPDX-License-Identifier: GPL-2.0-or-later
"""`solidem law`: laws of central force before any run."""

from __future__ import annotations

import csv
import xml.etree.ElementTree as ElementTree

import pytest

MIE = ["mie", "energy=0.24 mJ", "repulsive_exponent=8", "attractive_exponent=4"]
PIECEWISE = ["piecewise", "stiffness=1500 kN/m", "attraction=25 N"]


def rows_of(solidem, name="out.csv"):
    with open(solidem.folder / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_list_names_every_law_with_parameters_and_units(solidem):
    done = solidem("law", "list")
    assert done.returncode == 0
    for word in ("piecewise", "lennard-jones", "shifted-lennard-jones", "mie", "threshold",
                 "attraction", "N/m", "peak_separation", "threshold_strain", "integer"):
        assert word in done.stdout


def test_the_table_holds_force_stiffness_and_potential_that_go_together(solidem):
    done = solidem("law", "plot", *MIE, "range=1.5", "--equilibrium", "52 um",
                   "--interpenetration", "0.2", "--output", "out")
    assert done.returncode == 0, done.stderr
    rows = [{k: v if k in ("law", "part") else float(v) for k, v in row.items()}
            for row in rows_of(solidem)]
    assert {row["part"] for row in rows} == {"continuation", "law", "beyond"}
    eq = 52e-6
    rest = min(rows, key=lambda row: abs(row["distance_m"] - eq))
    assert rest["stiffness_N_per_m"] == pytest.approx(8 * 4 * 0.24e-3 / eq**2, rel=1e-6)
    for before, after in zip(rows, rows[1:]):
        if before["part"] != after["part"]:
            continue
        step = after["distance_m"] - before["distance_m"]
        if step < 1e-6 * eq:
            continue
        force = -(after["potential_J"] - before["potential_J"]) / step
        stiffness = -(after["force_N"] - before["force_N"]) / step
        assert force == pytest.approx((before["force_N"] + after["force_N"]) / 2, rel=1e-3,
                                      abs=1e-3)
        assert stiffness == pytest.approx(
            (before["stiffness_N_per_m"] + after["stiffness_N_per_m"]) / 2, rel=1e-3,
            abs=1e-3 * rest["stiffness_N_per_m"])
    assert all(row["force_N"] == 0 for row in rows if row["part"] == "beyond")
    assert all(row["distance_over_equilibrium"] >= 1.5 - 1e-8 for row in rows
               if row["part"] == "beyond")
    deep = [row["stiffness_N_per_m"] for row in rows if row["part"] == "continuation"]
    assert deep and max(deep) == min(deep)


def test_the_picture_shows_every_law_by_name(solidem):
    done = solidem("law", "plot", *MIE, "label=8 < 4 & more", *PIECEWISE, "--output", "out")
    assert done.returncode == 0, done.stderr
    picture = ElementTree.parse(solidem.folder / "out.svg").getroot()
    words = " ".join("".join(node.itertext()) for node in picture.iter() if "text" in node.tag)
    words = words.replace("\u200b", "")
    for word in ("8 < 4 & more", "piecewise 1500 kN/m, 25 N", "distance δ / δeq", "N/m", "mJ",
                 "largest attraction", "tangent"):
        assert word in words
    assert "Nan" not in (solidem.folder / "out.svg").read_text(encoding="utf-8").title()


def test_figures_are_those_that_sources_give(solidem):
    done = solidem("law", "plot", "shifted-lennard-jones", "attraction=25 N",
                   "peak_separation=1.15", *PIECEWISE, "range=1.4", "--output", "out")
    assert "largest attraction 25 N at 1.15 of it" in done.stdout
    assert "stiffness there 1.5 MN/m" in done.stdout
    # A piecewise law attracts most from δ_eq + γ/K on, and so still does where its range ends.
    assert "at 1.05556 of it; 25 N where the range ends, at 1.4" in done.stdout


SCENE = """\
title = "crystal"
[specimen]
shape = "crystal"
lattice = "bcc"
cells = [4, 4, 4]
element_radius = "0.1 mm"
[material]
density = "2790 kg/m^3"
[central_forces]
law = "piecewise"
stiffness = "1500 kN/m"
attraction = "25 N"
range = 1.4
interpenetration = 0.25
[run]
steps = 10
"""


def test_the_law_of_a_scene_is_the_one_with_its_words(solidem):
    scene = solidem.scene("bar.toml", SCENE)
    done = solidem("law", "plot", scene, "label=A", "--output", "scene")
    assert done.returncode == 0, done.stderr
    words = solidem("law", "plot", *PIECEWISE, "range=1.4", "interpenetration=0.25",
                    "equilibrium=0.2 mm", "label=A", "--output", "words")
    assert words.returncode == 0, words.stderr
    assert rows_of(solidem, "scene.csv") == rows_of(solidem, "words.csv")
    assert (solidem.folder / "scene.svg").read_text() == (solidem.folder / "words.svg").read_text()
    # Two in one picture, one of them changed.
    both = solidem("law", "plot", scene, scene, "range=1.2", "label=nearer", "-o", "both")
    assert both.returncode == 0 and "nearer" in both.stdout and "of crystal" in both.stdout


def test_a_scene_without_central_forces_and_an_unreadable_one_are_told(solidem):
    beams = SCENE.replace("[central_forces]", "[beams]").replace("interpenetration = 0.25\n", "")
    for text, told in ((SCENE[:SCENE.index("[material]")], "no central forces"),
                       (beams, "bar.toml"), (SCENE.replace("1500 kN/m", "1500 kN"), "1500 kN")):
        done = solidem("law", "plot", solidem.scene("bar.toml", text), "--output", "out")
        assert done.returncode == 2 and told in done.stderr
    done = solidem("law", "plot", solidem.scene("bar.toml", SCENE), "stifness=3", "-o", "out")
    assert done.returncode == 2 and "stifness" in done.stderr
    assert not list(solidem.folder.glob("out.*"))


@pytest.mark.parametrize(("words", "told"), [
    (["mei", "energy=1 J"], ["mei", "did you mean mie", "threshold"]),
    (["mie", "energy=3 kg"], ["mie energy", "3 kg", "an energy"]),
    (["mie", "energy=3"], ["mie energy", "no unit", "mJ"]),
    (["mie", "energy=-3 J", *MIE[2:]], ["mie energy", "-3 J", "above 0"]),
    (["energy=3 J"], ["energy=3 J", "no law stands before it"]),
    (["mie", "enrgy=3 J"], ["mie enrgy", "did you mean energy"]),
    (["mie", "energy=3 J"], ["repulsive_exponent is missing"]),
    (["mie", "energy=3 J", "energy=4 J"], ["mie energy", "given twice"]),
    (["mie", "energy=3 J", "repulsive_exponent=4.5", "attractive_exponent=2"],
     ["repulsive_exponent = 4.5", "not an integer"]),
    (["mie", "energy=3 J", "repulsive_exponent=4", "attractive_exponent=5"],
     ["attractive_exponent must be below repulsive_exponent"]),
    ([*PIECEWISE, "range=0.9"], ["range = 0.9", "above 1"]),
    ([*PIECEWISE, "--equilibrium", "3 N"], ["equilibrium = 3 N", "a length"]),
    ([*PIECEWISE, "--from", "1.2", "--to", "0.9"], ["--from 1.2 --to 0.9"]),
])
def test_what_is_wrong_is_told_and_nothing_is_written(solidem, words, told):
    done = solidem("law", "plot", *words, "--output", "out")
    assert done.returncode == 2, done.stdout + done.stderr
    for word in told:
        assert word in done.stderr
    assert not list(solidem.folder.glob("out.*"))
