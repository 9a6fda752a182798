# SPDX-License-Identifier: GPL-2.0-or-later
"""Specimens: packings of spheres, and the bonds between them."""

from __future__ import annotations

import html
import os

from . import _core


class Specimen(_core.Specimen):
    """A packing, made by `Scene.specimen` or read from a file. Its arrays are views without a copy."""

    @staticmethod
    def read(path: str | os.PathLike[str]) -> Specimen:
        """Reads .h5, .data (LIGGGHTS), .txt (YADE) or .csv."""
        return Specimen(_core.Specimen.read(os.fspath(path)))

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes it in the format of the path's ending; only .h5 keeps everything."""
        _core.Specimen.write(self, os.fspath(path))

    def __repr__(self) -> str:
        return (f"<solidem.Specimen {self.shape}: {len(self)} elements, {len(self.bonds)} bonds, "
                f"mean radius {self.report['mean_radius']:.4g} m>")

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.report_text())}</pre>"
