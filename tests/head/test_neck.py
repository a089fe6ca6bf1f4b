"""The neck against the bend that it undoes."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.head.neck import NO_NECK, Neck, turned_by

NECK = Neck(np.array([0.0, 1.0, 0.3]) / np.hypot(1.0, 0.3), -0.05, 0.11)
TURNS = ([0.4, 0.0, 0.0], [-0.4, 0.1, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.1, -0.6, 0.3])


def around_the_neck(count=500):
    return np.random.default_rng(4).uniform([-0.07, -0.2, -0.07], [0.07, 0.03, 0.07], (count, 3))


def test_the_share_falls_from_one_to_nothing():
    up = NECK.upward
    heights = np.array([0.1, -0.05, -0.105, -0.16, -0.3])
    np.testing.assert_allclose(NECK.share(heights[:, None] * up), [1, 1, 0.5, 0, 0], atol=1e-12)
    step = 1e-6
    points = around_the_neck()
    slope = (NECK.share(points + step * up) - NECK.share(points - step * up)) / (2 * step)
    np.testing.assert_allclose(NECK.slope(points), slope, atol=1e-4)
    assert np.array_equal(NECK.reaches(points), NECK.share(points) < 1)


@pytest.mark.parametrize("turn", TURNS)
def test_a_turn_by_a_share(turn):
    points = around_the_neck()
    share = NECK.share(points)
    turn = np.array(turn)
    expected = Rotation.from_rotvec(share[:, None] * turn).apply(points)
    np.testing.assert_allclose(turned_by(points, turn, share), expected, atol=1e-14)


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("way", [0, 1], ids=["from above", "from below"])
def test_what_is_bent_is_led_back(turn, way):
    """Around a neck that does not fold up there is one place at rest for every place, and both ways come to it."""
    rest = around_the_neck()
    bent = HeadFrame(rotation=Rotation.from_rotvec(turn)).skinned(rest, NECK.share(rest))
    share = NECK.shares_when_bent(bent, np.array(turn))[way]
    np.testing.assert_allclose(share, NECK.share(rest), atol=2e-3)
    np.testing.assert_allclose(turned_by(bent, np.array(turn), -share), rest, atol=2e-4)


@pytest.mark.parametrize("turn", TURNS)
def test_normals_stay_square_to_what_they_were_square_to(turn):
    """Against two ways along the surface, bent by a difference quotient; and their length is how distances shrink."""
    turn = np.array(turn)
    rest = around_the_neck()
    rng = np.random.default_rng(5)
    ways = rng.normal(size=(2, len(rest), 3))
    normals = np.cross(*ways)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)

    def bend(points):
        return turned_by(points, turn, NECK.share(points))

    step = 1e-6
    bent_normals = turned_by(NECK.bent_normals(rest, normals, turn), turn, NECK.share(rest))
    for way in ways:
        bent_way = (bend(rest + step * way) - bend(rest - step * way)) / (2 * step)
        np.testing.assert_allclose(np.einsum("ij,ij->i", bent_way, bent_normals), 0, atol=1e-6)
    off = (bend(rest + step * normals) - bend(rest - step * normals)) / (2 * step)
    np.testing.assert_allclose(np.einsum("ij,ij->i", off, bent_normals), 1, atol=1e-6)


def test_a_head_alone_turns_wholly():
    points = around_the_neck()
    assert np.array_equal(NO_NECK.share(points), np.ones(len(points)))
    assert not NO_NECK.reaches(points).any()
