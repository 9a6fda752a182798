# SPDX-License-Identifier: GPL-2.0-or-later
"""Central forces: the force between two elements along a path, and bars that rearrange and break."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.measures import measure
from compare.result import CodeFailure, Floats, Result
from compare.row import Measured, Plot, Series
from compare.runs import View
from compare.tension import LEFT_WHEN_TORN, history_column
from contrib.yade.central_law import interaction_of

#: Grips of the scenes; the right one is moved along x.
LEFT, RIGHT = "left", "right"


def _path(view: View, result: Result) -> tuple[Floats, Floats]:
    """Distance of the two elements over their rest length, and the force that pushes them apart."""
    specimen = view.job.specimen
    if len(specimen.radius) != 2 or len(specimen.pairs) != 1:
        raise CodeFailure(f"{len(specimen.radius)} elements and {len(specimen.pairs)} pairs; a path "
                          "needs two elements that are a pair")
    rest = float(specimen.rest_length[0])
    moved = (history_column(result, f"grip.{RIGHT}.displacement_x")
             - history_column(result, f"grip.{LEFT}.displacement_x"))
    # What a grip does balances what the other element does.
    return (rest + moved) / rest, -history_column(result, f"grip.{RIGHT}.force_x")


def _equations(view: View, compression_ratio: Floats) -> Floats:
    """The force of the law's equations, N."""
    forces, specimen = view.job.parameters.central_forces, view.job.specimen
    if forces is None:
        raise CodeFailure("the scene has no central forces")
    limit = forces.range * specimen.radius.sum()
    rest = np.full(len(compression_ratio), specimen.rest_length[0])
    return interaction_of(forces).force(compression_ratio * rest, rest,
                                        np.full(len(compression_ratio), limit))


@dataclass(frozen=True)
class PairForce:
    """The force between two elements in a code and in its reference."""

    distance: Floats  #: over that of equilibrium
    found: Floats  #: over the law's largest attraction
    expected: Floats  #: the same

    @property
    def error(self) -> Floats:
        """Difference over the force or the largest attraction, whichever is larger."""
        return np.asarray(np.abs(self.found - self.expected)
                          / np.maximum(np.abs(self.expected), 1))


def _pair_force(view: View) -> PairForce:
    distance, found = _path(view, view.tested)
    if view.check.reference == "equations":
        expected = _equations(view, distance)
    else:
        _, rows, others = np.intersect1d(view.tested.history["step"], view.other.history["step"],
                                         return_indices=True)
        other, expected = (column[others] for column in _path(view, view.other))
        if len(rows) < len(distance):
            raise CodeFailure(f"{view.check.reference} has no row for each of {view.check.code}'s")
        if np.abs(other - distance).max() > 1e-12:
            raise CodeFailure(f"{view.check.code} and {view.check.reference} went different ways")
    ends = sorted((1.0, float(view.option("to"))))
    if np.abs(np.array([distance.min(), distance.max()]) - ends).max() > 0.005:
        raise CodeFailure(f"the path went from {distance.min():.4g} to {distance.max():.4g} of the "
                          f"equilibrium; {ends[0]:g} to {ends[1]:g} is wanted")
    forces = view.job.parameters.central_forces
    even = np.linspace(1, forces.range if forces else 1, 2001)[:-1]
    attraction = -float(_equations(view, even).min())
    return PairForce(distance, found / attraction, expected / attraction)


@measure
def pair_force(view: View) -> Measured:
    """Largest difference of the force between two elements from that of another code, or of the
    law's "equations", over the force there or the law's largest attraction, whichever is larger;
    the worst of the group.

    Option: `to`, distance over that of equilibrium that the path must reach from 1.
    """
    paths = {str(m.variant.values.get("law", m.variant.name)): _pair_force(m) for m in view.members}
    series, below = [], []
    for law, path in paths.items():
        series += [Series(f"{law}: {view.check.reference}", path.distance, path.expected, wide=True),
                   Series(f"{law}: {view.check.code}", path.distance, path.found, "--",
                          colour_of_previous=True)]
        below.append(Series(law, path.distance, path.error + 1e-17))
    title = view.check.options.get("title", "two elements")
    plot = Plot(f"{title}: {view.check.code}", "distance / that of equilibrium",
                "force / largest attraction", series, below=below, below_label="difference, relative",
                below_log=True)
    errors = {law: float(path.error.max()) for law, path in paths.items()}
    return Measured(max(errors.values()),
                    ", ".join(f"{law}: {error:.2g} (force up to "
                              f"{np.abs(paths[law].expected).max():.3g} of the attraction)"
                              for law, error in errors.items()), plot)


@measure
def neighbours_changed(view: View) -> Measured:
    """How far a run falls short of rearranging: 1 less the largest change of the number of pairs
    within the range, over `fraction` (option) of those at the start; or 0."""
    pairs = history_column(view.tested, "interactions")
    change, wanted = float(np.ptp(pairs)), float(view.option("fraction")) * float(pairs[0])
    if not wanted > 0:
        raise CodeFailure("no pair is within the range at the start")
    return Measured(max(0.0, 1 - change / wanted),
                    f"pairs from {pairs[0]:.0f} to {pairs[-1]:.0f}, {change:.0f} between the most and "
                    "the least")


@dataclass(frozen=True)
class Rupture:
    """What a bar bore."""

    elongation: Floats  #: of the distance of the grips, over `length`
    force: Floats  #: of the right grip, N

    @property
    def peak(self) -> float:
        """Largest force, N."""
        return float(self.force.max())

    @property
    def rupture(self) -> float:
        """Elongation at which half of the largest force is left."""
        top = int(np.argmax(self.force))
        torn = self.force[top:] < LEFT_WHEN_TORN * self.force[top]
        if not torn.any():
            raise CodeFailure(f"not torn at an elongation of {self.elongation[-1]:.3g}")
        return float(self.elongation[top + int(np.argmax(torn))])


def rupture_of(view: View, result: Result) -> Rupture:
    """The tension test in a history; option of the case: `length`, m."""
    moved = (history_column(result, f"grip.{RIGHT}.displacement_x")
             - history_column(result, f"grip.{LEFT}.displacement_x"))
    return Rupture(moved / float(view.case.options["length"]),
                   history_column(result, f"grip.{RIGHT}.force_x"))


@measure
def rupture_over_scatter(view: View) -> Measured:
    """Largest difference of a figure of the same specimen in two codes, over the scatter (largest
    less least) of the group's specimens. Option `of`: peak or rupture."""
    name = view.option("of")
    if name not in ("peak", "rupture"):
        raise CodeFailure(f"no figure {name!r}; known: peak, rupture")
    if len(view.members) < 2:
        raise CodeFailure("a scatter needs two specimens at least")
    curves = [(rupture_of(m, m.tested), rupture_of(m, m.other)) for m in view.members]
    tested, other = (np.array([getattr(pair[k], name) for pair in curves]) for k in (0, 1))
    scatter = float(np.ptp(other))
    if not scatter > 0:
        raise CodeFailure("the specimens do not differ")
    series = []
    for member, pair in zip(view.members, curves):
        for code, curve, wide in zip((view.check.reference, view.check.code), pair[::-1],
                                     (True, False)):
            series.append(Series(f"{code}, {member.variant.name}", 100 * curve.elongation,
                                 curve.force, "-" if wide else "--", wide=wide,
                                 colour_of_previous=not wide))
    plot = Plot("tension with rearrangement, to rupture", "elongation, %", "force of the grip, N",
                series)
    return Measured(float(np.abs(tested - other).max()) / scatter,
                    f"{name} {tested.min():.5g} to {tested.max():.5g}; {view.check.reference} "
                    f"{other.min():.5g} to {other.max():.5g}; largest difference "
                    f"{np.abs(tested - other).max():.2g}", plot)
