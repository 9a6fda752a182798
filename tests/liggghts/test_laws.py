# SPDX-License-Identifier: GPL-2.0-or-later
"""What one bond does along a path: elastic laws, plastic flow, rupture, contact, bonds made anew."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

from liggghts_runs import Liggghts
from two_atoms import (
    AREA,
    AXIAL_STIFFNESS,
    COEFFICIENTS,
    DIRECTION,
    KAPPA,
    LAWS,
    LENGTH,
    RADII,
    SHEAR,
    START,
    YOUNG,
    by_the_laws,
    by_the_style,
    stretched,
    wandering,
)

LAW_WORDS = {
    "euler-bernoulli": "",
    "timoshenko": f"law timoshenko {KAPPA}",
    "spring": "law spring",
}
SCALE = YOUNG * AREA * np.array([1.0] * 6 + [LENGTH] * 6)
YIELD_STRAIN, HARDENING = 2e-3, 0.05
WORK, FRACTURE, BROKEN, CONTACT, REMOVED, FORMED, FIRST = range(7)  # places in f_bonds


@pytest.fixture(scope="session")
def laws(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program that leads a bond by the laws' own headers."""
    program = tmp_path_factory.mktemp("laws") / "bond_path"
    source = Path(__file__).with_name("bond_path.cpp")
    subprocess.run(["g++", "-std=c++17", "-O2", f"-I{LAWS}", source, "-o", program], check=True)
    return program


@pytest.mark.parametrize("law", LAW_WORDS)
def test_elastic_laws(liggghts: Liggghts, laws: Path, tmp_path: Path, law: str) -> None:
    poses = wandering(12, 0.05)
    found = by_the_style(liggghts, tmp_path, f"{COEFFICIENTS} {LAW_WORDS[law]}", poses)
    expected = by_the_laws(laws, poses, law)
    assert np.abs(expected.loads / SCALE).max() > 1e-3
    assert np.abs((found.loads - expected.loads) / SCALE).max() <= 1e-14
    energy = expected.figures["energy"]
    assert np.abs(found.figures["energy"] - energy).max() <= 1e-12 * energy.max()
    stress = expected.figures["stress"]
    assert np.abs(found.figures["stress"] - stress).max() <= 1e-12 * stress.max()


# How the bond style is told of a yield law, and its parameters.
HARDENING_WORDS = {
    "linear, without names": (f"{YIELD_STRAIN * YOUNG:.17g} {HARDENING * YOUNG:.17g}", "linear",
                              {"yield_strain": YIELD_STRAIN, "hardening_ratio": HARDENING}),
    "linear": (f"linear hardening_ratio {HARDENING} yield_stress {YIELD_STRAIN * YOUNG:.17g}",
               "linear", {"yield_strain": YIELD_STRAIN, "hardening_ratio": HARDENING}),
    "voce": (f"voce yield_strain {YIELD_STRAIN} saturation_strain 0.003 plastic_scale 0.008",
             "voce", {"yield_strain": YIELD_STRAIN, "saturation_strain": 0.003,
                      "plastic_scale": 0.008}),
}


@pytest.mark.parametrize("hardening", HARDENING_WORDS)
@pytest.mark.parametrize("plasticity", ["radial-return", "scaled-offset", "associated"])
@pytest.mark.parametrize("law", LAW_WORDS)
def test_plastic_flow(
    liggghts: Liggghts, laws: Path, tmp_path: Path, law: str, plasticity: str, hardening: str
) -> None:
    poses = wandering(60, 0.01)
    words, name, parameters = HARDENING_WORDS[hardening]
    words = f"{COEFFICIENTS} {LAW_WORDS[law]} plasticity {plasticity} {words}"
    found = by_the_style(liggghts, tmp_path, words, poses, one_step=True)
    expected = by_the_laws(laws, poses, law, plasticity, name, **parameters)
    strain = expected.figures["plastic_strain"]
    assert strain[-1] > 5 * YIELD_STRAIN
    assert 5 < (np.diff(strain) > 0).sum() < 55, "it must flow and unload"
    error = np.abs((found.loads - expected.loads) / SCALE).max()
    print(f"{law}, {plasticity}, {hardening}: largest error of the loads {error:.1e} E S")
    assert error <= 1e-14
    for figure in ("stress", "plastic_strain", "energy", "plastic_work"):
        values = expected.figures[figure]
        assert np.abs(found.figures[figure] - values).max() <= 1e-12 * np.abs(values).max(), figure
    assert found.totals[:, 0] == pytest.approx(expected.figures["plastic_work"], rel=1e-12)


@pytest.mark.parametrize("extension, broken", [(2.9e-3, 0), (3.1e-3, 1), (-3.1e-3, 0), (-0.1, 0)])
def test_mohr_coulomb_breaks_in_tension_but_not_under_pressure(
    liggghts: Liggghts, tmp_path: Path, extension: float, broken: int
) -> None:
    words = f"{COEFFICIENTS} rupture mohr-coulomb tensile_strength {3e-3 * YOUNG:.17g} "
    words += "cohesion_strain 4e-3 friction_coefficient 0.6"
    found = by_the_style(liggghts, tmp_path, words, stretched(extension), one_step=True)
    assert found.totals[0, BROKEN] == broken


def test_a_second_look_changes_nothing(liggghts: Liggghts, tmp_path: Path) -> None:
    """Every run looks at its first pose again: bitwise the same loads, nothing flows."""
    words = f"{COEFFICIENTS} plasticity radial-return {YIELD_STRAIN * YOUNG:.17g} 0"
    found = by_the_style(liggghts, tmp_path, words, wandering(30, 0.01), one_step=True, looks=2)
    first, second = found.loads[0::2], found.loads[1::2]
    assert (first == second).all()
    assert found.totals[-1, WORK] > 0
    assert (found.totals[0::2] == found.totals[1::2]).all()
    for values in found.figures.values():
        assert (values[0::2] == values[1::2]).all()




@pytest.mark.parametrize(
    "limit, breaking",
    [("rupture_stress", 1.5e-2), ("rupture_strain", 1.5e-2)],
)
def test_a_bond_that_breaks_acts_once_more(
    liggghts: Liggghts, tmp_path: Path, limit: str, breaking: float
) -> None:
    value = breaking * (YOUNG if limit == "rupture_stress" else 1.0)
    extensions = np.array([0.5, 0.99, 1.2, 1.2, -0.5, 0.5]) * breaking
    words = f"{COEFFICIENTS} {limit} {value:.17g}"
    found = by_the_style(liggghts, tmp_path, words, stretched(*extensions), one_step=True)
    force = found.loads[:, :3] @ DIRECTION
    expected = AXIAL_STIFFNESS * LENGTH * extensions
    assert force[:3] == pytest.approx(expected[:3], rel=1e-12)
    assert (found.loads[3:] == 0).all()
    stored = 0.5 * AXIAL_STIFFNESS * (LENGTH * extensions[2]) ** 2
    assert (found.totals[:2, [FRACTURE, BROKEN]] == 0).all()
    assert found.totals[2:, FRACTURE] == pytest.approx(stored, rel=1e-12)
    assert (found.totals[2:, BROKEN] == 1).all()
    assert (found.totals[:2, FIRST] == -1).all() and (found.totals[2:, FIRST] == 3).all()
    assert (found.broken[:2] == 0).all() and (found.broken[2:] == 1).all()
    assert found.figures["state"][:3].tolist() == [0, 0, 1]
    assert np.isnan(found.figures["state"][3:]).all(), "a bond without contact is gone"


def test_plastic_strain_counts_towards_rupture(liggghts: Liggghts, tmp_path: Path) -> None:
    """Strain is elastic and plastic together: at constant yield stress it is the extension."""
    words = f"{COEFFICIENTS} plasticity radial-return {1e-3 * YOUNG:.17g} 0 rupture_strain 0.02"
    found = by_the_style(liggghts, tmp_path, words, stretched(0.01, 0.0199, 0.0201, 0.03),
                         one_step=True)
    assert found.totals[:, BROKEN].tolist() == [0, 0, 1, 1]
    assert found.loads[2, :3] @ DIRECTION == pytest.approx(YOUNG * AREA * 1e-3, rel=1e-12)
    assert (found.loads[3] == 0).all()
    # In the step in which it begins to flow, from no load on, the mean of both loads works.
    flowed = 0.5 * (0.01 - 1e-3) + (0.0201 - 0.01)
    work = 1e-3 * flowed * YOUNG * AREA * LENGTH
    assert found.totals[2:, WORK] == pytest.approx(work, rel=1e-12)
    stored = 0.5 * YOUNG * AREA * LENGTH * 1e-6
    assert found.totals[2, FRACTURE] == pytest.approx(stored, rel=1e-12)
    # Its load acts on half of the way to the next pose.
    last_work = 0.5 * YOUNG * AREA * LENGTH * 1e-3 * (0.03 - 0.0201)
    assert found.totals[3, FRACTURE] == pytest.approx(stored + last_work, rel=1e-12)


def test_broken_faces_touch_where_the_bond_was_free(liggghts: Liggghts, tmp_path: Path) -> None:
    """These spheres overlapped when they were bonded: contact begins at that distance."""
    assert LENGTH < RADII.sum()
    extensions = np.array([0.03, 0.02, 1e-9, -0.01, -0.02, -1e-9, 0.02])
    words = f"{COEFFICIENTS} rupture_strain 0.025 contact 0.7"
    found = by_the_style(liggghts, tmp_path, words, stretched(*extensions), one_step=True)
    push = np.minimum(extensions, 0.0) * LENGTH * 0.7 * AXIAL_STIFFNESS
    assert found.loads[1:, :3] @ DIRECTION == pytest.approx(push[1:], rel=1e-6, abs=1e-9)
    assert (found.loads[1:, 6:] == 0).all()
    energy = 0.5 * push**2 / (0.7 * AXIAL_STIFFNESS)
    assert found.totals[1:, CONTACT] == pytest.approx(energy[1:], rel=1e-6, abs=1e-15)
    assert found.figures["force"][1:] == pytest.approx(push[1:], rel=1e-6, abs=1e-9)
    assert (found.figures["state"] == 1).all()


def test_broken_faces_that_never_overlapped_touch_where_spheres_meet(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    words = f"{COEFFICIENTS} rupture_strain 0.025 contact 1"
    away = START + np.array([[0.0], [0.2 * LENGTH]]) * DIRECTION  # made 1.2 times as long
    made = 1.2 * LENGTH
    assert made > RADII.sum()
    poses = stretched(0.25, 0.1, -0.05)
    found = by_the_style(liggghts, tmp_path, words, poses, one_step=True, start=away)
    stiffness = YOUNG * AREA / made
    depth = np.maximum(RADII.sum() - LENGTH * (1 + np.array([0.25, 0.1, -0.05])), 0.0)
    assert found.totals[0, BROKEN] == 1 and depth[2] > 0 == depth[1]
    assert found.loads[1:, :3] @ DIRECTION == pytest.approx(-stiffness * depth[1:], rel=1e-12)


def test_pressure_makes_a_bond_anew(
    liggghts: Liggghts, laws: Path, tmp_path: Path
) -> None:
    """Above the pressure the atoms are one again, free of load where they stand and as they are
    turned; from then on the bond is elastic about that pose."""
    pressure = 0.01 * YOUNG
    words = f"{COEFFICIENTS} rupture_strain 0.025 contact 1 rebonding_pressure {pressure:.17g}"
    poses = stretched(0.03, -0.005, -0.011, -0.011, -0.021, 0.01, 0.02)
    turn = np.array([[0.9, 0.1, -0.2, 0.3], [0.8, 0.3, 0.1, -0.2]])
    turn /= np.linalg.norm(turn, axis=1)[:, None]
    for pose in poses[2:]:
        pose.orientation = turn
    found = by_the_style(liggghts, tmp_path, words, poses, one_step=True)
    force = found.loads[:, :3] @ DIRECTION
    assert force[1:3] == pytest.approx(-AXIAL_STIFFNESS * LENGTH * np.array([0.005, 0.011]))
    assert np.abs(found.loads[3] / SCALE).max() <= 1e-14
    assert found.totals[:, FORMED].tolist() == [0, 0, 1, 1, 1, 1, 1]
    again = YOUNG * AREA / (LENGTH * (1 - 0.011))
    assert force[4:6] == pytest.approx(again * LENGTH * np.array([-0.010, 0.021]), rel=1e-10)
    assert np.abs(found.loads[4:6, 6:] / SCALE[6:]).max() <= 1e-14
    assert found.totals[:, BROKEN].tolist() == [1, 1, 1, 1, 1, 1, 2]
    assert found.figures["state"].tolist() == [1, 1, 0, 0, 0, 0, 1]


def test_an_atom_with_too_few_bonds_is_removed(liggghts: Liggghts, tmp_path: Path) -> None:
    words = f"{COEFFICIENTS} rupture_strain 0.025"
    found = by_the_style(liggghts, tmp_path, words, stretched(0.02, 0.03, 0.02), one_step=True,
                         options="minimal_bonds 1")
    assert found.totals[:, REMOVED].tolist() == [0, 2, 2]
