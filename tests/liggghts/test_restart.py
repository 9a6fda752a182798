# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs in a row and restart files lose nothing: bonds, history, orientation, temperature."""

from pathlib import Path

import numpy as np
import pytest

import moving_bar
from liggghts_runs import HEADER, Liggghts, read_dump, thermo
from moving_bar import STEPS, STYLES, beginning, largest_difference, state

ROUND_OFF = 1e-12
HALF = STEPS // 2


@pytest.fixture(scope="module")
def one_run(liggghts: Liggghts, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    folder = tmp_path_factory.mktemp("one_run")
    script = beginning() + state() + f"run {STEPS}\n"
    frame = moving_bar.run(liggghts, folder, script)[STEPS]
    moving_bar.check_it_moved(frame)
    return frame


@pytest.mark.parametrize("rebuild", [True, False])
@pytest.mark.parametrize("ranks", [1, 2])
def test_runs_in_a_row_equal_one_run(
    liggghts: Liggghts, tmp_path: Path, one_run: np.ndarray, ranks: int, rebuild: bool
) -> None:
    runs = f"run {STEPS - 70}\nrun 0\nrun 30\nrun 40\n"
    frames = moving_bar.run(liggghts, tmp_path, beginning(rebuild=rebuild) + state() + runs, ranks)
    difference = largest_difference(one_run, frames[STEPS])
    print(f"{ranks} ranks, rebuilds {rebuild}: {difference:.1e}")
    assert difference <= ROUND_OFF


RESUME = (
    HEADER.replace("units           si\natom_style      hybrid granular molecular\n", "")
    + "read_restart half.restart\nneighbor 0.5e-3 bin\nneigh_modify every 1 delay 0 check no\n"
    + "pair_style none\n"
    + STYLES
)


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("written", ["after the run", "in mid-run", "in mid-run without rebuilds"])
def test_a_restart_file_carries_everything(
    liggghts: Liggghts,
    tmp_path: Path,
    one_run: np.ndarray,
    ranks: int,
    newton: str,
    written: str,
) -> None:
    script = beginning(newton, rebuild="without" not in written)
    if written == "after the run":
        script += f"run {HALF}\nwrite_restart half.restart\n"
    else:
        script += f"restart {HALF} step.*.restart\nrun {HALF + 10}\n"
        script += f"shell mv step.{HALF}.restart half.restart\n"
    moving_bar.write_body(tmp_path)
    first = thermo(liggghts.run(tmp_path, script, ranks))
    resumed = tmp_path / "resumed"
    resumed.mkdir()
    (tmp_path / "half.restart").rename(resumed / "half.restart")
    said = liggghts.run(resumed, RESUME + state() + f"run {STEPS - HALF}\n", ranks)
    difference = largest_difference(one_run, read_dump(resumed / "state.txt")[STEPS])
    print(f"{ranks} ranks, newton {newton}, {written}: {difference:.1e}")
    assert difference <= ROUND_OFF
    second = thermo(said)
    assert second[0, 0] == HALF
    if written == "after the run":  # thermal energy and heat supplied so far
        assert second[0, 3:] == pytest.approx(first[-1, 3:], rel=1e-13)
    assert second[-1, 4] > second[0, 4] > 0


def test_a_restart_may_change_the_number_of_ranks(
    liggghts: Liggghts, tmp_path: Path, one_run: np.ndarray
) -> None:
    moving_bar.write_body(tmp_path)
    liggghts.run(tmp_path, beginning() + f"run {HALF}\nwrite_restart half.restart\n", ranks=4)
    liggghts.run(tmp_path, RESUME + state() + f"run {STEPS - HALF}\n", ranks=1)
    assert largest_difference(one_run, read_dump(tmp_path / "state.txt")[STEPS]) <= ROUND_OFF


def resumed_from(liggghts: Liggghts, folder: Path, content: bytes) -> str:
    """What LIGGGHTS says when it goes on from a restart file."""
    (folder / "half.restart").write_bytes(content)
    try:
        return liggghts.run(folder, RESUME + "run 1\n")
    except AssertionError as failure:
        return str(failure)


@pytest.mark.parametrize("part", ["history of bonds", "figures of the fix", "coefficients",
                                  "heat supplied", "key of a bond"])
def test_a_restart_file_that_is_damaged_in_our_part_is_refused(
    liggghts: Liggghts, tmp_path: Path, part: str
) -> None:
    """One bit is turned over in what the styles wrote."""
    moving_bar.write_body(tmp_path)
    liggghts.run(tmp_path, beginning() + f"run {HALF}\nwrite_restart half.restart\n")
    whole = (tmp_path / "half.restart").read_bytes()
    assert "damaged" not in resumed_from(liggghts, tmp_path, whole)
    a_bond = place_of_a_bond(whole)
    at = {
        "history of bonds": a_bond,
        "key of a bond": a_bond - 2 * 8,
        "figures of the fix": behind(whole, b"solidem/bonds\0"),
        "heat supplied": behind(whole, b"solidem/temperature\0"),
        "coefficients": whole.index(np.float64(3.5e10).tobytes()),
    }[part]
    broken = bytearray(whole)
    broken[at + 5] ^= 4
    said = resumed_from(liggghts, tmp_path, bytes(broken))
    assert "damaged, or of another version" in said
    words = {"history of bonds": "the record of atom", "key of a bond": "the record of atom",
             "coefficients": "coefficients of bond style solidem/beam"}
    assert words.get(part, "what this fix wrote into it") in said


def behind(content: bytes, style: bytes) -> int:
    """Where the first number of a fix stands: behind the length and the checksum."""
    return content.index(style) + len(style) + 4 + 8


def place_of_a_bond(content: bytes) -> int:
    """Where a history begins: with a unit vector and a rest length."""
    for shift in range(8):
        number = np.frombuffer(content, offset=shift, count=(len(content) - shift) // 8)
        with np.errstate(all="ignore"):
            square = number[:-3] ** 2 + number[1:-2] ** 2 + number[2:-1] ** 2
            found = np.flatnonzero((abs(square - 1) < 1e-12) & (number[1:-2] != 0)
                                   & (abs(number[3:] / (2 * moving_bar.RADIUS) - 1) < 0.1))
        if len(found):
            return shift + 8 * int(found[0])
    raise AssertionError("no bond in the restart file")
