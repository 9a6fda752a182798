# SPDX-License-Identifier: GPL-2.0-or-later
"""The Python module as it was built beside the program."""

from __future__ import annotations

import importlib
import os
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = Path(os.environ.get("SOLIDEM_PYTHON", ROOT / "build" / "release" / "python"))


@pytest.fixture(scope="session")
def solidem() -> ModuleType:
    """The package."""
    if not list(PACKAGES.glob("solidem/_core*.so")):
        pytest.fail(f"{PACKAGES} has no module; build it first: cmake --preset release "
                    "-DSOLIDEM_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3 && "
                    "cmake --build --preset release --target solidem_python")
    sys.path.insert(0, str(PACKAGES))
    return importlib.import_module("solidem")


@pytest.fixture
def tables() -> dict:
    """A short tension test on a lattice bar."""
    return {
        "title": "bar",
        "specimen": {"shape": "crystal", "lattice": "bcc", "cells": [8, 4, 4],
                     "element_radius": "0.1 mm"},
        "material": {"density": "2790 kg/m^3"},
        "beams": {"young_modulus": "3.5 TPa", "poisson_ratio": 0.3, "radius_ratio": 0.27},
        "grips": [
            {"name": "left", "region": {"axis": "x", "side": "low", "layers": 1},
             "displacement": ["0 m", "0 m", "0 m"]},
            {"name": "right", "region": {"axis": "x", "side": "high", "layers": 1},
             "velocity": ["1 m/s", "free", "free"]}],
        "gauge": {"axis": "x", "lower": "0.4 mm", "upper": "1.4 mm"},
        "run": {"steps": 200, "time_step_ratio": 0.3, "observe_every": 50},
        "output": {"frames": 2},
    }


@pytest.fixture
def hot() -> dict:
    """A bar that conducts heat and does not move."""
    return {
        "specimen": {"shape": "crystal", "lattice": "simple_cubic", "cells": [10, 3, 3],
                     "element_radius": "0.1 mm"},
        "material": {"density": "2790 kg/m^3", "conductivity": "100 W/(m K)",
                     "specific_heat_capacity": "900 J/(kg K)"},
        "conduction": {"law": "platonic", "initial_temperature": "300 K"},
        "temperatures": [{"name": "hot", "region": {"axis": "x", "side": "low", "layers": 1},
                         "value": "400 K"}],
        "run": {"steps": 50},
        "output": {"frames": 0},
    }
