# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of specimens as a user meets them: formats, the body that spheres stand for, what is told."""

from __future__ import annotations

import h5py
import numpy as np
import pytest

CYLINDER = """\
[specimen]
shape = "cylinder"
axis = "z"
length = "1 mm"
radius = "0.3 mm"
elements = 600
[material]
density = "2700 kg/m^3"
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
[conduction]
law = "platonic"
initial_temperature = "298 K"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[run]
steps = 1
"""
RECIPE = CYLINDER[:CYLINDER.index("[material]")]
VOLUME = np.pi * 0.3e-3**2 * 1e-3


@pytest.fixture
def cylinder(solidem):
    """The program, and a cylinder in bar.h5 and as bare spheres in bare.csv."""
    done = solidem("specimen", solidem.scene("bar.toml", CYLINDER), "-o", "bar.h5")
    assert done.returncode == 0, done.stderr
    with h5py.File(solidem.folder / "bar.h5") as file:
        rows = np.column_stack([file["elements/position"], file["elements/radius"]])
    np.savetxt(solidem.folder / "bare.csv", rows, fmt="%.9g", delimiter=",",
               header="x,y,z,radius", comments="")
    return solidem


def mass(solidem, specimen, law="platonic"):
    """The mass that elements are given together, and what the program printed."""
    text = CYLINDER.replace(RECIPE, f"[specimen]\n{specimen}\n").replace('"platonic"', f'"{law}"')
    done = solidem("prepare", solidem.scene("scene.toml", text), "-o", "prepared.h5",
                   "--overwrite")
    if done.returncode != 0:
        return None, done.stderr
    with h5py.File(solidem.folder / "prepared.h5") as file:
        return file["mechanics/mass"][:].sum(), done.stdout


@pytest.mark.parametrize("ending", ["csv", "txt", "data"])
def test_a_cylinder_through_text_and_back_is_the_same_body(cylinder, ending):
    assert cylinder("convert", "bar.h5", f"bar.{ending}").returncode == 0
    found, told = mass(cylinder, f'file = "bar.{ending}"', "platonic-calibrated")
    assert np.isclose(found, 2700 * VOLUME, rtol=1e-12, atol=0)
    assert "its volume" not in told


def test_bare_spheres_are_no_box(cylinder):
    found, told = mass(cylinder, 'file = "bare.csv"')
    assert np.isclose(found, 2700 * VOLUME, rtol=0.03, atol=0)  # of the box around them: 27 % more
    assert "note: the specimen's file does not tell its body" in told
    for law in ("voronoi", "platonic-calibrated"):
        assert "[specimen] shape" in mass(cylinder, 'file = "bare.csv"', law)[1]
    warmed = CYLINDER.replace(RECIPE, '[specimen]\nfile = "bare.csv"\n') + """\
[[convections]]
name = "air"
wall = "z_low"
coefficient = "1000 W/(m^2 K)"
temperature = "300 K"
"""
    done = cylinder("prepare", cylinder.scene("warmed.toml", warmed), "-o", "warmed.h5")
    assert done.returncode == 2 and "[specimen] shape" in done.stderr


def test_the_scene_tells_the_body_of_a_file(cylinder):
    found, told = mass(cylinder, 'file = "bare.csv"\nvolume = "0.3 mm^3"')
    assert np.isclose(found, 2700 * 0.3e-9, rtol=1e-12, atol=0) and "its volume" not in told
    shape = 'file = "bare.csv"\nshape = "cylinder"\naxis = "z"\nlength = "1 mm"\nradius = "0.3 mm"'
    for law in ("platonic", "platonic-calibrated", "voronoi"):
        assert np.isclose(mass(cylinder, shape, law)[0], 2700 * VOLUME, rtol=1e-12, atol=0)
    assert "beyond the wall side" in mass(cylinder, shape.replace("0.3 mm", "0.2 mm"))[1]
    assert "scene.toml:" in mass(cylinder, shape + '\nvolume = "1 mm^3"')[1]
    assert "tells its body (a cylinder)" in mass(cylinder, 'file = "bar.h5"\nvolume = "1 mm^3"')[1]


def test_files_of_others(solidem):
    (solidem.folder / "chain.data").write_text(
        "chain\n\n3 atoms\n2 bonds\n\nAtoms # bpm/sphere\n\n1 1 1 .002 2500 .010 0 0\n"
        "2 1 1 .002 2500 .012 0 0\n3 1 1 .002 2500 .014 0 0\n\nBonds\n\n1 1 1 2\n2 1 2 3\n")
    done = solidem("info", "chain.data")
    assert done.returncode == 0, done.stderr
    assert "mean radius                 0.001 m" in done.stdout
    assert "0.006 x 0.002 x 0.002 m" in done.stdout
    (solidem.folder / "cell.txt").write_text("##PERIODIC:: 4 4 4\n1 1 1 1\n3 1 1 1\n")
    done = solidem("info", "cell.txt")
    assert "periodic along x, y, z" in done.stdout and "64 m3" in done.stdout, done.stderr
    done = solidem("convert", "chain.data", "chain.csv")
    assert "note: .csv holds no bonds: 2 stay behind" in done.stdout
    for command in ("info", "convert"):
        text = solidem(command, "--help").stdout
        assert "id molecule type diameter density x y z" in text and "SI units" in text


def test_two_elements_in_one_place(solidem):
    (solidem.folder / "twice.csv").write_text("x,y,z,radius\n0,0,0,1\n2,0,0,1\n2,0,0,1\n")
    text = CYLINDER.replace(RECIPE, '[specimen]\nfile = "twice.csv"\n')
    for command in ("run", "explain"):
        done = solidem(command, solidem.scene("scene.toml", text))
        assert done.returncode == 2
        assert "twice.csv: elements 1 and 2 are in one place, (2, 0, 0) m" in done.stderr


def test_pieces_are_told_before_a_run(solidem):
    (solidem.folder / "pieces.csv").write_text(
        "x,y,z,radius\n0,0,0,1\n2,0,0,1\n8,0,0,1\n10,0,0,1\n20,0,0,1\n")
    text = CYLINDER.replace(RECIPE, '[specimen]\nfile = "pieces.csv"\n')
    scene = solidem.scene("scene.toml", text)
    for words in (["run", scene], ["explain", scene], ["prepare", scene, "-o", "a.h5"],
                  ["specimen", scene, "-o", "b.h5"], ["info", "pieces.csv"],
                  ["convert", "pieces.csv", "c.h5"]):
        done = solidem(*words)
        assert done.returncode == 0, done.stderr
        assert "1 elements have no bond" in done.stdout, words
        assert "2 pieces that do not see each other" in done.stdout, words


def test_an_unknown_command_names_the_nearest(solidem):
    done = solidem("pepare", "scene.toml")
    assert done.returncode == 2
    assert "did you mean prepare?" in done.stderr


BORED = CYLINDER[CYLINDER.index("[material]"):CYLINDER.index("[beams]")].replace(
    '"platonic"', '"voronoi"') + """\
[run]
steps = 1
[[temperatures]]
name = "bore"
wall = "cut_1"
value = "350 K"
[[convections]]
name = "air"
wall = "side"
coefficient = "1000 W/(m^2 K)"
temperature = "300 K"
"""
BORE = """[[specimen.cut]]
shape = { kind = "cylinder", radius = "0.12 mm", axis = "z" }
centre = ["0 mm", "0 mm", "0.5 mm"]
"""


def test_the_wall_of_a_bore_conducts_and_a_file_keeps_it(solidem):
    """The conductance of the bore is that of rings as thick as half an element."""
    solidem.scene("made.toml", RECIPE + BORE + BORED)
    assert solidem("specimen", "made.toml", "-o", "bored.h5").returncode == 0
    done = solidem("convert", "bored.h5", "bored.csv")
    assert "where the cuts are stays behind" in done.stdout
    solidem.scene("read.toml", '[specimen]\nfile = "bored.h5"\n' + BORED)
    totals = []
    for scene in ("made", "read"):
        done = solidem("prepare", f"{scene}.toml", "-o", f"{scene}.prepared.h5")
        assert done.returncode == 0, done.stderr
        with h5py.File(solidem.folder / f"{scene}.prepared.h5") as file:
            exchanges = file["conduction/exchanges"]
            names = sorted(exchanges)
            totals.append([file["conduction/heat_capacity"][:].sum()]
                          + [exchanges[name]["conductance"][:].sum() for name in names])
    assert totals[0] == totals[1] and len(totals[0]) == 3
    volume = VOLUME - np.pi * 0.12e-3**2 * 1e-3
    assert np.isclose(totals[0][0], 2700 * 880 * volume, rtol=1e-9, atol=0)
    # Nothing but the film holds up the air: 1000 W/(m² K) over the side, in row with a thin ring.
    assert 0.9 < min(totals[0][1:]) / (1000 * 2 * np.pi * 0.3e-3 * 1e-3) < 1


def test_who_has_no_walls_at_cuts_is_told(solidem):
    solidem.scene("platonic.toml", RECIPE + BORE + BORED.replace('"voronoi"', '"platonic"'))
    done = solidem("prepare", "platonic.toml", "-o", "prepared.h5")
    assert done.returncode == 2 and 'expected [conduction] law = "voronoi"' in done.stderr
    solidem.scene("wrong.toml", RECIPE + BORE + BORED.replace("cut_1", "cut_2"))
    done = solidem("prepare", "wrong.toml", "-o", "prepared.h5")
    assert done.returncode == 2 and "expected one of cut_1, side, z_high, z_low" in done.stderr
    solidem.scene("bored.toml", RECIPE + BORE + BORED)
    assert solidem("specimen", "bored.toml", "-o", "bored.csv").returncode == 0
    solidem.scene("text.toml", '[specimen]\nfile = "bored.csv"\n' + BORED)
    done = solidem("prepare", "text.toml", "-o", "prepared.h5")
    assert done.returncode == 2 and "does not tell where its cuts are" in done.stderr
