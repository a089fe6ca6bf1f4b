"""From a scalp to particles, section 3.2."""

import numpy as np
import pytest

from headstudio.lcp.beam import beam_directions
from headstudio.lcp.density import density
from headstudio.lcp.grow import grow_hair, hang
from headstudio.lcp.settings import HairSettings

from .dome import CENTRE, RADIUS, DomeScalp, no_body


def test_root_particles_lie_below_the_scalp_against_their_direction(hair):
    roots = hair.fixed
    assert roots.any()
    np.testing.assert_array_equal(roots, hair.arc_length < 0)
    below = hair.root_points + hair.arc_length[:, None] * hair.rest_directions
    np.testing.assert_allclose(hair.rest_positions[roots], below[roots], atol=1e-12)
    assert np.all(np.linalg.norm(hair.rest_positions[roots] - CENTRE, axis=1) < RADIUS)


def test_hair_is_no_longer_than_its_arc_length(hair):
    free = ~hair.fixed
    reach = np.linalg.norm(hair.rest_positions - hair.root_points, axis=1)
    assert np.all(reach[free] <= hair.arc_length[free] * (1 + 1e-9))
    np.testing.assert_allclose(np.linalg.norm(hair.rest_directions, axis=1), 1.0)


def test_hair_lies_outside_the_body(hair):
    outside = np.linalg.norm(hair.rest_positions - CENTRE, axis=1) - RADIUS
    assert outside[~hair.fixed].min() > -0.002


def test_hair_weighs_what_it_is_said_to_weigh(hair):
    assert hair.mass[~hair.fixed].sum() == pytest.approx(HairSettings().mass)


def test_the_smoothing_lengths_frame_the_mean_distance(hair):
    """h_1 is a little larger, h_2 a little smaller than the mean distance of neighbours."""
    assert hair.smoothing_length < hair.spacing < hair.smoothing_length_links


def test_the_density_at_rest_is_that_of_the_initial_state(hair):
    i, j = np.triu_indices(hair.count, k=1)
    everybody = np.column_stack([i, j])
    by_hand = density(hair.rest_positions, hair.mass, everybody, hair.smoothing_length)
    np.testing.assert_allclose(hair.rest_density, by_hand)


def test_the_points_of_one_hair_lie_on_one_beam():
    """Along a hair that touches nothing, the arc length is the length of the curve."""
    root_direction = np.array([[0.6, 0.8, 0.0]])
    s = np.linspace(0, 0.25, 60)
    positions, directions = hang(
        np.zeros((60, 3)), np.repeat(root_direction, 60, axis=0), s, np.full(60, 0.25), 0.04, no_body()
    )
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    np.testing.assert_allclose(steps, np.diff(s), rtol=0.03)
    assert np.all(steps <= np.diff(s) * (1 + 1e-9))
    pieces = beam_directions(root_direction, np.array([0.25]), 0.04, 2000)[0]
    np.testing.assert_allclose(positions[-1], pieces.mean(axis=0) * 0.25, atol=0.001)
    tangents = np.diff(positions, axis=0) / steps[:, None]
    assert np.mean(np.linalg.norm(directions[:-1] - tangents, axis=1)) < 0.05


def test_same_seed_same_hair(dome, ball, hair):
    again = grow_hair(dome, ball, HairSettings(particles=300, length=0.2))
    for name in ("rest_positions", "rest_directions", "links", "strength", "lifeline", "rest_density"):
        np.testing.assert_array_equal(getattr(again, name), getattr(hair, name))


def test_few_particles_of_long_hair_still_hang_on_the_scalp(dome, ball):
    """With one root particle in 250, a hundred particles may well have none: every slider position must give hair."""
    for seed in range(4):
        model = grow_hair(dome, ball, HairSettings(particles=100, length=1.0, root_depth=0.004, seed=seed))
        assert np.all(model.lifeline[~model.fixed] >= 0)


def test_a_bald_head_is_no_error(ball):
    """A length map that is black all over leaves nothing but roots."""
    assert grow_hair(_Bald(), ball, HairSettings(particles=200)).fixed.all()


class _Bald(DomeScalp):
    def lengths(self, uv):
        return np.zeros(len(uv))
