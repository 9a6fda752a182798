# SPDX-License-Identifier: GPL-2.0-or-later
"""The Debian packages: what is in them works far from the tree, and says what it needs."""

from __future__ import annotations

import fcntl
import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"

pytestmark = pytest.mark.slow


def run(*command: object, cwd: Path | None = None, **environment: str) -> str:
    """What a command prints; its errors are shown when it fails."""
    done = subprocess.run([str(word) for word in command], check=False, text=True, cwd=cwd,
                          env={**os.environ, **environment}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The packages of the release build, by name."""
    folder = tmp_path_factory.mktemp("packages")
    with (BUILD / "tests.lock").open("a") as lock:  # the test of the wheel builds there, too
        fcntl.flock(lock, fcntl.LOCK_EX)
        run("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", folder, cwd=folder)
    return {path.name.split("_")[0]: path for path in folder.glob("*.deb")}


@pytest.fixture(scope="module")
def unpacked(packages: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All of them in one root."""
    root = tmp_path_factory.mktemp("root")
    for path in packages.values():
        run("dpkg", "-x", path, root)
    return root


def needs(package: Path) -> set[str]:
    """Names of the packages that one depends on."""
    text = run("dpkg-deb", "-f", package, "Depends")
    return {re.split(r"[ (:]", word.strip())[0] for word in text.split(",") if word.strip()}


def test_each_says_what_it_needs(packages):
    assert set(packages) == {"solidem", "libsolidem-dev", "python3-solidem", "liggghts-solidem"}
    for name in ("solidem", "python3-solidem"):
        found = needs(packages[name])
        assert {"libc6", "libstdc++6", "libgomp1", "libhdf5-103-1"} <= found, (name, found)
    assert "python3-numpy" in needs(packages["python3-solidem"])
    assert "libeigen3-dev" in needs(packages["libsolidem-dev"])
    assert "libliggghts3" in needs(packages["liggghts-solidem"])
    # Every dependency is a package of this Debian.
    needed = set().union(*map(needs, packages.values()))
    told = run("apt-cache", "show", "--no-all-versions", *sorted(needed))
    assert needed <= set(re.findall(r"^Package: (.*)$", told, re.MULTILINE))


def test_the_program_runs_its_example_and_has_its_manual(unpacked, tmp_path):
    program = unpacked / "usr/bin/solidem"
    example = unpacked / "usr/share/doc/solidem/examples/tension.toml"
    run(program, "run", example, "-o", "results", "-q", "--set", "run.duration=", "--set",
        "run.steps=20", cwd=tmp_path)
    assert (tmp_path / "results" / "history.csv").exists()
    page = (unpacked / "usr/share/man/man1/solidem.1").read_text()
    assert page.startswith(".TH SOLIDEM 1")
    assert "_solidem" in (unpacked / "usr/share/bash-completion/completions/solidem").read_text()
    assert "GNU GENERAL PUBLIC LICENSE" in (
        unpacked / "usr/share/doc/solidem/copyright").read_text().upper()


def test_the_module_is_imported(unpacked, tmp_path):
    place = unpacked / "usr/lib/python3/dist-packages"
    assert (place / "solidem" / "py.typed").exists()
    told = run("/usr/bin/python3", "-c", "import solidem; print(solidem.__file__)", cwd=tmp_path,
               PYTHONPATH=str(place), PYTHONDONTWRITEBYTECODE="1")
    assert str(place) in told


def test_a_project_links_to_the_library(unpacked, tmp_path):
    run("cmake", "-S", ROOT / "tests/install", "-B", tmp_path / "build", "-G", "Ninja",
        f"-DCMAKE_PREFIX_PATH={unpacked / 'usr'}", "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", tmp_path / "build")
    assert run(tmp_path / "build" / "consumer", tmp_path / "trajectory.h5").split()[1:] == ["1", "4"]


def test_liggghts_knows_the_styles(unpacked, tmp_path):
    (tmp_path / "in.style").write_text("""\
units si
atom_style hybrid granular molecular
atom_modify map array sort 0 0
boundary f f f
newton off
region box block 0 1 0 1 0 1
create_box 1 box
pair_style none
bond_style solidem/beam
""")
    program = unpacked / "usr/bin/liggghts-solidem"
    shown = run(program, "-in", "in.style", cwd=tmp_path)
    assert "ERROR" not in shown
    preload = unpacked / "usr/lib/solidem/libsolidem_liggghts.so"
    shown = run("liggghts", "-in", "in.style", cwd=tmp_path, LD_PRELOAD=str(preload))
    assert "ERROR" not in shown
    # From where they lie the styles can be built once more.
    scripts = unpacked / "usr/share/solidem/contrib/liggghts"
    assert os.access(scripts / "install", os.X_OK) and (scripts / "src").is_dir()
    assert (unpacked / "usr/share/solidem/standalone/laws/beam.hpp").exists()
    assert (unpacked / "usr/share/solidem/standalone/effects/kernels/pack.hpp").exists()
