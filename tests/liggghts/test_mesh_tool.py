# SPDX-License-Identifier: GPL-2.0-or-later
"""A ball that is thrown on a floor of facets: solidem's tool, and LIGGGHTS' own wall by a mesh."""

import csv
import math
import subprocess
from pathlib import Path

import numpy as np

from liggghts_runs import Liggghts, dump, read_dump

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/solidem"
RADIUS, STIFFNESS, FRICTION = 0.5e-3, 1e5, 0.4
START, VELOCITY = (0.1e-3, 0.05e-3, 0.51e-3), (3.0, 1.7, -1.0)
STEPS, EVERY = 4000, 100

SCENE = f"""[specimen]
file = "ball.txt"
volume = "{4 / 3 * math.pi * RADIUS**3:.17g} m^3"
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[[tools]]
name = "floor"
shape = "mesh"
file = "floor.stl"
unit = "1 m"
stiffness = "{STIFFNESS} N/m"
friction = {FRICTION}
[gravity]
acceleration = ["0 m/s^2", "0 m/s^2", "-3000 m/s^2"]
[[initial_velocities]]
region = {{ all = true }}
velocity = [{", ".join(f'"{v} m/s"' for v in VELOCITY)}]
[[sensors]]
name = "ball"
point = [{", ".join(f'"{x} m"' for x in START)}]
quantity = "position"
[run]
steps = {STEPS}
time_step = "100 ns"
observe_every = {EVERY}
"""

SCRIPT = f"""units si
atom_style granular
atom_modify map array sort 0 0
boundary f f f
newton off
communicate single vel yes
region box block -4e-3 4e-3 -4e-3 4e-3 -2e-3 4e-3 units box
create_box 1 box
neighbor 1e-4 bin
neigh_modify delay 0 every 1
fix k_n all property/global kn peratomtypepair 1 {STIFFNESS}
fix k_t all property/global kt peratomtypepair 1 {STIFFNESS * 2 / 7:.17g}
fix c_n all property/global gamman_abs peratomtypepair 1 0
fix c_t all property/global gammat_abs peratomtypepair 1 0
fix mu all property/global coefficientFriction peratomtypepair 1 {FRICTION}
pair_style gran model hooke/stiffness tangential history absolute_damping on tangential_damping off
pair_coeff * *
create_atoms 1 single {START[0]} {START[1]} {START[2]}
set atom 1 diameter {2 * RADIUS} density 2790 vx {VELOCITY[0]} vy {VELOCITY[1]} vz {VELOCITY[2]}
fix mesh all mesh/surface file floor.stl type 1
fix wall all wall/gran model hooke/stiffness tangential history mesh n_meshes 1 meshes mesh &
  absolute_damping on tangential_damping off
fix weight all gravity 3000 vector 0 0 -1
fix move all nve/sphere
timestep 1e-7
{dump("path", EVERY, "x", "y", "z")}
run {STEPS}
"""


def floor(side: float, cells: int) -> str:
    """A square of facets in the plane z = 0, in the words of STL."""
    def corner(i: int, j: int) -> str:
        return f"vertex {side * i / cells - side / 2:.17g} {side * j / cells - side / 2:.17g} 0\n"

    text = "solid floor\n"
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)
            for facet in (a + b + d, a + d + c):
                text += f"facet normal 0 0 1\nouter loop\n{facet}endloop\nendfacet\n"
    return text + "endsolid floor\n"


def test_a_ball_bounces_and_rolls_on_a_mesh_as_on_the_wall_of_liggghts(
        liggghts: Liggghts, tmp_path: Path) -> None:
    (tmp_path / "floor.stl").write_text(floor(6e-3, 12))
    (tmp_path / "ball.txt").write_text(" ".join(f"{x:.17g}" for x in (*START, RADIUS)) + "\n")
    (tmp_path / "scene.toml").write_text(SCENE)
    done = subprocess.run([PROGRAM, "run", "scene.toml", "--output", "results", "--quiet"],
                          cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with (tmp_path / "results/history.csv").open() as file:
        rows = list(csv.DictReader(file))
    ours = np.array([[float(row[f"sensor.ball.position_{axis}"]) for axis in "xyz"]
                     for row in rows])
    liggghts.run(tmp_path, SCRIPT)
    frames = read_dump(tmp_path / "path.txt")
    theirs = np.array([frames[step][0] for step in range(0, STEPS + 1, EVERY)])
    assert np.ptp(ours[:, 0]) > RADIUS  # over several facets
    assert np.abs(ours - theirs).max() < 1e-9 * RADIUS
