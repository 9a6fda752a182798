# SPDX-License-Identifier: GPL-2.0-or-later
"""What the presets promise: assertions where sanitizers look, none in what is used."""

import json
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(("preset", "asserts"), [("release", False), ("sanitize", True)])
def test_assertions_run_under_sanitizers_alone(preset: str, asserts: bool, tmp_path: Path) -> None:
    """The preset's compiler flags, over CMake's own, decide whether assert() does anything."""
    presets = {entry["name"]: entry for entry in
               json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
    values = {**presets["release"]["cacheVariables"], **presets[preset]["cacheVariables"]}
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\nproject(empty LANGUAGES CXX)\n"
        "add_library(empty OBJECT empty.cpp)\n")
    (tmp_path / "empty.cpp").write_text(
        "#include <cassert>\n#ifdef NDEBUG\n#error asserts nothing\n#endif\n")
    done = subprocess.run(["cmake", "-S", tmp_path, "-B", tmp_path / "build", "-Wno-dev",
                           *(f"-D{name}={value}" for name, value in values.items()
                             if not name.endswith("COMPILER"))],
                          check=False, text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    built = subprocess.run(["cmake", "--build", tmp_path / "build"], check=False, text=True,
                           capture_output=True)
    assert (built.returncode == 0) == asserts
    assert asserts or "asserts nothing" in built.stdout + built.stderr
