# SPDX-License-Identifier: GPL-2.0-or-later
"""A conducting body with faces of arbitrary areas, its files for LIGGGHTS, and its explicit steps
in numpy."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from liggghts_runs import HEADER, Body

RADIUS = 1e-3
CELLS = (10, 4, 3)
CONDUCTIVITY, SPECIFIC_HEAT, DENSITY = 134.0, 880.0, 2790.0
MATERIAL = (
    f"conductivity {CONDUCTIVITY} specific_heat {SPECIFIC_HEAT} density {DENSITY} "
    "initial_temperature 298"
)
VORONOI = f"fix heat all solidem/conduction law voronoi file cells.txt {MATERIAL}\n"
LEFT = "fix left all solidem/exchange file walls.txt name left temperature 798\n"
RIGHT = "fix right all solidem/exchange file walls.txt name right temperature v_outside\n"
OUTSIDE = "variable outside equal 300+2000*step*dt\n"
STEP = 2e-3
STEPS = 100


@dataclass
class Network:
    """Elements that exchange heat; `walls`: name -> elements and their conductances."""

    body: Body
    area: np.ndarray  # (B) m²
    distance: np.ndarray  # (B) m
    volume: np.ndarray  # (N) m³
    walls: dict[str, tuple[np.ndarray, np.ndarray]]  # zero-based elements, W/K

    @property
    def conductance(self) -> np.ndarray:
        return CONDUCTIVITY * self.area / self.distance

    @property
    def capacity(self) -> np.ndarray:
        return DENSITY * SPECIFIC_HEAT * self.volume

    def write(self, folder: Path) -> None:
        """body.data, cells.txt and walls.txt."""
        folder.mkdir(exist_ok=True)
        self.body.write(folder / "body.data")
        cells = ["# of a body made up for a test", f"volumes {len(self.volume)}"]
        cells += [f"{k} {v:.17g}" for k, v in enumerate(self.volume, 1)]
        cells += ["", f"faces {len(self.area)}"]
        order = np.random.default_rng(3).permutation(len(self.area))
        for k in order:  # in any order, either atom first
            i, j = self.body.pairs[k][:: -1 if k % 2 else 1] + 1
            cells.append(f"{i} {j} {self.area[k]:.17g} {self.distance[k]:.17g}")
        (folder / "cells.txt").write_text("\n".join(cells) + "\n")
        walls = []
        for name, (elements, conductance) in self.walls.items():
            walls.append(f"{name} {len(elements)}")
            walls += [f"{i + 1} {g:.17g}" for i, g in zip(elements, conductance)]
        (folder / "walls.txt").write_text("\n".join(walls) + "\n")

    def power(self, temperature: np.ndarray, outside: dict[str, float]) -> np.ndarray:
        """Power into each element, W."""
        i, j = self.body.pairs.T
        flow = self.conductance * (temperature[j] - temperature[i])
        power = np.zeros_like(temperature)
        np.add.at(power, i, flow)
        np.subtract.at(power, j, flow)
        for name, outer in outside.items():
            elements, conductance = self.walls[name]
            np.add.at(power, elements, conductance * (outer - temperature[elements]))
        return power


def outside(step: int) -> dict[str, float]:
    """What LEFT and RIGHT impose at a step."""
    return {"left": 798.0, "right": 300 + 2000 * step * STEP}


def network() -> Network:
    """A bar of 120 elements on a shaken lattice, faces to neighbours beside and across."""
    random = np.random.default_rng(11)
    cell = np.indices(CELLS).reshape(3, -1).T
    position = 2 * RADIUS * cell + random.uniform(-0.2, 0.2, cell.shape) * RADIUS
    radius = RADIUS * random.uniform(0.875, 1.125, len(cell))
    apart = np.linalg.norm(position[:, None] - position[None], axis=2)
    pairs = np.argwhere(np.triu(apart < 3.2 * RADIUS, 1))
    distance = apart[pairs[:, 0], pairs[:, 1]]
    area = random.uniform(0.1, 4, len(pairs)) * RADIUS**2
    volume = random.uniform(4, 9, len(cell)) * RADIUS**3
    walls = {}
    for name, layer in (("left", 0), ("right", CELLS[0] - 1)):
        elements = np.flatnonzero(cell[:, 0] == layer)
        walls[name] = (elements, random.uniform(0.1, 1, len(elements)))
    margin = 20 * RADIUS
    body = Body(
        position, radius, pairs, position.min(axis=0) - margin, position.max(axis=0) + margin
    )
    return Network(body, area, distance, volume, walls)


def beginning(newton: str = "off") -> str:
    """A script up to the fixes: the body flies through a fixed box, so that atoms change rank."""
    return HEADER + (
        f"boundary f f f\nnewton {newton}\nread_data body.data\nneighbor 0.2e-3 bin\n"
        "neigh_modify every 1 delay 0 check no\npair_style none\n"
        "fix flight all move linear 60e-3 30e-3 20e-3\n" + OUTSIDE
    )


ENERGY = (
    "thermo_style custom step atoms f_heat f_left f_right\n"
    "thermo_modify format float %.17g norm no\nthermo 10\n"
)
