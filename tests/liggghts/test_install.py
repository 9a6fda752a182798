# SPDX-License-Identifier: GPL-2.0-or-later
"""The install script: what it drops where, and what it refuses."""

import fcntl
import shutil
import subprocess
from pathlib import Path

import pytest

from liggghts_runs import CONTRIB, built_paths


def install(*arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [CONTRIB / "install", *arguments], capture_output=True, text=True, timeout=600
    )


def test_refuses_what_is_no_source_tree(tmp_path: Path) -> None:
    done = install("--source", str(tmp_path))
    assert done.returncode != 0
    assert f"{tmp_path} is no LIGGGHTS source tree" in done.stderr


def test_refuses_another_version(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src" / "version_liggghts.txt").write_text("3.7.0\n")
    done = install("--source", str(tmp_path))
    assert done.returncode != 0
    assert "is LIGGGHTS 3.7.0; the styles are for 3.8.0" in done.stderr


def test_refuses_an_unknown_argument() -> None:
    done = install("--sauce", "tree")
    assert done.returncode != 0
    assert "unknown argument '--sauce'; known:" in done.stderr


@pytest.mark.slow
def test_drops_styles_laws_and_pages_into_a_tree(tmp_path: Path) -> None:
    own = built_paths("install", "--drop-only")["tree"]
    tree = tmp_path / "LIGGGHTS"
    (tree / "doc").mkdir(parents=True)
    with (own.parent / "install.lock").open("a") as lock:  # another test may be building in it
        fcntl.flock(lock, fcntl.LOCK_EX)
        shutil.copytree(own / "src", tree / "src")
    for dropped in (tree / "src").glob("*solidem*"):
        dropped.unlink()
    shutil.rmtree(tree / "src" / "laws")
    before = {path.relative_to(tree): path.read_bytes() for path in (tree / "src").glob("*.*")}

    done = install("--source", str(tree), "--drop-only")
    assert done.returncode == 0, done.stderr
    for file in (CONTRIB / "src").iterdir():
        assert (tree / "src" / file.name).read_bytes() == file.read_bytes()
    for file in (CONTRIB.parents[1] / "standalone" / "laws").glob("*.hpp"):
        assert (tree / "src" / "laws" / file.name).read_bytes() == file.read_bytes()
    for file in (CONTRIB / "doc").iterdir():
        assert (tree / "doc" / file.name).read_bytes() == file.read_bytes()
    for path, text in before.items():  # no core edits, beyond the compiler's patches made before
        assert (tree / path).read_bytes() == text

    (tree / "src" / ".solidem_files").open("a").write("./bond_solidem_old.cpp\n")
    (tree / "src" / "bond_solidem_old.cpp").write_text("a style of an earlier version")
    again = install("--source", str(tree), "--drop-only")
    assert again.returncode == 0
    assert not (tree / "src" / "bond_solidem_old.cpp").exists()
    assert "install: cp" not in again.stderr, "an unchanged file was copied again"
