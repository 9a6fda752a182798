# SPDX-License-Identifier: GPL-2.0-or-later
"""One beam between two spheres under prescribed motions, against its stiffness matrix.

A case without a scene: its [options] give the beam, its checks name a `mode` and an `amplitude`,
and, where it is not Euler and Bernoulli's, the `law`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from compare.codes.base import TwoSpheres
from compare.measures import measure
from compare.references import beam_stiffness, spring_stiffness
from compare.result import CodeFailure, Floats
from compare.row import Measured, Plot, Series
from compare.runs import View


def modes(axes: Floats, length: float) -> dict[str, Floats]:
    """Motions (4, 3) of amplitude 1: displacement over length of i, j; rotation of i, j.

    `axes`: rows x (along the beam), y, z.
    """
    x, y, z = axes
    none = np.zeros(3)
    table = {
        "tension": [none, x, none, none],
        "shear": [none, y, none, none],
        "bending": [none, none, -z, z],
        "bending at one end": [none, none, none, z],
        "torsion": [none, none, none, x],
        "combined": [-0.2 * x + 0.3 * z, 0.5 * x + 0.7 * y - 0.4 * z,
                     0.3 * x - 0.5 * y + 0.2 * z, -0.6 * x + 0.4 * y + 0.3 * z],
    }
    scale = np.array([length, length, 1.0, 1.0])[:, None]
    return {name: scale * np.array(motion) for name, motion in table.items()}


def beam_of(view: View) -> TwoSpheres:
    """The beam of the case's [options] and the check's own."""
    given = {**view.case.options, **view.check.options}
    try:
        return TwoSpheres(
            np.array([given["first"], given["second"]], dtype=float), given["sphere_radius"],
            given["beam_radius"], given["young_modulus"], given["shear_modulus"],
            np.zeros((0, 4, 3)), given.get("law", "euler-bernoulli"),
            given.get("shear_coefficient", 0.9))
    except KeyError as error:
        raise CodeFailure(f"case {view.case.name}: [options] lacks {error}") from error


def axes_of(beam: TwoSpheres) -> tuple[Floats, float]:
    """Rows x (along the beam), y, z; and its length."""
    chord = beam.position[1] - beam.position[0]
    length = float(np.linalg.norm(chord))
    x = chord / length
    y = np.cross(np.eye(3)[int(np.argmin(np.abs(x)))], x)
    y /= np.linalg.norm(y)
    return np.stack([x, y, np.cross(x, y)]), length


def _scale(beam: TwoSpheres) -> Floats:
    """Divides forces by E S and moments by E S l: one measure of error for both, shape (4, 1)."""
    _, length = axes_of(beam)
    axial = beam.young_modulus * np.pi * beam.beam_radius**2
    return np.array([1, 1, 1 / length, 1 / length])[:, None] / axial


def loads_of(view: View, beam: TwoSpheres, motions: Floats, name: str) -> Floats:
    """(M, 4, 3) loads of the tested code."""
    folder = view.runs.directory / f"{view.check.code}_{name}".replace(" ", "_")
    code = view.runs.code(view.check.code)
    return code.beam_loads(replace(beam, motions=motions), folder, view.case.timeout)


def _mode_loads(view: View, beam: TwoSpheres, sizes: Floats) -> Floats:
    """(sizes, 4, 3) loads of the check's mode; a code computes all modes at once, starting once."""
    key = (view.check.code, beam.law, beam.shear_coefficient, *sizes)
    table = modes(*axes_of(beam))
    mode = view.option("mode")
    if mode not in table:
        raise CodeFailure(f"no mode is called {mode!r}; known: {', '.join(table)}")
    if key not in view.runs.kept:
        motions = np.array([a * motion for motion in table.values() for a in sizes])
        view.runs.kept[key] = loads_of(view, beam, motions, f"modes {len(view.runs.kept)}")
    loads: Floats = view.runs.kept[key]
    return loads.reshape(len(table), len(sizes), 4, 3)[list(table).index(mode)]


def _expected(beam: TwoSpheres, motion: Floats) -> Floats:
    chord = beam.position[1] - beam.position[0]
    if beam.law == "spring":
        matrix = spring_stiffness(chord, beam.beam_radius, beam.young_modulus)
    else:
        shear = beam.shear_coefficient if beam.law == "timoshenko" else np.inf
        matrix = beam_stiffness(chord, beam.beam_radius, beam.young_modulus, beam.shear_modulus,
                                shear)
    # What the beam does to its ends is the reverse of what holds them there.
    return -(matrix @ motion.ravel()).reshape(4, 3)


def _error(found: Floats, expected: Floats, scale: Floats) -> float:
    return float(np.abs((found - expected) * scale).max() / np.abs(expected * scale).max())


@measure
def small_motion_limit(view: View) -> Measured:
    """Error of the loads per amplitude as the amplitude tends to zero, against the matrix.

    Central differences at a, a/2, a/4 and a/8 (option `amplitude` = a), extrapolated three times:
    what is left is of order a⁸. Option `mode` names the motion.
    """
    beam = beam_of(view)
    sizes = float(view.option("amplitude")) / np.array([1.0, 2.0, 4.0, 8.0])
    loads = _mode_loads(view, beam, np.concatenate([sizes, -sizes]))
    limit = (loads[:4] - loads[4:]) / (2 * sizes[:, None, None])
    for order in (2, 4, 6):
        limit = (2**order * limit[1:] - limit[:-1]) / (2**order - 1)
    mode = modes(*axes_of(beam))[view.option("mode")]
    return Measured(_error(limit[0], _expected(beam, mode), _scale(beam)))


@measure
def at_amplitude(view: View) -> Measured:
    """Error of the loads at one amplitude (option `amplitude`) against the matrix."""
    beam = beam_of(view)
    size = float(view.option("amplitude"))
    loads = _mode_loads(view, beam, np.array([size]))
    motion = size * modes(*axes_of(beam))[view.option("mode")]
    return Measured(_error(loads[0], _expected(beam, motion), _scale(beam)))


@measure
def order_in_amplitude(view: View) -> Measured:
    """How far the error's decay with the amplitude falls short of first order (0: it does not).

    Options: `mode`, `amplitudes` (three or more).
    """
    beam = beam_of(view)
    sizes = np.array(view.option("amplitudes"), dtype=float)
    loads = _mode_loads(view, beam, sizes)
    mode = modes(*axes_of(beam))[view.option("mode")]
    errors = np.array([_error(found, _expected(beam, a * mode), _scale(beam))
                       for found, a in zip(loads, sizes)])
    if len(sizes) < 3 or not (errors > 0).all():
        raise CodeFailure(f"an order needs three amplitudes with an error above 0: {errors}")
    order = float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])
    plot = Plot(f"{view.check.code}: error against the stiffness matrix", "amplitude / length, or rad",
                "error, relative", [Series(view.option("mode"), sizes, errors, "o-")],
                log_x=True, log_y=True)
    return Measured(max(0.0, 1 - order),
                    f"order {order:.3f}, errors {errors.min():.2g} to {errors.max():.2g}", plot)


@measure
def rigid_rotation(view: View) -> Measured:
    """Largest load, as part of E S, after a large rigid rotation (option `angle`, rad)."""
    beam = beam_of(view)
    angle = float(view.option("angle"))
    axis = np.array([2.0, -1.0, 3.0]) / np.sqrt(14.0)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    moved = beam.position @ turn.T - beam.position
    motion = np.array([moved[0], moved[1], angle * axis, angle * axis])
    loads = loads_of(view, beam, motion[None], "rigid rotation")
    return Measured(float(np.abs(loads[0] * _scale(beam)).max()))


@measure
def order_swap(view: View) -> Measured:
    """Largest change of the loads, relative, when the two ends change their places in the bond.

    Options: `mode`, `amplitude`.
    """
    beam = beam_of(view)
    axes, length = axes_of(beam)
    motion = float(view.option("amplitude")) * modes(axes, length)[view.option("mode")]
    swapped = replace(beam, position=beam.position[::-1].copy())
    order = [1, 0, 3, 2]
    loads = loads_of(view, beam, motion[None], "as given")[0]
    other = loads_of(view, swapped, motion[order][None], "swapped")[0][order]
    return Measured(_error(other, loads, _scale(beam)))
