# SPDX-License-Identifier: GPL-2.0-or-later
"""`pip install .` works without a network, and what it installs runs far from the tree."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

TRIAL = """\
import solidem
assert "site-packages" in solidem.__file__, solidem.__file__
simulation = solidem.Scene({
    "specimen": {"shape": "crystal", "lattice": "bcc", "cells": [3, 3, 3], "element_radius": "0.1 mm"},
    "material": {"density": "2790 kg/m^3"},
    "beams": {"young_modulus": "3.5 TPa", "poisson_ratio": 0.3, "radius_ratio": 0.27},
    "run": {"steps": 10}}).simulation()
simulation.run()
print(solidem.__version__, simulation.steps_done)
"""


def run(*command: object, cwd: Path) -> str:
    """What a command prints; its errors are shown when it fails."""
    done = subprocess.run([str(word) for word in command], check=False, text=True, cwd=cwd,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.mark.slow
def test_pip_installs_it_without_a_network(tmp_path: Path) -> None:
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv", cwd=tmp_path)
    python = tmp_path / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", ROOT, cwd=tmp_path)
    assert run(python, "-c", TRIAL, cwd=tmp_path).split()[1] == "10"
    shown = run(python, "-m", "pip", "show", "--files", "solidem", cwd=tmp_path)
    assert "GPL-2.0-or-later" in shown and "solidem/py.typed" in shown and "_core.pyi" in shown


@pytest.mark.slow
def test_the_wheel_is_whole(tmp_path: Path) -> None:
    run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "-w", tmp_path, ROOT,
        cwd=tmp_path)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as file:
        assert file.testzip() is None
        names = set(file.namelist())
        (record,) = [name for name in names if name.endswith("RECORD")]
        recorded = {line.split(",")[0] for line in file.read(record).decode().splitlines()}
    assert recorded == names
    sources = {f"solidem/{path.name}" for path in (ROOT / "python" / "solidem").iterdir()
               if path.suffix in (".py", ".pyi", ".typed")}
    assert sources < names
