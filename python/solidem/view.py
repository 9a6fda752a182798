# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures and films of what a run has written, without a display; needs h5py and matplotlib.

    solidem view results/bar --field temperature
    solidem view results/bar --field bonds/intact --film
"""

from __future__ import annotations

import argparse
import dataclasses
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

import h5py  # type: ignore[import]
import matplotlib  # type: ignore[import]
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg  # type: ignore[import]
from matplotlib.cm import ScalarMappable  # type: ignore[import]
from matplotlib.colors import Normalize  # type: ignore[import]
from matplotlib.figure import Figure  # type: ignore[import]
from numpy.typing import NDArray
from PIL import Image  # type: ignore[import]  # matplotlib writes its own pictures with it

from ._core import InputError
from .fields import COMPONENTS, field_of, place_of
from .picture import Array, Facets, Picture

TOOL_COLOUR = np.array([0.66, 0.70, 0.78])
FOOT = 0.75  #: inches below the bodies, for the bar of colours
DOTS = 100  #: in an inch
SHOWN_FOR = 80  #: ms, of a frame of a film; the last one longer
LAST_SHOWN_FOR = 1500

#: How fields are told unless one says otherwise: label with its unit, and what SI units are multiplied by.
LABELS = {
    "temperature": ("temperature, K", 1.0),
    "speed": ("speed, m/s", 1.0),
    "displacement": ("displacement, mm", 1e3),
    "displacement_x": ("displacement along x, mm", 1e3),
    "displacement_y": ("displacement along y, mm", 1e3),
    "displacement_z": ("displacement along z, mm", 1e3),
    "broken_bonds": ("share of an element's bonds that broke", 1.0),
    "plastic_work": ("plastic work of an element, mJ", 1e3),
    "bonds/intact": ("share of an element's bonds that hold", 1.0),
    "bonds/stress": ("stress of an element's bonds, MPa", 1e-6),
    "bonds/plastic_strain": ("plastic strain of an element's bonds", 1.0),
    "von_mises_stress": ("von Mises stress, MPa", 1e-6),
    "mean_stress": ("mean stress, MPa", 1e-6),
    "plastic_strain": ("plastic strain", 1.0),
    "temperature_gradient": ("temperature gradient, K/mm", 1e-3),
    **{f"stress_{of}": (f"stress {of}, MPa", 1e-6) for of in COMPONENTS[6]},
    **{f"strain_{of}": (f"strain {of}", 1.0) for of in COMPONENTS[6]},
}


@dataclass(frozen=True, kw_only=True)
class View:
    """What a picture shows, and from where."""

    field: str  #: of the elements of a frame; "speed", "displacement_x"…; "bonds/stress": of its bonds
    label: str = ""  #: of the bar of colours, with the unit; empty: as LABELS has it
    scale: float = 0  #: by which the field is multiplied for that unit; 0: as LABELS has it
    shift: float = 0  #: what is added then
    range: Sequence[float] = ()  #: of the colours; else the field's
    colours: str = "viridis"
    azimuth: float = -60
    elevation: float = 25
    magnified: float = 1  #: displacements in the picture over those of the body
    cut: Sequence[Sequence[float | str]] = ()
    #: two corners in mm, "any" where open: what stood in there at rest is left out
    loose: bool = False  #: elements that never had a bond are shown, too
    view: Sequence[Sequence[float]] = ()  #: corners of what is seen, mm; else all bodies

    @property
    def title(self) -> str:
        """What stands below the bar of colours."""
        return self.label or LABELS.get(self.field, (self.field, 1.0))[0]

    @property
    def factor(self) -> float:
        """From SI units to those of the title."""
        return self.scale or LABELS.get(self.field, ("", 1.0))[1]


@dataclass(frozen=True)
class Shot:
    """What a moment of a run shows. SI units, but the values in those of the view's title."""

    position: Array
    radius: Array
    values: Array
    tools: dict[str, tuple[Array, Facets]]


def in_the_picture(view: View, rest: Array, pairs: Facets) -> NDArray[np.bool_]:
    """Which elements are shown: those outside of the cut that had a bond, where any had one."""
    shown = np.ones(len(rest), bool)
    if len(pairs) and not view.loose:
        shown = np.isin(np.arange(len(rest)), pairs)
    if view.cut:
        low, high = ([end if bound == "any" else 1e-3 * float(bound) for bound in corner]
                     for corner, end in zip(view.cut, (-np.inf, np.inf)))
        shown &= ~((rest > low) & (rest < high)).all(axis=1)
    return shown


def trajectory_of(results: str | os.PathLike[str]) -> Path:
    """The file that frames are found by; InputError where there is none."""
    path = Path(results) / "trajectory.h5"
    if not path.exists():
        raise InputError(f"{path}: no such file; expected the folder of a run whose scene asks for "
                         "frames ([output] frames)")
    return path


def shots_of(results: str | os.PathLike[str], view: View,
             numbers: Sequence[int] | None = None) -> list[Shot]:
    """The frames of these numbers, from the end where negative, or all."""
    with h5py.File(trajectory_of(results)) as file:
        rest, radius = file["elements/position"][:], file["elements/radius"][:]
        names = sorted(file["frames"])
        pairs = file["bonds/pairs"][:] if "bonds/pairs" in file else np.empty((0, 2), int)
        shown = in_the_picture(view, rest, pairs)
        shots = []
        for number in range(len(names)) if numbers is None else numbers:
            if not -len(names) <= number < len(names):
                raise InputError(f"frame {number}: none of this run; there are {len(names)}, "
                                 f"0 to {len(names) - 1}")
            frame = file["frames"][names[number]]
            tools = {name: (tool["vertices"][:], tool["facets"][:])
                     for name, tool in frame.get("tools", {}).items()}
            place = rest + view.magnified * (place_of(frame, rest) - rest)
            values = field_of(frame, view.field, rest, pairs) * view.factor + view.shift
            shots.append(Shot(place[shown], radius[shown], values[shown], tools))
    return shots


def bounds(view: View, shots: Sequence[Shot]) -> tuple[Array, Array]:
    """Corners of what must be seen of these, m."""
    if view.view:
        return 1e-3 * np.array(view.view[0]), 1e-3 * np.array(view.view[1])
    return (np.min([(s.position - s.radius[:, None]).min(axis=0) for s in shots], axis=0),
            np.max([(s.position + s.radius[:, None]).max(axis=0) for s in shots], axis=0))


def colour_range(view: View, shots: Sequence[Shot]) -> Normalize:
    """What the two ends of the bar of colours mean."""
    if view.range:
        return Normalize(*view.range)
    low = min(float(shot.values.min()) for shot in shots)
    high = max(float(shot.values.max()) for shot in shots)
    return Normalize(low, high if high > low else low + 1)


def painted(view: View, shot: Shot, norm: Normalize, corners: tuple[Array, Array],
            width: int) -> Picture:
    """The bodies and tools of one moment."""
    picture = Picture(*corners, view.azimuth, view.elevation, width)
    colours = matplotlib.colormaps[view.colours](norm(shot.values))
    picture.spheres(shot.position, shot.radius, np.asarray(colours)[:, :3])
    for vertices, facets in shot.tools.values():
        picture.triangles(vertices, facets, TOOL_COLOUR)
    return picture


def length_of_ruler(width: float) -> float:
    """A round length near a sixth of the width, m."""
    power = 10 ** np.floor(np.log10(width / 6))
    return float(max(step for step in (1, 2, 5) if step * power <= width / 6) * power)


def with_foot(view: View, image: Array, norm: Normalize, scale: float) -> Image.Image:
    """The image with a bar of colours and a ruler below; `scale`: pixels in a metre."""
    height, width, _ = image.shape
    size = (width / DOTS, height / DOTS + FOOT)
    figure = Figure(figsize=size, dpi=DOTS)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0, FOOT / size[1], 1, 1 - FOOT / size[1]))
    axes.imshow(image, interpolation="none")
    axes.axis("off")
    bar = figure.add_axes((0.32, 0.47 / size[1], 0.4, 0.13 / size[1]))
    figure.colorbar(ScalarMappable(norm, view.colours), cax=bar, orientation="horizontal",
                    label=view.title)
    length = length_of_ruler(width / scale)
    ruler = figure.add_axes((0.03, 0.4 / size[1], length * scale / width, 0.2 / size[1]))
    ruler.plot([0, 1], [1, 1], color="black", lw=3, clip_on=False, solid_capstyle="butt")
    ruler.set(xlim=(0, 1), ylim=(0, 1))
    ruler.axis("off")
    ruler.text(0.5, -0.1, f"{length * 1e3:g} mm", ha="center", va="top", fontsize=9)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy())


def of_few_colours(image: Image.Image, colours: int) -> Image.Image:
    """The same in a palette, which is several times smaller in a file."""
    return image.quantize(colours, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)


def paint(results: str | os.PathLike[str], view: View, *, frame: int = -1,
          width: int = 900) -> Image.Image:
    """One frame of a run, with a bar of colours and a ruler."""
    shots = shots_of(results, view, [frame])
    norm = colour_range(view, shots)
    picture = painted(view, shots[0], norm, bounds(view, shots), width)
    return with_foot(view, picture.image(), norm, picture.pixels_per_metre)


def write_film(results: str | os.PathLike[str], view: View, path: str | os.PathLike[str], *,
               width: int = 500, norm: Normalize | None = None, foot: bool = True) -> None:
    """All frames of a run as a GIF, in one range of colours and seen from one place."""
    shots = shots_of(results, view)
    norm, corners = norm or colour_range(view, shots), bounds(view, shots)
    images = []
    for shot in shots:
        picture = painted(view, shot, norm, corners, width)
        image = picture.image()
        images.append(with_foot(view, image, norm, picture.pixels_per_metre) if foot
                      else Image.fromarray((255 * image).astype(np.uint8)))
    palette = of_few_colours(images[-1], 64)
    small = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    small[0].save(path, save_all=True, append_images=small[1:], loop=0, optimize=True,
                  duration=[SHOWN_FOR] * (len(small) - 1) + [LAST_SHOWN_FOR])


def usual_field(results: str | os.PathLike[str]) -> str:
    """Temperatures where there are any, else how far elements have moved."""
    with h5py.File(trajectory_of(results)) as file:
        frame = file["frames"][sorted(file["frames"])[-1]]
        return "temperature" if "temperature" in frame else "displacement"


def arguments() -> argparse.ArgumentParser:
    """Of the command."""
    parser = argparse.ArgumentParser(prog="solidem view",
                                     description="A picture or a film of a run, without a display.")
    add = parser.add_argument
    add("results", type=Path, help="folder of the run")
    add("--field", help="what colours the elements; an unknown one tells all there are (default: "
        "temperature, else displacement)")
    add("--frame", type=int, default=-1, metavar="N", help="from 0; negative from the end "
        "(default: the last)")
    add("--film", action="store_true", help="all frames, as a GIF")
    add("-o", "--output", type=Path, metavar="FILE", help="default: RESULTS/FIELD.png or .gif")
    add("--range", type=float, nargs=2, metavar=("LOW", "HIGH"), default=(),
        help="of the colours, in the unit of the label")
    add("--colours", default="viridis", metavar="NAME", help="a map of colours of matplotlib")
    add("--azimuth", type=float, default=-60, metavar="DEGREES", help="where the viewer stands")
    add("--elevation", type=float, default=25, metavar="DEGREES")
    add("--magnified", type=float, default=1, metavar="TIMES", help="displacements in the picture")
    add("--loose", action="store_true", help="elements that never had a bond, too")
    add("--width", type=int, metavar="PIXELS", help="default: 900, of a film 500")
    return parser


def main(words: Sequence[str] | None = None) -> int:
    """The command; 2 where something given cannot be used."""
    given = arguments().parse_args(words)
    try:
        field = given.field or usual_field(given.results)
        names = {each.name for each in dataclasses.fields(View)}
        seen: dict[str, Any] = {key: value for key, value in vars(given).items() if key in names}
        seen["field"] = field
        view = View(**seen)
        if given.colours not in matplotlib.colormaps:
            raise InputError(f"colours {given.colours}: no map of matplotlib; for example viridis, "
                             "inferno, coolwarm")
        ending = "gif" if given.film else "png"
        path = given.output or given.results / f"{field.replace('/', '_')}.{ending}"
        if given.film:
            write_film(given.results, view, path, width=given.width or 500)
        else:
            paint(given.results, view, frame=given.frame, width=given.width or 900).save(path)
    except (InputError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
