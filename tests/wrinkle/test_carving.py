"""Carved fields, measured from their segments: what section 2.6.2 asks for."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from headstudio.wrinkle.carving import CarvedField, carve
from headstudio.wrinkle.direction_field import DirectionField
from headstudio.wrinkle.laws import LAWS
from headstudio.wrinkle.texels import texel_map

from .carved_sheets import crossings, distance_to_furrows, sheet, tube, uniform_field
from .sequential_carving import carve_one_by_one

PRINTED = LAWS["printed"]
DEPTH = 1e-4


def _swirl(size: int, strength: float = 0.6) -> DirectionField:
    """A field that turns around a point and is weak near it."""
    texture_map = sheet(low=0.1, high=0.9)
    away = texture_map.uv - [0.45, 0.55]
    vectors = strength * np.stack([-away[:, 1], away[:, 0]], axis=1) / np.maximum(0.2, np.hypot(*away.T))[:, None]
    return DirectionField(texel_map(texture_map, size), vectors)


@pytest.fixture(scope="module", params=[1, 2, 3])
def swirl(request: pytest.FixtureRequest) -> CarvedField:
    return carve(_swirl(128), PRINTED, depth=DEPTH, seed=request.param)


def test_no_furrow_crosses_another(swirl: CarvedField) -> None:
    assert swirl.segments.furrows.max() > 50
    assert crossings(swirl.segments) == 0


def test_no_starting_point_is_left(swirl: CarvedField) -> None:
    assert swirl.occupied.all()


def test_the_mapped_area_is_within_reach_of_furrows(swirl: CarvedField) -> None:
    points = swirl.texels.centres(np.flatnonzero(swirl.texels.mapped))
    _, beyond_strip = distance_to_furrows(swirl.segments, points)
    # A furrow starts anywhere in a texel, and then claims at least this texel.
    assert (beyond_strip <= 1e-9).mean() > 0.995
    assert beyond_strip.max() < 0.75


def test_angles_to_the_field_follow_the_law() -> None:
    segments = carve(_swirl(320), PRINTED, depth=DEPTH, seed=1).segments
    steps = segments.steps
    theta = np.arctan2(
        segments.directions[:, 0] * steps[:, 1] - segments.directions[:, 1] * steps[:, 0],
        (segments.directions * steps).sum(axis=1),
    )
    allowed = 0.5 - 0.4 * segments.magnitudes
    relative = theta / allowed
    assert np.abs(relative).max() <= 1
    # r is uniform in (-1, 1): mean 0, variance 1/3.
    assert abs(relative.mean()) < 0.05
    assert relative.var() == pytest.approx(1 / 3, rel=0.05)


def test_the_direction_is_that_of_the_field_at_the_start_of_a_segment(swirl: CarvedField) -> None:
    sample = _swirl(128).at(swirl.segments.starts)
    along = np.where(swirl.segments.sides == 0, 1, -1)[:, None] * sample.directions
    np.testing.assert_allclose(swirl.segments.directions, along, atol=1e-12)
    np.testing.assert_allclose(swirl.segments.magnitudes, sample.magnitudes, atol=1e-12)


def test_segments_have_the_length_and_number_of_the_laws(swirl: CarvedField) -> None:
    segments = swirl.segments
    np.testing.assert_allclose(np.linalg.norm(segments.steps, axis=1), 4 + 2 * segments.magnitudes)
    assert (segments.order <= np.floor(30 - 20 * segments.magnitudes.min())).all()
    follows = np.flatnonzero(np.diff(segments.order) == 1) + 1
    expected = np.minimum(segments.left[follows - 1] - 1, np.floor(30 - 20 * segments.magnitudes[follows]))
    np.testing.assert_array_equal(segments.left[follows], expected)


def test_a_furrow_ends_on_another_at_the_edge_or_after_its_segments(swirl: CarvedField) -> None:
    segments = swirl.segments
    side = 2 * segments.furrows + segments.sides
    last = np.append(side[1:] != side[:-1], True)
    ends, reasons = segments[last], np.zeros(last.sum(), dtype=int)
    for k in range(len(ends)):
        if ends.reach[k] < 1:
            # Its own last two segments touch it anyway; it may have come back to older ones.
            own = (side == side[last][k]) & (segments.order >= ends.order[k] - 1)
            rest = segments[~own]
            away, _ = distance_to_furrows(rest, ends.ends[k][None])
            assert away[0] < 1e-6
            reasons[k] = 1
        elif ends.left[k] > 0:
            assert swirl.texels.triangle_at(ends.ends[k][None])[0] < 0
            reasons[k] = 2
    assert (segments.reach[~last] == 1).all()
    assert (reasons == 1).sum() > 50
    assert (reasons == 2).any()


def test_the_same_seed_gives_the_same_furrows_and_another_one_others() -> None:
    first, same, other = (carve(_swirl(96), PRINTED, depth=DEPTH, seed=seed) for seed in (5, 5, 6))
    np.testing.assert_array_equal(first.height, same.height)
    np.testing.assert_array_equal(first.segments.starts, same.segments.starts)
    assert not np.array_equal(first.height, other.height)


@pytest.mark.parametrize("batch", [1, 7, 150])
def test_how_many_grow_at_once_changes_nothing(batch: int) -> None:
    field = _swirl(64)
    usual = carve(field, PRINTED, depth=DEPTH, seed=3)
    other = carve(field, PRINTED, depth=DEPTH, seed=3, batch=batch)
    np.testing.assert_array_equal(other.segments.ends, usual.segments.ends)
    np.testing.assert_array_equal(other.segments.furrows, usual.segments.furrows)
    np.testing.assert_array_equal(other.height, usual.height)


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("magnitude", [0.2, 0.7])
def test_furrows_are_those_of_the_printed_steps_one_by_one(seed: int, magnitude: float) -> None:
    field = uniform_field(sheet(low=0.1, high=0.9), 56, magnitude)
    carved = carve(field, PRINTED, depth=DEPTH, seed=seed).segments
    expected = np.array(carve_one_by_one(field, seed))
    np.testing.assert_allclose(carved.starts, expected[:, 0], atol=1e-9)
    np.testing.assert_allclose(carved.ends, expected[:, 1], atol=1e-9)


@pytest.fixture(scope="module")
def by_magnitude() -> dict[float, CarvedField]:
    return {m: carve(uniform_field(sheet(), 160, m), PRINTED, depth=DEPTH, seed=1) for m in (0.2, 0.5, 0.8)}


def test_a_stronger_field_has_furrows_wider_apart(by_magnitude: dict[float, CarvedField]) -> None:
    apart = []
    for magnitude, carved in by_magnitude.items():
        carved_length = (carved.segments.reach * np.linalg.norm(carved.segments.steps, axis=1)).sum()
        apart.append(carved.texels.mapped.sum() / carved_length / (1 + 12 * magnitude))
    # In strip widths it is the same: a little less than half of one, where furrows draw near before they meet.
    assert np.diff([a * (1 + 12 * m) for a, m in zip(apart, by_magnitude)]).min() > 1
    assert 0.4 < min(apart) < max(apart) < min(0.6, 1.1 * min(apart))


def test_furrows_start_half_a_strip_from_older_ones(by_magnitude: dict[float, CarvedField]) -> None:
    for magnitude, carved in by_magnitude.items():
        segments = carved.segments
        for furrow in range(1, int(segments.furrows.max()) + 1, 29):
            start = segments.starts[(segments.furrows == furrow) & (segments.order == 0)][:1]
            away, _ = distance_to_furrows(segments[segments.furrows < furrow], start)
            # Occupied are texels, by their centres.
            assert away[0] > 0.5 * (1 + 12 * magnitude) - np.sqrt(0.5)


def test_grooves_get_deeper_and_wider_with_the_field() -> None:
    previous = 0.0
    for magnitude in (0.3, 0.6, 1.0):
        carved = carve(uniform_field(sheet(), 256, magnitude, unit=6.0), PRINTED, depth=DEPTH, seed=1)
        assert carved.height.min() == pytest.approx(-DEPTH * magnitude**2, rel=0.02)
        points = carved.texels.centres(np.flatnonzero(carved.height < 0))
        away, _ = distance_to_furrows(carved.segments, points)
        assert away.max() == pytest.approx(6 * magnitude, abs=0.75)
        assert away.max() > previous
        previous = away.max()


def test_a_groove_thinner_than_texels_keeps_its_volume() -> None:
    fields = [uniform_field(sheet(), 256, 0.8, unit=unit) for unit in (1.0, 4.0)]
    volumes = []
    for field in fields:
        carved = carve(field, PRINTED, depth=DEPTH, seed=1)
        segments = carved.segments
        length = (segments.reach * np.linalg.norm(segments.steps, axis=1)).sum()
        volumes.append(-float(carved.height.sum()) / length / field.units[0])
    # Per length and unit; what grooves share where they meet is not counted twice.
    assert volumes[0] == pytest.approx(volumes[1], rel=0.15)


def test_furrows_cross_the_seam_of_a_tube_and_go_on() -> None:
    carved = carve(uniform_field(tube(), 96, 0.6, angle=0.3), PRINTED, depth=DEPTH, seed=2)
    segments = carved.segments
    assert crossings(segments, period=96) == 0
    over = np.floor(segments.starts[:, 0] / 96) != np.floor(segments.ends[:, 0] / 96)
    assert over.sum() > 10
    # As deep, and as many, at the seam as anywhere else.
    columns = carved.height[12:-12].mean(axis=0)
    assert columns[[0, -1]].mean() == pytest.approx(columns.mean(), rel=0.25)
    steps = np.abs(np.diff(carved.height, axis=1, append=carved.height[:, :1])).mean(axis=0)
    assert steps[-1] < 1.5 * steps.mean()
    assert carved.occupied.all()


def test_a_furrow_that_comes_back_to_itself_ends_there() -> None:
    texture_map = sheet()
    away = texture_map.uv - 0.5
    vectors = 0.95 * np.stack([-away[:, 1], away[:, 0]], axis=1) / np.maximum(np.hypot(*away.T), 1e-9)[:, None]
    longer = replace(PRINTED, segments=(60, 0, 0))
    carved = carve(DirectionField(texel_map(texture_map, 96), vectors), longer, depth=DEPTH, seed=4)
    segments = carved.segments
    split = replace(segments, furrows=np.arange(len(segments)))
    assert crossings(split) == 0


def test_512_texels_take_less_than_a_second() -> None:
    field = uniform_field(sheet(), 512, 0.5)
    spent = []
    for seed in range(2):
        start = time.process_time()
        carve(field, PRINTED, depth=DEPTH, seed=seed)
        spent.append(time.process_time() - start)
    assert min(spent) < 1.0
