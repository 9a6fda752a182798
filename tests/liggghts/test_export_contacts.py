# SPDX-License-Identifier: GPL-2.0-or-later
"""Loose grains, bonded bodies and tools: solidem's runs against LIGGGHTS' own laws, exported."""

import csv
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

from liggghts_runs import CONTRIB, Liggghts, read_dump

PROGRAM = CONTRIB.parents[1] / "build" / "release" / "solidem"
RADIUS = 1e-3

RUN = '[run]\nsteps = {steps}\ntime_step = "{step} ns"\nobserve_every = 10\n[output]\nframes = 10\n'
GRAVITY = '[gravity]\nacceleration = ["100 m/s^2", "0 m/s^2", "-1000 m/s^2"]\n'
CONTACT = '[contact]\nyoung_modulus = "5 GPa"\n'
FLOOR = """[[tools]]
name = "floor"
shape = "plane"
origin = ["0 mm", "0 mm", "-0.001 mm"]
stiffness = "2e6 N/m"
"""


def grains(*, velocity: str = '["1 m/s", "0.5 m/s", "-2 m/s"]') -> str:
    """Grains of two sizes that fly together and downwards."""
    return ('[specimen]\nfile = "grains.txt"\nvolume = "1 mm^3"\n[material]\ndensity = "2500 kg/m^3"\n'
            f"{CONTACT}[[initial_velocities]]\nregion = {{ all = true }}\nvelocity = {velocity}\n"
            'stretching = ["-400 1/s", "-300 1/s", "0 1/s"]\n')


def write_grains(folder: Path) -> None:
    """27 of two radii by turns on a lattice, each a little off its place; none touches another."""
    random = np.random.default_rng(3)
    place = np.stack(np.meshgrid(*[np.arange(3)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    radius = np.where(np.arange(27) % 2 == 0, RADIUS, 0.9 * RADIUS)
    place = 1.925 * RADIUS * place + random.uniform(-9e-6, 9e-6, (27, 3)) + [0, 0, 1.01 * RADIUS]
    rows = np.column_stack([place, radius])
    (folder / "grains.txt").write_text(
        "".join(" ".join(f"{x:.17g}" for x in row) + "\n" for row in rows))


def write_sheet(folder: Path) -> None:
    """A square of 8 facets about the origin, mm."""
    text, at = "solid sheet\n", np.linspace(-15, 15, 3)
    for i in range(2):
        for j in range(2):
            a, b, c, d = ((at[i + x], at[j + y]) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
            for facet in ((a, b, c), (a, c, d)):
                corners = "".join(f"vertex {x:.17g} {y:.17g} 0\n" for x, y in facet)
                text += f"facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n"
    (folder / "sheet.stl").write_text(text + "endsolid sheet\n")


def solidem(folder: Path, *words: str) -> str:
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def export(folder: Path, scene: str, *options: str) -> subprocess.CompletedProcess:
    """Exports a scene to the folder `out`."""
    write_grains(folder)
    write_sheet(folder)
    (folder / "scene.toml").write_text(scene)
    solidem(folder, "prepare", "scene.toml", "--output", "prepared.h5", "--overwrite")
    (folder / "explained.json").write_text(
        solidem(folder, "explain", "scene.toml", "--json", "--quick"))
    return subprocess.run([CONTRIB / "export.py", "prepared.h5", "explained.json", "out", *options],
                          cwd=folder, capture_output=True, text=True)


class Both:
    """A scene in both codes: frames of position by step, and solidem's history."""

    def __init__(self, liggghts: Liggghts, folder: Path, scene: str, *options: str, ranks: int = 1):
        folder.mkdir(exist_ok=True)
        done = export(folder, scene, *options)
        assert done.returncode == 0, done.stderr
        liggghts.run(folder / "out", (folder / "out" / "run.in").read_text(), ranks)
        self.rows = read_dump(folder / "out" / "state.txt")
        self.theirs = {step: rows[:, :3] for step, rows in self.rows.items()}
        solidem(folder, "run", "scene.toml", "--output", "results", "--quiet", "--overwrite")
        with h5py.File(folder / "results" / "trajectory.h5") as file:
            frames = [group["position"][:] for _, group in sorted(file["frames"].items())]
        self.ours = dict(zip(sorted(self.theirs), frames))
        with (folder / "results" / "history.csv").open() as file:
            self.history = list(csv.DictReader(file))

    def largest(self, column: str) -> float:
        """Largest size of a column of the history."""
        return max(abs(float(row[column])) for row in self.history)

    def difference(self) -> float:
        """Over the largest displacement of the run."""
        assert len(self.ours) == len(self.theirs) == 11
        start = self.ours[0]
        moved = max(float(np.abs(frame - start).max()) for frame in self.ours.values())
        return max(float(np.abs(self.ours[k] - self.theirs[k]).max()) for k in self.ours) / moved


def with_tools(tools: str, steps: int = 600, step: float = 50) -> str:
    return grains() + GRAVITY + tools + RUN.format(steps=steps, step=step)


SLOPE = """[[tools]]
name = "slope"
shape = "plane"
origin = ["4.359 mm", "0 mm", "0 mm"]
normal = [-0.8, 0, 0.6]
"""
LID = """[[tools]]
name = "lid"
shape = "mesh"
file = "sheet.stl"
unit = "1 mm"
origin = ["2 mm", "2.1 mm", "5.91 mm"]
tilt_axis = [1, 0, 0]
tilt_angle = "0.3 degree"
velocity = ["0.2 m/s", "0 m/s", "-10 m/s"]
angular_velocity = "40 rad/s"
rotation_axis = [0, 0.6, 0.8]
rotation_point = ["1 mm", "0 mm", "7 mm"]
stiffness = "3e6 N/m"
"""


def test_loose_grains_between_planes_move_alike(liggghts: Liggghts, tmp_path: Path) -> None:
    """Of two sizes; a plane across an axis, one aslant, one that rises."""
    rising = FLOOR.replace("floor", "piston").replace("-0.001", "-0.2") + (
        'velocity = ["0 m/s", "0 m/s", "8 m/s"]\n')
    both = Both(liggghts, tmp_path, with_tools(FLOOR + SLOPE + rising))
    for tool in ("floor", "slope", "piston"):
        assert both.largest(f"tool.{tool}.force_z") > 1
    assert both.largest("contacts") >= 10
    assert both.difference() < 1e-9


def test_loose_grains_under_a_mesh_that_comes_down_and_turns_move_alike(
        liggghts: Liggghts, tmp_path: Path) -> None:
    both = Both(liggghts, tmp_path, with_tools(FLOOR + LID))
    assert both.largest("tool.lid.force_z") > 1
    assert both.difference() < 1e-9


def test_a_hit_by_a_dashpot_differs_in_first_order_of_the_step(
        liggghts: Liggghts, tmp_path: Path) -> None:
    floor = FLOOR + "restitution = 0.5\n"
    found = [Both(liggghts, tmp_path / str(n), with_tools(floor, 200 * n, 50 / n),
                  "--nearly").difference() for n in (1, 2)]
    assert found[0] / found[1] == pytest.approx(2, rel=0.1)
    assert found[0] < 0.01


def test_friction_of_a_tool_differs_by_the_overlap(liggghts: Liggghts, tmp_path: Path) -> None:
    """LIGGGHTS has it act at the middle of the overlap, so that a hundred times the stiffness brings
    a tenth of the difference."""
    found = []
    for stiffness, steps, step in (("2e6", 60, 50), ("2e8", 60, 5)):
        floor = FLOOR.replace("2e6", stiffness).replace("-0.001", "0.00") + "friction = 2\n"
        scene = with_tools(floor, steps, step).replace("-2 m/s", "-0.5 m/s").replace(
            '"grains.txt"', '"ball.txt"')
        folder = tmp_path / stiffness
        folder.mkdir()
        (folder / "ball.txt").write_text(f"0 0 {RADIUS} {RADIUS}\n")
        found.append(Both(liggghts, folder, scene, "--nearly").difference())
    assert found[0] / found[1] == pytest.approx(10, rel=0.2)
    assert found[0] < 0.001


BEAMS = """[beams]
young_modulus = "200 GPa"
poisson_ratio = 0.3
radius_ratio = 0.4
"""
BLOCK = """[specimen]
shape = "box"
size = ["6 mm", "6 mm", "6 mm"]
elements = 120
[material]
density = "2500 kg/m^3"
"""
FALLS = ('[[initial_velocities]]\nregion = {{ {region} }}\n'
         'velocity = ["2 m/s", "1 m/s", "{speed} m/s"]\n')


def test_a_bonded_block_on_tools_moves_alike(liggghts: Liggghts, tmp_path: Path) -> None:
    """Its spheres overlap where bonds join them; only the tools push."""
    floor = FLOOR.replace("-0.001", "-0.2") + 'angular_velocity = "50 rad/s"\nrotation_axis = [0, 0, 1]\n'
    both = Both(liggghts, tmp_path, BLOCK + BEAMS + GRAVITY + floor
                + FALLS.format(region="all = true", speed=-20) + RUN.format(steps=600, step=30))
    assert both.largest("tool.floor.force_z") > 10
    assert np.abs(both.rows[0][:, 6:8] / both.rows[0][:, 8:9]).max() == pytest.approx(0.1)  # weight
    assert both.difference() < 1e-9


BODIES = """[[body]]
name = "plate"
shape = "plate"
length = "4 mm"
width = "4 mm"
thickness = "0.6 mm"
elements = 300
[[body]]
name = "ball"
shape = "sphere"
radius = "0.6 mm"
origin = ["1.6 mm", "1.6 mm", "1.23 mm"]
elements = 50
seed = 2
[[material]]
region = { body = "plate" }
density = "2790 kg/m^3"
[[material]]
region = { body = "ball" }
density = "7850 kg/m^3"
[[grips]]
name = "rim"
region = { body = "plate", axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
"""
MEET = (BODIES + BEAMS + '[contact]\nnormal_stiffness = "3e6 N/m"\n'
        + FALLS.format(region='body = "ball"', speed=-50))


@pytest.mark.parametrize("ranks", [1, 2])
def test_two_bonded_bodies_meet_alike(liggghts: Liggghts, tmp_path: Path, ranks: int) -> None:
    """Bonds inside of each, contacts between them: no pair is pushed by both, to the last digits."""
    both = Both(liggghts, tmp_path, MEET + RUN.format(steps=600, step=5), ranks=ranks)
    assert both.largest("contacts") >= 3
    assert np.abs(both.rows[0][:, 6:]).max() < 1e-9, "bonded spheres that overlap push each other"
    assert both.difference() < 1e-9


CRYSTAL = """[[body]]
name = "{name}"
shape = "crystal"
lattice = "simple_cubic"
cells = [{cells}]
element_radius = "0.5 mm"
origin = [{origin}]
"""
CRYSTALS = (CRYSTAL.format(name="low", cells="3, 3, 2", origin='"0 mm", "0 mm", "0 mm"')
            + CRYSTAL.format(name="ball", cells="2, 2, 2", origin='"0.3 mm", "0.4 mm", "1.87 mm"')
            + '[material]\ndensity = "2500 kg/m^3"\n')


def test_contacts_as_stiff_as_bonds_are_so_in_liggghts(liggghts: Liggghts, tmp_path: Path) -> None:
    both = Both(liggghts, tmp_path, CRYSTALS + BEAMS + "[contact]\nstiffness_ratio = 0.7\n"
                + FALLS.format(region='body = "ball"', speed=-20) + RUN.format(steps=600, step=5))
    assert both.largest("contacts") >= 4
    assert both.difference() < 1e-9


@pytest.mark.parametrize("scene, words", [
    (grains() + FLOOR + "friction = 0.3\n", "tool floor: friction acts at the middle"),
    (grains() + FLOOR + "restitution = 0.3\n", "restitution: dashpots see the velocity"),
    (grains().replace(CONTACT, CONTACT + "friction = 0.1\n"), "[contact] friction: its force does not"),
    (grains() + FLOOR.replace('"plane"', '"box"\nsize = ["9 mm", "9 mm", "1 mm"]').replace(
        "-0.001", "-0.6"), "tool floor: over a face, nearer to its edge"),
    (MEET + "[rupture]\nstrain = 0.1\n", "[contact] with friction, restitution or a stiffness"),
    (MEET.replace('normal_stiffness = "3e6 N/m"', "") + "[rupture]\nstrain = 0.1\n",
     "with 2 bodies"),
    (MEET.replace('normal_stiffness = "3e6 N/m"', ""), "different radii; LIGGGHTS has one stiffness"),
    (grains() + FLOOR.replace('"plane"', '"sphere"\nradius = "2 mm"').replace("-0.001", "-3"),
     "tool floor: a sphere has no wall in LIGGGHTS"),
    (grains() + FLOOR.replace("-0.001", "0.1"), "elements overlap it at the start, the deepest by"),
    (grains() + FLOOR + 'velocity = ["0 m/s", "0 m/s", { time = ["0 s", "1 us"], value = ["0 m/s", '
     '"1 m/s"] }]\n', "tool floor: "),
    (grains() + FLOOR + 'force = "1 N"\nforce_axis = [0, 0, 1]\nmass = "1 g"\n',
     "tool floor: is moved by a force"),
    (grains() + "[damping]\nlocal = 0.1\n", "[damping] local is not supported"),
    (grains() + '[damping]\nviscous = "1e4 1/s"\n', "viscous damping is not understood"),
], ids=lambda text: "" if "\n" in text else text)
def test_what_is_not_the_same_is_refused_by_name(tmp_path: Path, scene: str, words: str) -> None:
    done = export(tmp_path, scene + RUN.format(steps=10, step=5))
    assert done.returncode != 0
    assert words in done.stderr
    assert not (tmp_path / "out" / "run.in").exists()


def test_elements_that_overlap_at_the_start_are_named(tmp_path: Path) -> None:
    """solidem has them touch where they stand."""
    crystal = grains().replace('file = "grains.txt"\nvolume = "1 mm^3"\n',
                               'shape = "box"\nsize = ["5 mm", "5 mm", "5 mm"]\nelements = 60\n').replace(
                                   CONTACT, CONTACT + 'initial_overlap = "kept"\n')
    done = export(tmp_path, crystal + RUN.format(steps=10, step=5))
    assert "which no bond joins, overlap by" in done.stderr
