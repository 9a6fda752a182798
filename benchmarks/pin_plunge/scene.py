# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of the plunge: a plate of AA2024-T351, a threaded pin, and how both meet."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

PIN = Path(__file__).resolve().parents[2] / "docs" / "examples" / "threaded_pin.obj"
THICKNESS, DEPTH = 2e-3, 0.5e-3  #: of the plate; of the hole, m
SPEED, RAMP = 0.25, 40e-6  #: of the pin, m/s; in which it reaches that, s
DURATION = DEPTH / SPEED + RAMP / 2  #: s
PIN_RADIUS = 1.5e-3  #: of the crest of its thread, m
TAYLOR_QUINNEY = 0.9

#: Johnson and Cook's law of AA2024-T351 (their figures of 1985), which the bonds are calibrated to.
CURVE = """\
yield_stress = "265 MPa"
hardening_stress = "426 MPa"
hardening_exponent = 0.34
"""
CALIBRATION = f"""\
[specimen]
shape = "box"
size = ["5 mm", "3 mm", "2 mm"]
elements = 500
seed = 1
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.26
[plasticity]
hardening = "johnson-cook"
{CURVE}rate_sensitivity = 0.015
reference_rate = "1 1/s"
softening_exponent = 1
reference_temperature = "296 K"
melting_temperature = "775 K"
[calibration]
young_modulus = "73 GPa"
poisson_ratio = 0.33
specimens = 3
tension_tests = 5
speed = "10 m/s"
[calibration.curve]
{CURVE}strains = [0.01, 0.02, 0.05, 0.1]
tolerance = 0.03
"""

PLATE = """\
title = "A threaded pin is pressed and turned into a plate"

[specimen]
shape = "plate"
length = "6 mm"
width = "6 mm"
thickness = "2 mm"
elements = {elements}
seed = {seed}

[material]
density = "2790 kg/m^3"
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
expansion_coefficient = "2.3e-5 1/K"

{beams}
[rupture]
strain = 0.15

[contact]
{friction}
rebonding_pressure = "5 GPa"

[conduction]
law = "platonic-calibrated"
initial_temperature = "296 K"
largest_change = "2 K"

[plastic_heat]
fraction = 0.9

[expansion]
{rubbing}{scaling}
[[grips]]
name = "base"
region = {{ axis = "z", side = "low", layers = 1 }}
velocity = ["0 m/s", "0 m/s", "0 m/s"]

[[tools]]
name = "pin"
shape = "mesh"
file = "{pin}"
unit = "1 mm"
origin = ["3 mm", "3 mm", "2 mm"]
velocity = ["0 m/s", "0 m/s", {{ time = ["0 us", "40 us"], value = ["0 m/s", "-0.25 m/s"] }}]
angular_velocity = "1000 rpm"
rotation_axis = [0, 0, 1]
{tool}
[run]
duration = "{duration} s"
time_step_ratio = {ratio}
observe_every = {observe_every}

[output]
frames = {frames}
checkpoint_every = 2000
"""
#: Contacts of elements: as stiff across as those of the pin, which the time step does not feel.
ROUGH = "friction = 0.3\ntangential_stiffness_ratio = 0.285714"
#: What comes to it where the pin rubs: M42 steel that stays cold, hard against the plate.
RUBBING = """
[friction_heat]

[contact_conduction]
coefficient = "30000 W/(m^2 K)"
"""
STEEL = """\
friction = 0.3
conductivity = "21 W/(m K)"
density = "7970 kg/m^3"
specific_heat_capacity = "420 J/(kg K)"
temperature = "296 K"
"""


@dataclass(frozen=True)
class Case:
    """A run."""

    elements: int
    factor: float  #: of the masses in the equations of motion
    rubs: bool = False  #: friction, and heat of the tool
    seed: int = 1
    ratio: float = 0.5  #: time step over the stable one
    frames: int = 40

    @property
    def name(self) -> str:
        """Of its folder."""
        return (f"{'rubbing' if self.rubs else 'smooth'}_{self.elements}_{self.factor:g}"
                f"_{self.ratio:g}_{self.seed}")

    def text(self, beams: str) -> str:
        """The scene, with the beams and the flow that a calibration found."""
        return PLATE.format(
            elements=self.elements, seed=self.seed, beams=beams, pin=PIN, duration=DURATION,
            friction=ROUGH if self.rubs else "friction = 0", rubbing=RUBBING if self.rubs else "",
            tool=STEEL if self.rubs else "", ratio=self.ratio, observe_every=50,
            frames=self.frames,
            scaling=f"\n[mass_scaling]\nfactor = {self.factor:g}\n" if self.factor > 1 else "")
