"""Who is near whom: against looking at every pair."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from headstudio.lcp.neighbours import NeighbourList, find_pairs

RADIUS = 0.02


def everybody(positions, radius):
    """Every pair (i, j), i < j, that is closer than ``radius``, as a set."""
    apart = np.linalg.norm(positions[:, None] - positions[None], axis=2)
    return set(zip(*np.nonzero(np.triu(apart < radius, k=1)), strict=True))


def as_set(pairs):
    return {tuple(sorted(pair)) for pair in pairs.tolist()}


@st.composite
def clouds(draw):
    """Particles in clumps, on a lattice, at the same place, and far away from everybody."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    count = draw(st.integers(0, 60))
    spread = draw(st.sampled_from([0.1, 1.0, 4.0, 30.0])) * RADIUS
    points = rng.normal(scale=spread, size=(count, 3))
    match draw(st.sampled_from(["loose", "lattice", "same place", "flat", "outliers"])):
        case "lattice":
            points = RADIUS * np.round(points / RADIUS)
        case "same place":
            points = np.repeat(points[: count // 4 + 1], 4, axis=0)[:count]
        case "flat":
            points[:, draw(st.integers(0, 2))] = 0.3
        case "outliers":
            points[: count // 5] *= 1e6
    return points + draw(st.sampled_from([0.0, -100.0, 7.0]))


@settings(max_examples=150, deadline=None)
@given(clouds(), st.sampled_from([0.3, 1.0, 2.5]))
def test_it_finds_every_pair_once(points, scale):
    # Distances of exactly one radius may fall either way by rounding.
    radius = scale * RADIUS * (1 + 1e-7)
    pairs = find_pairs(points, radius)
    assert pairs.shape == (len(pairs), 2)
    assert len(as_set(pairs)) == len(pairs)
    assert as_set(pairs) == everybody(points, radius)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_hardly_anybody(count):
    assert len(find_pairs(np.zeros((count, 3)), RADIUS)) == max(count - 1, 0)
    assert len(find_pairs(np.arange(3.0 * count).reshape(count, 3), RADIUS)) == 0


def test_a_stray_hides_no_pair():
    """One particle very far away makes a very large grid."""
    points = np.random.default_rng(2).random((200, 3)) * 0.1
    crowd = everybody(points, RADIUS)
    for stray in 1e6 * np.array([[1, 1, 1], [-1, 1, 1], [0, 0, -1.0]]):
        assert as_set(find_pairs(np.vstack([points, stray]), RADIUS)) == crowd


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(1e-4, 0.5), st.floats(0.0, 3.0))
def test_the_list_never_misses_a_pair(seed, jitter, common):
    """Whatever the motion: together, apart, in small steps and in large ones."""
    rng = np.random.default_rng(seed)
    x = rng.random((80, 3)) * 0.15
    near = NeighbourList(RADIUS)
    drift = rng.normal(size=3) * common * RADIUS
    for _ in range(12):
        listed = near.pairs(x)
        assert len(as_set(listed)) == len(listed)
        assert everybody(x, RADIUS) <= as_set(listed)
        x = x + drift + rng.normal(scale=jitter * RADIUS, size=x.shape)


def test_the_list_never_misses_when_one_particle_flies_through():
    rng = np.random.default_rng(4)
    x = rng.random((300, 3)) * 0.15
    near = NeighbourList(RADIUS)
    for _ in range(60):
        assert everybody(x, RADIUS) <= as_set(near.pairs(x))
        x[0] += [0.0025, 0.002, 0.0]


def test_the_list_lives_while_motion_is_small():
    """Hair that moves along with its head by metres and in itself by millimetres is searched for now and then."""
    rng = np.random.default_rng(6)
    x = rng.random((300, 3)) * 0.15
    near = NeighbourList(RADIUS)
    velocity = rng.uniform(-0.02 * RADIUS, 0.02 * RADIUS, size=x.shape)
    for _ in range(60):
        near.pairs(x)
        x = x + velocity + [0.1, 0.0, 0.0]
    assert near.questions == 60
    assert 1 <= near.searches <= 20


def test_a_list_at_rest_is_searched_for_once():
    x = np.random.default_rng(7).random((100, 3)) * 0.1
    near = NeighbourList(RADIUS)
    first = near.pairs(x)
    assert all(near.pairs(x.copy()) is first for _ in range(5))
    assert near.searches == 1
