import numpy as np
import pytest

from headstudio.wisp.columns import cross, dot, unit
from headstudio.wisp.joints import REFERENCE_SEGMENT, bend_toward, joint_stiffness, most_aligned, turn


def random_directions(count: int, seed: int) -> np.ndarray:
    vectors = np.random.default_rng(seed).normal(size=(3, count))
    return unit(vectors, otherwise=vectors)


def across_to(directions: np.ndarray) -> np.ndarray:
    across = np.cross(directions, np.eye(3)[:, np.abs(directions).argmin(axis=0)], axis=0)
    return unit(across, otherwise=across)


def frames(across: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Rotations, (k, 3, 3), with these two for their first and last columns."""
    return np.stack([across, cross(along, across), along], axis=1).transpose(2, 0, 1)


def test_arithmetic_on_columns_is_that_of_numpy():
    one, other = np.random.default_rng(9).normal(size=(2, 3, 20))
    np.testing.assert_allclose(cross(one, other), np.cross(one, other, axis=0))
    np.testing.assert_allclose(dot(one, other), np.diag(one.T @ other))
    one[:, 3] = 0.0
    directions = unit(one, otherwise=other)
    np.testing.assert_array_equal(directions[:, 3], other[:, 3])
    np.testing.assert_allclose(np.linalg.norm(np.delete(directions, 3, axis=1), axis=0), 1.0)


@pytest.mark.parametrize("kappa", [0.0, 0.5, 2.5])
def test_no_direction_has_more_energy_than_the_closed_form(kappa):
    force, rest = 2.0 * random_directions(50, 1), random_directions(50, 2)
    others = random_directions(2000, 3)
    best = most_aligned(force, rest, kappa)
    energy = dot(force + kappa * rest, best)
    assert np.all(energy[:, None] >= (force + kappa * rest).T @ others - 1e-12)


def test_kappa_of_the_reference_segment_is_the_paper_s():
    assert joint_stiffness(0.5, REFERENCE_SEGMENT) == pytest.approx(0.5)
    assert joint_stiffness(0.0, 0.003) == 0.0


@pytest.mark.parametrize("kappa", [0.5, 2.5, 10.0])
def test_hair_bends_alike_however_finely_it_is_cut(kappa):
    force = np.array([[0.0], [-1.0], [0.0]])

    def after(length: float, segment: float) -> np.ndarray:
        direction = unit(np.array([[1.0], [-1.0], [0.0]]), otherwise=force)
        for _ in range(round(length / segment)):
            direction = most_aligned(force, direction, joint_stiffness(kappa, segment))
        return direction

    assert np.degrees(np.arccos(dot(after(0.04, 0.02), after(0.04, 0.0025))[0])) < 2.0


def test_frames_turn_the_shortest_way():
    start, end = random_directions(200, 4), random_directions(200, 5)
    across = across_to(start)
    turned = turn(across, start, end)
    assert dot(turned, end) == pytest.approx(np.zeros(200), abs=1e-12)
    assert dot(turned, turned) == pytest.approx(np.ones(200))
    rotation = frames(turned, end) @ frames(across, start).transpose(0, 2, 1)
    angle = np.arccos(np.clip((np.trace(rotation, axis1=1, axis2=2) - 1) / 2, -1, 1))
    assert angle == pytest.approx(np.arccos(dot(start, end)), abs=1e-6)


def test_the_opposite_direction_is_half_a_turn():
    start = random_directions(20, 6)
    turned = turn(across_to(start), start, -start)
    assert np.linalg.det(frames(turned, -start)) == pytest.approx(np.ones(20))


def test_a_bend_goes_so_far_and_not_beyond_its_goal():
    direction, goal = random_directions(100, 7), random_directions(100, 8)
    apart = np.arccos(dot(direction, goal))
    bent = bend_toward(direction, goal, 0.3)
    left = np.arccos(np.clip(dot(bent, goal), -1, 1))
    assert left == pytest.approx(np.maximum(apart - 0.3, 0.0), abs=1e-6)
