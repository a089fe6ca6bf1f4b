"""Which particles are linked, eq. 5 and 6."""

import numpy as np
import pytest

from headstudio.lcp.kernel import kernel
from headstudio.lcp.links import SMALLEST_ALIGNMENT, WANTED_LINKS, alignment, connect, lifelines

UP = np.array([0.0, 1.0, 0.0])


@pytest.mark.parametrize(
    ("theta_ij", "theta_ji", "expected"),
    [
        (0, 180, 1.0),  # in a row
        (180, 0, 1.0),  # in a row, counted from the other end
        (90, 90, 0.0),  # side by side
        (0, 0, 0.0),  # head on
        (60, 120, 0.5),
        (30, 135, (np.sqrt(3) / 2 + np.sqrt(0.5)) / 2),
    ],
)
def test_alignment_is_that_of_equation_6(theta_ij, theta_ji, expected):
    cosines = np.cos(np.radians([theta_ij, theta_ji]))
    assert alignment(*cosines) == pytest.approx(expected, abs=1e-12)


def straight(points, **changes):
    """Links of hair that grows straight up out of the plane y = 0."""
    points = np.asarray(points, dtype=float)
    roots = points * [1.0, 0.0, 1.0]
    return connect(points, np.tile(UP, (len(points), 1)), roots, points[:, 1], 0.012, 0.012, **changes)


def test_two_in_a_row_are_linked_with_the_length_between_them():
    links = straight([[0, 0.01, 0], [0, -0.002, 0]])
    assert links.pairs.tolist() == [[1, 0]]  # the rootward one first, whatever the order
    assert links.rest_length == pytest.approx([0.012])
    assert links.alignment == pytest.approx([1.0])
    assert links.strength == pytest.approx([0.012])  # eq. 5
    np.testing.assert_allclose(links.rest_cosine, [[1, -1]])


def test_a_slanted_pair_is_weaker():
    links = straight([[0, -0.002, 0], [0.004, 0.006, 0]])
    cosine = 8 / np.hypot(4, 8)
    assert links.alignment == pytest.approx([cosine])
    assert links.strength == pytest.approx([cosine * np.hypot(0.004, 0.008)])
    np.testing.assert_allclose(links.rest_cosine, [[cosine, -cosine]])


def test_neither_side_by_side_nor_far_apart_nor_among_roots():
    links = straight([[0, -0.002, 0], [0.008, -0.003, 0], [0, 0.01, 0], [0.008, 0.011, 0], [0, 0.04, 0]])
    linked = {tuple(pair) for pair in links.pairs.tolist()}
    assert (0, 2) in linked
    assert (1, 3) in linked
    assert not linked & {(0, 1), (2, 3), (0, 4)}


def test_a_particle_that_nothing_holds_gets_a_link_toward_the_root():
    links = straight([[0, -0.002, 0], [0.002, 0.2, 0], [0, 0.01, 0]])
    assert [2, 1] in links.pairs.tolist()
    assert links.alignment.min() >= SMALLEST_ALIGNMENT


@pytest.fixture(scope="module")
def grown(hair):
    return hair


def test_every_particle_hangs_on_the_scalp(grown):
    """Following lifelines, or any rootward links, ends at a root particle."""
    rootward, tipward = grown.links.T
    assert np.all(grown.arc_length[rootward] < grown.arc_length[tipward])
    free = np.flatnonzero(~grown.fixed)
    np.testing.assert_array_equal(tipward[grown.lifeline[free]], free)
    np.testing.assert_array_equal(grown.lifeline[grown.fixed], -1)
    here = free
    for _ in range(grown.count):
        here = here[~grown.fixed[here]]
        here = rootward[grown.lifeline[here]]
    assert len(here) == 0


def test_a_tip_that_fell_to_the_other_side_hangs_on_the_hair_that_is_there():
    """Its nearest hair by root and arc length lies far away; what lies beside it is of its strands, too."""
    positions = np.array([[0, -0.002, 0], [0.012, -0.002, 0], [0.2, 0.1, 0], [0, 0.1, 0], [0.011, 0.1, 0]])
    roots = np.array([[0, 0, 0], [0.012, 0, 0], [0, 0, 0], [0.012, 0, 0], [0.001, 0, 0]])
    arc_length = np.array([-0.002, -0.002, 0.1, 0.1, 0.11])
    links = connect(positions, np.tile(UP, (5, 1)), roots, arc_length, 0.012, 0.012)
    assert links.pairs[links.pairs[:, 1] == 4].tolist() == [[3, 4]]


def test_the_lifeline_is_the_strongest_rootward_link(grown):
    weight = grown.strength * kernel(grown.rest_length, grown.smoothing_length_links)
    best = np.zeros(grown.count)
    np.maximum.at(best, grown.links[:, 1], weight)
    held = ~grown.fixed
    np.testing.assert_allclose(weight[grown.lifeline[held]], best[held])


def test_nobody_has_many_more_links_than_wanted(grown):
    degree = np.bincount(grown.links.ravel(), minlength=grown.count)
    assert degree.max() <= 2 * WANTED_LINKS
    assert np.mean(degree > WANTED_LINKS) < 0.05


def test_a_dense_bundle_is_pruned_to_its_strongest_links():
    rng = np.random.default_rng(3)
    points = np.column_stack([rng.uniform(0, 0.01, 400), rng.uniform(-0.004, 0.03, 400), rng.uniform(0, 0.01, 400)])
    links = straight(points)
    degree = np.bincount(links.pairs.ravel(), minlength=400)
    assert np.mean(degree) < 1.2 * WANTED_LINKS
    assert np.mean(degree > WANTED_LINKS + 4) < 0.05


def test_no_link_is_there_twice_or_joins_roots(grown):
    low, high = np.sort(grown.links, axis=1).T
    assert len(np.unique(low * grown.count + high)) == len(grown.links)
    assert np.all(low != high)
    assert not np.any(grown.fixed[grown.links].all(axis=1))


def test_links_are_measured_in_the_initial_state(grown):
    i, j = grown.links.T
    x = grown.rest_positions[j] - grown.rest_positions[i]
    np.testing.assert_allclose(grown.rest_length, np.linalg.norm(x, axis=1))
    np.testing.assert_allclose(grown.strength, grown.alignment * grown.rest_length)
    unit = x / grown.rest_length[:, None]
    cosines = [np.sum(grown.rest_directions[i] * unit, axis=1), -np.sum(grown.rest_directions[j] * unit, axis=1)]
    np.testing.assert_allclose(grown.rest_cosine, np.column_stack(cosines), atol=1e-12)
    assert np.all(grown.alignment >= SMALLEST_ALIGNMENT)


def test_lifelines_of_two_rivals():
    points = np.array([[0, -0.002, 0], [0.006, -0.002, 0], [0.001, 0.008, 0]])
    links = straight(points)
    assert len(links.pairs) == 2
    life = lifelines(links, points[:, 1], 0.012)
    assert links.pairs[life[2]].tolist() == [0, 2]
    assert life[:2].tolist() == [-1, -1]
