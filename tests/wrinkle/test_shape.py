"""Equations 2.1, 2.2 and 2.4."""

import numpy as np
import pytest
from scipy.integrate import quad

from headstudio.wrinkle.shape import REACH, amplitude, bounded_shape, bounded_slope, wrinkle_shape

D, W = 3e-3, 2.5e-3
FURROW = D * W / np.e  # what is missing on one side of the floor, per length


def test_the_shape_function_is_the_printed_one():
    l = np.array([0.0, W, 2 * W, 5 * W])  # noqa: E741
    assert np.allclose(wrinkle_shape(l, D, W), D * (l / W - 1) * np.exp(-l / W), atol=1e-18)
    assert wrinkle_shape(np.array([0.0]), D, W)[0] == -D


@pytest.mark.parametrize(("shape", "end"), [(wrinkle_shape, 60 * W), (bounded_shape, REACH * W)])
def test_its_integral_is_zero(shape, end):
    def height(distance):
        return float(shape(np.array(distance), D, W))

    depressed, _ = quad(height, 0, W, epsabs=1e-16)
    raised, _ = quad(height, W, end, epsabs=1e-16, limit=200)
    assert depressed == pytest.approx(-FURROW, rel=1e-9)
    assert abs(depressed + raised) < 1e-6 * FURROW


def test_the_bounded_shape_ends_and_is_close_to_the_printed_one():
    l = np.linspace(0, 12 * W, 5000)  # noqa: E741
    assert np.abs(bounded_shape(l, D, W) - wrinkle_shape(l, D, W)).max() < 0.008 * D
    assert (bounded_shape(l[l >= REACH * W], D, W) == 0).all()
    step = 1e-9
    numeric = (bounded_shape(l[1:] + step, D, W) - bounded_shape(l[1:] - step, D, W)) / (2 * step)
    assert np.allclose(bounded_slope(l[1:], D, W), numeric, atol=1e-5 * D / W)


@pytest.mark.parametrize("r", [0.0, 1e-3, 0.1, 0.37, 0.5, 0.9, 1.0])
def test_amplitude_is_smooth_at_rest(r):
    step = 1e-7
    before, rest, after = amplitude(np.array([-step, 0.0, step]), r)
    assert rest == r
    assert abs((after - rest) - (rest - before)) / step < 1e-3


def test_amplitude_grows_with_shrinkage_to_one_and_dies_with_stretch():
    s = np.linspace(-1, 1, 401)
    for r in (0.0, 0.2, 0.7, 1.0):
        m = amplitude(s, r)
        assert (np.diff(m) >= 0).all()
        assert m[-1] == pytest.approx(1.0, abs=5.1e-3)
    assert np.allclose(amplitude(s[s >= 0], 0.2), 0.8 * s[s >= 0] + 0.2)
    assert np.allclose(amplitude(s[s < 0], 0.2), 0.2 * np.exp(4 * s[s < 0]))
    assert (amplitude(s[s < 0], 0.0) == 0).all()
    assert np.abs(amplitude(s[s > 0], 0.0) - s[s > 0]).max() <= 5.001e-3
