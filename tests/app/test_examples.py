# SPDX-License-Identifier: GPL-2.0-or-later
"""The examples show what docs/examples/README.md says that they show."""

from __future__ import annotations

import csv
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from scene_parts import (CONDUCTING_ALUMINIUM, HELD, HIGH_END, LOW_END, THICK_BEAMS, crystal,
                         grip)

if TYPE_CHECKING:
    from conftest import Program

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "docs" / "examples"
#: Examples that take more than some seconds.
SLOW = {"bimetal", "central_forces", "conduction", "fibre", "falling_block", "fibre_pull_out",
        "moving_source", "rupture", "shot_plate", "threaded_pin", "three_rollers", "two_materials"}
#: Told elsewhere: docs/calibration.md.
ELSEWHERE = {"calibration", "calibration_5000", "calibration_curve"}


@dataclass(frozen=True)
class Figure:
    """A row of the table."""

    expression: str  #: of columns of history.csv, or of names that the command prints
    value: float
    within: float


def table() -> dict[tuple[str, str], list[Figure]]:
    """The figures of the page, by scene and command."""
    figures: dict[tuple[str, str], list[Figure]] = {}
    for line in (EXAMPLES / "README.md").read_text().splitlines():
        found = re.fullmatch(r"\| \[(\w+)\]\(\1\.toml\) \| (\w+) \| .+ \| `(.+)` \| (\S+) ± (\S+) \|",
                             line)
        if found:
            scene, command, expression, value, within = found.groups()
            figures.setdefault((scene, command), []).append(
                Figure(expression, float(value), float(within)))
    return figures


def evaluate(expression: str, columns: dict[str, np.ndarray]) -> float:
    """A figure from columns; of a column alone the last row counts."""
    functions = {"largest": lambda x: np.abs(x).max(), "first": lambda x: x[0],
                 "rate": lambda x, t: (x[-1] - x[-2]) / (t[-1] - t[-2])}
    text = re.sub(r"(?<![\w.])[A-Za-z_][\w.]*",
                  lambda name: name.group() if name.group() in functions else
                  f"columns[{name.group()!r}]", expression)
    with np.errstate(all="ignore"):  # rows before the start of a motion
        found = eval(text, {"columns": columns, **functions})  # noqa: S307
    return float(np.atleast_1d(found)[-1])


def columns_of_run(solidem: Program, scene: Path) -> dict[str, np.ndarray]:
    done = solidem("run", scene, "--output", "results", "--quiet", "--threads", "1")
    assert done.returncode == 0, done.stderr
    with (solidem.folder / "results" / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def printed(solidem: Program, command: str, scene: Path) -> dict[str, np.ndarray]:
    done = solidem(command, scene)
    assert done.returncode == 0, done.stderr
    found = re.findall(r"^(\w+) +(-?[\d.]+)( GPa)?$", done.stdout, re.MULTILINE)
    return {name: np.array([float(value)]) for name, value, _ in found}


@pytest.mark.parametrize(
    "scene, command",
    [pytest.param(*key, marks=[pytest.mark.slow] if key[0] in SLOW else []) for key in table()])
def test_an_example_shows_its_figures(solidem: Program, scene: str, command: str) -> None:
    path = EXAMPLES / f"{scene}.toml"
    columns = (columns_of_run(solidem, path) if command == "run"
               else printed(solidem, command, path))
    for figure in table()[scene, command]:
        found = evaluate(figure.expression, columns)
        print(f"{scene}: {figure.expression} = {found:.5g}, said {figure.value} ± {figure.within}")
        assert found == pytest.approx(figure.value, abs=figure.within), figure.expression


def test_every_example_has_figures() -> None:
    scenes = {path.stem for path in EXAMPLES.glob("*.toml")}
    assert {scene for scene, _ in table()} | ELSEWHERE == scenes
    for path in EXAMPLES.glob("*.toml"):
        assert path.read_text().startswith("# "), f"{path.name} does not begin with what it is"


def test_the_threaded_pin_is_what_its_script_writes(tmp_path: Path) -> None:
    again = tmp_path / "pin.obj"
    subprocess.run([EXAMPLES / "make_threaded_pin", again], check=True)
    assert again.read_bytes() == (EXAMPLES / "threaded_pin.obj").read_bytes()


def test_words_of_the_first_example_are_those_of_the_table() -> None:
    text = (EXAMPLES / "tension.toml").read_text()
    modulus, ratio = table()["tension", "run"]
    assert f"modulus of {modulus.value:.0f} GPa" in text.replace("\n# ", " ")
    assert f"Poisson ratio of {ratio.value:.2f}" in text.replace("\n# ", " ")


HEATED_BAR = ('title = "heated bar"\n' + crystal("bcc", 4, 2, 2) + CONDUCTING_ALUMINIUM + f"""\
[[temperatures]]
name = "hot"
region = {{ {HIGH_END} }}
value = "798 K"
[run]
steps = 10
""")
BEAMS = THICK_BEAMS + grip("left", LOW_END, HELD) + grip("right", HIGH_END, HELD)


@pytest.mark.parametrize("bonded", [True, False])
def test_a_heated_bar_that_is_held_is_told_that_it_bears_no_stress(
    solidem: Program, bonded: bool
) -> None:
    """Heat and motion of one scene do not act on each other, which run, explain and summary tell."""
    scene = solidem.scene("bar.toml", HEATED_BAR + BEAMS * bonded)
    said = "no thermal expansion"
    ran = solidem("run", scene, "--output", "results")
    assert ran.returncode == 0, ran.stderr
    summary = (solidem.folder / "results" / "summary.json").read_text()
    for text in (ran.stdout, summary, solidem("explain", scene).stdout,
                 solidem("explain", scene, "--json").stdout):
        assert (said in text) == bonded


def test_a_heated_bar_that_expands_is_not_told_so(solidem: Program) -> None:
    """A note stands only for what is left out."""
    expands = HEATED_BAR.replace("conductivity =", 'expansion_coefficient = "23e-6 1/K"\nconductivity =')
    scene = solidem.scene("bar.toml", expands + BEAMS + "[expansion]\n")
    said = solidem("explain", scene).stdout
    assert "thermal expansion" not in said
    assert "no work warms elements" in said
    assert "temperature of bonds" in said
