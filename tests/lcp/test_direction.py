"""How links turn the hair direction of a particle, eq. 15."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.lcp.direction import DirectionUpdate, turned
from headstudio.lcp.springs import Springs

from .dome import hair_of, hanging_chain

E = 3e5


def updated(model, positions, directions):
    return DirectionUpdate(model).led_by(Springs(model).at(positions, E), directions)


def turned_by_link(unit, hair, cosine):
    """t_i^j of eq. 15: the connection turned by theta toward the hair, (m, 3)."""
    between = np.einsum("ij,ij->i", unit, hair)
    lengthwise, sideways, _ = turned(between, cosine, np.sqrt(1 - cosine**2))
    return lengthwise[:, None] * unit + sideways[:, None] * hair


def mean_direction(model, links, directions):
    """Eq. 15 as it stands, particle by particle."""
    total = np.zeros((model.count, 3))
    for k, pair in enumerate(model.links):
        for end, unit in ((0, links.unit[k]), (1, -links.unit[k])):
            t = turned_by_link(unit[None], directions[pair[end]][None], model.rest_cosine[k, end][None])
            total[pair[end]] += links.stiffness[k] * t[0]
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)


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
        result = turned_by_link(unit, hair, np.array([np.cos(theta)]))
        np.testing.assert_allclose(result, [[np.cos(theta), np.sin(theta), 0.0]], atol=1e-9)


def test_a_turn_keeps_angle_and_plane():
    unit, hair, cosine = random_units(200, 1), random_units(200, 2), np.random.default_rng(3).uniform(-1, 1, 200)
    result = turned_by_link(unit, hair, cosine)
    np.testing.assert_allclose(np.linalg.norm(result, axis=1), 1.0)
    np.testing.assert_allclose(np.einsum("ij,ij->i", result, unit), cosine, atol=1e-9)
    np.testing.assert_allclose(np.einsum("ij,ij->i", result, np.cross(unit, hair)), 0, atol=1e-9)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_where_hair_and_connection_are_parallel_there_is_no_axis(side):
    unit = random_units(5)
    np.testing.assert_allclose(turned_by_link(unit, side * unit, np.full(5, 0.3)), side * unit, atol=1e-12)


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
    bent = hair.rest_positions + 0.3 * np.linalg.norm(hair.rest_positions, axis=1, keepdims=True) ** 2
    links = Springs(hair).at(bent, E)
    mean = mean_direction(hair, links, hair.rest_directions)
    directions = DirectionUpdate(hair)
    once = limit = directions.led_by(links, hair.rest_directions)
    for _ in range(60):
        limit = directions.led_by(links, limit)
    left, without = (np.median(np.linalg.norm((a - limit)[~hair.fixed], axis=1)) for a in (once, mean))
    assert without > 0.005
    assert left < 0.2 * without


def test_one_turn_is_the_step_of_newton_that_the_formula_says(hair):
    """((1 + e) s - B)^-1 r, particle by particle, with B as it is written."""
    rng = np.random.default_rng(5)
    links = Springs(hair).at(hair.rest_positions + rng.normal(scale=0.0005, size=(hair.count, 3)), E)
    directions = hair.rest_directions
    total, held = np.zeros((hair.count, 3)), np.zeros((hair.count, 3, 3))
    for k, pair in enumerate(hair.links):
        for end, unit in ((0, links.unit[k]), (1, -links.unit[k])):
            t, cosine = directions[pair[end]], hair.rest_cosine[k, end]
            across = np.cross(unit, t)
            weight = links.stiffness[k] * np.sqrt(1 - cosine**2) / np.linalg.norm(across) ** 3
            total[pair[end]] += links.stiffness[k] * turned_by_link(unit[None], t[None], cosine[None])[0]
            held[pair[end]] += weight * np.outer(across, across)
    along = np.einsum("ij,ij->i", total, directions)
    largest = np.linalg.eigvalsh(held)[:, -1]
    plain = ~hair.fixed & (largest < along)
    rest = (total - along[:, None] * directions)[plain]
    changed = np.linalg.solve((1.02 * along[:, None, None] * np.eye(3) - held)[plain], rest[:, :, None])[:, :, 0]
    plain[plain] = np.linalg.norm(changed, axis=1) < 0.5
    expected = directions[plain] + changed[np.linalg.norm(changed, axis=1) < 0.5]
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    assert np.count_nonzero(plain) > 0.5 * hair.count
    np.testing.assert_allclose(DirectionUpdate(hair).led_by(links, directions)[plain], expected, atol=1e-9)
