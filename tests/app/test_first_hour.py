# SPDX-License-Identifier: GPL-2.0-or-later
"""What docs/first_hour.md says is done in an empty directory, block by block, in its order."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "first_hour.md"
PROGRAM = Path(os.environ.get("SOLIDEM_PROGRAM", ROOT / "build" / "release" / "solidem"))
NEAR = 0.05  #: relative: processors round apart, and which bond breaks next may hang on that


@dataclass(frozen=True)
class Block:
    """A fenced block: ``` and its words, then the text."""

    kind: str  #: "sh", "toml", "python", "text" ...
    word: str  #: the name of the file, or of a command that is run elsewhere
    text: str


def blocks() -> list[Block]:
    found = re.findall(r"^```(\w+) ?(\S*)\n(.*?)^```$", PAGE.read_text(), re.M | re.S)
    return [Block(*parts) for parts in found]


def alike(said: str, found: str) -> bool:
    """The same words, and numbers that are near each other."""
    pairs = list(zip(said.split(), found.split()))
    if len(said.split()) != len(found.split()):
        return False
    for one, other in pairs:
        try:
            if float(one) != pytest.approx(float(other), rel=NEAR):
                return False
        except ValueError:
            if one != other and not (one.startswith("(") and other.startswith("(")):
                return False
    return True


def run(command: str, folder: Path) -> str:
    """What a block of commands prints."""
    done = subprocess.run(["bash", "-euc", command], cwd=folder, text=True, capture_output=True,
                          timeout=300, check=False,
                          env={**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"})
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


def follow(folder: Path, compare: bool) -> list[str]:
    """Does what the page says; each line that it promises. `compare`: with the last step."""
    printed, promised = "", []
    for block in blocks():
        if block.word == "compare" and not compare:
            break
        if block.kind in ("toml", "python"):
            (folder / block.word).write_text(block.text)
        elif block.word == "compare":  # what compare/run does when all is built
            words = re.sub(r"^\S+/compare/run", f'cd "{ROOT}" && {sys.executable} -m compare',
                           block.text.replace("$PWD", str(folder)))
            printed = run(words, folder)
        elif block.kind == "sh":
            printed = run(block.text, folder)
        elif block.kind == "text":
            for line in block.text.splitlines():
                assert any(alike(line, other) for other in printed.splitlines()), (
                    f"said: {line}\nprinted: {printed}")
                promised.append(line)
    return promised


def test_every_step_prints_what_the_page_says(tmp_path: Path) -> None:
    promised = follow(tmp_path, compare=False)
    assert len(promised) >= 9
    for name in ("aluminium/calibrated.toml", "torn/trajectory.xdmf", "torn/summary.json",
                 "torn.png"):
        assert (tmp_path / name).exists(), name


@pytest.mark.slow
def test_the_bar_is_the_same_in_liggghts(tmp_path: Path) -> None:
    codes = run(f'cd "{ROOT}" && {sys.executable} -m compare --list', tmp_path)
    if not re.search(r"^liggghts +ready$", codes, re.M):
        pytest.skip("LIGGGHTS is not built")
    assert "1 of 1 checks passed." in follow(tmp_path, compare=True)


def test_a_line_that_differs_is_told_from_one_that_does_not() -> None:
    assert alike("bonds broken 89", "bonds broken 91")
    assert not alike("bonds broken 89", "bonds broken 120")
    assert not alike("bonds broken 89", "bonds intact 89")


def test_every_file_of_the_page_has_its_name_above_it() -> None:
    text = PAGE.read_text()
    for block in blocks():
        if block.kind in ("toml", "python"):
            before = text[:text.index(f"```{block.kind} {block.word}\n")]
            if block.word != "bonds.py":
                assert f"`{block.word}`" in before, block.word
