# SPDX-License-Identifier: GPL-2.0-or-later
"""tests/lint sees a fault in any source, also where sources are checked together or cannot be."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

ROOM = {
    "neighbours/list.hpp": "#pragma once\nstruct Neighbour_list { int x; };\n",
    "neighbours/list.cpp": """\
#include "neighbours/list.hpp"
#include <string>
#include <utility>
int length(std::string text) {
  std::string other = std::move(text);
  return static_cast<int>(text.size() + other.size());
}
""",
    "neighbours/cells.cpp": """\
#include "neighbours/list.hpp"
int first(int* cell, bool empty) {
  if (empty) cell = nullptr;
  return *cell;
}
""",
    "output/summary.cpp": "namespace { int one() { return 1; } }\nint f() { return one(); }\n",
    "output/history.cpp": """\
namespace { int one() { return 2; } }
int ratio(int d) { return d == 0 ? 1 / d : one(); }
""",
}


def lint(folder: Path) -> subprocess.CompletedProcess[str]:
    """tests/lint in a tree that has nothing but these rooms."""
    (folder / "tests").mkdir()
    shutil.copy(ROOT / "tests" / "lint", folder / "tests")
    shutil.copy(ROOT / ".clang-tidy", folder)
    (folder / "build/clang").mkdir(parents=True)
    standalone = folder / "standalone"
    (folder / "build/clang/compile_commands.json").write_text(json.dumps([{
        "file": str(standalone / "output/summary.cpp"),
        "command": f"clang++-14 -std=c++17 -I{standalone} -c summary.cpp"}]))
    for words in (["init", "-q"], ["add", "standalone"]):
        subprocess.run(["git", *words], cwd=folder, check=True)
    return subprocess.run([folder / "tests/lint"], check=False, text=True, capture_output=True)


def write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = folder / "standalone" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.mark.slow
def test_faults_are_found_in_headers_and_in_every_source(tmp_path: Path) -> None:
    write(tmp_path, ROOM)
    done = lint(tmp_path)
    assert done.returncode == 1
    for file, check in [("list.hpp", "readability-identifier-naming"),
                        ("list.cpp", "bugprone-use-after-move"),
                        ("cells.cpp", "clang-analyzer-core.NullDereference"),
                        ("history.cpp", "clang-analyzer-core.DivideZero")]:
        assert any(file in line and check in line for line in done.stdout.splitlines()), done.stdout


@pytest.mark.slow
def test_sources_without_fault_pass(tmp_path: Path) -> None:
    write(tmp_path, {"output/summary.cpp": ROOM["output/summary.cpp"],
                     "output/other.cpp": "int g() { return 3; }\n"})
    done = lint(tmp_path)
    assert (done.returncode, done.stdout) == (0, "")
