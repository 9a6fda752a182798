# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong input ends with a message that says what is wrong."""

from pathlib import Path

import pytest

import central_body
from liggghts_runs import HEADER, Liggghts, simple_cubic

BODY = (
    HEADER
    + "boundary f f f\nnewton off\nread_data body.data\nneighbor 1e-3 bin\npair_style none\n"
)
BEAM = "bond_style solidem/beam\nbond_coeff 1 1e9 4e8 pair 0.3\n"
HEAT = "fix heat all solidem/conduction law platonic conductivity 1 specific_heat 1 density 1 "
WRONG = {
    "negative modulus": (
        "bond_style solidem/beam\nbond_coeff 1 -1e9 4e8 pair 0.3\n",
        "Young's modulus must be positive",
    ),
    "negative radius": (
        "bond_style solidem/beam\nbond_coeff 1 1e9 4e8 radius -1e-4\n",
        "radius or ratio must be positive",
    ),
    "no radius": (
        "bond_style solidem/beam\nbond_coeff 1 1e9 4e8\n",
        "either 'radius R' or 'pair RATIO'",
    ),
    "misspelt keyword": (
        "bond_style solidem/beam\nbond_coeff 1 1e9 4e8 par 0.3\n",
        "'radius' or 'pair' must follow the moduli",
    ),
    "unknown law of beams": (BEAM.replace("0.3", "0.3 law bernoulli"), "unknown law 'bernoulli'"),
    "shear coefficient missing": (
        BEAM.replace("0.3", "0.3 law timoshenko"),
        "'the shear coefficient' is missing",
    ),
    "unknown plasticity": (
        BEAM.replace("0.3", "0.3 plasticity j2 1e6 0"),
        "unknown plasticity 'j2'; known are radial-return, scaled-offset, associated",
    ),
    "negative yield stress": (
        BEAM.replace("0.3", "0.3 plasticity radial-return -1e6 0"),
        "the yield stress must be positive, not -1e6",
    ),
    "hardening missing": (
        BEAM.replace("0.3", "0.3 plasticity radial-return 1e6"),
        "'the hardening modulus' is missing",
    ),
    "unknown hardening": (
        BEAM.replace("0.3", "0.3 plasticity radial-return ludvik yield_strain 1e-3"),
        "unknown hardening 'ludvik'; known are linear, voce, johnson-cook",
    ),
    "a rate without its time": (
        BEAM.replace("0.3", "0.3 plasticity radial-return johnson-cook yield_strain 1e-3 "
                            "hardening_strain 1e-3 hardening_exponent 0.3 rate_sensitivity 0.02"),
        "a yield law that looks at the rate of flow needs rate_time",
    ),
    "a time of rates that do not count": (
        BEAM.replace("0.3", "0.3 plasticity radial-return 1e6 0 rate_time 1e-6"),
        "rate_time needs a yield law that looks at the rate of flow",
    ),
    "expansion without its reference": (
        BEAM.replace("0.3", "0.3 expansion 2e-5 to 300"),
        "after the coefficient of expansion comes 'from'",
    ),
    "a table that goes back": (
        BEAM.replace("0.3", "0.3 softening table 2 400 1 300 0.5"),
        "the temperatures of softening must increase",
    ),
    "a table too long": (
        BEAM.replace("0.3", "0.3 softening table 17 400 1"),
        "the table of softening has a whole number of points, 1 to 16",
    ),
    "a stiffness that vanishes": (
        BEAM.replace("0.3", "0.3 softening 0"),
        "softening must be positive",
    ),
    "more heat than work": (
        BEAM.replace("0.3", "0.3 plasticity radial-return 1e6 0 plastic_heat 1.1"),
        "plastic_heat must not be above 1",
    ),
    "heat of no flow": (
        BEAM.replace("0.3", "0.3 plastic_heat 0.9"),
        "plastic_heat needs plasticity: else no bond flows",
    ),
    "bonds made anew that expand": (
        BEAM.replace("0.3", "0.3 rupture_stress 1e6 contact 1 rebonding_pressure 1e6 "
                            "expansion 2e-5 from 300"),
        "rebonding_pressure does not go with expansion",
    ),
    "bonds that expand without temperatures": (
        BEAM.replace("0.3", "0.3 expansion 2e-5 from 300")
        + "fix bonds all solidem/bonds\nfix motion all nve/solidem\nrun 0\n",
        "expansion, softening and yield laws that look at temperature need a "
        "'fix ID all solidem/conduction'",
    ),
    "heat of flow that nobody takes": (
        BEAM.replace("0.3", "0.3 plasticity radial-return 1e6 0 plastic_heat 0.9")
        + "fix bonds all solidem/bonds\nfix motion all nve/solidem\nrun 0\n",
        "plastic_heat needs a 'fix ID all solidem/conduction'",
    ),
    "bonds made in the run that expand": (
        BEAM.replace("0.3", "0.3 expansion 2e-5 from 300")
        + "fix bonds all solidem/bonds\nfix motion all nve/solidem\n"
        + HEAT + "initial_temperature 300\n"
        + "fix make all solidem/bond/create step 0 type 1 tolerance 0.1\nrun 0\n",
        "leave out expansion",
    ),
    "a temperature that bonds do not know": (
        BEAM.replace("0.3", "0.3 plasticity radial-return johnson-cook yield_strain 1e-3 "
                            "hardening_strain 1e-3 hardening_exponent 0.3 "
                            "reference_temperature 300 melting_temperature 900")
        + "fix bonds all solidem/bonds\nfix motion all nve/solidem\nrun 0\n",
        "look at temperature need a 'fix ID all solidem/conduction'",
    ),
    "hardening without a parameter": (
        BEAM.replace("0.3", "0.3 plasticity radial-return voce yield_strain 1e-3 plastic_scale 1"),
        "voce needs saturation_strain or saturation_stress",
    ),
    "negative yield strain": (
        BEAM.replace("0.3", "0.3 plasticity radial-return linear yield_strain -1"),
        "yield_strain must be positive, not -1",
    ),
    "rupture law without a parameter": (
        BEAM.replace("0.3", "0.3 rupture mohr-coulomb tensile_strain 1e-3"),
        "mohr-coulomb needs cohesion_strain or cohesion",
    ),
    "rupture law that never breaks": (
        BEAM.replace("0.3", "0.3 rupture strain-limit"),
        "strain-limit: nothing says when a bond breaks",
    ),
    "two rupture laws": (
        BEAM.replace("0.3", "0.3 rupture mohr-coulomb tensile_strain 1 cohesion 1 rupture_strain 1"),
        "rupture_strain does not go with another rupture law",
    ),
    "parameter given twice": (
        BEAM.replace("0.3", "0.3 rupture strain-limit strain 1 strain 2"),
        "strain of strain-limit is given twice",
    ),
    "rupture at no strain": (
        BEAM.replace("0.3", "0.3 rupture_strain 0"),
        "rupture_strain must be positive, not 0",
    ),
    "contact of bonds that never break": (
        BEAM.replace("0.3", "0.3 contact 1"),
        "contact needs rupture_stress or rupture_strain",
    ),
    "bonded anew without contact": (
        BEAM.replace("0.3", "0.3 rupture_strain 1 rebonding_pressure 1e6"),
        "rebonding_pressure needs contact",
    ),
    "unknown word of a beam": (
        BEAM.replace("0.3", "0.3 ruptur_strain 1"),
        "unknown keyword 'ruptur_strain'; known are law, plasticity, ",
    ),
    "bonds that break and conduct": (
        BEAM.replace("0.3", "0.3 rupture_strain 1")
        + "fix bonds all solidem/bonds\n"
        + HEAT
        + "initial_temperature 298\nrun 0\n",
        "bonds that break cannot conduct heat as well",
    ),
    "history of another width": (
        BEAM + "fix bonds all solidem/bonds\nbond_coeff 1 1e9 4e8 pair 0.3 rupture_strain 1\nrun 0\n",
        "define the fix after bond_style and every bond_coeff",
    ),
    "few bonds of bonds that never break": (
        BEAM + "fix bonds all solidem/bonds minimal_bonds 2\nrun 0\n",
        "minimal_bonds needs bond_style solidem/beam with rupture",
    ),
    "unknown attribute of a bond": (
        BEAM + "fix bonds all solidem/bonds\ncompute b all solidem/bond strss\n",
        "unknown attribute 'strss'; known are id1",
    ),
    "no memory for the bonds": (BEAM + "run 0\n", "needs one 'fix ID all solidem/bonds'"),
    "bonds before the bond style": ("fix bonds all solidem/bonds\n", "comes after 'bond_style'"),
    "bonds of a group": (
        BEAM + "group some id 1\nfix bonds some solidem/bonds\n",
        "must be used with group 'all'",
    ),
    "integrator without orientations": (
        "fix motion all nve/solidem\nrun 0\n",
        "needs the orientations of 'fix ID all solidem/bonds'",
    ),
    "no initial temperature": (HEAT + "\n", "needs all of"),
    "unknown keyword": (HEAT + "initial_temprature 298\n", "unknown keyword 'initial_temprature'"),
    "keyword without value": (HEAT + "initial_temperature\n", "keyword without value"),
    "negative density": (
        "fix heat all solidem/conduction law platonic density -1\n",
        "density must be positive",
    ),
    "unknown law": ("fix heat all solidem/conduction law cubic\n", "unknown law 'cubic'"),
    "calibrated without its figures": (
        HEAT.replace("platonic", "platonic-calibrated") + "initial_temperature 298 volume 1\n",
        "needs both area_factor and volume",
    ),
    "factor of another law": (
        HEAT + "initial_temperature 298 area_factor 0.8\n",
        "needs both area_factor and volume, others neither",
    ),
    "voronoi without its file": (
        HEAT.replace("platonic", "voronoi") + "initial_temperature 298\n",
        "law voronoi needs file",
    ),
    "temperature without conduction": (
        "fix hot all solidem/temperature 300\nrun 0\n",
        "needs a 'fix ID all solidem/conduction'",
    ),
    "atoms of beams that nothing turns": (
        BEAM + "fix bonds all solidem/bonds\nfix motion all nve\nrun 0\n",
        "moves 8 bonded atoms that nothing turns, but beams bend with the turn of their atoms: use "
        "'fix ID GROUP nve/solidem' instead",
    ),
    "orientations that nothing turns": (
        BEAM + "fix bonds all solidem/bonds\nfix motion all nve/sphere\nrun 0\n",
        "use 'fix ID GROUP nve/solidem' instead",
    ),
    "orientation that is no rotation": (
        BEAM + "fix bonds all solidem/bonds\nrun 0\n"
        "set atom 3 property/atom orientation 1 0.5 0 0\nrun 0\n",
        "the orientation of atom 3 has the square 1.25",
    ),
    "below absolute zero": (
        HEAT + "initial_temperature -1\n",
        "initial_temperature is counted from absolute zero and must not be below it, but is -1",
    ),
    "set below absolute zero": (
        HEAT + "initial_temperature 298\nrun 0\nset atom 3 property/atom Temp -1\nrun 0\n",
        "atom 3 has -1.000000 K; temperatures are counted from absolute zero",
    ),
    "imposed below absolute zero": (
        HEAT + "initial_temperature 298\nfix cold all solidem/temperature -1\nrun 0\n",
        "must not be below it, but is -1.000000",
    ),
    "temperature by no variable": (
        HEAT + "initial_temperature 298\nfix hot all solidem/temperature v_warm\nrun 0\n",
        "no variable named warm",
    ),
}


def test_rupture_across_periodic_faces_needs_one_rank_to_decide(
    liggghts: Liggghts, tmp_path: Path
) -> None:
    simple_cubic((3, 3, 3), 1e-3, periodic=True).write(tmp_path / "body.data")
    script = BODY.replace("boundary f f f", "boundary p p p")
    script += BEAM.replace("0.3", "0.3 rupture_strain 1") + "fix bonds all solidem/bonds\nrun 0\n"
    with pytest.raises(AssertionError, match="need newton_bond on"):
        liggghts.run(tmp_path, script)
    liggghts.run(tmp_path, script.replace("newton off", "newton off on"))


@pytest.mark.parametrize("case", WRONG)
def test_wrong_input_is_told(liggghts: Liggghts, tmp_path: Path, case: str) -> None:
    lines, message = WRONG[case]
    simple_cubic((2, 2, 2), 1e-3).write(tmp_path / "body.data")
    with pytest.raises(AssertionError) as failure:
        liggghts.run(tmp_path, BODY + lines)
    assert "ERROR" in str(failure.value)
    assert message in str(failure.value)


#: Atoms of a beam that something else turns, that do not move by forces, or whose bonds bear no
#: moments.
RIGHT = {
    "turned by another fix": "fix motion all nve\nfix turning all nve/solidem rotation_only\n",
    "held": "group held id 1 2 3 4\ngroup free subtract all held\nfix grip held move linear 0 0 0\n"
    "fix motion free nve/solidem\n",
    "without forces": "fix motion all nve/noforce\n",
    "springs": "fix motion all nve\n",
}


@pytest.mark.parametrize("case", RIGHT)
def test_motion_that_is_right_is_taken(liggghts: Liggghts, tmp_path: Path, case: str) -> None:
    simple_cubic((2, 2, 2), 1e-3).write(tmp_path / "body.data")
    beam = BEAM.replace("0.3", "0.3 law spring") if case == "springs" else BEAM
    liggghts.run(tmp_path, BODY + beam + "fix bonds all solidem/bonds\n" + RIGHT[case] + "run 1\n")


PAIR = "pair_style solidem/central piecewise stiffness 1e6 attraction 25 range 1.2"
READY = PAIR + "\npair_coeff * *\n"
WRONG_CENTRAL = {
    "unknown law": (
        PAIR.replace("piecewise", "peicewise"),
        "unknown law 'peicewise'; known are piecewise, lennard-jones, shifted-lennard-jones, mie, "
        "threshold",
    ),
    "misspelt parameter": (
        PAIR.replace("stiffness", "stifness"),
        "unknown word 'stifness'; law piecewise has stiffness, attraction, every law has range",
    ),
    "parameter missing": (
        PAIR.replace("attraction 25 ", ""), "law piecewise needs attraction"),
    "parameter of another law": (PAIR + " energy 1", "unknown word 'energy'; law piecewise has"),
    "parameter without value": (PAIR.replace("range 1.2", "range"), "'range' has no value"),
    "not a number": (PAIR.replace("1e6", "1e6N"), "stiffness must be a number, not '1e6N'"),
    "negative parameter": (PAIR.replace("25", "-25"), "attraction must be above 0, not -25"),
    "broken exponent": (
        "pair_style solidem/central mie energy 1 repulsive_exponent 8.5 attractive_exponent 4 "
        "range 1.2",
        "repulsive_exponent must be a whole number from 1, not 8.5",
    ),
    "parameters that do not go together": (
        "pair_style solidem/central mie energy 1 repulsive_exponent 4 attractive_exponent 8 "
        "range 1.2",
        "attractive_exponent must be below repulsive_exponent",
    ),
    "no range": (PAIR.replace(" range 1.2", ""), "needs range, above 1"),
    "range of nothing": (PAIR.replace("1.2", "1"), "range must be above 1, not 1"),
    "unknown equilibrium": (
        PAIR + " equilibrium start", "equilibrium must be initial or radii, not 'start'"),
    "unknown neighbours": (
        PAIR + " neighbours new", "neighbours must be changing or fixed, not 'new'"),
    "interpenetration of all": (
        PAIR + " interpenetration 1", "interpenetration must be above 0 and below 1, not 1"),
    "beyond the pole of the law": (
        "pair_style solidem/central shifted-lennard-jones attraction 25 peak_separation 1.02 "
        "range 1.2 interpenetration 0.3",
        "the law has a pole before",
    ),
    "negative dissipation": (
        PAIR + " dissipation -1", "dissipation must not be negative, but is -1"),
    "coefficients": (PAIR + "\npair_coeff 1 1 5\n", "pair_coeff takes '* *' and no more"),
    "ghosts without velocities": (
        READY.replace("1.2", "1.2 dissipation 1") + "communicate single vel no\nrun 0\n",
        "dissipation needs 'communicate single vel yes'",
    ),
    "damage without its pair style": (
        "fix damage all solidem/damage crack_threshold 0.4\nrun 0\n", "needs 'pair_style solidem/central'"),
    "damage that looks for nothing": (
        READY + "fix damage all solidem/damage\n", "looks for nothing: give crack_threshold C"),
    "misspelt word of damage": (
        READY + "fix damage all solidem/damage crack_faces 0.4\n",
        "unknown word 'crack_faces'; known are crack_threshold, every, minimal_neighbours, removal_every",
    ),
    "damage without value": (
        READY + "fix damage all solidem/damage crack_threshold\n", "'crack_threshold' has no value"),
    "negative crack threshold": (
        READY + "fix damage all solidem/damage crack_threshold -1\n", "crack_threshold must be above 0, not -1"),
    "half a step": (
        READY + "fix damage all solidem/damage crack_threshold 1 every 0.5\n",
        "every must be a whole number from 1, not 0.5",
    ),
    "damage of a group": (
        READY + "group some id 1\nfix damage some solidem/damage crack_threshold 1\n",
        "must be used with group 'all'",
    ),
    "damage twice": (
        READY + "fix one all solidem/damage crack_threshold 1\n"
        "fix two all solidem/damage crack_threshold 1\nrun 0\n",
        "must be the only one of its style",
    ),
    "memory by hand": (
        READY + "fix mine all solidem/central\n", "is made by 'pair_style solidem/central'"),
}


@pytest.mark.parametrize("case", WRONG_CENTRAL)
def test_wrong_input_of_central_forces_is_told(
    liggghts: Liggghts, tmp_path: Path, case: str
) -> None:
    lines, message = WRONG_CENTRAL[case]
    central_body.write(simple_cubic((2, 2, 2), 1e-3), tmp_path / "body.data")
    begin = central_body.HEAD + "boundary f f f\nread_data body.data\nneighbor 1e-4 bin\n"
    with pytest.raises(AssertionError) as failure:
        liggghts.run(tmp_path, begin + lines + "\n")
    assert "ERROR" in str(failure.value)
    assert message in str(failure.value)


def test_a_periodic_cell_where_ids_do_not_tell_pairs(liggghts: Liggghts, tmp_path: Path) -> None:
    """Two atoms that meet each other twice: only without memory."""
    central_body.write(simple_cubic((2, 5, 5), 1e-3, periodic=True), tmp_path / "body.data")
    begin = central_body.HEAD + "boundary p p p\nread_data body.data\nneighbor 1e-4 bin\n"
    with pytest.raises(AssertionError, match="the periodic cell is 0.004 wide in x, but must be"):
        liggghts.run(tmp_path, begin + READY + "run 0\n")
    liggghts.run(tmp_path, begin + READY.replace("1.2", "1.2 equilibrium radii") + "run 0\n")
