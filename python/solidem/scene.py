# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes: what body, of what, how it is loaded."""

from __future__ import annotations

import html
import json
import os
import tempfile
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping

from . import _core
from .results import Results
from .scene_text import assignments, toml_text
from .specimen import Specimen

if TYPE_CHECKING:
    from .simulation import Simulation

Source = str | os.PathLike[str] | Mapping[str, Any]


class Scene:
    """A scene that was read and found to be right. It does not change: `changed` makes others."""

    def __init__(self, source: Source, changes: Mapping[str, Any] | None = None, *,
                 folder: str | os.PathLike[str] = ".", name: str = "scene") -> None:
        """Reads a scene.

        `source`: a file; a text of several lines, in TOML; or a dict of sections.
        `changes`: values that hold instead, by dotted keys: {"beams.young_modulus": "3 TPa",
        "grips.right.velocity.0": "2 m/s"}; None takes a key out.
        `folder` and `name` are those of a scene that stands in no file: where paths in it begin,
        what messages call it. Raises InputError with the key, what was found, what is right.
        """
        text = None
        if isinstance(source, Mapping):
            text = toml_text(source)
        elif isinstance(source, str) and "\n" in source:
            text = source
        path = str(Path(folder) / f"{name}.toml") if text is not None else os.fspath(source)  # type: ignore[arg-type]
        self._text = text
        self._changes = dict(changes or {})
        self._source = _core.SceneSource(path, text, assignments(self._changes))
        self._read = _core.Scene(self._source)

    @property
    def title(self) -> str:
        """Its title, or its name."""
        return self._read.title

    @property
    def path(self) -> Path:
        """Of its file; of a scene without one, what messages call it."""
        return Path(self._read.path)

    @property
    def text(self) -> str:
        """Its TOML, without the changes."""
        return self.path.read_text(encoding="utf-8") if self._text is None else self._text

    @property
    def tables(self) -> dict[str, Any]:
        """Its TOML as a dict, without the changes: to be changed and made a scene again."""
        return tomllib.loads(self.text)

    @property
    def changes(self) -> dict[str, Any]:
        """The values that hold in place of its text's, by dotted keys."""
        return dict(self._changes)

    @property
    def values(self) -> dict[str, str]:
        """All that was read, with the changes, in SI units: {"[beams] young_modulus": "3e+12"}."""
        return dict(self._read.record)

    def changed(self, changes: Mapping[str, Any]) -> Scene:
        """The same scene with other values, by dotted keys; those of before stay changed."""
        both = {**self._changes, **changes}
        if self._text is None:
            return Scene(self.path, both)
        return Scene(self._text + "\n", both, folder=self.path.parent, name=self.path.stem)

    def specimen(self) -> Specimen:
        """Makes its packing, with bonds."""
        return Specimen(self._read)

    def simulation(self, specimen: Specimen | None = None, *, force: bool = False) -> Simulation:
        """Makes a simulation to step. `specimen`: in the place of the scene's own; `force`: accept
        a time step beyond the stable limit."""
        from .simulation import Simulation as Made

        return Made(self._read, specimen, force)

    def run(self, folder: str | os.PathLike[str], *, overwrite: bool = False, resume: bool = False,
            force: bool = False, quiet: bool = True) -> Results:
        """Runs and records it as `solidem run` does: the same files, the same bits. `quiet`: no
        progress on the standard error. Ctrl-C leaves a checkpoint and raises KeyboardInterrupt."""
        self._read.run(os.fspath(folder), overwrite, resume, force, quiet)
        return Results(folder)

    def solve(self, folder: str | os.PathLike[str] | None = None, *, rotations: str = "small",
              modes: int = 0, overwrite: bool = False) -> Results:
        """Finds the static equilibrium at the end of its run, as `solidem solve` does. Without a
        folder, the results are kept as long as what is returned."""
        if rotations not in ("small", "finite"):
            raise ValueError(f"rotations = {rotations!r}: expected \"small\" or \"finite\"")
        kept = None
        if folder is None:
            kept = tempfile.TemporaryDirectory(prefix="solidem_")
            folder = kept.name
        place = os.fspath(folder)
        self._source.solve(place, rotations, modes, overwrite)
        return Results(place, _kept=kept)

    def calibrate(self, folder: str | os.PathLike[str] | None = None, *,
                  overwrite: bool = False) -> dict[str, Any]:
        """Finds the parameters of its beams that give the body the properties of a material, as
        `solidem calibrate` does: what that writes into calibration.json. RunError where a target is
        missed."""
        with tempfile.TemporaryDirectory(prefix="solidem_") as own:
            place = own if folder is None else os.fspath(folder)
            self._source.calibrate(place, overwrite)
            found: dict[str, Any] = json.loads((Path(place) / "calibration.json").read_text())
        return found

    def __repr__(self) -> str:
        return f"<solidem.Scene {self.title!r}: {', '.join(self.sections)}>"

    @property
    def sections(self) -> list[str]:
        """Names of its sections, in their order."""
        return list(dict.fromkeys(name.split("]")[0].strip("[") for name in self.values
                                  if name.startswith("[")))

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(value)}</td></tr>"
                       for name, value in self.values.items())
        return f"<b>{html.escape(self.title)}</b><table>{rows}</table>"
