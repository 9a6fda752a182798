# SPDX-License-Identifier: GPL-2.0-or-later
"""The laws of central force as they are scripted for YADE: mechanics, not figures."""

from __future__ import annotations

import numpy as np
import pytest

from contrib.yade.central_body import CentralBody, near_pairs
from contrib.yade.central_law import Interaction, Law, interaction_of, law_named
from contrib.prepared import CentralForces, Damage, Specimen

MIE = {"energy": 2.0, "repulsive_exponent": 8, "attractive_exponent": 4}
PARAMETERS = {
    "piecewise": {"stiffness": 900.0, "attraction": 25.0},
    "lennard-jones": {"energy": 2.0},
    "shifted-lennard-jones": {"attraction": 25.0, "peak_separation": 1.2},
    "mie": MIE,
    "threshold": {**MIE, "beyond_energy": 0.3, "beyond_repulsive_exponent": 6,
                  "beyond_attractive_exponent": 3, "threshold_strain": 0.1},
}
REST = np.array(0.7)


@pytest.fixture(params=PARAMETERS)
def law(request: pytest.FixtureRequest) -> Law:
    return law_named(request.param, PARAMETERS[request.param])


def derivative(function, at: np.ndarray, step: float = 1e-4) -> np.ndarray:
    """By central differences of fourth order."""
    return (8 * (function(at + step) - function(at - step))
            - (function(at + 2 * step) - function(at - 2 * step))) / (12 * step)


def test_force_is_the_slope_of_the_potential_and_stiffness_that_of_the_force(law: Law) -> None:
    # Places are chosen off the kinks at δ_eq (1 ± .1) and at the plateau's beginning.
    at = REST * np.array([0.7, 0.85, 0.93, 0.97, 1.02, 1.05, 1.15, 1.3, 1.45])
    scale = np.abs(law.force(at, REST))
    force = -derivative(lambda d: law.potential(d, REST), at)
    assert np.abs((law.force(at, REST) - force) / scale).max() < 1e-8
    slope = -derivative(lambda d: law.force(d, REST), at)
    scale = np.abs(law.slope(at, REST)) + np.abs(law.slope(REST, REST)) * 1e-3
    assert np.abs((law.slope(at, REST) - slope) / scale).max() < 1e-7


def test_no_force_at_equilibrium_and_attraction_beyond(law: Law) -> None:
    assert law.force(REST, REST) == pytest.approx(0, abs=1e-12)
    assert law.force(0.95 * REST, REST) > 0 > law.force(1.05 * REST, REST)


def test_published_values() -> None:
    places = np.linspace(1, 1.5, 200001)
    attraction = -law_named("lennard-jones", {"energy": 1.0}).force(places, np.array(1.0))
    assert attraction.max() == pytest.approx(2.690, abs=1e-3)
    assert places[attraction.argmax()] == pytest.approx(1.1087, abs=1e-4)
    attraction = -law_named("shifted-lennard-jones", PARAMETERS["shifted-lennard-jones"]).force(
        places, np.array(1.0))
    assert attraction.max() == pytest.approx(25)
    assert places[attraction.argmax()] == pytest.approx(1.2, abs=1e-5)
    twelve_six = law_named("mie", {**MIE, "repulsive_exponent": 12, "attractive_exponent": 6})
    assert twelve_six.force(places, REST) == pytest.approx(
        law_named("lennard-jones", {"energy": 2.0}).force(places, REST), rel=1e-12, abs=1e-12)


def test_range_and_continuation(law: Law) -> None:
    of, limit = Interaction(law, 0.2), np.array(1.5 * REST)
    assert of.force(limit, REST, limit) == 0 == of.potential(limit, REST, limit)
    nearest = 0.8 * REST
    deep = np.array([0.0, 0.3, 0.6]) * nearest
    steepness = law.slope(nearest, REST)
    assert of.force(deep, REST, limit) == pytest.approx(
        law.force(nearest, REST) + steepness * (nearest - deep))
    across = nearest + np.array([-1e-9, 1e-9]) * REST
    assert np.ptp(of.force(across, REST, limit)) < 1e-8 * steepness
    at = np.array([0.3, 0.7, 0.95]) * REST
    assert -derivative(lambda d: of.potential(d, REST, limit), at) == pytest.approx(
        of.force(at, REST, limit), rel=1e-7)


def test_parameters_that_do_not_fit_are_named() -> None:
    with pytest.raises(ValueError, match="needs energy, repulsive_exponent"):
        law_named("mie", {"energy": 1.0})
    with pytest.raises(ValueError, match="known: piecewise"):
        law_named("morse", {})


def cloud(count: int = 300) -> Specimen:
    random = np.random.default_rng(4)
    position = random.uniform(0, 8, (count, 3))
    return Specimen(None, position, random.uniform(0.4, 0.6, count), np.zeros((0, 2), int))


def all_pairs(count: int) -> np.ndarray:
    return np.argwhere(np.triu(np.ones((count, count)), 1))


def test_linked_cells_find_every_pair() -> None:
    specimen = cloud()
    reach = 1.2 * specimen.radius
    every = all_pairs(len(reach))
    distance = np.linalg.norm(specimen.position[every[:, 1]] - specimen.position[every[:, 0]],
                              axis=1)
    expected = every[distance < reach[every].sum(axis=1)]
    assert len(expected) > 500
    assert (near_pairs(specimen.position, reach) == expected).all()


def body(specimen: Specimen, damage: Damage | None = None, **words) -> CentralBody:
    forces = CentralForces("piecewise", PARAMETERS["piecewise"], 1.2, **words)
    return CentralBody(specimen, interaction_of(forces), forces, damage)


def test_a_body_on_the_move_is_that_of_all_pairs() -> None:
    specimen = cloud()
    of, every = body(specimen), all_pairs(300)
    together = specimen.radius[every].sum(axis=1)
    position, random = specimen.position.copy(), np.random.default_rng(5)
    drift = random.normal(size=position.shape)
    for step in range(40):
        chord = position[every[:, 1]] - position[every[:, 0]]
        distance = np.linalg.norm(chord, axis=1)
        force = of.interaction.force(distance, together, 1.2 * together)
        expected = np.zeros_like(position)
        for end, sign in ((0, -1), (1, 1)):
            np.add.at(expected, every[:, end], (sign * force / distance)[:, None] * chord)
        found = of.respond(step, position)
        assert found.force == pytest.approx(expected, abs=1e-9)
        assert found.interactions == (distance < 1.2 * together).sum()
        position = position + 0.001 * drift
    assert 3 < of.rebuilds < 20


def pair_at(distance: float) -> Specimen:
    return Specimen(None, np.array([[0, 0, 0], [distance, 0, 0]]), np.full(2, 0.5),
                    np.array([[0, 1]]))


@pytest.mark.parametrize("words, rest", [({}, 1.1), ({"equilibrium": "radii"}, 1.0)])
def test_initial_pairs_meet_again_at_their_first_distance(words: dict, rest: float) -> None:
    of = body(pair_at(1.1), **words)
    for step, distance in enumerate((1.1, 3.0, 1.08)):
        found = of.respond(step, pair_at(distance).position)
        assert found.interactions == (distance < 1.2)
    assert found.force[1, 0] == pytest.approx(max(900 * (rest - 1.08), -25))


def test_neighbours_that_are_fixed() -> None:
    three = np.array([[0, 0, 0], [1.0, 0, 0], [0, 1.05, 0]])
    specimen = Specimen(None, three, np.full(3, 0.5), np.array([[0, 1]]))
    moved = three * 0.98
    assert body(specimen, neighbours="fixed").respond(0, moved).interactions == 1
    assert body(specimen).respond(0, moved).interactions == 2


def test_dissipation_takes_energy_and_keeps_momentum() -> None:
    specimen = cloud()
    velocity = np.random.default_rng(6).normal(size=specimen.position.shape)
    still = body(specimen).respond(0, specimen.position)
    found = body(specimen, dissipation=3.0).respond(0, specimen.position, velocity)
    drag = found.force - still.force
    assert -(drag * velocity).sum() == pytest.approx(found.dissipation)
    assert found.dissipation > 0
    assert drag.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-9)


def lattice(gap: float) -> Specimen:
    """6 × 4 × 4 elements that touch, torn open in the middle by a gap."""
    cell = np.indices((6, 4, 4)).reshape(3, -1).T
    position = cell + gap * (cell[:, :1] > 2) * np.array([1.0, 0, 0])
    return Specimen(None, position, np.full(len(cell), 0.5), near_pairs(cell + 0.0, np.full(96, .51)))


def test_faces_of_a_crack_only_push() -> None:
    whole, torn = lattice(0.0), lattice(0.1)
    middle = np.isin(whole.position[:, 0], [2, 3])
    inner = ((whole.position[:, 1:] > 0) & (whole.position[:, 1:] < 3)).all(axis=1)
    of = body(whole, Damage(crack_threshold=0.3))
    of.respond(0, whole.position)
    assert not of.crack_faces[inner & middle].any()
    assert of.crack_faces[~inner].any()  # free edges
    across = body(whole).respond(0, torn.position)
    assert np.abs(across.force[middle, 0]).min() == pytest.approx(25)
    # Out of range on both sides of the gap, then back within it before anyone looks again.
    of = body(whole, Damage(crack_threshold=0.3, every=3))
    of.respond(0, lattice(0.3).position)
    assert of.crack_faces[inner & middle].all()
    assert np.abs(of.respond(1, torn.position).force).max() < 1e-9
    pushed = of.respond(2, lattice(-0.01).position)
    assert np.abs(pushed.force[middle, 0]) == pytest.approx(np.full(32, 9.0))
    of.respond(3, whole.position)
    assert not of.crack_faces[inner & middle].any()


def test_elements_that_lost_their_neighbours_are_removed_when_it_is_due() -> None:
    specimen = lattice(0.0)
    moved = specimen.position.copy()
    moved[0] -= [0.5, 0.02, 0]  # a corner: two of its three neighbours stay within the range
    of = body(specimen, Damage(minimal_neighbours=3, removal_every=2))
    of.respond(0, specimen.position)
    assert of.respond(1, moved).force[0].any()
    assert not of.removed.any()
    found = of.respond(2, moved)
    assert list(np.flatnonzero(of.removed)) == [0]
    assert not found.force[0].any()
    assert not of.respond(3, specimen.position + 0.01).force[0].any()  # for good
