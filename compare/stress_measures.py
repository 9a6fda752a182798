# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of stress: means over patches of a body at rest against finite elements."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.codes.calculix_hot_plate import hot_plate
from compare.measures import measure
from compare.result import CodeFailure, Floats
from compare.row import Measured, Plot, Series
from compare.runs import View

IN_PLANE = {0: "xx", 1: "yy", 3: "xy"}  #: places of the plane's stresses among the six


@dataclass(frozen=True)
class Patches:
    """Squares of the plate, through its thickness, and the mean stresses in them."""

    centre: list[Floats]  #: of the patches along x and along y, m
    found: Floats  #: (X, Y, 6) by elements, in the unit of `right`
    right: Floats  #: (X, Y, 6) by finite elements at the centres of the same elements, Pa
    fewest: int  #: elements in a patch

    @property
    def difference(self) -> Floats:
        """(X, Y, 3) of the stresses in the plane, over the largest of these."""
        plane = list(IN_PLANE)
        over: Floats = (self.found - self.right)[..., plane] / np.abs(self.right[..., plane]).max()
        return over


def _modulus(view: View) -> float:
    """Young's modulus of the body, Pa: the mean of those that its tension along x and y shows."""
    found = []
    for name in view.option("pulled"):
        history = view.runs.result(name, view.check.code).history
        if "gauge.stress" not in history:
            raise CodeFailure(f"the body that is pulled, {name!r}, has no gauge")
        found.append(float(history["gauge.stress"][-1] / history["gauge.strain"][-1]))
    return float(np.mean(found))


def mean_over_patches(place: Floats, weight: Floats, values: Floats, size: Floats,
                      count: tuple[int, int]) -> tuple[Floats, int]:
    """(X, Y, K) weighted means of values (N, K) over squares of a size (2,), and the fewest in one.

    Places (N, 2) are m from the corner of the first square. CodeFailure when a square is empty.
    """
    index = np.clip((place / size).astype(int), 0, np.array(count) - 1)
    patch = index[:, 0] * count[1] + index[:, 1]
    fewest = int(np.bincount(patch, minlength=count[0] * count[1]).min())
    if fewest == 0:
        raise CodeFailure("a patch has no element")
    total = np.bincount(patch, weight)
    means = np.stack([np.bincount(patch, weight * column) / total for column in values.T], axis=1)
    return means.reshape(*count, -1), fewest


def _patches(view: View) -> Patches:
    """Of the view's body, and of finite elements."""
    plate, mesh = hot_plate(view.case.options)
    reference = view.runs.result(view.option("reference_variant"), view.check.reference)
    bricks = reference.frames[-1].columns["stress"].reshape(*mesh.cells[::-1], 6)
    columns = bricks.mean(axis=0).transpose(1, 0, 2)
    body = view.job.specimen
    place, weight = body.position[:, :2], body.radius**3
    count = tuple(round(s / float(view.option("patch"))) for s in plate.size[:2])
    size = np.array(plate.size[:2]) / count
    frame = view.tested.frames[-1].columns
    if "stress" not in frame:
        raise CodeFailure(f"{view.tested.code} wrote no stress")
    stress = frame["stress"] * plate.young_modulus / _modulus(view)
    x, y = np.clip((place / mesh.size[:2]).astype(int), 0, np.array(mesh.cells[:2]) - 1).T
    found, fewest = mean_over_patches(place, weight, stress, size, count)
    right, _ = mean_over_patches(place, weight, columns[x, y], size, count)
    return Patches([(np.arange(n) + 0.5) * s for n, s in zip(count, size)], found, right, fewest)


@measure
def patch_stress(view: View) -> Measured:
    """Difference of a plate's stress from finite elements', over the largest of all patches.

    Of xx, xy and yy, means over squares of the side `patch` (m) through the thickness, by the volume
    of the elements in them; finite elements are read at the centres of the same elements. Options: `of`:
    "largest" (of all patches and stresses), "root mean square" or "hottest" (where the stress is
    largest); `pulled`: variants that tell the body's Young's modulus along x and y;
    `reference_variant`; for the plot `label`, `style`, `title`, and `over_elements` (true: error
    against the number of elements, else the stresses along x through the hottest patch, of which
    the reference's are named where `first` is true).
    """
    patches = _patches(view)
    error, kind = np.abs(patches.difference), view.option("of")
    plane = np.abs(patches.right[..., list(IN_PLANE)])
    hottest = np.unravel_index(plane.argmax(), plane.shape)
    ways = {"largest": error.max(), "root mean square": np.sqrt(np.mean(error**2)),
            "hottest": error[hottest]}
    if kind not in ways:
        raise CodeFailure(f"of = {kind!r}; known: {', '.join(ways)}")
    note = (f"largest stress {1e-6 * plane.max():.4g} MPa; at least {patches.fewest} elements a "
            "patch; " + ", ".join(f"{name} {100 * value:.2f} %" for name, value in ways.items()))
    return Measured(float(ways[kind]), note, _plot(view, patches, float(ways[kind]), hottest[1]))


def _plot(view: View, patches: Patches, error: float, row: int) -> Plot:
    options = view.check.options
    label = options.get("label", view.variant.name)
    title = options.get("title", view.check.quantity)
    if options.get("over_elements"):
        return Plot(title, "elements", "error, % of the largest stress",
                    [Series(label, np.array([float(view.tested.elements)]),
                            np.array([100 * error]), options.get("style", "o-"), joined=True)],
                    log_x=True, log_y=True)
    x = 1e3 * patches.centre[0]
    series = []
    # A label that begins with _ stays out of the legend.
    hidden = "" if options.get("first", True) else "_"
    for k, (place, name) in enumerate((p, n) for p, n in IN_PLANE.items() if n != "xy"):
        series += [Series(f"{hidden}σ_{name}, {view.check.reference}", x,
                          1e-6 * patches.right[:, row, place], f"C{k}-"),
                   Series(f"σ_{name}, {label}", x, 1e-6 * patches.found[:, row, place],
                          f"C{k}{options.get('style', 'o')}")]
    return Plot(title, "x, mm", "mean stress of a patch, MPa", series)
