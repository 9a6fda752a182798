# SPDX-License-Identifier: GPL-2.0-or-later
"""What is proposed to somebody who asks for an error, and the scene of it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ._core import InputError
from .choices import Choices
from .foretold import Cost, ErrorModel, Errors
from .level import Level
from .refinement import refinement_of
from .scene import Scene
from .scene_edit import edited
from .scene_text import toml_text
from .series import Series
from .studies import Study


@dataclass(frozen=True)
class Proposal:
    """A scene that keeps an error, and what that takes."""

    elements: int
    packings: int  #: whose mean keeps the error
    changes: dict[str, Any]  #: of the scene, by dotted keys
    errors: Errors
    cost: Cost  #: of one packing
    bytes: float  #: of one packing


@dataclass(frozen=True)
class Advice:
    """All that was found."""

    scene: Scene
    of: str
    at: str
    error: float  #: that is asked for
    kind: str
    study: Study | None
    scale: float
    levels: list[Level]  #: from the coarsest
    costs: list[Cost]  #: of one packing of each
    model: ErrorModel | None  #: None: bodies stay as they are
    choices: Choices
    why_not_finer: str  #: what keeps bodies as they are
    proposal: Proposal | None  #: None: no body that is allowed keeps the error
    cheaper: Proposal | None  #: the mean of several packings, where that takes less time
    least: Proposal | None  #: the largest body that is allowed, where none keeps the error
    series: Series | None  #: whose limit keeps it where no body does or in less time, or comes nearest
    pilot_seconds: float

    @property
    def proposed(self) -> Proposal | Series | None:
        """What keeps the error: one body, or else a series."""
        if self.proposal or not self.series or self.series.promised > self.error:
            return self.proposal
        return self.series


def changes_of(advice: Advice, proposed: Proposal | Series) -> dict[str, Any]:
    """Of the scene, by dotted keys; of a series for its finest body."""
    if isinstance(proposed, Proposal):
        return proposed.changes
    last = proposed.asked()[-1]
    return {**last.changes, **refinement_of(advice.scene.tables).changes(last.factor)}


def scene_text(advice: Advice, proposed: Proposal | Series) -> str:
    """The scene as it is proposed, in the words of the scene."""
    source, changes = advice.scene, changes_of(advice, proposed)
    wanted = source.changed(changes)
    text = edited(source.text, changes)
    try:
        same = Scene(text, folder=source.path.parent, name=source.path.stem).values == wanted.values
    except InputError:
        same = False
    if not same:  # values on several lines, tables in braces: without its comments
        tables = json.loads(json.dumps(source.tables, default=str))
        for key, value in changes.items():
            section, *between, entry = key.split(".")
            table = tables.setdefault(section, {})
            if between:
                table = next(part for number, part in enumerate(table)
                             if part.get("name", str(number)) == between[0])
            table[entry] = value
            if value is None:
                del table[entry]
        text = toml_text(tables)
    head = (f"# Proposed by solidem advise: {advice.of} at the {advice.at} within "
            f"{100 * advice.error:g} % of what finer bodies tend to")
    if isinstance(proposed, Series):
        asked = ", ".join(f"{part.packings} × {part.elements:.0f}" for part in proposed.asked())
        return head + f",\n# as the limit of a series, packings × elements: {asked}.\n" + text
    if proposed.packings > 1:
        return head + f",\n# as the mean of {proposed.packings} packings (seeds).\n" + text
    return head + ".\n" + text


def write_scene(advice: Advice, proposed: Proposal | Series, file: Path, overwrite: bool) -> None:
    """Writes and reads it. InputError where it cannot stand there."""
    if file.exists() and not overwrite:
        raise InputError(f"{file}: exists already; expected a new name, or --overwrite")
    text = scene_text(advice, proposed)
    try:
        Scene(text, folder=file.parent, name=file.stem)
    except InputError as error:
        raise InputError(f"{file}: {error}; a scene that names files stands beside them: expected a "
                         f"place in {advice.scene.path.parent}") from error
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}; expected a file that can be written") from error
