# SPDX-License-Identifier: GPL-2.0-or-later
"""A bonded block falls on a floor of two facets and breaks; a loose ball bounces off floor and wall.

    solidem specimen block.toml --output block.h5
    yade -n -x -j1 dropped_block.py block.h5 [speed, m/s] [steps]

Prints a line of figures. Bonds and contacts of the block are YADE's cohesive-frictional law, facets,
wall and ball touch by Cundall and Strack's.
"""

import sys
from pathlib import Path

# YADE runs a script as its own __main__, so __file__ is the program, not this file.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parents[1]))

from bonded import Bonds, add_specimen, engines, stable_step  # noqa: E402
from yade import FrictMat, O, utils  # noqa: E402

speed = float(sys.argv[2]) if len(sys.argv) > 2 else 20.0
steps = int(sys.argv[3]) if len(sys.argv) > 3 else 2000

bonds = Bonds(young_modulus=70e9, shear_modulus=27e9, radius_ratio=0.5, density=2700,
              tensile_strength=80e6, shear_strength=80e6)
block = add_specimen(sys.argv[1], bonds, velocity=(0, 0, -speed))

# The block stands where its file has it: the floor is just below.
lowest = min(O.bodies[i].state.pos[2] - O.bodies[i].shape.radius for i in block)
radius = max(O.bodies[i].shape.radius for i in block)
size, floor = 200 * radius, lowest - 0.01 * radius
stone = O.materials.append(FrictMat(young=5e9, poisson=0.4, density=2700, frictionAngle=0.0))
corners = [(-size, -size, floor), (size, -size, floor), (size, size, floor), (-size, size, floor)]
O.bodies.append([utils.facet([corners[0], corners[1], corners[2]], material=stone),
                 utils.facet([corners[0], corners[2], corners[3]], material=stone)])
O.bodies.append(utils.wall(-50 * radius, axis=0, material=stone))
ball = O.bodies.append(utils.sphere((-48.5 * radius, 0, floor + 1.2 * radius), radius,
                                    material=stone))
O.bodies[ball].state.vel = (-speed, 0, -speed)

O.engines, O.dt = engines(gravity=(0, 0, -9.81)), stable_step()
made = sum(1 for i in O.interactions if hasattr(i.phys, "unp"))
start = utils.kineticEnergy()
O.run(steps, True)

whole = sum(1 for i in O.interactions if hasattr(i.phys, "unp") and i.phys.normalAdhesion > 0
            and not i.phys.cohesionBroken)
lowest = min(O.bodies[i].state.pos[2] for i in [*block, ball]) - floor
print(f"bonds {made} whole {whole} lowest/radius {lowest / radius:.4f} "
      f"motion/start {utils.kineticEnergy() / start:.6f} "
      f"ball {O.bodies[ball].state.vel[0] / speed:.6f} {O.bodies[ball].state.vel[2] / speed:.6f}")
