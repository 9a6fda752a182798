# SPDX-License-Identifier: GPL-2.0-or-later
"""Where and of what a verification table was made: commit, day, machine, versions of the codes."""

from __future__ import annotations

import os
import platform
import re
import subprocess
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Iterable

from compare.codes.base import ROOT, Code
from compare.row import Row


@dataclass(frozen=True)
class Provenance:
    """What a reader must know to make the table again."""

    date: str
    commit: str
    machine: str
    versions: dict[str, str]  #: of each code that rows name

    def lines(self) -> list[str]:
        """One sentence each."""
        return [f"{self.date}, commit {self.commit}", self.machine,
                *(f"{name}: {version}" for name, version in self.versions.items())]


def commit(directory: Path = ROOT) -> str:
    """Short name of the commit, and whether files differ from it."""
    try:
        name, changes = (subprocess.run(["git", *words], cwd=directory, capture_output=True,
                                        text=True, check=True, timeout=20).stdout.strip()
                         for words in (["rev-parse", "--short=12", "HEAD"],
                                       ["status", "--porcelain", "--untracked-files=no"]))
    except (OSError, subprocess.SubprocessError):
        return "unknown: no git repository"
    return f"{name}, with changes that are not committed" if changes else name


def machine() -> str:
    """Processor, cores, system."""
    try:
        found = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(),
                          re.MULTILINE)
    except OSError:
        found = None
    processor = found.group(1) if found else platform.machine()
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    return f"{processor}, {os.cpu_count()} cores, {system}"


def version_of(code: Code) -> str:
    """What a code says it is; why not, when it cannot."""
    if reason := code.missing():
        return reason
    try:
        return code.version()
    except (OSError, subprocess.SubprocessError, ValueError) as error:
        return f"unknown: {error}"


def provenance(rows: Iterable[Row], codes: dict[str, Code]) -> Provenance:
    """Of these rows, made now."""
    named = {name for row in rows for name in (row.code, row.reference)}
    return Provenance(datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC"), commit(),
                      machine(), {name: version_of(code) for name, code in codes.items()
                                  if name in named})
