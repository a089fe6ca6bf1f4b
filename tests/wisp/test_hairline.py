"""Toward the border of the scalp hair is finer and sparser."""

import numpy as np
import pytest

from headstudio.head.scalp_settings import GrayImage
from headstudio.wisp.follicles import scatter_strands, spread_wisps
from headstudio.wisp.hairline import fineness, thinning

from .dressed import body

BREADTH = 0.012  # [m]
EVEN = GrayImage(np.ones((2, 2)))


def within(scalp, places):
    """How far within the hairline places are, in its breadths: at the nape it is twice as broad."""
    front, left, back, right = scalp.curves
    distances = [
        np.linalg.norm(places[:, None] - np.concatenate(curves), axis=2).min(axis=1)
        for curves in ((front, left, right), (back,))
    ]
    return np.minimum(distances[0] / BREADTH, distances[1] / (2 * BREADTH))


@pytest.mark.parametrize(("part_of", "at_border"), [(fineness, 0.5), (thinning, 0.5)])
def test_hair_is_finer_and_sparser_the_nearer_to_the_border(part_of, at_border):
    scalp = body()[1]
    places = scalp.points(scalp.random_points(3000, np.random.default_rng(1)))
    part, inside = part_of(scalp, places, BREADTH, *([1] if part_of is fineness else [])), within(scalp, places)
    assert np.all(part[inside > 2.0] == 1.0)
    means = [part[(inside >= a) & (inside < a + 0.35)].mean() for a in (0.0, 0.35, 0.7, 1.05)]
    assert np.all(np.diff(means) > 0)
    assert means[0] < at_border
    # No line: side by side there is more and less.
    assert part[np.abs(inside - 0.5) < 0.1].std() > 0.1


def test_strands_are_sparser_toward_the_border_by_as_much():
    scalp = body()[1]
    counts = []
    for breadth in (0.0, BREADTH):
        roots, _ = scatter_strands(spread_wisps(scalp, EVEN, 500, None, 1, breadth), 20_000, 1)
        inside = within(scalp, roots)
        counts.append([np.sum(inside < 0.5), np.sum(inside > 2.0)])
    (border, middle), (thin, rest) = counts
    places = scalp.points(scalp.random_points(4000, np.random.default_rng(2)))
    wanted = thinning(scalp, places[within(scalp, places) < 0.5], BREADTH).mean()
    assert thin / rest / (border / middle) == pytest.approx(wanted, abs=0.08)


def test_a_hairline_of_no_breadth_leaves_all_hair_alike():
    scalp = body()[1]
    roots = scalp.points(scalp.random_points(300, np.random.default_rng(1)))
    assert np.all(fineness(scalp, roots, 0.0, seed=1) == 1.0)
    assert np.all(thinning(scalp, roots, 0.0) == 1.0)
    assert fineness(scalp, roots[:0], 0.01, seed=1).shape == (0,)
