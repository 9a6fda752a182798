# SPDX-License-Identifier: GPL-2.0-or-later
"""What docs/adding.md says works: its files are made and its lines put into a copy of the tree, which is
built, and the commands of the page are run there.

A block of the page with `file="…"` is the whole text of a new file, or with `after="…"` lines that
follow the one line of a file in which these words stand. Blocks of the kind `sh` are commands.
"""

from __future__ import annotations

import csv
import json
import os
import re
import shutil
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "adding.md"
SECTIONS = ("A law of central force", "A yield law of bonds", "An effect",
            "A case of the comparison", "A code of the comparison", "A study of accuracy and cost")
LISTS = {"standalone/laws/central_laws.hpp", "standalone/laws/yield_laws.hpp",
         "standalone/effects/all_effects.cpp", "compare/codes/__init__.py"}
FENCE = re.compile(r"^```(\w*)([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class Block:
    """A block of the page."""

    language: str
    text: str
    file: str  #: that it makes or changes; empty: none
    after: str  #: words of the line that it follows; empty: it is the whole file
    before: str  #: the paragraph that stands before the block


def sections() -> dict[str, str]:
    """Text by heading."""
    parts = re.split(r"^## (.*)\n", PAGE.read_text(), flags=re.MULTILINE)[1:]
    return dict(zip(parts[::2], parts[1::2]))


def blocks(text: str) -> list[Block]:
    """The blocks of a text of the page, in their order."""
    found = []
    end = 0
    for match in FENCE.finditer(text):
        words = dict(re.findall(r'(\w+)="([^"]*)"', match[2]))
        assert set(words) <= {"file", "after"}, match[0].splitlines()[0]
        found.append(Block(match[1], match[3], words.get("file", ""), words.get("after", ""),
                           text[end:match.start()]))
        end = match.end()
    return found


def all_blocks() -> list[Block]:
    return [block for text in sections().values() for block in blocks(text)]


def put(tree: Path, block: Block) -> None:
    """Makes the file of a block, or puts its lines where they belong."""
    path = tree / block.file
    if not block.after:
        assert not path.exists(), f"{block.file} is there already"
        assert path.parent.is_dir(), f"{block.file}: no such folder"
        path.write_text(block.text)
        return
    assert path.is_file(), f"{block.file} is not there"
    lines = path.read_text().splitlines(keepends=True)
    at = [n for n, line in enumerate(lines) if block.after in line]
    assert len(at) == 1, f"{block.after!r} stands in {len(at)} lines of {block.file}"
    path.write_text("".join(lines[:at[0] + 1]) + block.text + "".join(lines[at[0] + 1:]))


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the tree with all that the page adds."""
    folder = tmp_path_factory.mktemp("adding") / "solidem"
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, text=True,
                           capture_output=True).stdout.split("\n")
    for name in filter(None, names):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    for block in all_blocks():
        if block.file:
            put(folder, block)
    return folder


def test_the_page_has_an_example_of_each_thing() -> None:
    assert set(sections()) == set(SECTIONS)
    for name, text in sections().items():
        found = blocks(text)
        assert text.count("```") == 2 * len(found), f"{name}: a block does not end"
        assert any(block.file and not block.after for block in found), name
        assert any(block.language == "sh" for block in found), name
    assert {block.file for block in all_blocks() if block.after} == LISTS


def test_every_block_does_something_and_the_reader_is_told_where() -> None:
    for block in all_blocks():
        assert (block.language == "sh") != bool(block.file), block.text
        if block.file:
            told = re.findall(r"`([^`\s]+)`", block.before)
            assert block.file in told or not block.before.strip(), block.file


def test_a_line_has_one_place_and_a_page_that_is_stale_is_noticed(tree: Path) -> None:
    """The copy is made by the fixture, which insists on both."""
    new, line = (next(b for b in all_blocks() if b.file and bool(b.after) == wanted)
                 for wanted in (False, True))
    with pytest.raises(AssertionError, match="there already"):
        put(tree, new)
    with pytest.raises(AssertionError, match="stands in 0 lines"):
        put(tree, Block("cpp", "", line.file, "words that no list has", ""))
    with pytest.raises(AssertionError, match="is not there"):
        put(tree, Block("cpp", "", "standalone/no_such_list.hpp", line.after, ""))


def test_files_of_the_page_can_be_read(tree: Path) -> None:
    from benchmarks.accuracy_cost.study import read_study
    from compare.case import read_case
    for block in all_blocks():
        path = tree / block.file
        if block.file.endswith(".py"):
            compile(path.read_text(), block.file, "exec")
        elif block.file.endswith(".toml"):
            tomllib.loads(path.read_text())
        if block.file.startswith("compare/cases/"):
            case = read_case(path)
            assert case.scene is not None and case.scene.is_file()
        elif "/studies/" in block.file:
            assert len(read_study(path).points()) == 2


@pytest.mark.slow
def test_sources_of_the_page_are_formatted(tree: Path) -> None:
    sources = {block.file for block in all_blocks() if block.language == "cpp"}
    subprocess.run(["clang-format-14", "--dry-run", "-Werror", *sorted(sources)], cwd=tree, check=True)


def environment(tree: Path) -> dict[str, str]:
    """That of commands in the copy: its own program, and a compiler that remembers if there is one."""
    found = {**os.environ, "PATH": f"{tree / 'build' / 'release'}:{os.environ['PATH']}"}
    found.pop("SOLIDEM_PROGRAM", None)
    found.pop("SOLIDEM_INSTRUCTION_SET", None)
    if shutil.which("ccache"):
        found |= {"CCACHE_BASEDIR": str(tree), "CCACHE_NOHASHDIR": "1",
                  "CMAKE_C_COMPILER_LAUNCHER": "ccache", "CMAKE_CXX_COMPILER_LAUNCHER": "ccache"}
    return found


def run(tree: Path, *command: str | Path, seconds: float = 900) -> str:
    """What a command prints in the copy; its words are shown when it fails."""
    done = subprocess.run([str(word) for word in command], cwd=tree, env=environment(tree), text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=seconds, check=False)
    assert done.returncode == 0, f"{command}\n{done.stdout[-5000:]}"
    return done.stdout


def run_commands(tree: Path, section: str) -> str:
    """What all commands of a section print."""
    return "".join(run(tree, "bash", "-c", line) for block in blocks(sections()[section])
                   if block.language == "sh" for line in block.text.splitlines())


def table(path: Path) -> list[dict[str, str]]:
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(path: Path, name: str) -> np.ndarray:
    """A column of a table of numbers."""
    return np.array([float(row[name]) for row in table(path)])


@pytest.fixture(scope="module")
def built(tree: Path) -> Path:
    """The copy, with its program, in a quarter of the time that one fast everywhere takes."""
    run(tree, "cmake", "--preset", "release", "-DSOLIDEM_TESTS=OFF", "-DSOLIDEM_UNITY_BUILD=ON",
        "-DSOLIDEM_PRECOMPILED_HEADERS=ON", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
        "-DSOLIDEM_WARNINGS_AS_ERRORS=ON", "-DSOLIDEM_INSTRUCTION_SETS=baseline")
    run(tree, "cmake", "--build", "--preset", "release", "--target", "solidem", seconds=7200)
    return tree


def morse(compression_ratio: np.ndarray, energy: float, steepness: float,
          equilibrium: float) -> np.ndarray:
    """Force, N, at distances over that of equilibrium."""
    x = steepness * (compression_ratio - 1)
    return 2 * steepness * energy / equilibrium * (np.exp(-2 * x) - np.exp(-x))


@pytest.mark.slow
def test_the_central_law_is_listed_drawn_and_acts(built: Path) -> None:
    said = run_commands(built, "A law of central force")
    assert "morse" in said and "steepness" in said
    rows = [row for row in table(built / "results" / "morse.csv") if row["part"] == "law"]
    compression_ratio, force = (np.array([float(row[name]) for row in rows])
                        for name in ("distance_over_equilibrium", "force_N"))
    expected = morse(compression_ratio, 1.9e-3, 4, 0.2e-3)
    assert len(rows) > 50
    assert np.abs(force - expected).max() < 1e-6 * np.abs(expected).max()

    scene = (built / "compare" / "scenes" / "two_elements.toml").read_text()
    for old, new in (('"piecewise"', '"morse"'), ('stiffness = "1500 kN/m"', 'energy = "1.9 mJ"'),
                     ('attraction = "25 N"', "steepness = 4")):
        assert scene.count(old) == 1
        scene = scene.replace(old, new)
    (built / "two_elements.toml").write_text(scene)
    run(built, "solidem", "run", "two_elements.toml", "--output", "results/two_elements")
    history = built / "results" / "two_elements" / "history.csv"
    compression_ratio = 1 + column(history, "grip.right.displacement_x") / 0.2e-3
    assert compression_ratio.max() > 1.48
    expected = morse(compression_ratio, 1.9e-3, 4, 0.2e-3)
    found = -column(history, "grip.right.force_x")
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()


def swift(strain: float, yield_strain: float, scale: float, exponent: float) -> float:
    """The elastic strain left of a strain, by halving: what is left is the limit after the flow."""
    low, high = 0.0, strain
    for _ in range(200):
        left = 0.5 * (low + high)
        is_beyond = left > yield_strain * (1 + (strain - left) / scale)**exponent
        low, high = (low, left) if is_beyond else (left, high)
    return min(strain, low)


@pytest.mark.slow
def test_a_bond_flows_by_the_yield_law(built: Path) -> None:
    run_commands(built, "A yield law of bonds")
    history = built / "results" / "swift" / "history.csv"
    strain = column(history, "grip.right.displacement_x") / 0.2e-3
    young, area = 70e9, np.pi * (0.5 * 0.1e-3)**2
    expected = [young * swift(float(e), 140e6 / young, 0.002, 0.2) for e in strain]
    stress = column(history, "grip.right.force_x") / area
    assert strain[-1] == pytest.approx(0.01)
    assert expected[-1] > 1.2 * 140e6
    assert stress == pytest.approx(expected, rel=1e-9, abs=1e-9 * 140e6)


@pytest.mark.slow
def test_liggghts_takes_the_words_of_the_yield_law(
    built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(ROOT / "tests" / "liggghts")
    from liggghts_runs import Liggghts
    from two_atoms import COEFFICIENTS, YOUNG, by_the_style, stretched
    told = re.search(r"`(swift\s[^`]*)`", sections()["A yield law of bonds"])
    assert told
    words = " ".join(told[1].split())
    paths = dict(line.split(" ", 1) for line in
                 run(built, "bash", "-c", "contrib/liggghts/build_prebuilt 2> build_prebuilt.log",
                     seconds=7200).splitlines())
    strains = [1e-5, 1e-3, 4e-3, 1e-2]
    found = by_the_style(Liggghts(Path(paths["program"])), tmp_path,
                         f"{COEFFICIENTS} plasticity radial-return {words}", stretched(*strains),
                         one_step=True)
    expected = [YOUNG * swift(e, 140e6 / YOUNG, 0.002, 0.2) for e in strains]
    assert found.figures["stress"] == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_a_body_is_flung_out_by_the_effect(built: Path) -> None:
    said = run_commands(built, "An effect")
    assert "| `angular_velocity` |" in said
    results = built / "results" / "flung"
    # The middle of a free body under a force linear in its place moves as one element does.
    with h5py.File(results / "trajectory.h5") as file:
        frames = [file["frames"][name] for name in sorted(file["frames"])]
        time = np.array([float(frame.attrs["time"]) for frame in frames])
        middle = np.array([frame["position"][:].mean(axis=0) for frame in frames])
    assert 2e4 * time[-1] > 0.05
    grown = np.cosh(2e4 * time) * middle[0, 0]
    assert middle[:, 0] - middle[0, 0] == pytest.approx(grown - middle[0, 0], rel=1e-5, abs=1e-15)
    history = results / "history.csv"
    work = column(history, "centrifugal_work")
    assert work[-1] > 0
    assert np.abs(column(history, "energy_balance")).max() < 1e-3 * work[-1]
    summary = json.loads((results / "summary.json").read_text())
    assert summary["centrifugal_work"] == pytest.approx(work[-1])


@pytest.mark.slow
def test_a_flight_that_goes_on_from_a_checkpoint_is_the_same(built: Path) -> None:
    scene = (built / "flung.toml").read_text()
    assert scene.count("steps = 4000") == 1
    folders = [built / "results" / name for name in ("whole", "parts")]
    run(built, "solidem", "run", "flung.toml", "--output", folders[0])
    part = built / "part.toml"
    part.write_text(scene.replace("steps = 4000", "steps = 1500"))
    run(built, "solidem", "run", part, "--output", folders[1])
    part.write_text(scene)
    run(built, "solidem", "run", part, "--output", folders[1], "--resume")
    whole, parts = (table(folder / "history.csv") for folder in folders)
    assert whole == parts
    last = []
    for folder in folders:
        with h5py.File(folder / "trajectory.h5") as file:
            last.append(file["frames"][sorted(file["frames"])[-1]]["position"][:])
    assert last[0].tobytes() == last[1].tobytes()


def passed(results: Path) -> list[bool]:
    """Which rows of a comparison passed."""
    return [bool(row["passed"]) for row in json.loads((results / "table.json").read_text())["rows"]]


@pytest.mark.slow
def test_the_case_agrees(built: Path) -> None:
    run_commands(built, "A case of the comparison")
    assert passed(built / "results" / "morse_crystal") == [True, True]


@pytest.mark.slow
def test_the_code_is_ready_and_agrees(built: Path) -> None:
    said = run_commands(built, "A code of the comparison")
    assert re.search(r"^standalone-baseline +ready$", said, re.MULTILINE)
    assert passed(built / "results" / "instruction_sets") == [True]
    folder = built / "results" / "instruction_sets" / "runs" / "instruction_sets" / "crystal"
    summary = json.loads((folder / "standalone-baseline" / "results" / "summary.json").read_text())
    assert summary["instruction_set"] == "baseline"


@pytest.mark.slow
def test_the_study_measures_two_points(built: Path) -> None:
    run_commands(built, "A study of accuracy and cost")
    points = table(built / "results" / "morse_tension" / "points.csv")
    error = {row["step"]: float(row["error"]) for row in points}
    assert set(error) == {"0.5 of the limit", "0.2 of the limit"}
    assert 0 < error["0.2 of the limit"] < error["0.5 of the limit"] < 0.1
