# SPDX-License-Identifier: GPL-2.0-or-later
"""pair_style solidem/central: every law against its own header, energy, initial distances that are
kept, ranks, runs in a row, restart files."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

from central_body import (
    HEAD,
    LAWS,
    RADIUS,
    STANDALONE,
    beginning,
    by_the_law,
    largest_difference,
    last_state,
    shaken_block,
    state,
    words,
    write,
)
from liggghts_runs import Body, Liggghts, dump, read_dump, thermo

ROUND_OFF = 1e-12
RADII = np.array([0.55e-3, 0.45e-3])
TOTAL = "thermo_style custom step atoms ke c_stored f_solidem_central[1] f_solidem_central[2] "
TOTAL += "f_solidem_central[3]\nthermo_modify norm no format float %.17g\n"
STORED = "compute stored all pe\n"
INTERACTIONS, DEEPEST, DISSIPATED = 4, 5, 6
STEPS = 100
MOTION = "fix motion all nve\ntimestep 5e-8\n"


@pytest.fixture(scope="session")
def laws(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program that evaluates the laws' own headers."""
    program = tmp_path_factory.mktemp("central_laws") / "central_pair"
    source = Path(__file__).with_name("central_pair.cpp")
    subprocess.run(["g++", "-std=c++17", "-O2", f"-I{STANDALONE}", source, "-o", program],
                   check=True)
    return program


def two_atoms(folder: Path, distance: float, velocity: float = 0.0) -> Body:
    """Two unlike atoms along a skew line; the second leaves at this speed."""
    direction = np.array([2.0, -1.0, 2.0]) / 3
    place = np.array([[0.2e-3, 0.1e-3, -0.3e-3]] * 2)
    place[1] += distance * direction
    body = Body(place, RADII, np.empty((0, 2)), np.full(3, -6e-3), np.full(3, 6e-3))
    body.velocity = np.zeros((2, 6))
    body.velocity[1, :3] = velocity * direction
    write(body, folder / "body.data")
    return body


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("equilibrium", ["initial", "radii"])
def test_force_and_energy_are_those_of_the_law(
    liggghts: Liggghts, laws: Path, tmp_path: Path, law: str, equilibrium: str
) -> None:
    """Deep overlap, where the force goes on along its tangent, to beyond the range."""
    radii, made = RADII.sum(), 0.98 * RADII.sum()
    rest = made if equilibrium == "initial" else radii
    distances = rest * np.array([0.05, 0.5, 0.79, 0.81, 0.95, 0.995, 1.0, 1.005, 1.05, 1.2])
    distances = np.append(distances, radii * np.array([1.2999999, 1.3000001]))
    body = two_atoms(tmp_path, made)
    pair = f"{words(law)} range 1.3 interpenetration 0.2 equilibrium {equilibrium}"
    script = beginning(pair) + STORED + (
        "fix motion all nve\n" + TOTAL + "run 0\n"
    )
    direction = (body.position[1] - body.position[0]) / made
    for k, distance in enumerate(distances):
        place = body.position[0] + distance * direction
        script += "set atom 2 x {:.17g} y {:.17g} z {:.17g}\n".format(*place)
        script += dump(f"at{k}", 1, "fx", "fy", "fz") + f"run 0\nundump at{k}\n"
    said = liggghts.run(tmp_path, script)
    energy = [float(line.split()[3]) for line in said.splitlines()
              if line.split()[:2] == ["0", "2"]][1:]
    places = body.position[0] + distances[:, None] * direction
    exact = np.linalg.norm(places - body.position[0], axis=1)
    expected = by_the_law(laws, law, 0.2, np.column_stack([exact, 0 * exact + rest,
                                                           0 * exact + 1.3 * radii]))
    scale = np.abs(expected[3:10, 0]).max()
    for k in range(len(distances)):
        force = read_dump(tmp_path / f"at{k}.txt")[0]
        assert force[0] == pytest.approx(-force[1], abs=0)
        # Places are rounded to 1e-16 of a millimetre, forces grow by 1e9 N/m and more.
        tolerance = 1e-12 * max(abs(expected[k, 0]), scale)
        assert force[1] @ direction == pytest.approx(expected[k, 0], abs=tolerance)
        assert energy[k] == pytest.approx(expected[k, 1], rel=1e-12,
                                          abs=1e-12 * np.abs(expected[3:, 1]).max())


@pytest.mark.parametrize("ranks", [1, 2])
def test_groups_tell_what_is_between_them(liggghts: Liggghts, tmp_path: Path, ranks: int) -> None:
    """`compute group/group` asks for one pair after the other: forces and energy of the step."""
    body = shaken_block()
    write(body, tmp_path / "body.data")
    left = " ".join(str(k + 1) for k in np.flatnonzero(body.position[:, 0] < 5e-3))
    script = beginning(words("mie") + " range 1.3") + STORED + MOTION + (
        f"group left id {left}\ngroup right subtract all left\n"
        "compute between left group/group right\ncompute inside left group/group left\n"
        "compute other right group/group right\ncompute pull left reduce sum fx fy fz\n"
        "thermo_style custom step atoms c_stored c_inside c_other c_between c_between[1] "
        "c_between[2] c_between[3] c_pull[1] c_pull[2] c_pull[3]\n"
        "thermo_modify norm no format float %.17g\nrun 50\n"
    )
    row = thermo(liggghts.run(tmp_path, script, ranks))[-1]
    assert row[3:6].sum() == pytest.approx(row[2], rel=1e-12)
    assert row[6:9] == pytest.approx(row[9:12], rel=1e-10)
    assert np.abs(row[6:9]).max() > 1


@pytest.mark.parametrize("law", LAWS)
def test_energy_is_kept_while_neighbours_change(
    liggghts: Liggghts, tmp_path: Path, law: str
) -> None:
    """Half the time step, at most half the error: neighbours part and meet without a jump."""
    write(shaken_block(), tmp_path / "body.data")
    errors, pairs = [], []
    for halves in (1, 8):
        script = beginning(f"{words(law)} range 1.3 interpenetration 0.3") + STORED + TOTAL
        script += f"fix motion all nve\ntimestep {5e-8 / halves}\nthermo {10 * halves}\n"
        rows = thermo(liggghts.run(tmp_path, script + f"run {STEPS * halves}\n"))
        energy = rows[:, 2] + rows[:, 3]
        errors.append(np.abs(energy - energy[0]).max() / rows[0, 2])
        pairs.append(rows[:, INTERACTIONS])
    print(f"{law}: relative error of the energy {errors[0]:.1e}, {errors[1]:.1e}")
    assert np.ptp(pairs[1]) > 50, "too few neighbours changed"
    assert errors[1] <= 3e-5 and errors[1] <= errors[0] / 2


def test_dissipation_takes_the_energy_that_is_lost(liggghts: Liggghts, tmp_path: Path) -> None:
    """Of first order in the time step, as velocities are half a step behind."""
    write(shaken_block(), tmp_path / "body.data")
    errors = []
    for halves in (2, 4, 8):
        script = beginning(words("piecewise") + " range 1.3 dissipation 0.2") + STORED + TOTAL
        script += f"fix motion all nve\ntimestep {5e-8 / halves}\nthermo 1000\n"
        rows = thermo(liggghts.run(tmp_path, script + f"run {STEPS * halves}\n"))
        energy = rows[:, 2] + rows[:, 3] + rows[:, DISSIPATED]
        assert rows[-1, DISSIPATED] > 0.1 * rows[0, 2]
        errors.append(abs(energy[-1] - energy[0]) / rows[0, 2])
    assert errors[2] <= 5e-4
    assert errors[1] / errors[2] == pytest.approx(2, rel=0.3)
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.3)


def test_initial_distance_outlasts_parting(liggghts: Liggghts, laws: Path, tmp_path: Path) -> None:
    """Two atoms part far beyond any list and come back: still the distance of the start. A third
    that they meet for the first time has the sum of the radii."""
    radii, made = RADII.sum(), 0.97 * RADII.sum()
    body = two_atoms(tmp_path, made)
    direction = (body.position[1] - body.position[0]) / made
    far = body.position[0] + 4e-3 * direction
    back = body.position[0] + 0.99 * radii * direction
    body.position = np.vstack([body.position, body.position[0] - 2 * radii * direction])
    body.radius = np.append(RADII, RADII[1])
    body.velocity = None
    write(body, tmp_path / "body.data")
    met = body.position[0] - 0.99 * radii * direction
    script = beginning(words("mie") + " range 1.3") + "fix motion all nve\ntimestep 1e-12\nrun 1\n"
    script += "set atom 2 x {:.17g} y {:.17g} z {:.17g}\nrun 3\n".format(*far)
    script += "set atom 2 x {:.17g} y {:.17g} z {:.17g}\n".format(*back)
    script += "set atom 3 x {:.17g} y {:.17g} z {:.17g}\n".format(*met) + state(1) + "run 0\n"
    force = last_state(liggghts, tmp_path, script)[:, 6:9] @ direction
    at = np.array([[0.99 * radii, made, 1.3 * radii], [0.99 * radii, radii, 1.3 * radii]])
    attraction, repulsion = by_the_law(laws, "mie", 0.1, at)[:, 0]
    assert attraction < 0 < repulsion
    assert force[1] == pytest.approx(attraction, rel=1e-9)
    assert force[2] == pytest.approx(-repulsion, rel=1e-9)


def test_fixed_neighbours_are_those_of_the_start(liggghts: Liggghts, tmp_path: Path) -> None:
    """A stranger passes through; initial pairs by the tolerance given."""
    x = np.array([0.0, 1.0, 2.05, 3.2]) * 1e-3
    body = Body(np.column_stack([x, 0 * x, 0 * x]), np.full(4, RADIUS), np.empty((0, 2)),
                np.full(3, -5e-3), np.full(3, 8e-3))
    write(body, tmp_path / "body.data")
    script = beginning(words("mie") + " range 1.3 tolerance 0.01 neighbours fixed")
    script += "fix motion all nve\ntimestep 1e-12\nrun 0\nset atom 4 x 0.95e-3 y 1e-4 z 0\n"
    force = last_state(liggghts, tmp_path, script + state(1) + "run 0\n")[:, 6:9]
    assert (force == 0).all(), "only 1 and 2 are neighbours, and they have not moved"
    moved = script + "set atom 2 x 1.01e-3\n" + state(1) + "run 0\n"
    force = last_state(liggghts, tmp_path, moved)[:, 6]
    assert force[0] > 1 and force[1] == -force[0] and (force[2:] == 0).all()


@pytest.fixture(scope="module")
def serial(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """The last state of each law on one rank in one run."""
    frames = {}
    for law in LAWS:
        folder = tmp_path_factory.mktemp("serial")
        write(shaken_block(), folder / "body.data")
        frames[law] = last_state(liggghts, folder, moving(law) + state(STEPS) + f"run {STEPS}\n")
    return frames


def moving(law: str, newton: str = "off", dissipation: float = 0.0) -> str:
    return beginning(f"{words(law)} range 1.3 dissipation {dissipation}", newton=newton) + MOTION


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("ranks, newton", [(1, "on"), (2, "off"), (4, "on"), (4, "off")])
def test_ranks_change_nothing(
    liggghts: Liggghts, tmp_path: Path, serial: dict[str, np.ndarray], law: str, ranks: int,
    newton: str
) -> None:
    body = shaken_block()
    write(body, tmp_path / "body.data")
    script = moving(law, newton) + state(STEPS) + f"run {STEPS}\n"
    frame = last_state(liggghts, tmp_path, script, ranks)
    middle = (body.lower + body.upper) / 2
    changed = (body.position < middle) != (frame[:, :3] < middle)
    assert changed[:, 0].sum() > 10, "too few atoms changed processor"
    difference = largest_difference(serial[law], frame)
    print(f"{law}, {ranks} ranks, newton {newton}: {difference:.1e}")
    assert difference <= ROUND_OFF


@pytest.mark.parametrize("ranks", [2, 4])
def test_dissipation_does_not_see_ranks(liggghts: Liggghts, tmp_path: Path, ranks: int) -> None:
    write(shaken_block(), tmp_path / "body.data")
    script = moving("mie", dissipation=0.2) + STORED + TOTAL + state(STEPS) + f"run {STEPS}\n"
    totals, frames = [], []
    for processors in (1, ranks):
        totals.append(thermo(liggghts.run(tmp_path, script, processors))[-1])
        frames.append(read_dump(tmp_path / "state.txt")[STEPS])
    assert largest_difference(*frames) <= ROUND_OFF
    assert totals[0][DISSIPATED] > 0.1
    assert totals[1][2:] == pytest.approx(totals[0][2:], rel=1e-12)


@pytest.mark.parametrize("ranks", [1, 2])
def test_sorting_atoms_and_runs_in_a_row_change_nothing(
    liggghts: Liggghts, tmp_path: Path, serial: dict[str, np.ndarray], ranks: int
) -> None:
    write(shaken_block(), tmp_path / "body.data")
    script = moving("mie").replace("sort 0 0", "sort 5 1e-3") + state(STEPS)
    frame = last_state(liggghts, tmp_path, script + "run 30\nrun 0\nrun 30\nrun 40\n", ranks)
    assert largest_difference(serial["mie"], frame) <= ROUND_OFF


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("before, after", [(1, 1), (2, 4), (4, 1)])
def test_a_restart_file_carries_law_and_distances(
    liggghts: Liggghts, tmp_path: Path, serial: dict[str, np.ndarray], law: str, before: int,
    after: int
) -> None:
    """Written in mid-run; the pair style need not be named again."""
    write(shaken_block(), tmp_path / "body.data")
    script = moving(law) + STORED + TOTAL + "restart 50 half.*.restart\nrun 60\n"
    liggghts.run(tmp_path, script, before)
    resume = HEAD.partition("atom_style granular\n")[2] + (
        "read_restart half.50.restart\nneighbor 1e-4 bin\nneigh_modify every 1 delay 0 check yes\n"
    )
    frame = last_state(liggghts, tmp_path, resume + MOTION + state(50) + "run 50\n", after)
    assert largest_difference(serial[law], frame) <= ROUND_OFF
    again = resume + "pair_coeff * *\n" + MOTION + STORED + TOTAL + "run 0\n"
    deepest = thermo(liggghts.run(tmp_path, again, after))[0, DEEPEST]
    assert deepest > 0.02, "the deepest interpenetration so far goes with the file"


def test_a_periodic_body_flies_through_its_own_faces(liggghts: Liggghts, tmp_path: Path) -> None:
    """A crystal vibrates alike at rest and in flight, on any ranks."""
    cells = np.stack(np.meshgrid(*map(np.arange, (5, 5, 5)), indexing="ij"), -1).reshape(-1, 3)
    random = np.random.default_rng(1)
    noise = random.normal(scale=20.0, size=cells.shape)
    frames = []
    for name, speed, ranks in (("rest", 0.0, 1), ("flight", 400.0, 1), ("parallel", 400.0, 4)):
        folder = tmp_path / name
        folder.mkdir()
        body = Body(2 * RADIUS * (cells + 0.5), np.full(len(cells), RADIUS), np.empty((0, 2)),
                    np.zeros(3), np.full(3, 10 * RADIUS))
        body.velocity = np.zeros((len(cells), 6))
        body.velocity[:, :3] = noise + [speed, 0.5 * speed, 0]
        write(body, folder / "body.data")
        script = beginning(words("lennard-jones") + " range 1.2", "p p p") + MOTION
        frames.append(last_state(liggghts, folder, script + state(STEPS, "ix") + f"run {STEPS}\n",
                                 ranks))
    rest, flight, parallel = frames
    assert (flight[:, 9] != rest[:, 9]).sum() > 10, "no atom crossed the face"
    force = np.abs(rest[:, 6:9]).max()
    assert force > 1
    assert np.abs(flight[:, 6:9] - rest[:, 6:9]).max() <= 1e-11 * force
    assert np.abs(parallel[:, 6:9] - flight[:, 6:9]).max() <= 1e-11 * force
