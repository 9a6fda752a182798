# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes values into the text of a scene, so that its words and its order stay."""

from __future__ import annotations

import re
from typing import Any, Mapping

from .scene_text import value_text

HEADER = re.compile(r"\s*(\[\[?)\s*([A-Za-z0-9_.\"-]+)\s*\]\]?\s*(#.*)?$")
ENTRY = re.compile(r"\s*([A-Za-z0-9_-]+)\s*=")
#: A comment after a value that holds no sign of a comment itself.
COMMENT = re.compile(r"^(?:[^\"'#]|\"[^\"]*\"|'[^']*')*?(\s*#.*)$")


def _part(lines: list[str], section: str, name: str | None) -> tuple[int, int]:
    """Where the lines of a section begin and end, after its header; of [[section]] those of the
    entry with this name, or number. (-1, -1): there is none."""
    starts = [number for number, line in enumerate(lines) if HEADER.match(line)] + [len(lines)]
    count = 0
    for start, end in zip(starts, starts[1:]):
        header = HEADER.match(lines[start])
        assert header is not None
        if header.group(2) != section:
            continue
        own = [line.split("=", 1)[1] for line in lines[start + 1:end]
               if (entry := ENTRY.match(line)) and entry.group(1) == "name"]
        own_name = own[0].split("#")[0].strip().strip("\"'") if own else None
        if name is None or name in (own_name, str(count)):
            return start + 1, end
        count += 1
    return -1, -1


def _last_entry(lines: list[str], start: int, end: int) -> int:
    """After the last line of a section that is neither empty nor a comment."""
    while end > start and (not lines[end - 1].strip() or lines[end - 1].lstrip().startswith("#")):
        end -= 1
    return end


def edited(text: str, changes: Mapping[str, Any]) -> str:
    """The text with these values by dotted keys, "specimen.elements" or "body.plate.elements"; None
    takes a key out. Values stand on one line each; who calls makes sure that what was read of the
    new text is what was meant."""
    lines = text.splitlines()
    for key, value in changes.items():
        section, *between, entry = key.split(".")
        start, end = _part(lines, section, between[0] if between else None)
        if start < 0:
            if value is not None:
                lines += ["", f"[{section}]", f"{entry} = {value_text(value)}"]
            continue
        at = next((number for number in range(start, end)
                   if (found := ENTRY.match(lines[number])) and found.group(1) == entry), None)
        if value is None:
            if at is not None:
                del lines[at]
            continue
        line = f"{entry} = {value_text(value)}"
        if at is None:
            lines.insert(_last_entry(lines, start, end), line)
        else:
            told = COMMENT.match(lines[at])
            lines[at] = line + (told.group(1) if told else "")
    return "\n".join(lines) + "\n"
