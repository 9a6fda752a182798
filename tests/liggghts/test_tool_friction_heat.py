# SPDX-License-Identifier: GPL-2.0-or-later
"""Heat of friction with tools: exported scenes against solidem, on ranks, through a restart; bad words.

Where nothing spins LIGGGHTS' friction is solidem's: the two agree to round-off there.
"""

from pathlib import Path

import h5py
import numpy as np
import pytest

from liggghts_runs import HEADER, Liggghts, read_dump, thermo
from test_export_contacts import write_sheet
from test_friction_heat import (CONDUCTION, CONSTANTS, IN_THE_FILE, INITIAL, MATERIAL, RUN, STEPS,
                                TWO, differences, export, history, script, worst)

BLOCK = """\
[[body]]
name = "block"
shape = "crystal"
lattice = "simple_cubic"
cells = [4, 2, 2]
element_radius = "0.5 mm"
origin = ["0 mm", "0 mm", "0 mm"]

""" + MATERIAL + """
[conduction]
law = "platonic"
initial_temperature = "300 K"

[friction_heat]
fraction = 0.8
"""
#: Of steel: it takes its share of the heat.
METAL = """\
conductivity = "45 W/(m K)"
density = "7850 kg/m^3"
specific_heat_capacity = "480 J/(kg K)"
"""
FLOOR = """
[[tools]]
name = "floor"
shape = "plane"
origin = ["0 mm", "-0.0001 mm", "0 mm"]
normal = [0, 1, 0]
stiffness = "3e6 N/m"
friction = 0.3
"""
LID = """
[[tools]]
name = "lid"
shape = "mesh"
file = "sheet.stl"
unit = "1 mm"
origin = ["1.7 mm", "2.0001 mm", "1.2 mm"]
tilt_axis = [1, 0, 0]
tilt_angle = "90 degree"
velocity = ["0 m/s", "-0.4 m/s", "0 m/s"]
angular_velocity = "3000 rad/s"
rotation_axis = [0, 1, 0]
stiffness = "3e6 N/m"
friction = 0.4
"""
DRAGGED = """
[[grips]]
name = "all"
region = { body = "block" }
velocity = ["5 m/s", "-0.2 m/s", "1 m/s"]
"""
THROWN = """
[[initial_velocities]]
region = { body = "block" }
velocity = ["5 m/s", "-2 m/s", "0 m/s"]
"""
HELD = DRAGGED.replace("5 m/s", "0 m/s").replace("-0.2 m/s", "0 m/s").replace("1 m/s", "0 m/s")


class Both:
    """A scene in both codes: frames of position and temperature, and histories."""

    def __init__(self, liggghts: Liggghts, folder: Path, scene: str, step: str = "20 ns"):
        folder.mkdir(exist_ok=True)
        write_sheet(folder)
        heats = " ".join(f"f_friction[{k + 1}]" for k in range(scene.count("[[tools]]")))
        text = script(folder, scene, heats, RUN.replace("20 ns", step))
        said = liggghts.run(folder, text + f"run {STEPS}\n")
        self.rows, self.frames = thermo(said), read_dump(folder / "state.txt")
        self.ours = history(folder)
        with h5py.File(folder / "results" / "trajectory.h5") as file:
            self.kept = [(frame["position"][:], frame["temperature"][:])
                         for _, frame in sorted(file["frames"].items())]
        assert len(self.kept) == len(self.frames) == len(self.rows) == len(self.ours) == 11

    def column(self, name: str) -> np.ndarray:
        return np.array([row[name] for row in self.ours])

    def off(self) -> tuple[float, float]:
        """Of all frames: positions over the way, temperatures over the rise."""
        way = np.abs(self.kept[-1][0] - self.kept[0][0]).max()
        rise = max(float(np.abs(temperature - INITIAL).max()) for _, temperature in self.kept)
        assert rise > 1e-3
        found = [(worst(self.frames[step][:, :3], x, way or 1.0), worst(self.frames[step][:, 3], t, rise))
                 for step, (x, t) in zip(sorted(self.frames), self.kept)]
        return tuple(np.max(found, axis=0))

    def require_closed_books(self) -> None:
        """What slip made is in the atoms, waits for them, or is in tools."""
        gained = self.rows[:, 2] - self.rows[0, 2] + self.rows[:, 3] + self.rows[:, 4:].sum(axis=1)
        assert gained == pytest.approx(0.8 * self.rows[:, 1], abs=1e-14 * self.rows[0, 2])


def test_a_block_that_is_dragged_over_a_plane_is_as_warm_as_in_solidem(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    both = Both(liggghts, tmp_path, BLOCK + FLOOR + METAL + DRAGGED)
    print(both.off())
    assert max(both.off()) <= 1e-9
    both.require_closed_books()
    assert both.rows[-1, 1] > 1e-4
    assert both.rows[:, 1] == pytest.approx(both.column("friction"), rel=1e-9)
    assert both.rows[-1, 4] > 0.3 * 0.8 * both.rows[-1, 1]
    assert both.rows[:, 4] == pytest.approx(both.column("tool.floor.heat"), rel=1e-9)


def test_under_a_mesh_that_moves_it_is_as_warm_as_in_solidem(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """The lid comes down and goes sideways, over several facets."""
    lid = LID[: LID.index("velocity")] + ('velocity = ["7 m/s", "-0.4 m/s", "3 m/s"]\n'
                                          'stiffness = "3e6 N/m"\nfriction = 0.4\n')
    both = Both(liggghts, tmp_path, BLOCK + lid + METAL + HELD)
    print(both.off())
    assert max(both.off()) <= 1e-9
    both.require_closed_books()
    assert both.rows[:, 4] == pytest.approx(both.column("tool.lid.heat"), rel=1e-9)


def test_where_a_mesh_turns_it_differs_by_the_square_of_the_overlap(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    """LIGGGHTS' spring does not turn with the lid, and lags behind the slip by an angle that grows
    with the overlap."""
    both = Both(liggghts, tmp_path, BLOCK + LID + HELD)
    off = both.rows[1:, 1] / both.column("friction")[1:] - 1
    print(both.off(), off)
    assert max(both.off()) <= 1e-5
    both.require_closed_books()
    assert off[9] / off[4] == pytest.approx(4, rel=0.1)
    assert both.rows[-1, 4] == 0  # it takes none


def test_where_elements_roll_it_differs_by_the_overlap(liggghts: Liggghts, tmp_path: Path) -> None:
    """LIGGGHTS has friction act at the middle of the overlap, of which a hundred times all stiffness
    leaves a tenth."""
    found = []
    for factor, step in ((1, "20 ns"), (100, "2 ns")):
        scene = BLOCK + FLOOR + METAL + THROWN
        for old, new in (("3e6 N/m", f"{3e6 * factor} N/m"), ("200 GPa", f"{200 * factor} GPa"),
                         ("-0.0001", "-0.00000001")):
            scene = scene.replace(old, new)
        both = Both(liggghts, tmp_path / str(factor), scene, step)
        both.require_closed_books()
        found.append(both.off()[1])
    print(found)
    assert found[0] / found[1] == pytest.approx(10, rel=0.2)
    assert found[0] < 2e-3


def test_heat_that_waits_comes_a_step_later(liggghts: Liggghts, tmp_path: Path) -> None:
    """With every = 7, and between two steps of heat: the books close, what tools took is the same."""
    every = BLOCK.replace("[conduction]", "[conduction]\nevery = 7")
    both = Both(liggghts, tmp_path, every + FLOOR + METAL + DRAGGED)
    print(both.off())
    both.require_closed_books()
    assert both.rows[-1, 3] > 0  # waits
    assert both.rows[:, 4] == pytest.approx(both.column("tool.floor.heat"), rel=1e-9)
    assert both.off()[1] <= 1e-2


@pytest.fixture(scope="module")
def whole(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> tuple:
    """The block between floor and lid on one rank: frames by step, and rows of figures."""
    folder = tmp_path_factory.mktemp("whole")
    said = liggghts.run(folder, between(folder) + f"run {STEPS}\n")
    return read_dump(folder / "state.txt"), thermo(said)


def between(folder: Path) -> str:
    """The script of the block between floor and lid, up to its run."""
    write_sheet(folder)
    return script(folder, BLOCK + FLOOR + METAL + LID + METAL + THROWN,
                  "f_friction[1] f_friction[2]")


def require_the_same(whole: tuple, frames: dict[int, np.ndarray], rows: np.ndarray) -> None:
    """At the end: places, temperatures, work of slip, and heat of both tools."""
    found = differences(whole, frames)
    print(found, rows[-1, [1, 4, 5]] / whole[1][-1, [1, 4, 5]] - 1)
    assert max(found) <= 1e-9
    assert (whole[1][-1, [1, 4, 5]] > 1e-6).all()
    assert rows[-1, [1, 4, 5]] == pytest.approx(whole[1][-1, [1, 4, 5]], rel=1e-9)


@pytest.mark.parametrize("ranks", [2, 4])
def test_ranks_differ_by_round_off(
    liggghts: Liggghts, tmp_path: Path, whole: tuple, ranks: int
) -> None:
    said = liggghts.run(tmp_path, between(tmp_path) + f"run {STEPS}\n", ranks)
    require_the_same(whole, read_dump(tmp_path / "state.txt"), thermo(said))


def test_a_restart_while_they_rub_goes_on_as_one_run(
    liggghts: Liggghts, tmp_path: Path, whole: tuple
) -> None:
    text, half = between(tmp_path), 200
    liggghts.run(tmp_path, text + f"run {half}\nwrite_restart half.restart\n", 2)
    for name, words in (("beams.in", (tmp_path / "beams.in").read_text()),
                        ("heat.in", (tmp_path / "heat.in").read_text()), ("resumed", text)):
        kept = "".join(line for line in words.splitlines(keepends=True)
                       if not line.startswith(IN_THE_FILE))
        (tmp_path / name).write_text(kept.replace("read_data       body.data",
                                                  "read_restart    half.restart"))
    said = liggghts.run(tmp_path, (tmp_path / "resumed").read_text() + f"run {STEPS - half}\n")
    rows = thermo(said)
    assert 0 < rows[0, 1] < 0.9 * whole[1][-1, 1]
    require_the_same(whole, read_dump(tmp_path / "state.txt"), rows)


WALL = ("fix wall all wall/gran model {} primitive type 1 xplane -4e-3 "
        "absolute_damping on tangential_damping off\n")
SMOOTH = "pair_style none\n"
FRICTION = "fix friction all solidem/friction {}\n"


def require_refused(liggghts: Liggghts, folder: Path, lines: str, message: str) -> None:
    """A script with these lines ends with this word."""
    TWO.write(folder / "body.data")
    text = (HEADER + "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 nsq\n"
            + CONSTANTS + SMOOTH + lines + "bond_style none\n")
    with pytest.raises(AssertionError) as failure:
        liggghts.run(folder, text + "timestep 1e-9\nrun 1\n")
    assert message in str(failure.value)


@pytest.mark.parametrize("lines, message", [
    (WALL.format("hooke/stiffness tangential history") + CONDUCTION + FRICTION.format("tool wall -1"),
     "the effusivity of tool wall must not be negative, but is -1"),
    (WALL.format("hooke/stiffness tangential history") + CONDUCTION + FRICTION.format("tool wall"),
     "keyword without value: tool"),
    (WALL.format("hooke/stiffness tangential history") + CONDUCTION + FRICTION.format("tool wal 1"),
     "there is no fix wal for its tool"),
    (CONDUCTION + WALL.format("hooke/stiffness tangential history") + FRICTION.format(""),
     "fix wall wall/gran must be defined before this fix and fix solidem/conduction"),
    (WALL.format("hooke/stiffness tangential no_history") + CONDUCTION + FRICTION.format(""),
     "fix wall wall/gran must be 'model hooke/stiffness tangential history'"),
    (WALL.format("hooke/stiffness") + CONDUCTION + FRICTION.format(""),
     "or a fix wall/gran of that model"),
])
def test_what_the_fix_cannot_do_it_says(
    liggghts: Liggghts, tmp_path: Path, lines: str, message: str
) -> None:
    require_refused(liggghts, tmp_path, lines, message)
