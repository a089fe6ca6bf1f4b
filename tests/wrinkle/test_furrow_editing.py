"""Furrows in an artist's hands: drawn, bent, cut finer, turned to the other side."""

import numpy as np
import pytest

from headstudio.wrinkle.default_furrows import default_furrows
from headstudio.wrinkle.furrow import Furrow
from headstudio.wrinkle.furrow_editing import (
    STROKE_TOLERANCE,
    drawn_furrow,
    free_name,
    mirrored,
    shifted,
    with_control,
    with_point,
    without_point,
)

ARC = Furrow(
    "arc left",
    "forehead",
    controls=((0.0, 0.0), (0.01, 0.0), (0.02, 0.01), (0.03, 0.01), (0.04, 0.01), (0.05, 0.0), (0.06, 0.02)),
)


def away(points, furrow):
    """How far points, (k, 2), lie from a furrow at most."""
    line = furrow.chain.sampled(400)[1]
    return np.linalg.norm(np.asarray(points)[:, None] - line, axis=2).min(axis=1).max()


@pytest.mark.parametrize(("height", "region"), [(0.038, "forehead"), (-0.13, "neck")])
def test_a_stroke_is_a_furrow_like_those_around_it(height, region):
    rng = np.random.default_rng(3)
    x = np.linspace(-0.03, 0.03, 80)
    stroke = np.stack([x, height + 0.004 * np.sin(90 * x)], axis=1) + rng.normal(0, 1e-4, (80, 2))
    furrow = drawn_furrow(stroke, 0.6)
    assert away(stroke, furrow) < STROKE_TOLERANCE
    assert len(furrow.controls) <= 13, "few handles, for all the trembling"
    assert furrow.region == region
    like = next(other for other in default_furrows(0.6) if other.region == region)
    assert furrow.initial == like.initial
    assert furrow.width == like.width


def test_a_stroke_needs_two_points():
    with pytest.raises(ValueError, match="at least two points"):
        drawn_furrow(np.array([[0.01, 0.02]] * 5), 0.5)


def test_names_are_free():
    taken = tuple(Furrow(f"chin new {k}") for k in (1, 3))
    assert free_name("chin", taken) == "chin new 2"
    assert free_name("chin", ()) == "chin new 1"


def test_a_point_of_the_curve_takes_its_handles_along():
    moved = np.array(with_control(ARC, 3, np.array([0.03, 0.015])).controls)
    change = moved - np.array(ARC.controls)
    np.testing.assert_allclose(change[2:5], [[0, 0.005]] * 3)
    assert not change[[0, 1, 5, 6]].any()


def test_a_smooth_joint_stays_smooth_and_a_corner_a_corner():
    bent = np.array(with_control(ARC, 4, np.array([0.04, 0.02])).controls)
    ahead, behind = bent[4] - bent[3], bent[2] - bent[3]
    assert ahead @ behind == pytest.approx(-np.linalg.norm(ahead) * np.linalg.norm(behind))
    assert np.linalg.norm(behind) == pytest.approx(0.01), "the other handle keeps its length"
    corner = with_control(ARC, 3, np.array([0.03, 0.01]))
    corner = Furrow("corner", controls=(*corner.controls[:2], (0.03, 0.0), *corner.controls[3:]))
    kept = with_control(corner, 4, np.array([0.04, 0.02]))
    assert kept.controls[2] == corner.controls[2]


def test_the_handles_at_the_ends_are_free():
    moved = with_control(ARC, 1, np.array([0.0, 0.01]))
    assert moved.controls[1] == (0.0, 0.01)
    assert moved.controls[:1] + moved.controls[2:] == ARC.controls[:1] + ARC.controls[2:]


def test_shifting_moves_all_of_it():
    np.testing.assert_allclose(shifted(ARC, np.array([0.001, -0.002])).controls, np.add(ARC.controls, [0.001, -0.002]))


@pytest.mark.parametrize("t", [0.0, 0.3, 0.999, 1.5, 2.0])
def test_another_point_leaves_the_course_as_it_is(t):
    finer = with_point(ARC, ARC.chain.at(np.array(t)))
    assert finer.chain.count == 3
    assert away(finer.chain.sampled(50)[1], ARC) < 1e-4
    assert away(ARC.chain.sampled(50)[1], finer) < 1e-4


def test_a_point_that_goes_leaves_the_course_nearly_as_it_was():
    finer = with_point(ARC, ARC.chain.at(np.array(0.4)))
    assert away(without_point(finer, 3).chain.sampled(50)[1], ARC) < 2e-4
    assert without_point(ARC, 0).controls == ARC.controls[3:]
    assert without_point(ARC, 6).controls == ARC.controls[:4]
    assert without_point(without_point(ARC, 0), 0) is None


def test_the_other_side():
    right = mirrored(ARC)
    assert right.name == "arc right"
    np.testing.assert_allclose(right.controls, np.array(ARC.controls) * [-1, 1])
    assert mirrored(right) == ARC
    assert mirrored(ARC, (right,)).name == "forehead new 1", "no name twice"
