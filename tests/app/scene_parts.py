# SPDX-License-Identifier: GPL-2.0-or-later
"""Pieces of which tests put small scenes together."""

DENSITY = 'density = "2790 kg/m^3"\n'
ALUMINIUM = f'[material]\n{DENSITY}'
#: The same in a scene with heat.
CONDUCTING_ALUMINIUM = ALUMINIUM + """\
specific_heat_capacity = "880 J/(kg K)"
conductivity = "134 W/(m K)"
[conduction]
initial_temperature = "298 K"
"""
#: Beams of a packing that is as stiff as aluminium.
STIFF_BEAMS = """\
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
"""
#: Of a chain of such spheres: one end stands, the other moves along x.
PULLED_ENDS = """\
[[grips]]
name = "left"
region = { axis = "x", side = "low", depth = "0.15 mm" }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", depth = "0.15 mm" }
velocity = ["SPEED m/s", "0 m/s", "0 m/s"]
"""
THICK_BEAMS = """\
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
"""


def crystal(lattice: str, *cells: int) -> str:
    """A body of touching spheres of a radius of a tenth of a millimetre."""
    return (f'[specimen]\nshape = "crystal"\nlattice = "{lattice}"\ncells = {list(cells)}\n'
            'element_radius = "0.1 mm"\n')


def grip(name: str, region: str, motion: str) -> str:
    """A grip on what a region, without its braces, holds."""
    return f'[[grips]]\nname = "{name}"\nregion = {{ {region} }}\n{motion}\n'


LOW_END, HIGH_END = ('axis = "x", side = "low", layers = 1', 'axis = "x", side = "high", layers = 1')
HELD = 'displacement = ["0 m", "0 m", "0 m"]'
