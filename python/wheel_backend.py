# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds the wheel of `solidem` for `pip install .`: CMake compiles, this packs. It needs nothing
but Python, CMake and what solidem is built with, so pip has nothing to fetch.

The interface is that of PEP 517. The build goes on in build/wheel of the sources, or, with the
setting `build-directory`, in a folder that CMake has configured already, which may hold the core:

    pip install . --config-settings=build-directory=build/release
"""

from __future__ import annotations

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "wheel"


def _version() -> str:
    """That of the project, which stands in CMakeLists.txt."""
    found = re.search(r"project\(solidem VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    assert found, "CMakeLists.txt tells no version"
    return found[1]


def _metadata() -> str:
    head = {"Metadata-Version": "2.1", "Name": "solidem", "Version": _version(),
            "Summary": "Continuous solids as compact packings of spheres (DEM)",
            "License": "GPL-2.0-or-later", "Requires-Python": ">=3.11", "Requires-Dist": "numpy",
            "Description-Content-Type": "text/markdown"}
    lines = [f"{name}: {value}" for name, value in head.items()]
    lines += ["Provides-Extra: results", "Requires-Dist: h5py; extra == 'results'",
              "Requires-Dist: pandas; extra == 'results'"]
    return "\n".join(lines) + "\n\n" + (ROOT / "docs" / "python.md").read_text(encoding="utf-8")


def _tag() -> str:
    interpreter = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{interpreter}-{interpreter}-{platform}"


def _python_of(build: Path) -> str:
    """The interpreter that a build is for."""
    cache = build / "CMakeCache.txt"
    found = re.search(r"^_?Python_EXECUTABLE:\w+=(.+)$", cache.read_text() if cache.exists() else "",
                      re.MULTILINE)
    if found is None:
        raise SystemExit(f"{build} builds no Python module; expected a folder that was configured "
                         "with -DSOLIDEM_PYTHON=ON")
    return found[1]


def _configured(settings: dict[str, Any]) -> Path:
    """The build directory, configured."""
    unknown = set(settings) - {"build-directory"}
    if unknown:
        raise SystemExit(f"unknown setting {min(unknown)}; known: build-directory")
    if "build-directory" not in settings:
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(BUILD), "-DSOLIDEM_PYTHON=ON",
                        "-DSOLIDEM_TESTS=OFF", "-DSOLIDEM_PRECOMPILED_HEADERS=ON",
                        "-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}"],
                       check=True)
        return BUILD
    build = ROOT / str(settings["build-directory"])
    tell = [_python_of(build), "-c", "import sys; print(sys.implementation.cache_tag)"]
    tag = subprocess.run(tell, check=True, capture_output=True, text=True).stdout.strip()
    if tag != sys.implementation.cache_tag:
        raise SystemExit(f"{build} builds the module for {tag}; this is "
                         f"{sys.implementation.cache_tag}")
    return build


def _compile(settings: dict[str, Any]) -> Path:
    """Builds the package; its folder."""
    build = _configured(settings)
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
    subprocess.run(["cmake", "--build", str(build), "--target", "solidem_python", "--parallel", jobs],
                   check=True)
    return build / "python" / "solidem"


class _Wheel:
    """A wheel that is being written, and the record of its files."""

    def __init__(self, path: Path) -> None:
        self.name = f"solidem-{_version()}.dist-info"
        self._file = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self._record: list[str] = []

    def add(self, name: str, content: bytes) -> None:
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        self._record.append(f"{name},sha256={digest},{len(content)}")
        self._file.writestr(name, content)

    def close(self) -> None:
        record = f"{self.name}/RECORD"
        self._file.writestr(record, "\n".join([*self._record, f"{record},,"]) + "\n")
        self._file.close()


def build_wheel(wheel_directory: str, config_settings: dict[str, Any] | None = None,
                metadata_directory: str | None = None) -> str:
    """Builds the wheel into a folder; its name."""
    package = _compile(config_settings or {})
    name = f"solidem-{_version()}-{_tag()}.whl"
    wheel = _Wheel(Path(wheel_directory) / name)
    for path in sorted(package.iterdir()):
        if path.suffix in (".py", ".pyi", ".csv", ".so") or path.name == "py.typed":
            wheel.add(f"solidem/{path.name}", path.read_bytes())
    wheel.add(f"{wheel.name}/METADATA", _metadata().encode())
    wheel.add(f"{wheel.name}/WHEEL", "Wheel-Version: 1.0\nGenerator: solidem\nRoot-Is-Purelib: false\n"
              f"Tag: {_tag()}\n".encode())
    wheel.add(f"{wheel.name}/LICENSE", (ROOT / "LICENSE").read_bytes())
    wheel.close()
    return name


def build_sdist(sdist_directory: str, config_settings: dict[str, Any] | None = None) -> str:
    """Packs the sources that are needed to build the wheel; the name of the file."""
    stem = f"solidem-{_version()}"
    with tarfile.open(Path(sdist_directory) / f"{stem}.tar.gz", "w:gz",
                      format=tarfile.PAX_FORMAT) as archive:
        for name in ("CMakeLists.txt", "packages.cmake", "LICENSE", "README.md", "pyproject.toml",
                     "docs/python.md", "standalone", "python"):
            archive.add(ROOT / name, f"{stem}/{name}",
                        filter=lambda entry: None if "__pycache__" in entry.name else entry)
        information = BUILD / "PKG-INFO"
        information.parent.mkdir(parents=True, exist_ok=True)
        information.write_text(_metadata(), encoding="utf-8")
        archive.add(information, f"{stem}/PKG-INFO")
    return f"{stem}.tar.gz"
