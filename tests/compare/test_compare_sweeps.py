# SPDX-License-Identifier: GPL-2.0-or-later
"""Variants over lists of values, rows over groups of them, long cases, specimens made once."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fake_codes import FakeStandalone, honest_result

from compare.__main__ import main
from compare.case import CaseError, read_case
from compare.codes.base import Job
from compare.result import Result

CASE = """\
title = "Rods"
scene = "rod.scene"
timed = false
[[variant]]
name = "$law, $size elements, seed $seed"
codes = ["standalone"]
for = { law = ["coarse", "fine"], size = [10, 20], seed = [1, 2, 3] }
replace = { "steps = 20" = "steps = 20 # $law $size $seed" }
[[check]]
quantity = "spread at $at"
measure = "dispersion"
over = "seed"
class = "P"
code = "standalone"
reference = "nothing"
variants = ["fine, *"]
for = { at = ["A"] }
tolerance = 0.5
reason = "A test."
options = { column = "sensor.$at.temperature", against = "size", limit = 0.04 }
"""


class Rods(FakeStandalone):
    """Sensor A reads 273.15 K + 100 K + seed, constantly."""

    def __init__(self) -> None:
        """Remembers what it was called for."""
        super().__init__()
        self.calls: list[str] = []

    def call(self, words: list[str | Path], directory: Path, timeout: float) -> Path:
        self.calls.append(str(words[0]))
        return super().call(words, directory, timeout)

    def run(self, job: Job, directory: Path) -> Result:
        self.calls.append("run")
        seed = int(job.scene.read_text().split("# ")[1].split()[2])
        result = honest_result(self.name)
        return dataclasses.replace(result, history={
            **result.history, "sensor.A.temperature": np.full(5, 273.15 + 100 + seed)})


@pytest.fixture
def rods(case_directory: Path) -> Path:
    """A directory with the case of rods alone."""
    (case_directory / "rod.toml").unlink()
    (case_directory / "rods.toml").write_text(CASE)
    return case_directory


def run(directory: Path, *words: str, codes: dict[str, Any]) -> tuple[int, dict[str, Any]]:
    """Exit status and tables."""
    output = directory.parent / "results"
    status = main([*words, "--case-directory", str(directory), "--output", str(output)], codes)
    return status, json.loads((output / "table.json").read_text())


def test_variants_over_lists(rods: Path) -> None:
    case = read_case(rods / "rods.toml")
    assert len(case.variants) == 12
    assert case.variants[0].name == "coarse, 10 elements, seed 1"
    assert case.variants[0].values == {"law": "coarse", "size": 10, "seed": 1}
    assert case.variants[-1].replace == {"steps = 20": "steps = 20 # fine 20 3"}


def test_a_word_alone_keeps_its_kind(rods: Path) -> None:
    path = rods / "rods.toml"
    path.write_text(CASE.replace('{ at = ["A"] }', '{ at = [{ at = "A", bound = 0.25 }] }')
                    .replace("tolerance = 0.5", 'tolerance = "$bound"'))
    check, = read_case(path).checks
    assert check.tolerance == 0.25
    assert check.options["column"] == "sensor.A.temperature"


@pytest.mark.parametrize("old, new, words", [
    ('"$law, $size elements, seed $seed"', '"$law, $size elements"', "same name"),
    ("# $law $size", "# $lax $size", "lax"),
    ('over = "seed"', 'over = "weather"', "weather"),
    ('for = { at = ["A"] }', 'for = "A"', "for"),
    ('["fine, *"]', '["finest, *"]', "finest"),
])
def test_wrong_sweeps_are_refused(rods: Path, old: str, new: str, words: str) -> None:
    path = rods / "rods.toml"
    path.write_text(CASE.replace(old, new))
    with pytest.raises(CaseError, match=words):
        read_case(path)


def test_one_row_for_a_group_and_each_run_once(rods: Path) -> None:
    code = Rods()
    status, found = run(rods, codes={"standalone": code})
    assert status == 0
    assert [row["variant"] for row in found["rows"]] == [
        "fine, 10 elements, seed 1–3", "fine, 20 elements, seed 1–3"]
    # From 101 °C to 103 °C.
    assert [row["error"] for row in found["rows"]] == pytest.approx([2 / 103] * 2)
    assert code.calls.count("run") == 6
    # The rods share one recipe.
    assert code.calls.count("specimen") == 1
    # Runs side by side are no measurements of time.
    assert {line["wall_seconds"] for line in found["runs"]} == {None}


def test_one_failing_specimen_fails_its_group_alone(rods: Path) -> None:
    class Broken(Rods):
        def run(self, job: Job, directory: Path) -> Result:
            result = super().run(job, directory)
            if "fine 20 2" in job.scene.read_text():
                result.history["sensor.A.temperature"][3] = np.nan
            return result
    status, found = run(rods, codes={"standalone": Broken()})
    assert status == 1
    assert [row["passed"] for row in found["rows"]] == [True, False]


def test_specimens_are_shared_between_cases(rods: Path) -> None:
    (rods / "again.toml").write_text(CASE)
    code = Rods()
    assert run(rods, codes={"standalone": code})[0] == 0
    assert code.calls.count("run") == 12
    assert code.calls.count("specimen") == 1


def test_long_cases_wait_to_be_asked(rods: Path) -> None:
    (rods / "more.toml").write_text("long = true\n" + CASE)
    for words, cases in (((), {"rods"}), (("--long",), {"rods", "more"}), (("more",), {"more"})):
        _, found = run(rods, *words, codes={"standalone": Rods()})
        assert {row["case"] for row in found["rows"]} == cases


def test_plots_of_a_group_are_joined_into_one_picture(rods: Path) -> None:
    path = rods / "rods.toml"
    path.write_text(CASE.replace("limit = 0.04", 'limit = 0.04, figure = "spread"'))
    assert run(rods, codes={"standalone": Rods()})[0] == 0
    picture = (rods.parent / "results" / "figures" / "spread.png").read_bytes()
    assert picture.startswith(b"\x89PNG")
