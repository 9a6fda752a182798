# SPDX-License-Identifier: GPL-2.0-or-later
"""LIGGGHTS with solidem's styles, for every test of this folder.

A LIGGGHTS that is missing, or does not build, is a failure: no test here skips.
"""

import subprocess
from pathlib import Path

import pytest

from liggghts_runs import Liggghts

CONTRIB = Path(__file__).resolve().parents[2] / "contrib" / "liggghts"


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: builds LIGGGHTS from source (cached)")


def built_paths(script: str, *arguments: str) -> dict[str, Path]:
    """What a build script of contrib/liggghts says it built."""
    done = subprocess.run(
        [CONTRIB / script, *arguments], capture_output=True, text=True, timeout=7200
    )
    if done.returncode != 0:
        pytest.fail(f"contrib/liggghts/{script} failed:\n{done.stderr[-3000:]}", pytrace=False)
    return {
        name: Path(path) for name, path in (line.split(" ", 1) for line in done.stdout.splitlines())
    }


@pytest.fixture(scope="session")
def prebuilt() -> dict[str, Path]:
    """Paths of `program` and `preload` on Debian's prebuilt library."""
    return built_paths("build_prebuilt")


@pytest.fixture(scope="session")
def liggghts(prebuilt: dict[str, Path]) -> Liggghts:
    return Liggghts(prebuilt["program"])
