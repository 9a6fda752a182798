# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong input ends with a message that says what is wrong."""

from pathlib import Path

import pytest

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
        "unknown plasticity 'j2'; known are radial-return, scaled-offset",
    ),
    "negative yield stress": (
        BEAM.replace("0.3", "0.3 plasticity radial-return -1e6 0"),
        "the yield stress must be positive, not -1e6",
    ),
    "hardening missing": (
        BEAM.replace("0.3", "0.3 plasticity radial-return 1e6"),
        "'the hardening modulus' is missing",
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
        "unknown keyword 'ruptur_strain'; known are law, plasticity, rupture_stress",
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
