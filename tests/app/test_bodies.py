# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of several bodies: what runs, what it tells, and what is refused."""

from __future__ import annotations

import json
import math

import h5py
import numpy as np
import pytest

from contrib.prepared import read_specimen

BALL_AND_PLATE = """\
[[body]]
name = "plate"
shape = "plate"
length = "2 mm"
width = "2 mm"
thickness = "0.6 mm"
elements = 120
[[body.cut]]
shape = { kind = "cylinder", radius = "0.3 mm", axis = "z" }
centre = ["0.5 mm", "0.5 mm", "0.3 mm"]
[[body]]
name = "ball"
shape = "sphere"
radius = "0.5 mm"
origin = ["1 mm", "1 mm", "1.2 mm"]
elements = 40
seed = 2
[[material]]
region = { body = "plate" }
density = "2790 kg/m^3"
[[material]]
region = { body = "ball" }
density = "7850 kg/m^3"
[beams]
young_modulus = "100 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[[initial_velocities]]
region = { body = "ball" }
velocity = ["0 m/s", "0 m/s", "-10 m/s"]
[[grips]]
name = "rim"
region = { body = "plate", axis = "x", side = "low", depth = "0.2 mm" }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[run]
steps = 20
[output]
frames = 1
"""


def run(solidem, text):
    scene = solidem.scene("scene.toml", text)
    done = solidem("run", scene, "-o", "out", "--overwrite", "--quiet")
    assert done.returncode == 0, done.stderr
    return json.loads((solidem.folder / "out" / "summary.json").read_text())


def test_each_body_has_its_exact_volume_and_mass(solidem):
    summary = run(solidem, BALL_AND_PLATE)
    plate, ball = summary["bodies"]
    assert (plate["name"], ball["name"], ball["elements"]) == ("plate", "ball", 40)
    assert plate["shape"] == "plate with cuts"
    hole = math.pi * 0.3e-3**2 * 0.6e-3
    assert math.isclose(plate["volume"], 2.4e-9 - hole, rel_tol=1e-12)
    assert math.isclose(plate["mass"], 2790 * plate["volume"], rel_tol=1e-12)
    assert math.isclose(ball["mass"], 7850 * 4 / 3 * math.pi * 0.5e-3**3, rel_tol=1e-12)


def test_bodies_apart_do_not_see_each_other_and_the_trajectory_tells_them(solidem):
    run(solidem, BALL_AND_PLATE)
    with h5py.File(solidem.folder / "out" / "trajectory.h5") as file:
        body = np.array(file["elements/body"])
        frames = file["frames"]
        velocity = np.array(frames[sorted(frames)[-1]]["velocity"])
    assert np.allclose(velocity[body == 1], [0, 0, -10], rtol=1e-9, atol=1e-9)
    assert np.abs(velocity[body == 0]).max() < 1e-9  # what bonds pull by round-off
    assert "elements/body" in (solidem.folder / "out" / "trajectory.xdmf").read_text()


def test_a_prepared_file_and_its_report_keep_them(solidem):
    scene = solidem.scene("scene.toml", BALL_AND_PLATE)
    assert solidem("prepare", scene, "-o", "both.h5").returncode == 0
    told = solidem("info", "both.h5").stdout
    assert "of plate" in told and "of ball" in told
    prepared = read_specimen(solidem.folder / "both.h5")
    assert prepared.bodies == 2
    mass = prepared.column("mechanics/mass")
    whole = 2790 * (2.4e-9 - math.pi * 0.3e-3**2 * 0.6e-3) + 7850 * 4 / 3 * math.pi * 0.5e-3**3
    assert math.isclose(mass.sum(), whole, rel_tol=1e-12)
    done = solidem("convert", "both.h5", "both.data")
    assert done.returncode != 0 and "several bodies" in done.stderr


@pytest.mark.parametrize("old, new, words", [
    ('"1.2 mm"]', '"0.9 mm"]', "bodies overlap at the start"),
    ('region = { body = "ball" }\nvelocity', 'region = { body = "bal" }\nvelocity',
     'no such body (did you mean ball?)'),
    ('name = "ball"', 'name = "plate"', "plate"),
    ('name = "ball"', 'name = "ball"\nbonded_to = ["wall"]', 'bonded_to "wall"'),
    ('[[material]]', '[specimen]\nshape = "box"\n[[material]]', "body"),
    ('radius = "0.3 mm", axis = "z"', 'radius = "0.05 mm", axis = "z"', "wide, less than an element"),
    ('centre = ["0.5 mm"', 'centre = ["5 mm"', "lies outside of the body"),
    ('[run]', '[gauge]\naxis = "x"\nlower = "0.5 mm"\nupper = "1.5 mm"\n[run]', "one section"),
])
def test_what_makes_no_sense_is_refused(solidem, old, new, words):
    scene = solidem.scene("scene.toml", BALL_AND_PLATE.replace(old, new, 1))
    done = solidem("explain", scene)
    assert done.returncode != 0
    assert words in done.stderr, done.stderr


BOX_OBJ = """\
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
v 0 0 1
v 2 0 1
v 2 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""
MESH = """\
[specimen]
shape = "mesh"
mesh = "box.obj"
mesh_unit = "1 mm"
elements = 150
[[specimen.cut]]
mesh = "box.obj"
mesh_unit = "0.4 mm"
centre = ["0.6 mm", "0.8 mm", "0.3 mm"]
"""


def test_a_mesh_is_packed_and_cut_by_a_mesh(solidem):
    (solidem.folder / "box.obj").write_text(BOX_OBJ)
    scene = solidem.scene("scene.toml", MESH)
    done = solidem("specimen", scene, "-o", "mesh.h5")
    assert done.returncode == 0, done.stderr
    with h5py.File(solidem.folder / "mesh.h5") as file:
        # The cut is 0.8 by 0.4 by 0.4 mm, and 0.2 mm of its width are in the body.
        volume = 2e-9 - 0.8e-3 * 0.2e-3 * 0.4e-3
        assert math.isclose(file["domain"].attrs["volume"], volume, rel_tol=1e-9)
        position = np.array(file["elements/position"])
    assert (position > 0).all() and (position < [2e-3, 1e-3, 1e-3]).all()
    inside = (position > [0.6e-3, 0.8e-3, 0.3e-3]) & (position < [1.4e-3, 1.2e-3, 0.7e-3])
    assert not inside.all(axis=1).any()


@pytest.mark.parametrize("spoil, words", [
    (lambda text: text.replace("f 1 4 3 2\n", ""), "closed"),
    (lambda text: text.replace("f 1 4 3 2", "f 1 2 3 4"), "facet"),
    (lambda text: text.replace("v 2 0 0", "v nan 0 0"), "facet"),
])
def test_meshes_that_bound_no_body_are_refused(solidem, spoil, words):
    (solidem.folder / "box.obj").write_text(spoil(BOX_OBJ))
    done = solidem("specimen", solidem.scene("scene.toml", MESH), "-o", "mesh.h5")
    assert done.returncode != 0
    assert "box.obj" in done.stderr and words in done.stderr, done.stderr


def test_a_mesh_in_wrong_units_makes_too_many_elements(solidem):
    (solidem.folder / "box.obj").write_text(BOX_OBJ)
    text = MESH.replace("elements = 150", 'mean_radius = "0.06 mm"').replace('"1 mm"', '"1 m"')
    done = solidem("specimen", solidem.scene("scene.toml", text), "-o", "mesh.h5")
    assert done.returncode != 0
    assert "elements: at most" in done.stderr and "mesh_unit" in done.stderr, done.stderr

CUT = """\
[specimen]
shape = "cylinder"
axis = "z"
length = "2 mm"
radius = "0.5 mm"
elements = 150
[[specimen.cut]]
shape = { kind = "box", size = ["1 mm", "1 mm", "0.5 mm"] }
centre = ["0.5 mm", "0 mm", "1 mm"]
"""


def test_a_cut_body_keeps_its_volume_in_text(solidem):
    scene = solidem.scene("scene.toml", CUT)
    assert solidem("specimen", scene, "-o", "cut.h5").returncode == 0
    for there, back in [("cut.data", "data.h5"), ("cut.csv", "csv.h5"), ("cut.txt", "txt.h5")]:
        assert solidem("convert", "cut.h5", there).returncode == 0
        assert solidem("convert", there, back).returncode == 0
        with h5py.File(solidem.folder / back) as file:
            domain = file["domain"].attrs
            half_slice = 0.5 * math.pi * 0.5e-3**2 * 0.5e-3
            assert math.isclose(domain["volume"], math.pi * 0.5e-3**2 * 2e-3 - half_slice,
                                rel_tol=1e-12)
            assert domain["cuts"] == 1


def test_a_body_that_is_cut_already_is_not_cut_again(solidem):
    scene = solidem.scene("scene.toml", CUT)
    assert solidem("specimen", scene, "-o", "cut.h5").returncode == 0
    again = '[specimen]\nfile = "cut.h5"\n' + CUT[CUT.index("[[specimen.cut]]"):]
    done = solidem("specimen", solidem.scene("again.toml", again), "-o", "again.h5")
    assert done.returncode != 0 and "cut already" in done.stderr, done.stderr
