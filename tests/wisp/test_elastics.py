"""What an elastic does: it lies where the hair does, square to it, and all that it holds goes through it."""

import numpy as np
import pytest

from headstudio.head.rows import row_unit
from headstudio.wisp.elastics import Elastic, elastics_of
from headstudio.wisp.hairdressing import Grip
from headstudio.wisp.operations import Braid, Bun, Tie
from headstudio.wisp.outlines import Outlines
from headstudio.wisp.selection import Selection

from .dressed import body, hair, styled, weight

AXIS = np.array([0.0, 0.6, -0.8])
MIDDLE = np.array([0.01, 0.02, 0.03])


def bundle(count: int = 200, reach: float = 0.008, seed: int = 2) -> Outlines:
    """Straight wisps along AXIS through a disc of ``reach`` [m] around MIDDLE."""
    rng = np.random.default_rng(seed)
    turn, out = rng.uniform(0, 2 * np.pi, count), reach * np.sqrt(rng.random(count))
    side = row_unit(np.cross(AXIS, [[1.0, 0.0, 0.0]]), otherwise=AXIS[None])[0]
    across = out[:, None] * (np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * np.cross(AXIS, side))
    frame = np.stack([side, np.cross(AXIS, side), AXIS], axis=1)
    return Outlines(
        roots=MIDDLE - 0.05 * AXIS + across,
        segment=0.01,
        counts=np.full(count, 10),
        frames=np.broadcast_to(frame, (count, 10, 3, 3)),
        radii=np.zeros((count, 11)),
        strands=np.full(count, 10),
    )


def strands_of(outlines: Outlines) -> np.ndarray:
    return outlines.joints.astype(np.float32)


def passing(points: np.ndarray, elastic: Elastic) -> np.ndarray:
    """How far from the elastic's middle strands pass through its plane [m]."""
    height = (points - elastic.middle) @ elastic.axis
    strand, place = np.nonzero((height[:, :-1] <= 0) & (height[:, 1:] > 0))
    low, high = height[strand, place], height[strand, place + 1]
    part = (-low / (high - low))[:, None]
    crossing = (1 - part) * points[strand, place] + part * points[strand, place + 1]
    return np.linalg.norm(crossing - elastic.middle, axis=1)


def test_an_elastic_lies_where_the_hair_does_and_square_to_it():
    outlines = bundle()
    askew = Grip(MIDDLE + np.array([0.003, 0.0, 0.002]), np.array([0.0, 0.0, -1.0]), 0.015, None)
    elastic = Elastic.around(outlines, askew, np.ones(200, dtype=bool))
    np.testing.assert_allclose(elastic.axis, AXIS, atol=1e-9)
    beside = elastic.middle - MIDDLE - (elastic.middle - MIDDLE) @ AXIS * AXIS
    assert np.linalg.norm(beside) < 0.001
    # Three quarters of an even disc lie within sqrt(3) / 2 of its radius.
    assert elastic.radius == pytest.approx(0.008 * np.sqrt(0.75), rel=0.06)


def test_an_elastic_is_no_wider_than_it_is_told_to_be():
    elastic = Elastic.around(bundle(), Grip(MIDDLE, AXIS, 0.003, None), np.ones(200, dtype=bool))
    assert elastic.radius == 0.003


def test_hair_that_does_not_come_near_leaves_the_elastic_where_it_was_wanted():
    away = Grip(MIDDLE + np.array([0.5, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]), 0.01, None)
    elastic = Elastic.around(bundle(), away, np.ones(200, dtype=bool))
    np.testing.assert_array_equal(elastic.middle, away.middle)
    np.testing.assert_array_equal(elastic.axis, away.axis)
    assert elastic.radius == away.radius


def test_all_that_is_held_goes_through_and_hair_farther_off_stays_in_order():
    outlines = bundle(reach=0.02)
    elastic = Elastic(MIDDLE, AXIS, 0.01, np.ones(200, dtype=bool), None)
    before = strands_of(outlines)
    after = elastic.pressed(before.copy(), np.arange(200))
    was, now = passing(before, elastic), passing(after, elastic)
    assert now.max() <= 0.01
    order = np.argsort(was)
    assert np.all(np.diff(now[order]) > -1e-7)
    # Well inside nothing is moved, and neither is what is a radius and more away along the hair.
    np.testing.assert_allclose(now[was < 0.003], was[was < 0.003], rtol=0.01)
    far = np.abs((before - MIDDLE) @ AXIS) > 0.0151
    np.testing.assert_array_equal(after[far], before[far])


def test_other_hair_and_hair_that_passes_by_stays():
    outlines = bundle(reach=0.02)
    wisps = np.arange(200) < 100
    elastic = Elastic(MIDDLE, AXIS, 0.006, wisps, None)
    before = strands_of(outlines)
    after = elastic.pressed(before.copy(), np.arange(200))
    np.testing.assert_array_equal(after[100:], before[100:])
    by = passing(before, elastic) >= 0.018
    assert by[:100].any()
    np.testing.assert_array_equal(after[by], before[by])


def test_a_tie_on_a_head_holds_nearly_all_of_its_hair():
    _, scalp, surroundings = body()
    outlines = hair(scalp, length=0.4)
    tie = Tie()
    laid, _ = styled(outlines, operations=(tie,))
    (elastic,) = elastics_of((tie,), laid, surroundings, weight(), scalp.locate(outlines.roots))
    before = strands_of(laid)
    after = elastic.pressed(before.copy(), np.arange(len(before)))
    assert elastic.radius <= tie.tolerance
    inside = passing(after, elastic) <= elastic.radius
    assert inside.sum() >= 0.97 * len(before)
    assert inside.sum() > (passing(before, elastic) <= elastic.radius).sum()


def test_hair_that_two_operations_select_is_held_by_the_last():
    _, scalp, surroundings = body()
    outlines = hair(scalp)
    uv = scalp.locate(outlines.roots)
    first, last = Tie(), Braid(Selection("left"))
    held, plaited = elastics_of((first, Bun(Selection("u < 0.1")), last), outlines, surroundings, weight(), uv)
    assert not (held.wisps & plaited.wisps).any()
    np.testing.assert_array_equal(plaited.wisps, Selection("left").of(uv))
    np.testing.assert_array_equal(held.wisps, ~plaited.wisps & ~Selection("u < 0.1").of(uv))


def test_a_tail_is_round_grows_full_and_lies_on_the_head_below_its_tie():
    _, scalp, surroundings = body()
    outlines = hair(scalp, length=0.45)
    tie = Tie(place=(0.0, 0.6, -0.95))
    laid, report = styled(outlines, operations=(tie,))
    assert report.queues[0].too_short < 0.02 * len(outlines.roots)
    tail = laid.joints[np.arange(len(outlines.roots)), outlines.counts - 8]
    aside = np.abs(tail[:, 0]).max()
    assert 1.2 * tie.tolerance < aside < 3.0 * tie.tolerance
    assert surroundings.distance(tail).max() < 0.09
    # Behind the head, at every height: no slab to either side with a gap between.
    assert np.histogram(tail[:, 0], 6, (-aside, aside))[0].min() > 0
