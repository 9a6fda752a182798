# SPDX-License-Identifier: GPL-2.0-or-later
"""The harness never takes a failure for agreement."""

from __future__ import annotations

import dataclasses
import json
import sys
from pathlib import Path
from typing import Callable

import numpy as np
import pytest
from fake_codes import FakeCode, FakeStandalone, honest_result

from compare.__main__ import main
from compare.codes.base import Job, run_program
from compare.codes.yade import Yade
from compare.result import CodeFailure, Result, read_result


def run(case_directory: Path, other: FakeCode | None) -> tuple[int, dict]:
    """Runs the harness; returns its exit status and the only row."""
    output = case_directory.parent / "results"
    codes = {"standalone": FakeStandalone()}
    if other is not None:
        codes["other"] = other
    status = main(["--case-directory", str(case_directory), "--output", str(output)], codes)
    rows = json.loads((output / "table.json").read_text())["rows"]
    assert len(rows) == 1
    assert rows[0]["passed"] == (status == 0)
    words = "FAIL" if status else "pass"
    assert words in (output / "table.md").read_text()
    assert words in (output / "index.html").read_text()
    return status, rows[0]


def test_agreement_passes(case_directory: Path) -> None:
    status, row = run(case_directory, FakeCode("other", lambda job, d: honest_result("other")))
    assert status == 0
    assert row["error"] == 0


def perturbed(amount: float) -> Callable[[Job, Path], Result]:
    def action(job: Job, directory: Path) -> Result:
        result = honest_result("other")
        result.frames[-1].columns["temperature"][3] += amount
        return result
    return action


def test_difference_above_tolerance_fails(case_directory: Path) -> None:
    status, row = run(case_directory, FakeCode("other", perturbed(20 * 2e-9)))
    assert status == 1
    assert row["error"] == pytest.approx(2e-9, rel=1e-3)


def test_difference_below_tolerance_passes(case_directory: Path) -> None:
    assert run(case_directory, FakeCode("other", perturbed(20 * 0.5e-9)))[0] == 0


def crash(job: Job, directory: Path) -> Result:
    run_program([sys.executable, "-c", "import os; os.abort()"], directory, 20)
    return honest_result("other")


def refuse(job: Job, directory: Path) -> Result:
    run_program([sys.executable, "-c", "raise SystemExit('error: no such style')"], directory, 20)
    return honest_result("other")


def hang(job: Job, directory: Path) -> Result:
    run_program([sys.executable, "-c", "import time; time.sleep(60)"], directory, 0.5)
    return honest_result("other")


def absent_program(job: Job, directory: Path) -> Result:
    run_program([directory / "no_such_program"], directory, 20)
    return honest_result("other")


def write_nothing(job: Job, directory: Path) -> Result:
    directory.mkdir(parents=True)
    run_program([sys.executable, "-c", "print('all is well')"], directory, 20)
    return read_result("other", directory)


def not_a_number(job: Job, directory: Path) -> Result:
    return perturbed(float("nan"))(job, directory)


def not_a_number_in_history(job: Job, directory: Path) -> Result:
    result = honest_result("other")
    result.history["thermal_energy"][2] = np.nan
    return result


def stop_early(job: Job, directory: Path) -> Result:
    result = honest_result("other")
    return dataclasses.replace(result, frames=result.frames[:-1])


def no_frames(job: Job, directory: Path) -> Result:
    return dataclasses.replace(honest_result("other"), frames=[])


def other_field(job: Job, directory: Path) -> Result:
    result = honest_result("other")
    for frame in result.frames:
        frame.columns["warmth"] = frame.columns.pop("temperature")
    return result


def fewer_elements(job: Job, directory: Path) -> Result:
    result = honest_result("other")
    for frame in result.frames:
        frame.columns["temperature"] = frame.columns["temperature"][:1]
    return result


def other_time_step(job: Job, directory: Path) -> Result:
    return dataclasses.replace(honest_result("other"), time_step=2e-3)


def broken_adaptor(job: Job, directory: Path) -> Result:
    raise KeyError("a bug of the adaptor")


@pytest.mark.parametrize("action", [
    crash, refuse, hang, absent_program, write_nothing, not_a_number, not_a_number_in_history,
    stop_early, no_frames, other_field, fewer_elements, other_time_step, broken_adaptor,
], ids=lambda action: action.__name__)
def test_a_code_that_fails_is_a_failure(case_directory: Path,
                                        action: Callable[[Job, Path], Result]) -> None:
    status, row = run(case_directory, FakeCode("other", action))
    assert status == 1
    assert row["error"] is None
    assert row["note"]


def test_a_missing_code_is_a_failure(case_directory: Path) -> None:
    status, row = run(case_directory, FakeCode("other", crash, "not installed"))
    assert status == 1
    assert "not installed" in row["note"]


def test_an_unknown_code_is_a_failure(case_directory: Path) -> None:
    assert run(case_directory, None)[0] == 1


def test_yade_without_its_program_is_a_failure(case_directory: Path) -> None:
    case = case_directory / "rod.toml"
    case.write_text(case.read_text().replace('"other"', '"yade"'))
    output = case_directory.parent / "results"
    codes = {"standalone": FakeStandalone(), "yade": Yade(program="no-such-yade")}
    assert main(["--case-directory", str(case_directory), "--output", str(output)], codes) == 1


def test_a_missing_reference_is_a_failure_of_its_own(case_directory: Path) -> None:
    case = case_directory / "rod.toml"
    case.write_text(case.read_text().replace('reference = "standalone"', 'reference = "oracle"'))
    status, row = run(case_directory, FakeCode("other", lambda job, d: honest_result("other")))
    assert status == 1
    assert "oracle" in row["note"]


def test_a_reference_code_that_fails_is_a_failure(case_directory: Path) -> None:
    case = case_directory / "rod.toml"
    case.write_text(case.read_text().replace('code = "other"', 'code = "standalone"')
                    .replace('reference = "standalone"', 'reference = "other"'))
    assert run(case_directory, FakeCode("other", not_a_number))[0] == 1


def test_an_unknown_measure_is_a_failure(case_directory: Path) -> None:
    case = case_directory / "rod.toml"
    case.write_text(case.read_text().replace("field_difference", "good_will"))
    assert run(case_directory, FakeCode("other", lambda job, d: honest_result("other")))[0] == 1


@pytest.mark.parametrize("old, new, words", [
    ('class = "C"', 'class = "X"', "class"),
    ("tolerance = 1e-9", "tolerance = 0", "tolerance"),
    ("tolerance = 1e-9", "", "tolerance"),
    ("tolerance = 1e-9", "tolerance = nan", "tolerance"),
    ('reason = "Same law, same order of steps."', 'reason = ""', "reason"),
    ('measure = "field', 'meassure = "field', "meassure"),
    ('codes = ["standalone", "other"]', 'codes = ["standalone"]', "other"),
    ("[[check]]", "[[chek]]", "chek"),
])
def test_a_wrong_case_file_is_a_failure(case_directory: Path, old: str, new: str,
                                        words: str) -> None:
    case = case_directory / "rod.toml"
    case.write_text(case.read_text().replace(old, new))
    status, row = run(case_directory, FakeCode("other", lambda job, d: honest_result("other")))
    assert status == 1
    assert words in row["note"]


def test_no_cases_is_a_failure(tmp_path: Path) -> None:
    (tmp_path / "none").mkdir()
    assert main(["--case-directory", str(tmp_path / "none"), "--output", str(tmp_path / "o")],
                {}) == 1


def test_an_unknown_case_is_refused(case_directory: Path) -> None:
    assert main(["no_such_case", "--case-directory", str(case_directory)], {}) == 2


def test_an_unfinished_run_is_no_result(tmp_path: Path) -> None:
    (tmp_path / "summary.json").write_text('{"completed": false}')
    with pytest.raises(CodeFailure, match="complete"):
        read_result("standalone", tmp_path)
