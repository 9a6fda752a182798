# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages: listed, linked to what is there, with every key and every work that laws come from."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"


@cache
def pages() -> list[Path]:
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"],
                           cwd=ROOT, check=True, text=True, capture_output=True).stdout.split()
    return [ROOT / name for name in sorted(set(names)) if (ROOT / name).exists()]


def prose(page: Path) -> str:
    """A page without its blocks of code."""
    return re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)


@cache
def anchors(page: Path) -> set[str]:
    """Those of its headings, as GitHub and Sphinx make them."""
    headings = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)
                for heading in re.findall(r"^#+ (.*)$", prose(page), flags=re.MULTILINE)]
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_every_page_is_in_the_table_of_contents_once() -> None:
    listed = re.findall(r"^- \[[^]]*\]\(([^)#\s]+)\)", (DOCS / "README.md").read_text(), re.MULTILINE)
    assert sorted((DOCS / target).resolve() for target in listed) == sorted(
        page for page in pages() if page != DOCS / "README.md")


def test_links_to_headings_find_them() -> None:
    dead = []
    for page in pages():
        for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", prose(page)):
            there = (page.parent / target).resolve() if target else page
            if not target.startswith("http") and anchor not in anchors(there):
                dead.append(f"{page.relative_to(ROOT)}: {target}#{anchor}")
    assert not dead


def test_the_theory_names_every_law() -> None:
    """Each header that tells its source."""
    names = {header.stem for header in (ROOT / "standalone/laws").glob("*.hpp")
             if "// Source:" in header.read_text()}
    assert len(names) > 10
    words = "".join(page.read_text() for page in (DOCS / "theory.md", DOCS / "laws.md",
                                                  *(DOCS / "theory").glob("*.md")))
    assert not {name for name in names if name.replace("_", "-") not in words
                and f"{name}.hpp" not in words}


def test_the_bibliography_has_the_year_of_every_work_that_a_law_names() -> None:
    page = (DOCS / "bibliography.md").read_text()
    comments = "\n".join(line for header in (ROOT / "standalone/laws").glob("*.hpp")
                         for line in header.read_text().splitlines() if line.startswith("//"))
    years = set(re.findall(r"\b(?:19|20)\d\d\b", comments))
    assert {"1979", "2013"} <= years
    assert not {year for year in years if not re.search(rf"\b{year}\b", page)}


def test_versions_agree() -> None:
    version = re.search(r"project\(solidem VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    assert f"version: {version}" in (ROOT / "CITATION.cff").read_text().splitlines()
    assert re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE).group(1) == version


#: A section whose keys stand on the page by hand -> a scene in which `nonsense = 1` is one more key of it.
SPECIMEN = '[specimen]\nshape = "crystal"\nlattice = "bcc"\ncells = [6, 4, 4]\nelement_radius = "0.1 mm"\n'
ALUMINIUM = '[material]\ndensity = "2790 kg/m^3"\n'
BEAMS = '[beams]\nyoung_modulus = "70 GPa"\npoisson_ratio = 0.3\nradius_ratio = 0.3\n'
BODY = SPECIMEN + ALUMINIUM + BEAMS
RUN = "[run]\nsteps = 2\n"
BY_HAND = {
    "[specimen]": SPECIMEN + "nonsense = 1\n",
    "[[specimen.cut]]": SPECIMEN + "[[specimen.cut]]\nnonsense = 1\n",
    "[[body]]": SPECIMEN.replace("[specimen]", "[[body]]") + 'name = "one"\nnonsense = 1\n',
    "[bonds]": SPECIMEN + "[bonds]\nnonsense = 1\n",
    "[material]": SPECIMEN + ALUMINIUM + "nonsense = 1\n" + BEAMS + RUN,
    "[[sensors]]": BODY + RUN + "[[sensors]]\nnonsense = 1\n",
    "[gauge]": BODY + RUN + "[gauge]\nnonsense = 1\n",
    "[run]": BODY + RUN + "nonsense = 1\n",
    "[output]": BODY + RUN + "[output]\nnonsense = 1\n",
    "[calibration]": BODY + RUN + '[calibration]\nyoung_modulus = "70 GPa"\nnonsense = 1\n',
    "[calibration.curve]": (BODY + RUN + '[calibration]\nyoung_modulus = "70 GPa"\n'
                            '[calibration.curve]\nyield_stress = "9 MPa"\nnonsense = 1\n'),
    "[calibration.curve] of a table": (BODY + RUN + '[calibration]\nyoung_modulus = "70 GPa"\n'
                                       '[calibration.curve]\nfile = "curve.csv"\nnonsense = 1\n'),
}


@pytest.mark.slow
def test_the_pages_are_built_without_a_warning(tmp_path: Path) -> None:
    """Sphinx knows dead links and anchors, pages that nothing lists, blocks that cannot be read."""
    built = subprocess.run([DOCS / "make_html", "--output", tmp_path / "html"], check=False, text=True,
                           capture_output=True)
    assert built.returncode == 0, built.stderr
    assert (tmp_path / "html" / "index.html").exists()
    assert "searchindex.js" in {path.name for path in (tmp_path / "html").iterdir()}


@pytest.mark.slow
def test_a_dead_link_or_a_page_that_is_not_listed_is_an_error(tmp_path: Path) -> None:
    tree = tmp_path / "tree"
    shutil.copytree(ROOT, tree, ignore=shutil.ignore_patterns(".git", "build", "results"))
    subprocess.run(["git", "init", "-q", tree], check=True)
    (tree / "docs" / "stray.md").write_text("# Stray\n\nTo [nowhere](scene.md#nowhere).\n")
    built = subprocess.run([tree / "docs" / "make_html"], check=False, text=True, capture_output=True)
    assert built.returncode != 0
    assert "nowhere" in built.stderr
    assert "isn't included in any toctree" in built.stderr


@pytest.mark.parametrize("section", BY_HAND)
def test_every_key_that_the_reader_knows_is_on_the_page(section: str, tmp_path: Path) -> None:
    """The reader tells all keys of a section when it meets one that it does not know."""
    (tmp_path / "scene.toml").write_text(BY_HAND[section])
    program = os.environ.get("SOLIDEM_PROGRAM", ROOT / "build/release/solidem")
    refused = subprocess.run([program, "explain", tmp_path / "scene.toml"], check=False, text=True,
                             capture_output=True)
    found = re.search(r"nonsense = 1: no such key.*expected one of (.*)", refused.stderr)
    assert found, refused.stderr
    page = (DOCS / "scene.md").read_text()
    heading = page.index(f"## `{section.split(' of ')[0]}`")
    part = page[heading:page.find("\n### ", heading + 1)]
    if section == "[[body]]":  # has those of [specimen], too
        part += page[page.index("### `[specimen]`"):heading]
    missing = [key for key in re.split(r", | or ", found.group(1).strip()) if f"`{key}`" not in part
               and f".{key}]" not in part]
    assert not missing
