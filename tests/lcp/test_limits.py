"""What no step leaves behind: hair in the body, beyond its reach, or far from the hair that it continues."""

from dataclasses import replace

import numpy as np
import pytest

from headstudio.head.frame import HeadFrame
from headstudio.lcp.contact import Touching, looked_again, touching
from headstudio.lcp.limits import LONGEST_LINK, LONGEST_REACH, Tethers, put_back

from .dome import CENTRE, RADIUS, hanging_chain

UP = np.array([0.0, 1.0, 0.0])


def over_floor(*distances):
    """Every particle over a floor of its own that goes up with 0.5 m/s."""
    count = len(distances)
    still, up = np.zeros((count, 3)), np.tile(UP, (count, 1))
    return Touching(still, np.array(distances), up, 0.5 * up, np.zeros(count))


def no_touch(count):
    still = np.zeros((count, 3))
    return Touching(still, np.full(count, np.inf), still, still, np.zeros(count))


def test_what_is_too_deep_is_put_back_to_the_surface_and_goes_no_deeper():
    """Eq. 3.21 for what no spring could stop: it loses what leads into the body, and keeps the rest."""
    chain, touch = hanging_chain(3), over_floor(0.0, -0.05, -0.0001)
    v = np.tile([1.0, -2.0, 3.0], (3, 1))
    positions, velocities = put_back(chain, chain.rest_positions, v, touch)
    moved = positions - chain.rest_positions
    assert moved[1, 1] == pytest.approx(0.05, abs=0.0025)
    np.testing.assert_allclose(velocities[1], [1.0, 0.5, 3.0])
    np.testing.assert_array_equal(moved[2], 0)
    np.testing.assert_array_equal(velocities[2], v[2])


def test_what_leaves_the_body_is_not_held_up():
    chain, touch = hanging_chain(2), over_floor(0.0, -0.05)
    v = np.tile([0.0, 4.0, 0.0], (2, 1))
    np.testing.assert_array_equal(put_back(chain, chain.rest_positions, v, touch)[1], v)


def test_root_particles_are_left_where_they_are():
    chain, touch = hanging_chain(2), over_floor(-0.05, -0.05)
    positions, _ = put_back(chain, chain.rest_positions, np.zeros((2, 3)), touch)
    np.testing.assert_array_equal(positions[0], chain.rest_positions[0])


def test_what_is_too_far_out_is_put_back_within_its_reach():
    chain = hanging_chain(3, arc_length=np.array([-0.002, 0.05, 0.1]))
    x = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, -2.0], [0.03, 0.0, 0.04]])
    v = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 4.0]])
    touch = no_touch(3)
    back, stopped = put_back(chain, x, v, touch)
    assert np.linalg.norm(back[1]) == pytest.approx(LONGEST_REACH * 0.05)
    np.testing.assert_allclose(back[1] / np.linalg.norm(back[1]), x[1] / 3)
    np.testing.assert_allclose(stopped[1], v[1] - x[1] / 3)
    np.testing.assert_array_equal(back[2], x[2])
    np.testing.assert_array_equal(stopped[2], v[2])


def test_hair_that_is_caught_behind_an_edge_gives_to_the_body_and_to_its_length():
    """What presses it out leads away from its root: as far as that is too far, it may be deeper, to an end."""
    chain = hanging_chain(2, arc_length=np.array([-0.002, 0.1]))
    for too_far, depth in ((-0.01, 0.001), (0.002, 0.003), (0.02, 0.0045)):
        at_skin = -(LONGEST_REACH * 0.1 + too_far)
        x = np.array([[0.0, 0.0, 0.0], [0.0, at_skin + 0.03, 0.0]])
        touch = Touching(x, np.array([1.0, -0.031]), np.tile(-UP, (2, 1)), np.zeros((2, 3)), np.full(2, 0.005))
        back, _ = put_back(chain, x, np.zeros((2, 3)), touch)
        assert back[1, 1] - at_skin == pytest.approx(depth - 0.001, abs=1e-9)


def test_hair_ends_outside_however_fast_it_came(hair, ball):
    """By no more than the planes are off."""
    rng = np.random.default_rng(1)
    hair = replace(hair, coordinates=np.where([0, 0, 1], 1.0, hair.coordinates))  # within its reach
    out = rng.normal(size=(hair.count, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    x = CENTRE + (RADIUS + 0.004) * out
    touch = touching(hair, ball, x, HeadFrame())
    way = -0.05 * out
    back, _ = put_back(hair, x + way, -3.0 * out, looked_again(ball, touch, x + way, HeadFrame()))
    height = np.linalg.norm(back - CENTRE, axis=1) - RADIUS
    assert np.all(height[~hair.fixed] > np.minimum(touch.keep[~hair.fixed], 0.0) - 0.003)


def test_what_is_left_behind_follows_its_rootward_hair():
    chain = hanging_chain(4)
    x = chain.rest_positions.copy()
    x[3] += [0.0, -0.5, 0.0]
    drawn = Tethers(chain).drawn_along(x)
    np.testing.assert_array_equal(drawn[:3], x[:3])
    link = chain.lifeline[3]
    ends = chain.links[link]
    assert np.linalg.norm(np.diff(drawn[ends], axis=0)) == pytest.approx(LONGEST_LINK * chain.rest_length[link])


def test_hair_that_keeps_up_is_not_drawn():
    chain = hanging_chain(4)
    np.testing.assert_array_equal(Tethers(chain).drawn_along(chain.rest_positions), chain.rest_positions)
