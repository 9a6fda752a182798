# SPDX-License-Identifier: GPL-2.0-or-later
"""A flying bar whose bonds flow, break, touch and are made anew: any ranks, restarts, runs in a row."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import HEADER, Liggghts, dump, read_dump, simple_cubic, thermo
from moving_bar import (
    COLUMNS,
    MECHANICS,
    MOTION,
    RADIUS,
    SETTINGS,
    STEPS,
    beginning,
    largest_difference,
    write_body,
)

ROUND_OFF = 1e-12
HALF = STEPS // 2
WORK, FRACTURE, BROKEN, CONTACT, REMOVED, FORMED, FIRST = range(7)
ENERGIES = "c_motion c_spin c_elastic"
TOTALS = " ".join(f"f_bonds[{k}]" for k in range(1, 8))


@dataclass(frozen=True)
class Scene:
    """What bonds do in it, and how violently the bar vibrates."""

    beam: str
    violence: float
    bonds: str = ""


FLOW = "plasticity radial-return 1.5e7 1e9"
SCENES = {
    "flow": Scene(FLOW, 1.0),
    "scaled offset": Scene(f"law timoshenko 0.9 {FLOW.replace('radial-return', 'scaled-offset')}",
                           1.0),
    "rupture": Scene(f"{FLOW} rupture_strain 0.03", 5.0),
    "contact": Scene(f"{FLOW} rupture_strain 0.03 contact 1 rebonding_pressure 5e6", 10.0),
    "removal": Scene(f"{FLOW} rupture_strain 0.022 contact 1", 1.0, "minimal_bonds 3"),
}


@dataclass
class Outcome:
    state: np.ndarray  # (N, columns) at the last step
    broken: np.ndarray  # (N) bonds lost by each atom
    totals: np.ndarray  # f_bonds at the last step
    energies: np.ndarray  # (rows, 3) of motion, of spin and in the bonds, in the course of the run
    history: np.ndarray  # (rows, 7) of f_bonds
    said: str


def script(scene: Scene, newton: str = "on", rebuild: bool = True) -> str:
    beam = SETTINGS.replace("pair 0.3", f"pair 0.3 {scene.beam}")
    return beginning(newton, rebuild, beam + styles(scene))


def styles(scene: Scene) -> str:
    return (
        MOTION.replace("solidem/bonds", f"solidem/bonds {scene.bonds}")
        + "compute elastic all pe bond\ncompute motion all ke\ncompute spin all erotate/sphere\n"
        + "compute broken all solidem/broken/atom\n"
        + f"thermo_style custom step atoms {ENERGIES} {TOTALS}\nthermo 5\n"
        + "thermo_modify format float %.17g norm no\n"
        + dump("state", STEPS, *COLUMNS[:MECHANICS], *COLUMNS[MECHANICS + 1 :], "c_broken")
    )


def run(liggghts: Liggghts, folder: Path, scene: Scene, text: str, ranks: int = 1) -> Outcome:
    folder.mkdir(exist_ok=True)
    write_body(folder, violence=scene.violence)
    said = liggghts.run(folder, text, ranks)
    frame, rows = read_dump(folder / "state.txt")[STEPS], thermo(said)
    return Outcome(frame[:, :-1], frame[:, -1], rows[-1, 5:], rows[:, 2:5], rows[:, 5:], said)


@pytest.fixture(scope="module")
def references(
    liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Outcome]:
    """Every scene on one rank in one run without rebuilds."""
    return {
        name: run(liggghts, tmp_path_factory.mktemp("one"), scene,
                  script(scene, rebuild=False) + f"run {STEPS}\n")
        for name, scene in SCENES.items()
    }


@pytest.mark.parametrize("name", SCENES)
def test_the_scene_does_what_it_is_for(references: dict[str, Outcome], name: str) -> None:
    one = references[name]
    assert one.totals[WORK] > 1e-3
    assert (one.totals[BROKEN] > 50) == (SCENES[name].beam.count("rupture") > 0)
    assert (one.totals[FORMED] > 10) == (name == "contact")
    assert (one.history[:, CONTACT].max() > 1e-6) == (name == "contact")
    assert (one.totals[REMOVED] > 10) == (name == "removal")
    assert (np.diff(one.history[:, [WORK, BROKEN]], axis=0) >= 0).all()


@pytest.mark.parametrize("name", [name for name in SCENES if name != "scaled offset"])
def test_energy_goes_where_it_is_said_to_go(references: dict[str, Outcome], name: str) -> None:
    """Nothing moves the bar from outside: motion, bonds, flow and fracture share what it had, but for
    the error of the time step. (The scaled offset flows in jumps, whose error is of first order.)"""
    one = references[name]
    taken = one.history[:, [WORK, FRACTURE]]
    total = one.energies.sum(axis=1) + taken.sum(axis=1)
    drift = np.abs(total - total[0]).max() / taken[-1].sum()
    print(f"{name}: energy drifts by {drift:.1e} of what flow and fracture took")
    assert drift <= 0.05


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2, pytest.param(3, marks=pytest.mark.slow), 4])
@pytest.mark.parametrize("name", SCENES)
def test_ranks_and_rebuilds_change_nothing(
    liggghts: Liggghts, tmp_path: Path, references: dict[str, Outcome], name: str, ranks: int,
    newton: str,
) -> None:
    found = run(liggghts, tmp_path, SCENES[name], script(SCENES[name], newton) + f"run {STEPS}\n",
                ranks)
    one = references[name]
    difference = largest_difference(one.state[:, :MECHANICS], found.state[:, :MECHANICS])
    print(f"{name}, {ranks} ranks, newton {newton}: {difference:.1e}")
    assert (found.broken == one.broken).all()
    assert (found.history[:, [BROKEN, REMOVED, FORMED, FIRST]]
            == one.history[:, [BROKEN, REMOVED, FORMED, FIRST]]).all()
    assert found.history == pytest.approx(one.history, rel=1e-9, abs=1e-15)
    assert difference <= ROUND_OFF


def check_the_same(found: Outcome, expected: Outcome, ranks: int) -> None:
    """Bitwise on one rank, to round-off on several."""
    assert (found.broken == expected.broken).all()
    if ranks == 1:
        assert (found.state == expected.state).all()
        assert found.totals == pytest.approx(expected.totals, rel=1e-13)
    else:
        difference = largest_difference(
            expected.state[:, :MECHANICS], found.state[:, :MECHANICS])
        assert difference <= ROUND_OFF
        assert found.totals == pytest.approx(expected.totals, rel=1e-9, abs=1e-15)


@pytest.fixture(scope="module")
def rebuilt(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Outcome]:
    """Every scene on one rank in one run, neighbour lists rebuilt in every step."""
    return {
        name: run(liggghts, tmp_path_factory.mktemp("rebuilt"), scene,
                  script(scene) + f"run {STEPS}\n")
        for name, scene in SCENES.items()
    }


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("name", SCENES)
def test_runs_in_a_row_equal_one_run(
    liggghts: Liggghts, tmp_path: Path, rebuilt: dict[str, Outcome], name: str, ranks: int
) -> None:
    runs = f"run {STEPS - 70}\nrun 0\nrun 30\nrun 39\nrun 1\n"
    found = run(liggghts, tmp_path, SCENES[name], script(SCENES[name]) + runs, ranks)
    check_the_same(found, rebuilt[name], ranks)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("written", ["after the run", "in mid-run"])
@pytest.mark.parametrize("name", SCENES)
def test_a_restart_file_carries_everything(
    liggghts: Liggghts, tmp_path: Path, rebuilt: dict[str, Outcome], name: str, written: str,
    ranks: int,
) -> None:
    scene = SCENES[name]
    first = script(scene)
    if written == "after the run":
        first += f"run {HALF}\nwrite_restart half.restart\n"
    else:
        first += f"restart {HALF} step.*.restart\nrun {HALF + 10}\n"
        first += f"shell mv step.{HALF}.restart half.restart\n"
    write_body(tmp_path, violence=scene.violence)
    before = thermo(liggghts.run(tmp_path, first, ranks))
    resume = (
        "atom_modify map array sort 0 0\ncommunicate single vel yes\n"
        "special_bonds lj/coul 1 1 1\nread_restart half.restart\nneighbor 0.5e-3 bin\n"
        "neigh_modify every 1 delay 0 check no\npair_style none\n"
        + styles(scene) + f"run {STEPS - HALF}\n"
    )
    said = liggghts.run(tmp_path, resume, ranks)
    frame, rows = read_dump(tmp_path / "state.txt")[STEPS], thermo(said)
    at_half = before[before[:, 0] == HALF][0]
    assert rows[0, 5:] == pytest.approx(at_half[5:], rel=1e-13), "figures of the file itself"
    found = Outcome(frame[:, :-1], frame[:, -1], rows[-1, 5:], rows[:, 2:5], rows[:, 5:], said)
    check_the_same(found, rebuilt[name], ranks)


@pytest.mark.parametrize("name", ["rupture", "contact"])
def test_bonds_across_periodic_faces_break_alike(
    liggghts: Liggghts, tmp_path: Path, name: str
) -> None:
    """An endless bar in flight, its bonds crossing the faces at other places, on one rank and on two."""
    outcomes = []
    for speed, ranks in ((0.0, 1), (400.0, 1), (400.0, 2)):
        body = simple_cubic((6, 3, 3), RADIUS, periodic=True)
        body.velocity = np.zeros((len(body.position), 6))
        body.velocity[:, :3] = 15 * np.random.default_rng(2).normal(size=body.position.shape)
        body.velocity[:, 0] += speed
        body.write(tmp_path / "body.data")
        text = HEADER + (
            "boundary p p p\nnewton off on\nread_data body.data\nneighbor 0.3e-3 bin\n"
            "neigh_modify every 1 delay 0 check no\npair_style none\n"
            + SETTINGS.replace("pair 0.3", f"pair 0.3 {SCENES[name].beam}")
            + styles(SCENES[name]) + f"run {STEPS}\n"
        )
        rows = thermo(liggghts.run(tmp_path, text, ranks))
        outcomes.append((read_dump(tmp_path / "state.txt")[STEPS], rows[:, 5:]))
    (rest, totals), *flights = outcomes
    assert totals[-1, BROKEN] > 50
    for state, in_flight in flights:
        assert (state[:, -1] == rest[:, -1]).all()
        assert in_flight == pytest.approx(totals, rel=1e-8, abs=1e-14)
