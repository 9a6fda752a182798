# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of Python as TOML, which the one reader of scenes takes."""

from __future__ import annotations

import json
import math
import os
import re
from typing import Any, Mapping

import numpy as np


def _key(name: object) -> str:
    if not isinstance(name, str):
        raise TypeError(f"the key {name!r} is no str")
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _text(text: str) -> str:
    # JSON's escapes are TOML's, but for the delete character.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _float(value: float) -> str:
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(value)  # the shortest digits that give the same number


def value_text(value: Any) -> str:
    """A value as TOML: text, numbers, truth, paths, sequences and arrays, tables in braces."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return _float(float(value))
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(value_text(entry) for entry in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {value_text(v)}" for k, v in value.items()) + "}"
    raise TypeError(f"{value!r} is nothing that a scene can hold; expected text, a number, a truth "
                    "value, a list or a dict of these")


def _lines(table: Mapping[str, Any]) -> str:
    return "".join(f"{_key(name)} = {value_text(value)}\n" for name, value in table.items())


def _is_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(
        isinstance(entry, Mapping) for entry in value)


def toml_text(scene: Mapping[str, Any]) -> str:
    """A scene as TOML: single values first, then a section for each dict, [[one]] for each dict of
    a list. What is None is left out. Raises TypeError for what a scene cannot hold."""
    scene = {name: value for name, value in scene.items() if value is not None}
    single = {name: value for name, value in scene.items()
              if not isinstance(value, Mapping) and not _is_tables(value)}
    parts = [_lines(single)] if single else []
    for name, value in scene.items():
        if isinstance(value, Mapping):
            parts.append(f"[{_key(name)}]\n{_lines(value)}")
        elif _is_tables(value):
            parts += [f"[[{_key(name)}]]\n{_lines(entry)}" for entry in value]
    return "\n".join(parts)


def assignments(changes: Mapping[str, Any]) -> list[str]:
    """Changes by dotted keys as the program takes them: "beams.young_modulus=\"3 TPa\""; None
    takes a key out."""
    return [f"{key}={'' if value is None else value_text(value)}" for key, value in changes.items()]
