"""The smoothing kernel, eq. 2."""

import numpy as np
import pytest
from scipy.integrate import quad

from headstudio.lcp.kernel import kernel, kernel_slope

H = 0.013


@pytest.mark.parametrize(
    ("q", "bracket"), [(0.0, 4.0), (0.5, 4 - 6 * 0.25 + 3 * 0.125), (1.0, 1.0), (1.5, 0.125), (2.0, 0.0), (7.0, 0.0)]
)
def test_it_has_the_values_of_equation_2(q, bracket):
    assert kernel(np.array(q * H), H) == pytest.approx(bracket / (4 * np.pi * H**3), rel=1e-12, abs=1e-12)


def test_its_integral_over_space_is_one():
    total = quad(lambda r: 4 * np.pi * r**2 * kernel(np.array(r), H), 0, 2 * H, points=[H])[0]
    assert total == pytest.approx(1.0, rel=1e-10)


def test_it_reproduces_a_gradient():
    """The first moment of the slope is -3, so that SPH differentiates a linear field exactly."""
    moment = quad(lambda r: 4 * np.pi * r**3 * kernel_slope(np.array(r), H), 0, 2 * H, points=[H])[0]
    assert moment == pytest.approx(-3.0, rel=1e-10)


def test_it_is_flat_at_its_middle_and_at_its_rim():
    np.testing.assert_array_equal(kernel_slope(np.array([0.0, 2 * H, 2.5 * H]), H), 0)


def test_its_slope_is_its_derivative():
    r, step = np.linspace(0.01, 1.99, 97) * H, 1e-6 * H
    rise = (kernel(r + step, H) - kernel(r - step, H)) / (2 * step)
    np.testing.assert_allclose(kernel_slope(r, H), rise, rtol=1e-5, atol=1e-6 / H**4)
    assert np.all(kernel_slope(r, H) < 0)


def test_it_takes_any_shape():
    r = np.linspace(0, 3 * H, 12).reshape(2, 3, 2)
    assert kernel(r, H).shape == kernel_slope(r, H).shape == r.shape
