# SPDX-License-Identifier: GPL-2.0-or-later
"""The law of beams that flow and break, as it is scripted for YADE: mechanics, not figures."""

from __future__ import annotations

import numpy as np
import pytest

from compare.references import beam_stiffness
from contrib.yade.beam_law import BeamLaw, Bonds, Floats, Response, Yield, rotated, turns

POSITION = np.array([[0.3, -0.2, 0.5], [0.42, -0.08, 0.41]])
CHORD = POSITION[1] - POSITION[0]
LENGTH = float(np.linalg.norm(CHORD))
RADIUS, YOUNG, SHEAR, KAPPA = 0.03, 7.0, 2.6, 0.9


def law(flow: Yield | None = None, **limits: float) -> BeamLaw:
    area = np.pi * RADIUS**2
    bending = YOUNG * area * RADIUS**2 / 2
    slack = 6 * bending / (KAPPA * SHEAR * area * LENGTH**2)
    rigidity = np.array([[YOUNG * area, bending, bending / (1 + slack),
                          SHEAR * area * RADIUS**2 / 2]])
    bonds = Bonds(rigidity, np.array([LENGTH]), CHORD[None] / LENGTH, np.array([RADIUS]),
                  np.array([SHEAR / YOUNG]))
    return BeamLaw(bonds, flow, **limits)


def respond(of: BeamLaw, motion: Floats) -> Response:
    """Motion (4, 3): displacements, then rotation vectors of i and j."""
    return of.respond((CHORD + motion[1] - motion[0])[None], turns(motion[2:3]), turns(motion[3:]))


def loads(found: Response) -> Floats:
    return np.array([found.force[0], -found.force[0], found.moment_i[0], found.moment_j[0]])


def random_motion(seed: int, size: float) -> Floats:
    scale = np.array([LENGTH, LENGTH, 1.0, 1.0])[:, None]
    return size * scale * np.random.default_rng(seed).normal(size=(4, 3))


def test_small_motion_is_the_matrix_of_timoshenko() -> None:
    matrix = beam_stiffness(CHORD, RADIUS, YOUNG, SHEAR, KAPPA)
    motion = random_motion(1, 1e-7)
    expected = -(matrix @ motion.ravel()).reshape(4, 3)
    assert loads(respond(law(), motion)) == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_loads_balance_and_are_the_gradient_of_the_energy() -> None:
    of, motion, step = law(), random_motion(2, 0.1), 1e-6
    found = loads(respond(of, motion))
    lever = np.cross(CHORD + motion[1] - motion[0], found[1])
    assert found[2] + found[3] + lever == pytest.approx(np.zeros(3), abs=1e-14)
    for end, axis in np.ndindex(2, 3):
        moved = [motion.copy(), motion.copy()]
        for sign, place in zip((-1, 1), moved):
            place[end, axis] += sign * step
        energy = [float(respond(of, place).energy[0]) for place in moved]
        assert found[end, axis] == pytest.approx((energy[0] - energy[1]) / (2 * step), abs=1e-9)


def test_rigid_motion_loads_nothing_new_after_flow() -> None:
    of = law(Yield(0.002, 0.01))
    motion = random_motion(3, 0.05)
    of.keep(respond(of, motion))
    assert of.history.strain[0] > 0.01
    before = respond(of, motion)
    turn = turns(np.array([[0.7, -1.1, 0.4]]))
    chord = CHORD + motion[1] - motion[0]

    def turned(q: Floats) -> Floats:
        w = turn[:, :1] * q[:, :1] - (turn[:, 1:] * q[:, 1:]).sum(axis=1, keepdims=True)
        return np.hstack([w, turn[:, :1] * q[:, 1:] + q[:, :1] * turn[:, 1:]
                          + np.cross(turn[:, 1:], q[:, 1:])])

    after = of.respond(rotated(turn, chord[None]), turned(turns(motion[2:3])),
                       turned(turns(motion[3:])))
    assert rotated(turn, before.force) == pytest.approx(after.force, rel=1e-12)
    assert rotated(turn, before.moment_j) == pytest.approx(after.moment_j, rel=1e-10)
    # What flows again is what the first flow left over, of the square of the sections' turns.
    assert after.plastic_work[0] == pytest.approx(before.plastic_work[0], rel=1e-6, abs=1e-18)
    assert after.plastic_work[0] < 1e-4 * of.plastic_work


def test_responding_changes_nothing() -> None:
    of, motion = law(Yield(0.002), largest_strain=0.01), random_motion(4, 0.05)
    first, second = respond(of, motion), respond(of, motion)
    assert first.breaks.all() and of.intact.all() and of.history.strain[0] == 0
    assert (first.force == second.force).all()
    of.keep(first)
    assert of.broken == 1 and of.plastic_work > 0 and of.fracture_energy > 0
    assert (respond(of, motion).force == 0).all()


@pytest.mark.parametrize("flow", [Yield(0.002, 0.05), Yield(0.002, 0.05, scaled_offset=True)])
def test_work_becomes_elastic_energy_and_plastic_work(flow: Yield) -> None:
    """To first order in the steps at least."""
    target = random_motion(5, 0.03)
    target[2:] = 0  # forces alone do work then
    errors = []
    for count in (400, 800):
        of, work, before = law(flow), 0.0, np.zeros((4, 3))
        for fraction in np.linspace(0, 1, count + 1)[1:]:
            found = respond(of, fraction * target)
            of.keep(found)
            now = loads(found)
            work -= float(((now + before)[:2] * target[:2]).sum()) / (2 * count)
            before = now
        errors.append(abs(work - float(found.energy[0]) - of.plastic_work) / work)
    assert of.plastic_work > 0.5 * work
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] > 1.8


def test_stress_returns_to_the_yield_surface() -> None:
    flow = Yield(0.002, 0.05)
    of = law(flow)
    for seed in range(20):
        found = respond(of, random_motion(seed, 0.01))
        of.keep(found)
        limit = flow.strain + flow.hardening_ratio * of.history.strain[0]
        # A section that leans keeps its length: the square of its turn is left over.
        assert found.strain[0] <= limit * (1 + 1e-4)
    assert of.history.strain[0] > 0.03
