"""Catmull-Rom curves, the default hairline, and the length maps drawn over the square."""

import numpy as np
import pytest

from headstudio.head import length_maps
from headstudio.head.hairline import default_curves
from headstudio.head.head import HeadError
from headstudio.head.locate import Locator, locator
from headstudio.head.scalp_curves import SPACING, catmull_rom, sample_curves
from headstudio.head.scalp_settings import LENGTH_MAPS, GrayImage

from .bumpy_heads import bumpy_head, smooth_head

STEP = 1 / 65535  # Images hold 16 bits.


def test_a_catmull_rom_curve_goes_through_its_control_points():
    points = np.random.default_rng(0).random((7, 3))
    curve = catmull_rom(points)
    np.testing.assert_allclose(curve(curve.x), points, atol=1e-12)
    assert curve.x[0] == 0
    assert curve.x[-1] == 1


def test_evenly_spaced_control_points_give_the_classic_tangents():
    angle = np.linspace(0, 1.2, 6)
    points = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    curve = catmull_rom(points)
    classic = (points[3] - points[1]) / (curve.x[3] - curve.x[1])
    np.testing.assert_allclose(curve(curve.x[2], 1), classic, rtol=1e-9)


def test_control_points_on_a_line_give_a_line_and_uneven_ones_no_loop():
    parts = np.array([0, 0.01, 0.02, 0.9, 1.0])[:, None]
    curve = catmull_rom(parts * [1.0, 2.0, 3.0])
    along = curve(np.linspace(0, 1, 400))
    assert np.all(np.diff(along[:, 0]) > 0)
    np.testing.assert_allclose(along, along[:, :1] * [1, 2, 3], atol=1e-12)


def test_one_control_point_is_no_curve():
    with pytest.raises(HeadError, match="at least two"):
        catmull_rom(np.zeros((1, 3)))


def test_samples_are_close_together_and_keep_the_ends():
    head = smooth_head(4)
    curves = default_curves(head)
    for samples, points in zip(sample_curves(curves, locator(head.skin)), curves):
        np.testing.assert_allclose(samples[[0, -1]], points[[0, -1]], atol=1e-12)
        assert np.linalg.norm(np.diff(samples, axis=0), axis=1).max() < 1.05 * SPACING


@pytest.mark.parametrize("seed", range(8))
def test_default_control_points_lie_on_the_skin_around_the_crown(seed):
    head = bumpy_head(1000, seed)
    curves = default_curves(head)
    _, distance = Locator(head.skin.vertices, head.skin.faces).nearest(np.concatenate(curves))
    assert distance.max() < 0.004
    for curve, following in zip(curves, [*curves[1:], curves[0]]):
        np.testing.assert_array_equal(curve[-1], following[0])
    assert all(curve[:, 1].max() < head.landmarks.crown[1] for curve in curves)


@pytest.mark.parametrize("name", LENGTH_MAPS)
def test_length_maps_are_gray_images_alike_on_both_sides(name):
    pixels = length_maps.preset(name).pixels
    assert pixels.shape == (256, 256)
    assert pixels.dtype == np.float32
    assert 0 <= pixels.min() <= pixels.max() <= 1
    np.testing.assert_allclose(pixels, pixels[:, ::-1], atol=STEP)
    # No cut edges: neighbouring hair differs by at most 3 % of the length.
    assert np.abs(np.diff(pixels, axis=0)).max() < 0.03
    assert np.abs(np.diff(pixels, axis=1)).max() < 0.03


def test_what_the_named_maps_promise():
    forehead, crown, back, side = np.array([[[0.5, 0.02]], [[0.5, 0.4]], [[0.5, 0.9]], [[0.05, 0.2]]])

    def length(name: str, uv: np.ndarray) -> float:
        return float(length_maps.sample(length_maps.preset(name), uv)[0])

    assert length("even", forehead) == length("even", back) == 1
    # At the default 30 cm the fringe is 5 to 7 cm over the forehead.
    assert 0.05 <= 0.3 * length("fringe", forehead) <= 0.07
    assert length("fringe", back) == length("fringe", side) == 1
    assert length("long back", forehead) < 0.05
    assert length("long back", back) == 1
    assert length("bob", back) < length("bob", crown) < 1
    assert max(length("short", uv) for uv in (forehead, crown, back, side)) <= 0.25 + STEP
    assert length("short", back) < length("short", crown)


def test_images_are_sampled_like_textures():
    image = GrayImage(np.array([[0, 1], [0.5, 0.25]], dtype=np.float32))
    uv = np.array([[0.25, 0.25], [0.75, 0.25], [0.5, 0.25], [0.5, 0.5], [0, 0], [1, 1]])
    np.testing.assert_allclose(length_maps.sample(image, uv), [0, 1, 0.5, 0.4375, 0, 0.25], atol=STEP)
