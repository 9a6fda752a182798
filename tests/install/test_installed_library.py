# SPDX-License-Identifier: GPL-2.0-or-later
"""The installed library and program work without the source tree."""

import subprocess
from pathlib import Path

import h5py
import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"


def run(*command: object) -> str:
    """What a command prints; its errors are shown when it fails."""
    done = subprocess.run([str(word) for word in command], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the release build is installed."""
    folder = tmp_path_factory.mktemp("prefix")
    run("cmake", "--install", BUILD, "--prefix", folder)
    return folder


@pytest.mark.slow
def test_another_project_finds_links_and_runs_it(prefix: Path, tmp_path: Path) -> None:
    run("cmake", "-S", ROOT / "tests" / "install", "-B", tmp_path / "build", "-G", "Ninja",
        f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", tmp_path / "build")
    words = run(tmp_path / "build" / "consumer", tmp_path / "trajectory.h5").split()
    assert words[1:] == ["1", "4"]  # mean radius; face of the cube round a unit sphere
    with h5py.File(tmp_path / "trajectory.h5") as file:
        assert file["frames/000000/radius"].shape == (4,)


@pytest.mark.slow
def test_the_installed_program_knows_its_version(prefix: Path) -> None:
    version = [line.split('"')[1] for line in
               (prefix / "lib/cmake/solidem/solidemConfigVersion.cmake").read_text().splitlines()
               if line.startswith("set(PACKAGE_VERSION ")]
    assert version[0] in run(prefix / "bin" / "solidem", "--version")


@pytest.mark.slow
def test_no_header_needs_the_source_tree(prefix: Path, tmp_path: Path) -> None:
    include = prefix / "include" / "solidem"
    headers = [path.relative_to(include) for path in include.rglob("*.hpp")]
    assert Path("laws/beam.hpp") in headers
    assert not list(include.glob("app/*"))
    assert str(ROOT) not in (prefix / "lib/cmake/solidem/solidemTargets.cmake").read_text()
