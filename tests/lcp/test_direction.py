"""How links turn the hair direction of a particle, eq. 15."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.rows import rows_at
from headstudio.lcp.direction import turned, updated_directions
from headstudio.lcp.springs import Springs

from .dome import hair_of, hanging_chain

E = 3e5


def updated(model, positions, directions):
    springs = Springs(model)
    return updated_directions(model, springs, springs.at(positions, E), directions)


def random_units(count, seed=0):
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def test_hair_at_rest_keeps_its_directions(hair):
    np.testing.assert_allclose(
        updated(hair, hair.rest_positions, hair.rest_directions), hair.rest_directions, atol=1e-9
    )


def test_hair_that_is_turned_as_a_whole_turns_its_directions(hair):
    turn = Rotation.from_rotvec([0.4, 1.9, -0.6])
    new = updated(hair, turn.apply(hair.rest_positions) + np.array([0.1, 2.0, -0.3]), turn.apply(hair.rest_directions))
    free = ~hair.fixed
    np.testing.assert_allclose(new[free], turn.apply(hair.rest_directions)[free], atol=1e-9)


def test_directions_follow_a_turn_in_small_steps(hair):
    """The directions are not told of the turn: the connections lead them."""
    directions = hair.rest_directions
    for k in range(1, 31):
        turn = Rotation.from_rotvec([0.0, 0.0, k * 0.05])
        directions = updated(hair, turn.apply(hair.rest_positions), directions)
    carried = np.einsum("ij,ij->i", directions, turn.apply(hair.rest_directions))
    assert np.mean(carried[~hair.fixed]) > 0.9


def test_they_are_unit_vectors_and_roots_keep_theirs(hair):
    rng = np.random.default_rng(1)
    new = updated(hair, hair.rest_positions + rng.normal(scale=0.01, size=(hair.count, 3)), random_units(hair.count))
    np.testing.assert_allclose(np.linalg.norm(new, axis=1), 1.0)
    np.testing.assert_array_equal(new[hair.fixed], random_units(hair.count)[hair.fixed])


def test_one_link_turns_the_direction_by_hand():
    """The connection turned by theta, in the plane of connection and hair, on the hair's side."""
    unit = np.array([[1.0, 0.0, 0.0]])
    hair = np.array([[np.cos(0.3), np.sin(0.3), 0.0]])
    for theta in (0.0, 0.5, np.pi / 2, 2.5, np.pi):
        result = turned(unit, hair, np.array([np.cos(theta)]))
        np.testing.assert_allclose(result, [[np.cos(theta), np.sin(theta), 0.0]], atol=1e-9)


def test_a_turn_keeps_angle_and_plane():
    unit, hair, cosine = random_units(200, 1), random_units(200, 2), np.random.default_rng(3).uniform(-1, 1, 200)
    result = turned(unit, hair, cosine)
    np.testing.assert_allclose(np.linalg.norm(result, axis=1), 1.0)
    np.testing.assert_allclose(np.einsum("ij,ij->i", result, unit), cosine, atol=1e-9)
    np.testing.assert_allclose(np.einsum("ij,ij->i", result, np.cross(unit, hair)), 0, atol=1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_where_hair_and_connection_are_parallel_there_is_no_axis(side):
    unit = random_units(5)
    np.testing.assert_allclose(turned(unit, side * unit, np.full(5, 0.3)), side * unit, atol=1e-12)


def test_stiffer_links_count_for_more():
    """A particle between two roots, one of which has let go, takes the direction of the near one."""
    points = [[0, 0, 0], [0.012, 0, 0], [0, -0.01, 0]]
    model = hair_of(points, [[0, -1, 0]] * 3, [(1, 2), (0, 2)], fixed=(0, 1), smoothing_length_links=0.01)
    moved = np.array([[0, 0, 0], [0.012, 0, 0], [-0.012, -0.012, 0]])
    new = updated(model, moved, model.rest_directions)[2]
    near = (moved[2] - moved[0]) / np.linalg.norm(moved[2] - moved[0])
    assert new @ near > 0.999


def test_links_that_cancel_out_change_nothing():
    model = hanging_chain(3)
    folded = np.array([[0.0, 0.0, 0.0], [0.0, -0.01, 0.0], [0.0, 0.0, 0.0]])
    sideways = np.tile([1.0, 0.0, 0.0], (3, 1))
    new = updated(model, folded, sideways)
    assert np.all(np.isfinite(new))
    np.testing.assert_allclose(np.linalg.norm(new, axis=1), 1.0)


def test_one_turn_of_the_directions_comes_nearly_to_where_many_lead(hair):
    """A mean alone, eq. 15, would need tens of them where links lie across the hair."""
    springs = Springs(hair)
    bent = hair.rest_positions + 0.3 * np.linalg.norm(hair.rest_positions, axis=1, keepdims=True) ** 2
    links = springs.at(bent, E)
    at_ends = rows_at(hair.rest_directions, hair.links.T.ravel())
    unit, cosine = np.concatenate([links.unit, -links.unit]), hair.rest_cosine.ravel(order="F")
    mean = springs.sum_at_ends(np.tile(links.stiffness, 2)[:, None] * turned(unit, at_ends, cosine))
    mean /= np.linalg.norm(mean, axis=1, keepdims=True)
    once = limit = updated_directions(hair, springs, links, hair.rest_directions)
    for _ in range(60):
        limit = updated_directions(hair, springs, links, limit)
    left, without = (np.median(np.linalg.norm((a - limit)[~hair.fixed], axis=1)) for a in (once, mean))
    assert without > 0.005
    assert left < 0.2 * without
