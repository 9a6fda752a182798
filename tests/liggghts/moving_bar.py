# SPDX-License-Identifier: GPL-2.0-or-later
"""One scene with everything in it: a bonded bar that flies, spins, vibrates and conducts heat.

It flies through a fixed box, so that its atoms change processor while bonds cross between them. The
conductivity is large enough for heat to spread in so short a time.
"""

from pathlib import Path

import numpy as np

from liggghts_runs import HEADER, Liggghts, dump, read_dump, simple_cubic

RADIUS = 0.5e-3
CELLS = (12, 4, 4)
SIZE = 2 * RADIUS * CELLS[0]
AXIAL_STIFFNESS = 3.5e10 * np.pi * (0.3 * RADIUS) ** 2  # E S, N
STEPS = 100

SETTINGS = """bond_style solidem/beam
bond_coeff 1 3.5e10 1.3e10 pair 0.3
"""
MOTION = """fix bonds all solidem/bonds
fix motion all nve/solidem
timestep 1e-7
"""
STYLES = MOTION + """fix heat all solidem/conduction law platonic conductivity 1e6 specific_heat 880 density 2790 &
  initial_temperature 298
fix hot hot solidem/temperature 798
thermo_style custom step atoms ke f_heat f_hot
thermo_modify format float %.17g norm no
"""
COLUMNS = ["x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz", "fx", "fy", "fz"]
COLUMNS += ["tqx", "tqy", "tqz"]
MECHANICS = len(COLUMNS)
COLUMNS += ["f_Temp"] + [f"f_orientation[{k}]" for k in (1, 2, 3, 4)]


def write_body(folder: Path, seed: int = 5, violence: float = 1.0) -> None:
    """The bar, vibrating at random while it flies 2 mm and turns by .4 rad in 100 steps."""
    body = simple_cubic(CELLS, RADIUS)
    random = np.random.default_rng(seed)
    body.position += 0.02 * RADIUS * random.normal(size=body.position.shape)
    middle = body.position.mean(axis=0)
    spin = np.array([1e4, -3e4, 2e4])
    body.velocity = np.empty((len(body.position), 6))
    body.velocity[:, :3] = np.array([200.0, 100.0, -80.0]) + np.cross(spin, body.position - middle)
    body.velocity[:, :3] += violence * random.normal(size=body.position.shape)
    body.velocity[:, 3:] = spin + 1e3 * violence * random.normal(size=body.position.shape)
    body.write(folder / "body.data")


def beginning(newton: str = "off", rebuild: bool = True, styles: str = SETTINGS + STYLES) -> str:
    """A script up to its first run."""
    rebuilds = "every 1 delay 0 check no" if rebuild else "once yes"
    return (
        HEADER
        + f"boundary f f f\nnewton {newton}\nread_data body.data\nneighbor 0.5e-3 bin\n"
        + f"neigh_modify {rebuilds}\npair_style none\ngroup hot id 1:16\n"
        + styles
    )


def state(name: str = "state", every: int = STEPS) -> str:
    return dump(name, every, *COLUMNS)


def run(
    liggghts: Liggghts, folder: Path, script: str, ranks: int = 1, name: str = "state"
) -> dict[int, np.ndarray]:
    """Frames of the named dump of a script, the body's data file beside it."""
    folder.mkdir(exist_ok=True)
    write_body(folder)
    liggghts.run(folder, script, ranks)
    return read_dump(folder / f"{name}.txt")


def largest_difference(a: np.ndarray, b: np.ndarray) -> float:
    """Largest difference of two states, each quantity measured by its own scale."""
    speed, spin = np.abs(a[:, 3:6]).max(), np.abs(a[:, 6:9]).max()
    scale = [SIZE] * 3 + [speed] * 3 + [spin] * 3
    scale += [AXIAL_STIFFNESS] * 3 + [AXIAL_STIFFNESS * RADIUS] * 3 + [500.0] + [1.0] * 4
    return float((np.abs(a - b) / scale[: a.shape[1]]).max())


def check_it_moved(frame: np.ndarray) -> None:
    """The scene must exercise what it is for: strain, rotation and heat."""
    assert np.abs(frame[:, 9:12]).max() > 1e-3 * AXIAL_STIFFNESS
    assert np.abs(frame[:, 17:20]).max() > 0.1
    assert (frame[:, 15] > 299).sum() > 20
