# SPDX-License-Identifier: GPL-2.0-or-later
"""What the documents promise: a page and an example that runs for every style, and the scripts of
the README as printed."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import central_body
from liggghts_runs import CONTRIB, Liggghts, read_dump, simple_cubic

KINDS = sorted(
    (match.group(2), match.group(1).lower())
    for header in (CONTRIB / "src").glob("*.h")
    for match in re.finditer(
        r"^(Bond|Compute|Fix|Pair)Style\((\S+),\w+\)$", header.read_text(), re.M
    )
)
STYLES = sorted({style for style, _ in KINDS})

SECTIONS = ("Syntax", "Examples", "Description", "Restrictions", "Related commands", "Default")


def test_there_are_styles() -> None:
    assert {"solidem/beam", "nve/solidem", "solidem/bond", "solidem/central"} <= set(STYLES)


@pytest.mark.parametrize("style, kind", KINDS)
def test_every_style_has_a_complete_page(style: str, kind: str) -> None:
    page = (CONTRIB / "doc" / f"{kind}_{style.replace('/', '_')}.txt").read_text()
    for section in SECTIONS:
        assert f"[{section}:]" in page, f"{style}: no section {section}"
    assert re.search(r"\[Restart.*output.*:\]", page), f"{style}: nothing on restart and output"


@pytest.mark.parametrize("style", STYLES)
def test_every_style_has_an_example_that_runs(prebuilt: dict[str, Path], style: str) -> None:
    folder = CONTRIB / "examples" / style.replace("/", "_")
    done = subprocess.run(
        [folder / "runscript"],
        env={**os.environ, "LIGGGHTS": str(prebuilt["program"])},
        capture_output=True,
        text=True,
        timeout=900,
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    assert "limit" in done.stdout, "the example checked nothing"


@pytest.mark.parametrize(
    "number, last", [(0, "final.txt"), (1, "cracked.txt"), (2, "temperatures.txt")]
)
def test_the_scripts_of_the_readme_run(
    liggghts: Liggghts, tmp_path: Path, number: int, last: str
) -> None:
    readme = (CONTRIB / "README.md").read_text()
    script = re.findall(r"```\n(units.*?)```", readme, re.S)[number]
    body = simple_cubic((20, 4, 4), 1e-3)
    body.write(tmp_path / "bar.data")
    central_body.write(body, tmp_path / "spheres.data")
    liggghts.run(tmp_path, script)
    frame = read_dump(tmp_path / last)[1000]
    if number == 0:
        assert frame[304:, 0] == pytest.approx(body.position[304:, 0] + 1e-5, rel=1e-12)
        assert frame[:16, 3].sum() > 0 > frame[304:, 3].sum()
    elif number == 1:
        assert frame[304:, 0] == pytest.approx(body.position[304:, 0] + 1e-5, rel=1e-12)
        assert (frame[288:304, 0] > body.position[288:304, 0] + 1e-6).all()
        assert (frame[304:, 3] == 1).all() and (frame[:, 3] == 0).any()
    else:
        assert (frame[304:, 0] == 798).all()
        assert np.all((frame[:304, 0] > 298) & (frame[:304, 0] < 798))
