# SPDX-License-Identifier: GPL-2.0-or-later
"""LIGGGHTS with solidem's styles, for every test of this folder.

A LIGGGHTS that is missing, or does not build, is a failure: no test here skips.
"""

from pathlib import Path

import pytest

from liggghts_runs import Liggghts, built_paths


@pytest.fixture(scope="session")
def prebuilt() -> dict[str, Path]:
    """Paths of `program` and `preload` on Debian's prebuilt library."""
    return built_paths("build_prebuilt")


@pytest.fixture(scope="session")
def liggghts(prebuilt: dict[str, Path]) -> Liggghts:
    return Liggghts(prebuilt["program"])
