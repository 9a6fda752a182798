# SPDX-License-Identifier: GPL-2.0-or-later
"""A sample of the faults of campaign.py, the same each time. All of them: campaign.py."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from campaign import COMMANDS, DAMAGES, Command, Damage, build_shim, damaged_files, faulty_calls


@pytest.fixture(scope="module")
def shim(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_shim(tmp_path_factory.mktemp("shim"))


def name_of(item: Command | Damage) -> str:
    return item.name


@pytest.mark.parametrize("how", ["fail", "kill"])
@pytest.mark.parametrize("command", COMMANDS, ids=name_of)
def test_a_sample_of_faulty_calls(command: Command, how: str, tmp_path: Path, shim: Path) -> None:
    found = faulty_calls(command, how, tmp_path / "faults", shim, most=7)
    assert found["told" if how == "fail" else "killed"] >= 4


@pytest.mark.parametrize("damage", DAMAGES, ids=name_of)
def test_a_sample_of_damaged_files(damage: Damage, tmp_path: Path) -> None:
    found = damaged_files(damage, tmp_path / "damaged", 6)
    assert sum(found.values()) >= 10


def test_the_check_can_fail(tmp_path: Path, shim: Path) -> None:
    """A write that fails where nobody looks would be seen."""
    wrong: Callable[[Path], None] = lambda folder: (folder / "body.csv").write_text("x,y,z,radius\n")
    command = Command("convert .csv", ("info", "given.h5"), "body.csv", COMMANDS[5].before)
    with pytest.raises(AssertionError):
        from campaign import Faults
        faults = Faults(command, "fail", tmp_path / "faults", shim)
        wrong(faults.start)
        faults.check(faults.calls + 1)
