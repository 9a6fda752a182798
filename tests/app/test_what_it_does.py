# SPDX-License-Identifier: GPL-2.0-or-later
"""What docs/what_it_does.md says that scenes refuse is refused, in the words of the page."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from scene_parts import ALUMINIUM, CONDUCTING_ALUMINIUM, HIGH_END, STIFF_BEAMS, crystal, grip

if TYPE_CHECKING:
    from conftest import Program

PAGE = Path(__file__).resolve().parents[2] / "docs" / "what_it_does.md"
BODY = crystal("bcc", 6, 4, 4)
PERIODIC = BODY + "periodic = [true, true, true]\n"
CENTRAL = ('[central_forces]\nlaw = "piecewise"\nstiffness = "1500 kN/m"\nattraction = "25 N"\n'
           "range = 1.2\n")
LOOSE = '[contact]\nnormal_stiffness = "1 kN/m"\n'
SPRINGS = '[beams]\nlaw = "spring"\nyoung_modulus = "1 TPa"\nradius_ratio = 0.3\n'
SECOND_MATERIAL = ('[[beams.material]]\nname = "soft"\nyoung_modulus = "1 GPa"\npoisson_ratio = 0.3\n'
                   'region = { axis = "x", side = "low", depth = "0.5 mm" }\n')
FLOW = "[plasticity]\nyield_strain = 0.002\n"
BREAK = "[rupture]\nstrain = 0.1\n"
PASSING_ON = '[contact_conduction]\nconductance = "1 mW/K"\n'
GAUGE = '[gauge]\naxis = "x"\nlower = "0.4 mm"\nupper = "0.9 mm"\n'
TOOL = '[[tools]]\nname = "pin"\nshape = "sphere"\norigin = ["-1 mm", "0 mm", "0 mm"]\nradius = "0.2 mm"\n'
RUN = "[run]\nsteps = 2\n"

#: The first cell of a row -> a scene.
SCENES = {
    "`[beams]`, `[central_forces]`": BODY + ALUMINIUM + STIFF_BEAMS + CENTRAL,
    "`[central_forces]`, `[contact]`": BODY + ALUMINIUM + CENTRAL + LOOSE,
    "`[contact]` alone, `[conduction]`": BODY + CONDUCTING_ALUMINIUM + LOOSE,
    "`[contact]` alone, `[gauge]`": BODY + ALUMINIUM + LOOSE + GAUGE,
    '`[beams]` `law = "spring"`, `[contact]` `friction`':
        BODY + ALUMINIUM + SPRINGS + "[contact]\nfriction = 0.3\n",
    "`[[beams.material]]`, `[beams.anisotropy]`": BODY + ALUMINIUM + STIFF_BEAMS + SECOND_MATERIAL
    + '[beams.anisotropy]\ngrain = [1, 0, 0]\ntangential_modulus = "1 GPa"\n',
    '`[plasticity]` `law = "scaled-offset"`, `[contact]` `rebonding_pressure`':
        BODY + ALUMINIUM + STIFF_BEAMS + FLOW + 'law = "scaled-offset"\n' + BREAK
        + '[contact]\nrebonding_pressure = "1 GPa"\n',
    "`[damping]` `bonds`, `[[grips]]` that turn": BODY + ALUMINIUM + STIFF_BEAMS
    + "[damping]\nbonds = 0.1\n" + grip("screw", HIGH_END, 'torque = "1 N m"\nrotation_axis = [1, 0, 0]'),
    "a periodic body, `[[tools]]`": PERIODIC + ALUMINIUM + STIFF_BEAMS + TOOL,
    "`[damage]`, `[beams]` without `[rupture]`":
        BODY + ALUMINIUM + STIFF_BEAMS + "[damage]\ncrack_threshold = 0.7\n",
    "`[plastic_heat]` without `[plasticity]`":
        BODY + CONDUCTING_ALUMINIUM + STIFF_BEAMS + "[plastic_heat]\n",
    "`[friction_heat]` without `[contact]` or `[[tools]]`":
        BODY + CONDUCTING_ALUMINIUM + STIFF_BEAMS + "[friction_heat]\n",
    "`[contact_conduction]` without `[contact]` or `[[tools]]`":
        BODY + CONDUCTING_ALUMINIUM + STIFF_BEAMS + PASSING_ON,
    "`[contact_conduction]` without `[contact]`, `[[tools]]` without `temperature`":
        BODY + CONDUCTING_ALUMINIUM + STIFF_BEAMS + TOOL + PASSING_ON,
    '`[contact]` alone, `[conduction]` `law = "voronoi"`':
        BODY + CONDUCTING_ALUMINIUM + 'law = "voronoi"\n' + LOOSE + PASSING_ON,
    "`[contact]` alone, `[[convections]]`": BODY + CONDUCTING_ALUMINIUM + LOOSE + PASSING_ON
    + '[[convections]]\nname = "air"\nwall = "x_low"\ncoefficient = "1 W/(m^2 K)"\n'
      'temperature = "300 K"\n',
}


def refusals() -> dict[str, str]:
    """First cell -> second cell of the last table."""
    table = PAGE.read_text().split("## What a scene refuses")[1]
    rows = re.findall(r"^\| (.*) \| (.*) \|$", table, flags=re.MULTILINE)
    return {first: second for first, second in rows if first != "beside each other"}


def test_each_row_of_the_page_has_a_scene() -> None:
    assert set(refusals()) == set(SCENES)


@pytest.mark.parametrize("row", SCENES)
def test_the_scene_of_a_row_is_refused_in_its_words(row: str, solidem: Program) -> None:
    run = solidem("run", solidem.scene("scene.toml", SCENES[row] + RUN), "--output", "results", "--quiet")
    assert run.returncode == 2
    assert refusals()[row] in run.stderr
