# SPDX-License-Identifier: GPL-2.0-or-later
"""A specimen with bonds in a YADE script of one's own: the script of the page, and the example."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

from compare.codes.base import ROOT

YADE = ROOT / "contrib" / "yade"
RADIUS = 1e-3


def write(path: Path, position: np.ndarray, pairs: np.ndarray) -> None:
    with h5py.File(path, "w") as file:
        file["elements/position"], file["elements/radius"] = position, np.full(len(position), RADIUS)
        file["bonds/pairs"] = pairs.astype("i4")


def yade(script: Path, *arguments: str | Path) -> str:
    done = subprocess.run(["yade", "-n", "-x", "-j1", script, *map(str, arguments)],
                          cwd=script.parent, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0 and "Error" not in done.stderr, done.stdout + done.stderr
    return done.stdout


def test_the_script_of_the_page_bonds_as_beams_do(tmp_path: Path) -> None:
    """A pair that overlaps, bonded as it stands: free of load there, then of a beam's stiffness in
    tension, shear and twist."""
    page = (YADE / "README.md").read_text()
    lines = re.findall(r"```python\n(.*?)```", page, re.S)[0].splitlines()
    assert len(lines) == 5
    length = 1.95e-3
    write(tmp_path / "specimen.h5", np.array([[0, 0, 0], [length, 0, 0]]), np.array([[0, 1]]))
    moves = [("vel", (1, 0, 0)), ("vel", (0, 1, 0)), ("angVel", (1, 0, 0))]
    script = [f"import sys; sys.path.insert(0, {str(YADE)!r})", *lines[:-1],
              "for i in ids: O.bodies[i].state.blockedDOFs = 'xyzXYZ'", "O.run(2, True)",
              "print('force', *O.forces.f(ids[1]))", "s = O.bodies[ids[1]].state"]
    for name, speed in moves:
        script += [f"s.{name} = {speed}", "O.run(2, True)", f"s.{name} = (0, 0, 0)", "O.run(1, True)",
                   "print('force', *O.forces.f(ids[1]), *O.forces.t(ids[1]), O.dt)"]
    (tmp_path / "script.py").write_text("\n".join(script) + "\n")
    rows = [np.array(line.split()[1:], dtype=float) for line in
            yade(tmp_path / "script.py").splitlines() if line.startswith("force")]
    assert abs(rows[0][:3]).max() < 1e-9
    area = np.pi * (0.5 * RADIUS) ** 2
    moment = area**2 / 4 / np.pi
    way = 2 * rows[1][6]
    assert -rows[1][0] / way == pytest.approx(70e9 * area / length, rel=1e-6)
    assert -rows[2][1] / way == pytest.approx(12 * 70e9 * moment / length**3, rel=1e-3)
    assert -rows[3][3] / way == pytest.approx(27e9 * 2 * moment / length, rel=1e-3)


def test_the_example_breaks_a_block_beside_a_ball_that_bounces(tmp_path: Path) -> None:
    cells = np.indices((4, 4, 4)).reshape(3, -1).T
    position = 2 * RADIUS * cells
    apart = np.linalg.norm(position[:, None] - position[None], axis=2)
    write(tmp_path / "block.h5", position, np.argwhere(np.triu(apart < 2.01 * RADIUS, 1)))
    said = yade(YADE / "examples" / "dropped_block.py", tmp_path / "block.h5", 40, 900)
    line = next(line for line in said.splitlines() if line.startswith("bonds"))
    print(line)
    _, made, _, whole, _, lowest, _, motion, _, ball_x, ball_z = line.split()
    assert int(made) == 144 and 0 < int(whole) < 140
    assert float(lowest) > 0.7, "nothing falls through the facets"
    assert 0.3 < float(motion) < 1.0
    # Without friction and damping floor and wall send the ball back as it came.
    assert float(ball_x) == pytest.approx(1, abs=0.01)
    assert float(ball_z) == pytest.approx(1, abs=0.01)
