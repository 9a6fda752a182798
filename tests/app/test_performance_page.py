# SPDX-License-Identifier: GPL-2.0-or-later
"""Examples need about the memory that docs/performance.md says."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from conftest import Program

DOCS = Path(__file__).resolve().parents[2] / "docs"
FIGURES = dict(re.findall(r"^\| \[(\w+)\]\(examples/\1\.toml\) \| .* \| (\d+) \|$",
                          (DOCS / "performance.md").read_text(), flags=re.MULTILINE))


def test_the_page_has_figures() -> None:
    assert len(FIGURES) >= 6


@pytest.mark.parametrize("example", FIGURES)
def test_an_example_needs_the_memory_of_the_page(example: str, solidem: Program) -> None:
    explained = solidem("explain", DOCS / "examples" / f"{example}.toml")
    assert explained.returncode == 0, explained.stderr
    found = re.search(r"in all (\d+) bytes an element", explained.stdout)
    assert found
    assert int(found.group(1)) == pytest.approx(int(FIGURES[example]), rel=0.1)
