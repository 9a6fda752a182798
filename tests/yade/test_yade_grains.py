# SPDX-License-Identifier: GPL-2.0-or-later
"""Loose grains among moving walls: solidem's tools, and YADE's own walls, facets and law."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
from prepared_bar import run_yade

from compare.result import CodeFailure

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/solidem"
RADIUS = 1e-3

SCENE = """[specimen]
file = "grains.txt"
volume = "1 mm^3"
[material]
density = "2500 kg/m^3"
[contact]
normal_stiffness = "5 kN/mm"
[[tools]]
name = "floor"
shape = "plane"
origin = ["0 mm", "0 mm", "-0.001 mm"]
stiffness = "2 kN/mm"
friction = 0.4
[[tools]]
name = "side"
shape = "plane"
normal = [-1, 0, 0]
origin = ["4.9 mm", "0 mm", "0 mm"]
velocity = ["-5 m/s", "2 m/s", "0 m/s"]
stiffness = "3 kN/mm"
friction = 0.2
[gravity]
acceleration = ["100 m/s^2", "0 m/s^2", "-1000 m/s^2"]
[[initial_velocities]]
region = { all = true }
velocity = ["1 m/s", "0.5 m/s", "-2 m/s"]
stretching = ["-400 1/s", "-300 1/s", "0 1/s"]
[run]
steps = 600
time_step = "50 ns"
observe_every = 10
[output]
frames = 10
"""


def solidem(folder: Path, *words: str) -> str:
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def prepare(folder: Path, scene: str) -> dict:
    """Writes 27 grains of two radii by turns that touch nothing, and what YADE is told of them."""
    random = np.random.default_rng(3)
    place = np.stack(np.meshgrid(*[np.arange(3)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    place = 1.925 * RADIUS * place + random.uniform(-9e-6, 9e-6, (27, 3)) + [0, 0, 1.01 * RADIUS]
    radius = np.where(np.arange(27) % 2 == 0, RADIUS, 0.9 * RADIUS)
    (folder / "grains.txt").write_text("".join(
        " ".join(f"{x:.17g}" for x in row) + "\n" for row in np.column_stack([place, radius])))
    (folder / "scene.toml").write_text(scene)
    solidem(folder, "prepare", "scene.toml", "--output", "prepared.h5")
    return json.loads(solidem(folder, "explain", "scene.toml", "--json", "--quick"))


def positions(folder: Path) -> np.ndarray:
    """(frames, N, 3) m"""
    with h5py.File(folder / "trajectory.h5") as file:
        return np.array([frame["position"][:] for _, frame in sorted(file["frames"].items())])


def write_block(folder: Path, low: tuple, high: tuple) -> None:
    """A block of twelve facets; those above and below meet along a line from corner to corner."""
    corner = np.array([[(low, high)[k >> a & 1][a] for a in range(3)] for k in range(8)])
    facets = [(0, 3, 1), (0, 2, 3), (4, 5, 7), (4, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3),
              (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    (folder / "block.stl").write_text("solid block\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" + "".join(
            "vertex " + " ".join(f"{x:.17g}" for x in corner[v]) + "\n" for v in facet)
        + "endloop\nendfacet\n" for facet in facets) + "endsolid block\n")


PLANE = 'shape = "plane"\norigin = ["0 mm", "0 mm", "-0.001 mm"]'
MESH = ('shape = "mesh"\nfile = "block.stl"\nunit = "1 mm"\n'
        'origin = ["0 mm", "0 mm", "-0.001 mm"]')
BOX = 'shape = "box"\nsize = ["90 mm", "30 mm", "2 mm"]\norigin = ["40 mm", "8 mm", "-1.001 mm"]'


@pytest.mark.parametrize("old, new", [
    ("", ""),
    ('normal = [-1, 0, 0]|friction = 0.2', 'normal = [-1, 0.02, 0.03]|'),
    (PLANE + "|friction = 0.4", MESH + "|"),
    (PLANE + "|friction = 0.4", BOX + "|"),
], ids=["walls", "an oblique plane", "a mesh", "a box"])
def test_grains_rub_along_tools_alike(tmp_path: Path, old: str, new: str) -> None:
    """Two sizes, a stiffness and a friction for each tool, one that comes and slides."""
    write_block(tmp_path, (-4, -40, -2), (40, 4, 0))
    scene = SCENE
    for before, after in zip(old.split("|"), new.split("|"), strict=True):
        scene = scene.replace(before, after)
    task = prepare(tmp_path, scene)
    run_yade(tmp_path / "prepared.h5", task, tmp_path / "yade")
    solidem(tmp_path, "run", "scene.toml", "--output", "results", "--quiet")
    ours, theirs = positions(tmp_path / "results"), positions(tmp_path / "yade" / "results")
    assert ours.shape == theirs.shape == (11, 27, 3)
    summary = json.loads((tmp_path / "results" / "summary.json").read_text())
    assert summary["tools"]["side"]["work"] > 0 and np.ptp(ours[-1] - ours[0], axis=0).max() > 1e-5
    assert np.abs(ours - theirs).max() < 1e-9 * np.abs(ours - ours[0]).max()


@pytest.mark.parametrize("old, new, words", [
    (PLANE, 'shape = "sphere"\nradius = "1 mm"\norigin = ["0 mm", "0 mm", "-1.001 mm"]',
     "tool floor: planes, boxes and meshes are understood"),
    ("friction = 0.2", 'angular_velocity = "1 rad/s"\nrotation_axis = [1, 0, 0]',
     "tool side: tools that do not turn"),
    (PLANE + '\nstiffness = "2 kN/mm"\nfriction = 0.4', MESH + '\nstiffness = "2 kN/mm"',
     "tool floor: element"),
    ("normal = [-1, 0, 0]", "normal = [-1, 0, 0.1]", "tool side: friction on facets"),
    ("friction = 0.2", "restitution = 0.2", "tool side: restitution: YADE's native law"),
    ('normal_stiffness = "5 kN/mm"', 'young_modulus = "5 GPa"', "elements of one radius"),
    ('"-0.001 mm"', '"0.1 mm"', "tool floor: elements overlap it at the start"),
], ids=["sphere", "turning", "side of two facets",
        "friction on a facet", "restitution", "two radii", "overlap"])
def test_what_walls_and_facets_are_not_is_told(tmp_path: Path, old: str, new: str,
                                               words: str) -> None:
    assert old in SCENE
    write_block(tmp_path, (-4, -4, -2), (8, 8, 0))  # the line lies below the middle of the grains
    task = prepare(tmp_path, SCENE.replace(old, new))
    with pytest.raises(CodeFailure):
        run_yade(tmp_path / "prepared.h5", task, tmp_path / "yade")
    assert words in (tmp_path / "yade" / "output.log").read_text()
