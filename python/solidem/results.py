# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run has written, in numpy and, where it is there, in pandas."""

from __future__ import annotations

import html
import json
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping

import numpy as np
import numpy.typing as npt

from ._core import InputError

if TYPE_CHECKING:
    import pandas  # type: ignore[import]
    from PIL import Image  # type: ignore[import]

Floats = npt.NDArray[np.float64]


class History(Mapping[str, Floats]):
    """The columns of a history.csv, by name. Numbers are the very doubles of the run."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        """Reads a history. InputError where it is not there or is none."""
        try:
            with open(path, encoding="utf-8") as file:
                names = file.readline().strip().split(",")
                rows = np.loadtxt(file, delimiter=",", ndmin=2)
        except OSError as error:
            raise InputError(f"{os.fspath(path)}: {error.strerror}; expected a history.csv") from error
        except ValueError as error:
            raise InputError(f"{os.fspath(path)}: no history: {error}") from error
        if rows.size == 0:
            rows = np.empty((0, len(names)))
        if rows.shape[1] != len(names) or names[0] != "step":
            raise InputError(f"{os.fspath(path)}: no history; expected a row of names, \"step\" "
                             "first, and as many numbers in each row")
        self._columns: dict[str, Floats] = dict(zip(names, rows.T))

    def __getitem__(self, name: str) -> Floats:
        if name not in self._columns:
            raise KeyError(f"{name}; there are {', '.join(self._columns)}")
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def frame(self) -> pandas.DataFrame:
        """The same in pandas, with the step as index."""
        import pandas

        return pandas.DataFrame(self._columns).astype({"step": int}).set_index("step")

    def __repr__(self) -> str:
        return f"<solidem.History: {len(self['step'])} rows of {', '.join(self)}>"


class Frame(Mapping[str, Floats]):
    """The fields of one moment of a trajectory, by name ("position", "bonds/stress")."""

    def __init__(self, step: int, time: float, fields: dict[str, Floats]) -> None:
        self.step = step
        self.time = time  #: s
        self._fields = fields

    def __getitem__(self, name: str) -> Floats:
        if name not in self._fields:
            raise KeyError(f"{name}; there are {', '.join(self._fields)}")
        return self._fields[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)

    def __repr__(self) -> str:
        return f"<solidem.Frame: step {self.step}, {self.time:.4g} s, {', '.join(self)}>"


class Results:
    """The folder of a run, or of a solution."""

    def __init__(self, folder: str | os.PathLike[str], *,
                 _kept: tempfile.TemporaryDirectory[str] | None = None) -> None:
        self.folder = Path(folder)
        self._kept = _kept  # lives as long as this
        if not (self.folder / "summary.json").exists():
            raise InputError(f"{self.folder}: no results; expected a folder with summary.json, which "
                             "`solidem run` and `solidem solve` write")

    @property
    def summary(self) -> dict[str, Any]:
        """What the run was and cost, and what came out last."""
        read: dict[str, Any] = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        return read

    @property
    def history(self) -> History:
        """Its history."""
        return History(self.folder / "history.csv")

    @property
    def frames(self) -> list[Frame]:
        """All frames of the trajectory; needs h5py."""
        import h5py  # type: ignore[import]

        frames = []
        with h5py.File(self._trajectory()) as file:
            for group in file["frames"].values():
                fields: dict[str, Floats] = {}

                def note(name: str, item: object, fields: dict[str, Floats] = fields) -> None:
                    if isinstance(item, h5py.Dataset):
                        fields[name] = item[...]

                group.visititems(note)
                frames.append(Frame(int(group.attrs["step"]), float(group.attrs["time"]), fields))
        return frames

    @property
    def rest(self) -> dict[str, npt.NDArray[Any]]:
        """The body at rest: "position", "radius" and, where they are drawn, "bonds"; needs h5py."""
        import h5py

        with h5py.File(self._trajectory()) as file:
            body = {"position": file["elements/position"][...], "radius": file["elements/radius"][...]}
            if "bonds/pairs" in file:
                body["bonds"] = file["bonds/pairs"][...]
        return body

    def profile(self, field: str, axis: str, *, bins: int = 20,
                frame: int = -1) -> tuple[Floats, Floats]:
        """A field along an axis of the body at rest: the middle of each of so many slices, m, and the
        mean of the elements whose centres lie in it, by their volumes; NaN where there are none.
        `field`: a name that `view` knows, such as "temperature" or "stress_xx". Needs h5py."""
        import h5py

        from .fields import field_of

        if axis not in ("x", "y", "z"):
            raise InputError(f"axis {axis!r}: expected x, y or z")
        if bins < 1:
            raise InputError(f"bins {bins}: expected 1 or more")
        with h5py.File(self._trajectory()) as file:
            names = sorted(file["frames"])
            if not -len(names) <= frame < len(names):
                raise InputError(f"frame {frame}: none of this run; there are {len(names)}")
            rest = file["elements/position"][:]
            volume = file["elements/radius"][:] ** 3
            pairs = file["bonds/pairs"][:] if "bonds/pairs" in file else np.empty((0, 2), int)
            values = field_of(file["frames"][names[frame]], field, rest, pairs)
        along = rest[:, "xyz".index(axis)]
        edges = np.linspace(along.min(), along.max(), bins + 1)
        slices = np.clip(np.searchsorted(edges, along, side="right") - 1, 0, bins - 1)
        weight = np.bincount(slices, volume, bins)
        with np.errstate(invalid="ignore"):
            mean = np.bincount(slices, volume * values, bins) / weight
        return 0.5 * (edges[1:] + edges[:-1]), mean

    def view(self, field: str | None = None, *, frame: int = -1, width: int = 900,
             **how: Any) -> Image.Image:
        """A picture of a frame (PIL, which notebooks show); needs h5py and matplotlib. `field`: what
        colours the elements, else their temperature or how far they have moved; `how`: other fields
        of solidem.view.View, such as azimuth or magnified."""
        from .view import View, paint, usual_field

        seen = View(field=field or usual_field(self.folder), **how)
        return paint(self.folder, seen, frame=frame, width=width)

    def _trajectory(self) -> Path:
        path = self.folder / "trajectory.h5"
        if not path.exists():
            raise InputError(f"{path}: no such file; the scene asked for no frames ([output] frames)")
        return path

    def __repr__(self) -> str:
        return f"<solidem.Results {str(self.folder)!r}: {self.summary.get('scene')}>"

    def _repr_html_(self) -> str:
        final = self.summary.get("final", {})
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{value}</td></tr>"
                       for name, value in final.items())
        return f"{html.escape(repr(self))}<table>{rows}</table>"
