# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes as nested tables: keys set and removed by their dotted names, written as TOML."""

from __future__ import annotations

import copy
import json
import re
from typing import Any, Iterable, Mapping

Scene = dict[str, Any]


class SceneChangeError(ValueError):
    """A change that the scene does not allow."""


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, list):
        return "[" + ", ".join(_value(entry) for entry in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    raise SceneChangeError(f"{value!r} is nothing that a scene can hold")


def _section(heading: str, table: Mapping[str, Any]) -> str:
    return "\n".join([heading, *(f"{_key(k)} = {_value(v)}" for k, v in table.items())]) + "\n"


def write_scene(scene: Scene) -> str:
    """The scene as TOML: bare keys first, then a section for each table."""
    parts = ["\n".join(f"{_key(k)} = {_value(v)}" for k, v in scene.items()
                       if not isinstance(v, dict) and not _is_tables(v)) + "\n"]
    for name, value in scene.items():
        if isinstance(value, dict):
            parts.append(_section(f"[{_key(name)}]", value))
        elif _is_tables(value):
            parts += [_section(f"[[{_key(name)}]]", entry) for entry in value]
    return "\n".join(parts)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _step(node: Any, name: str, path: str) -> Any:
    """The table or entry under a name; "grips.right" is the grip whose name is right."""
    if isinstance(node, dict):
        return node.setdefault(name, {})
    if isinstance(node, list):
        if name.isdigit() and int(name) < len(node):
            return node[int(name)]
        for entry in node:
            if isinstance(entry, dict) and entry.get("name") == name:
                return entry
    raise SceneChangeError(f"{path}: the scene has no {name}")


def changed(scene: Scene, values: Mapping[str, Any], removed: Iterable[str] = ()) -> Scene:
    """A copy with dotted keys ("run.duration", "grips.right.velocity.0") set or removed."""
    result = copy.deepcopy(scene)
    for path, value in values.items():
        *way, last = path.split(".")
        node: Any = result
        for name in way:
            node = _step(node, name, path)
        if isinstance(node, list) and last.isdigit() and int(last) < len(node):
            node[int(last)] = value
        elif isinstance(node, dict):
            node[last] = value
        else:
            raise SceneChangeError(f"{path}: the scene has no such key")
    for path in removed:
        *way, last = path.split(".")
        node = result
        for name in way:
            node = _step(node, name, path)
        if not isinstance(node, dict) or last not in node:
            raise SceneChangeError(f"{path}: there is nothing to remove")
        del node[last]
    return result
