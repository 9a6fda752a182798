# SPDX-License-Identifier: GPL-2.0-or-later
"""The install script: what it drops where, and what it refuses."""

import fcntl
import os
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
    shutil.rmtree(tree / "src" / "effects")
    before = {path.relative_to(tree): path.read_bytes() for path in (tree / "src").glob("*.*")}

    done = install("--source", str(tree), "--drop-only")
    assert done.returncode == 0, done.stderr
    for file in (CONTRIB / "src").iterdir():
        assert (tree / "src" / file.name).read_bytes() == file.read_bytes()
    for file in (CONTRIB.parents[1] / "standalone" / "laws").glob("*.hpp"):
        assert (tree / "src" / "laws" / file.name).read_bytes() == file.read_bytes()
    pack = Path("effects/kernels/pack.hpp")
    assert (tree / "src" / pack).read_bytes() == (CONTRIB.parents[1] / "standalone" / pack).read_bytes()
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


def test_runs_no_words_of_the_path_that_it_stands_in(tmp_path: Path) -> None:
    if not Path("/usr/include/liggghts").is_dir():
        pytest.skip("LIGGGHTS is not there")
    tree = tmp_path / 'a $(touch ran) `touch ran` "; touch ran; " {} \'b'
    shutil.copytree(CONTRIB, tree / "contrib/liggghts")
    for folder in ("laws", "effects/kernels"):
        shutil.copytree(CONTRIB.parents[1] / "standalone" / folder, tree / "standalone" / folder)
    # A compiler that only makes the file that it is asked for, and says what it was given.
    tools = tmp_path / "tools"
    tools.mkdir()
    compiler = tools / "mpicxx"
    compiler.write_text('#!/bin/bash\nwhile [ $# -gt 1 ]; do\n'
                        '  [ "$1" != -c ] || [ -e "$2" ] || exit 1\n'
                        '  [ "$1" != -o ] || touch "$2"\n  shift\ndone\n')
    compiler.chmod(0o755)
    done = subprocess.run([tree / "contrib/liggghts/build_prebuilt"], cwd=tmp_path, text=True,
                          capture_output=True, check=False,
                          env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}",
                               "XDG_CACHE_HOME": str(tmp_path / "cache")})
    assert done.returncode == 0, done.stderr
    program = Path(done.stdout.splitlines()[0].removeprefix("program "))
    assert program.exists()
    assert not list(tmp_path.rglob("ran"))
