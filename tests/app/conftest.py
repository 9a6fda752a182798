# SPDX-License-Identifier: GPL-2.0-or-later
"""The program as a user calls it."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from scene_parts import ALUMINIUM, HELD, HIGH_END, LOW_END, STIFF_BEAMS, crystal, grip

ROOT = Path(__file__).resolve().parents[2]


class Program:
    """Calls solidem in a folder of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = Path(os.environ.get("SOLIDEM_PROGRAM",
                                        ROOT / "build" / "release" / "solidem"))
        assert os.access(self.path, os.X_OK), f"{self.path} is not there; build it first"

    def __call__(self, *words: str | Path, **options: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([str(self.path), *map(str, words)], cwd=self.folder, text=True,
                              capture_output=True, timeout=120, check=False, **options)  # type: ignore[call-overload]

    def start(self, *words: str | Path) -> subprocess.Popen[str]:
        return subprocess.Popen([str(self.path), *map(str, words)], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def scene(self, name: str, text: str) -> str:
        (self.folder / name).write_text(text)
        return name


@pytest.fixture
def solidem(tmp_path: Path) -> Program:
    return Program(tmp_path)


BAR = ('title = "bar"\n' + crystal("bcc", 8, 4, 4) + ALUMINIUM + STIFF_BEAMS
       + grip("left", LOW_END, HELD)
       + grip("right", HIGH_END, 'velocity = ["1 m/s", "free", "free"]') + """\
[gauge]
axis = "x"
lower = "0.4 mm"
upper = "1.4 mm"
[[sensors]]
name = "A"
point = ["1 mm", "0 mm", "0 mm"]
quantity = "displacement"
[run]
steps = 2000
time_step_ratio = 0.3
observe_every = 50
[output]
frames = 4
""")


@pytest.fixture
def bar() -> str:
    """A short tension test on a lattice bar."""
    return BAR
