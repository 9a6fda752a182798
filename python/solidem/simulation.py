# SPDX-License-Identifier: GPL-2.0-or-later
"""Simulations, step by step, with views of what is in memory."""

from __future__ import annotations

import html
import os
from typing import Any, Callable, Iterator, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core

Floats = npt.NDArray[np.float64]


class Motion(NamedTuple):
    """What elements do at one instant, (N, 3) each, in the order of the specimen."""

    forces: Floats  #: of its neighbours on each element, N
    velocities: Floats  #: m/s
    moments: Floats  #: N m
    angular_velocities: Floats  #: rad/s


def by_element(lanes: Floats, elements: int) -> Floats:
    """A view of lanes, (blocks, 8, components), as a copy of (elements, components)."""
    return lanes.reshape(-1, lanes.shape[-1])[:elements]


class Simulation(_core.Simulation):
    """A body under the effects of a scene; made by `Scene.simulation`.

    Arrays are views of solidem's own memory, not copies, and cannot be written. A view keeps the
    simulation alive. Places and temperatures have two buffers in turn, so take the property anew
    after each `step`; that costs next to nothing.
    """

    @property
    def positions(self) -> Floats:
        """Centres of the elements, m: a view (N, 3) with strides."""
        name = "position" if "position" in self.columns else "pose"
        return self.column(name)[:, :3]

    @property
    def orientations(self) -> Floats:
        """Quaternions w x y z of the elements: a view (N, 4)."""
        return self.column("pose")[:, 4:]

    @property
    def velocities(self) -> Floats:
        """m/s, half a step behind the positions: a view (blocks, 8, 3); element e is
        [e // 8, e % 8]. `by_element` makes a copy (N, 3) of it, `motion` tells velocities at the
        very time."""
        return self.column("velocity")

    @property
    def angular_velocities(self) -> Floats:
        """rad/s, in world axes, like `velocities`."""
        return self.column("angular_velocity")

    @property
    def temperatures(self) -> Floats:
        """K: a view (N,)."""
        return self.column("temperature")

    @property
    def forces(self) -> Floats:
        """Of its neighbours on each element, N, (N, 3). No column holds them: they are computed
        when asked for, at the cost of about a step."""
        return self.motion().forces

    def motion(self) -> Motion:
        """Forces, moments and velocities at this instant; computed, so keep what you get."""
        return Motion(**self._motion())

    def run(self, steps: int | None = None, *, every: int | None = None,
            callback: Callable[[Simulation], object] | None = None) -> None:
        """Steps to the end of the scene's run, or so many `steps`; calls `callback` after each
        `every` steps and at the end. It ends early where the callback returns False."""
        for _ in self.advance(steps, every=every):
            if callback is not None and callback(self) is False:
                return

    def advance(self, steps: int | None = None, *, every: int | None = None) -> Iterator[int]:
        """The same as a loop: steps, and yields the number of steps done after each `every`."""
        left = max(0, self.steps_to_run - self.steps_done) if steps is None else steps
        stride = max(1, left if every is None else every)
        while left > 0:
            now = min(left, stride)
            self.step(now)
            left -= now
            yield self.steps_done

    def write_checkpoint(self, path: str | os.PathLike[str]) -> None:
        """Writes all that is needed to go on exactly. RunError where the run has diverged."""
        _core.Simulation.write_checkpoint(self, os.fspath(path))

    def read_checkpoint(self, path: str | os.PathLike[str]) -> None:
        """Goes on from a checkpoint of the same scene and specimen, also one that `solidem run`
        wrote. InputError where it does not fit, is damaged or is not there."""
        _core.Simulation.read_checkpoint(self, os.fspath(path))

    def __repr__(self) -> str:
        return (f"<solidem.Simulation: {len(self)} elements, {self.bonds} bonds, step "
                f"{self.steps_done} of {self.steps_to_run}, {self.time:.4g} s>")

    def _repr_html_(self) -> str:
        values: dict[str, Any] = self.observe()
        rows = "".join(f"<tr><td>{html.escape(name)}</td><td>{value:.6g}</td></tr>"
                       for name, value in values.items())
        return f"{html.escape(repr(self))}<table>{rows}</table>"
