# SPDX-License-Identifier: GPL-2.0-or-later
"""One scene for beams and one for central forces, and the effects that are switched on in them."""

from __future__ import annotations

BAR = """
title = "A bar is pulled"
[specimen]
file = "bar.h5"
[material]
density = "2790 kg/m^3"
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
expansion_coefficient = "23e-6 1/K"
[[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1 }
velocity = ["0.5 m/s", "0 m/s", "0 m/s"]
"""

SPECIMEN = """
[specimen]
shape = "box"
size = ["5 mm", "3 mm", "2 mm"]
elements = $elements
"""

BEAMS = """
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
"""

CENTRAL = """
[central_forces]
law = "piecewise"
stiffness = "1500 kN/m"
attraction = "25 N"
range = 1.2
"""

CONDUCTION = """
[conduction]
law = "platonic"
initial_temperature = "296 K"
every = $every
[[temperatures]]
name = "hot"
region = { axis = "x", side = "low", layers = 1 }
value = "297 K"
"""

#: A bar that stretches evenly, so fast that nearly every bond flows in each step.
STRETCHED = """
[[initial_velocities]]
region = { all = true }
velocity = ["2.5 m/s", "0 m/s", "0 m/s"]
stretching = ["1000 1/s", "-500 1/s", "-500 1/s"]
"""

DAMPING = '\n[damping]\nviscous = "100 1/s"\n'
GRAVITY = '\n[gravity]\nacceleration = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]\n'
PLASTICITY = "\n[plasticity]\nyield_strain = $yield\nhardening_ratio = 0.007\n"
RUPTURE = "\n[rupture]\nstrain = 0.2\n"
SENSOR = """
[[sensors]]
name = "end"
point = ["5 mm", "1.5 mm", "1 mm"]
quantity = "displacement"
"""
TOOL = """
[[tools]]
name = "floor"
shape = "plane"
normal = [0, 0, 1]
origin = ["0 mm", "0 mm", "-1 mm"]
"""


def coupled(every: int) -> str:
    """Heat of plastic work that is conducted, expands, and steps once in so many steps of the motion."""
    return heat(every) + "\n[expansion]\n[plastic_heat]\nfraction = 0.9\n"


def heat(every: int) -> str:
    """Conduction beside motion."""
    return CONDUCTION.replace("$every", str(every))


#: Effect -> text that is added; one that begins with "=" takes the place of the base's law.
BEAM_EFFECTS: dict[str, str] = {
    "off again": "",
    "Timoshenko beams": "=" + BEAMS.replace("[beams]", '[beams]\nlaw = "timoshenko"'),
    "springs": "=" + BEAMS.replace("[beams]", '[beams]\nlaw = "spring"').replace(
        "poisson_ratio = 0.3\n", ""),
    "damping": DAMPING,
    "gravity": GRAVITY,
    "a sensor": SENSOR,
    "plasticity, nothing flows": PLASTICITY.replace("$yield", "0.5"),
    "rupture, nothing breaks": RUPTURE,
    "plasticity and rupture": PLASTICITY.replace("$yield", "0.5") + RUPTURE,
    "contact, nothing touches": "\n[contact]\n",
    "a tool, far away": TOOL,
    "heat, each step": heat(1),
    "heat, each hundredth": heat(100),
    "heat and expansion, each hundredth": heat(100) + "\n[expansion]\n",
}

MAY_FLOW = BEAMS + PLASTICITY.replace("$yield", "0.5")
FLOWING = BEAMS + PLASTICITY.replace("$yield", "1e-4") + STRETCHED

COUPLED_EFFECTS: dict[str, str] = {
    "off again": "",
    "heat of flow, conduction, expansion, each hundredth": coupled(100),
    "heat of flow, conduction, expansion, each thousandth": coupled(1000),
}

CENTRAL_EFFECTS: dict[str, str] = {
    "off again": "",
    "dissipation": "=" + CENTRAL + 'dissipation = "0.08 N s/m"\n',
    "damping": DAMPING,
    "gravity": GRAVITY,
    "a sensor": SENSOR,
    "cracks": "\n[damage]\ncrack_threshold = 0.4\n",
    "cracks and removal": "\n[damage]\ncrack_threshold = 0.4\nminimal_neighbours = 3\n",
    "a tool, far away": TOOL,
}


def scene(base: str, effect: str, steps: int) -> str:
    """The base with one effect."""
    law, more = (effect[1:], "") if effect.startswith("=") else (base, effect)
    bar = BAR.replace("0.5 m/s", "5 m/s") if STRETCHED in law else BAR
    return f"{bar}{law}{more}\n[run]\nsteps = {steps}\nobserve_every = {steps}\n[output]\nframes = 0\n"
