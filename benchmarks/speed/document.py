# SPDX-License-Identifier: GPL-2.0-or-later
"""What the measurements of speed share: where their scenes are, and on what they ran."""

from __future__ import annotations

from pathlib import Path

HERE = Path(__file__).resolve().parent  #: where the scenes are


def processor() -> str:
    """The name of this machine's processor."""
    with open("/proc/cpuinfo") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")),
                    "unknown processor")
