"""Poisson discs in the hair volume, eq. 3."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from headstudio.lcp.distribute import distribute, poisson_discs

from .dome import DomeScalp

LONGEST, DEPTH = 0.2, 0.012


def in_space(scalp, coordinates):
    """Points between which eq. 3 is the straight distance, (n, 4)."""
    return np.column_stack([scalp.points(coordinates[:, :2]), coordinates[:, 2]])


@pytest.fixture(scope="module", params=[500, 2000, 5000])
def spread(request, dome):
    return request.param, distribute(dome, LONGEST, DEPTH, request.param, np.random.default_rng(3))


def test_there_are_as_many_as_wanted(spread):
    wanted, coordinates = spread
    assert abs(len(coordinates) / wanted - 1) <= 0.02


def test_they_keep_their_distance_and_leave_no_hole(spread, dome):
    """Maximal discs: nobody is nearer than the radius, and nowhere is there much room for one more."""
    _, coordinates = spread
    tree = cKDTree(in_space(dome, coordinates))
    radius = tree.query(tree.data, k=2)[0][:, 1].min()
    ideal = (dome.area * (LONGEST + DEPTH) / len(coordinates)) ** (1 / 3)
    assert 0.7 * ideal < radius < 1.13 * ideal  # 1.12: the closest packing there is
    rng = np.random.default_rng(8)
    anywhere = np.column_stack([dome.random_points(20_000, rng), rng.uniform(-DEPTH, LONGEST, 20_000)])
    lonely = tree.query(in_space(dome, anywhere))[0]
    assert lonely.max() < 1.4 * radius
    assert np.mean(lonely > radius) < 0.02


def test_they_are_spread_evenly(spread, dome):
    """Over the skin in cells of the same area, and along the hair: evener than chance would have it."""
    wanted, coordinates = spread
    cells = np.histogram2d(*coordinates[:, :2].T, bins=4, range=[[0, 1], [0, 1]])[0]
    assert cells.std() < 0.8 * np.sqrt(wanted / 16)
    layers = np.histogram(coordinates[:, 2], bins=10, range=(-DEPTH, LONGEST))[0]
    np.testing.assert_allclose(layers, wanted / 10, atol=4 * np.sqrt(wanted / 10))
    assert layers[1:-1].std() < 0.8 * np.sqrt(wanted / 10)  # the outermost layers have no neighbours on one side


def test_they_fill_the_length_map_and_nothing_more():
    scalp = DomeScalp(shortest=0.2)
    coordinates = distribute(scalp, LONGEST, DEPTH, 2000, np.random.default_rng(1))
    _, v, s = coordinates.T
    assert np.all((coordinates[:, :2] >= 0) & (coordinates[:, :2] <= 1))
    assert np.all((s >= -DEPTH) & (s <= LONGEST * scalp.lengths(coordinates[:, :2])))
    quarters = np.histogram(v, bins=4, range=(0, 1))[0] / len(v)
    volume = LONGEST * scalp.lengths(np.column_stack([np.full(4, 0.5), [0.125, 0.375, 0.625, 0.875]])) + DEPTH
    np.testing.assert_allclose(quarters, volume / volume.sum(), atol=0.02)


def test_same_seed_same_particles(dome):
    first, second, other = (distribute(dome, LONGEST, DEPTH, 500, np.random.default_rng(seed)) for seed in (3, 3, 4))
    np.testing.assert_array_equal(first, second)
    assert not np.array_equal(first, other)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 80), st.floats(0.01, 0.6), st.integers(1, 4))
def test_discs_thrown_all_at_once_are_those_thrown_one_by_one(seed, count, radius, dimension):
    points = np.random.default_rng(seed).random((count, dimension))
    points[count // 2 :: 7] = points[: len(points[count // 2 :: 7])]  # some on top of others
    kept = []
    for k, point in enumerate(points):
        if all(np.linalg.norm(point - points[other]) > radius for other in kept):
            kept.append(k)
    np.testing.assert_array_equal(poisson_discs(points, radius), kept)
