# SPDX-License-Identifier: GPL-2.0-or-later
"""docs/history.md tells every column of every effect, and no other."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from scene_parts import (ALUMINIUM, CONDUCTING_ALUMINIUM, HELD, HIGH_END, LOW_END, STIFF_BEAMS,
                         crystal, grip)

if TYPE_CHECKING:
    from conftest import Program

PAGE = Path(__file__).resolve().parents[2] / "docs" / "history.md"
BODY = crystal("bcc", 6, 4, 4)
RUN = "[run]\nsteps = 2\n[output]\nframes = 0\n"
FREE_GRIP = grip("left", LOW_END, HELD)
SENSORS = "".join(f'[[sensors]]\nname = "{quantity}"\npoint = ["0.5 mm", "0.3 mm", "0.3 mm"]\n'
                  f'quantity = "{quantity}"\n' for quantity in ("position", "displacement", "velocity"))
ALL_THAT_HEATS = """\
[[temperatures]]
name = "hot"
region = { axis = "x", side = "high", layers = 1 }
value = "400 K"
[[heat_fluxes]]
name = "flame"
wall = "y_low"
flux = "1 kW/m^2"
[[convections]]
name = "air"
wall = "y_high"
coefficient = "10 W/(m^2 K)"
temperature = "300 K"
[[convections]]
name = "wind"
wall = "exposed"
coefficient = "10 W/(m^2 K)"
temperature = "300 K"
[[heat_sources]]
name = "inside"
power = "1 W"
region = { all = true }
[[sensors]]
name = "middle"
point = ["0.5 mm", "0.3 mm", "0.3 mm"]
quantity = "temperature"
"""
SCENES = {
    "beams that flow, break and touch": BODY + ALUMINIUM + STIFF_BEAMS + FREE_GRIP + SENSORS + """\
[plasticity]
yield_strain = 0.002
[rupture]
strain = 0.1
minimal_bonds = 1
[contact]
friction = 0.3
restitution = 0.5
rebonding_pressure = "1 GPa"
[damage]
crack_threshold = 0.7
minimal_neighbours = 1
[gravity]
acceleration = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[damping]
viscous = "100 1/s"
local = 0.1
bonds = 0.1
[gauge]
axis = "x"
lower = "0.4 mm"
upper = "0.9 mm"
""",
    "beams, a turning grip and a tool": BODY + ALUMINIUM + STIFF_BEAMS
    + grip("screw", HIGH_END, 'torque = "1 N m"\nrotation_axis = [1, 0, 0]') + """\
[mass_scaling]
factor = 4
[[tools]]
name = "pin"
shape = "sphere"
origin = ["-1 mm", "0 mm", "0 mm"]
radius = "0.2 mm"
friction = 0.3
restitution = 0.5
angular_velocity = "100 rpm"
rotation_axis = [0, 0, 1]
""",
    "central forces": BODY + ALUMINIUM + """\
[central_forces]
law = "piecewise"
stiffness = "1500 kN/m"
attraction = "25 N"
range = 1.2
dissipation = "0.08 N s/m"
[damage]
crack_threshold = 0.4
minimal_neighbours = 1
""",
    "heat and work": BODY + CONDUCTING_ALUMINIUM.replace(
        "conductivity", 'expansion_coefficient = "2e-5 1/K"\nconductivity', 1)
    + 'largest_change = "1 K"\n' + ALL_THAT_HEATS + STIFF_BEAMS + """\
[plasticity]
yield_strain = 0.002
[plastic_heat]
[expansion]
[[tools]]
name = "pin"
shape = "sphere"
origin = ["-1 mm", "0 mm", "0 mm"]
radius = "0.2 mm"
friction = 0.3
temperature = "300 K"
[friction_heat]
[contact_conduction]
conductance = "1 mW/K"
""",
}


def columns_of_the_page() -> set[str]:
    """Those in the first cell of each row."""
    return set(re.findall(r"^\| `([\w.]+)` \|", PAGE.read_text(), flags=re.MULTILINE))


def general(column: str) -> str:
    """A column as the page writes it: with NAME, of the three axes the first."""
    column = re.sub(r"^(grip|tool|sensor|temperature|convection|heat_flux|heat_source)\.[\w-]+\.",
                    r"\1.NAME.", column)
    return re.sub(r"_[yz]$", "_x", column)


def columns(solidem: Program, text: str) -> set[str]:
    """Those of the history of a scene, as the page writes them."""
    name = f"scene{sum(1 for _ in solidem.folder.iterdir())}"
    run = solidem("run", solidem.scene(name + ".toml", text + RUN), "--output", name, "--quiet")
    assert run.returncode == 0, run.stderr
    with open(solidem.folder / name / "history.csv") as history:
        return {general(column) for column in history.readline().strip().split(",")}


@pytest.mark.parametrize("title", SCENES)
def test_each_column_of_a_run_is_on_the_page(title: str, solidem: Program) -> None:
    assert columns(solidem, SCENES[title]) <= columns_of_the_page()


def test_each_column_on_the_page_is_in_a_run(solidem: Program) -> None:
    assert columns_of_the_page() == set().union(*(columns(solidem, text) for text in SCENES.values()))


def test_each_column_on_the_page_has_a_unit() -> None:
    rows = re.findall(r"^\| `[\w.]+` \| ([^|]*) \|", PAGE.read_text(), flags=re.MULTILINE)
    assert len(rows) == len(columns_of_the_page())
    assert set(rows) <= {"1", "s", "m", "m²", "m/s", "rad", "N", "N m", "Pa", "J", "W", "K"}
