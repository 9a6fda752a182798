# SPDX-License-Identifier: GPL-2.0-or-later
"""`pip install .` works without a network, and what it installs runs far from the tree."""

from __future__ import annotations

import fcntl
import importlib
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path
from types import ModuleType
from typing import Iterator

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: Not in build/wheel, where the core would be compiled again.
BUILT = ("--config-settings", "build-directory=build/release")

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


@pytest.fixture
def alone() -> Iterator[None]:
    """While a test builds in build/release no other does."""
    with (ROOT / "build/release/tests.lock").open("a") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def run(*command: object, cwd: Path) -> str:
    """What a command prints; its errors are shown when it fails."""
    done = subprocess.run([str(word) for word in command], check=False, text=True, cwd=cwd,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.mark.slow
@pytest.mark.usefixtures("alone")
def test_pip_installs_it_without_a_network(tmp_path: Path) -> None:
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv", cwd=tmp_path)
    python = tmp_path / "venv" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", *BUILT, ROOT, cwd=tmp_path)
    assert run(python, "-c", TRIAL, cwd=tmp_path).split()[1] == "10"
    shown = run(python, "-m", "pip", "show", "--files", "solidem", cwd=tmp_path)
    assert "GPL-2.0-or-later" in shown and "solidem/py.typed" in shown and "_core.pyi" in shown


@pytest.mark.slow
@pytest.mark.usefixtures("alone")
def test_the_wheel_is_whole(tmp_path: Path) -> None:
    run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "-w", tmp_path, *BUILT,
        ROOT, cwd=tmp_path)
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as file:
        assert file.testzip() is None
        names = set(file.namelist())
        (record,) = [name for name in names if name.endswith("RECORD")]
        recorded = {line.split(",")[0] for line in file.read(record).decode().splitlines()}
    assert recorded == names
    sources = {f"solidem/{path.name}" for path in (ROOT / "python" / "solidem").iterdir()
               if path.suffix in (".py", ".pyi", ".csv", ".typed")}
    assert sources < names


@pytest.fixture
def backend(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """What pip calls."""
    monkeypatch.syspath_prepend(str(ROOT / "python"))
    return importlib.import_module("wheel_backend")


@pytest.mark.slow
def test_the_packed_sources_are_all_that_the_module_needs(backend: ModuleType, tmp_path: Path) -> None:
    name = backend.build_sdist(str(tmp_path))
    with tarfile.open(tmp_path / name) as archive:
        archive.extractall(tmp_path)
        assert not [member for member in archive.getnames() if "__pycache__" in member]
    sources = tmp_path / name.removesuffix(".tar.gz")
    run("cmake", "-G", "Ninja", "-S", sources, "-B", tmp_path / "build", "-DSOLIDEM_PYTHON=ON",
        "-DSOLIDEM_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}", cwd=tmp_path)
    ask = ("ninja", "-C", tmp_path / "build", "-n", "solidem_python")
    assert "missing" not in run(*ask, cwd=tmp_path)


def test_settings_that_cannot_be_are_refused(backend: ModuleType, tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="unknown setting build_dir; known: build-directory"):
        backend.build_wheel(str(tmp_path), {"build_dir": "build"})
    with pytest.raises(SystemExit, match="builds no Python module.*SOLIDEM_PYTHON=ON"):
        backend.build_wheel(str(tmp_path), {"build-directory": str(tmp_path)})
