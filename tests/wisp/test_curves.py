"""Editable curves: lengths follow their density, radii their control points."""

import numpy as np
import pytest
from scipy import stats

from headstudio.params import ParameterError
from headstudio.wisp.curves import LengthDistribution, checked_curve, deviation_radius
from headstudio.wisp.settings import DEVIATION_RADII, LENGTH_DISTRIBUTIONS, WispSettings

DRAWN = {
    "one bump": ((0.2, 0.0), (0.5, 3.0), (0.6, 0.0)),
    "two bumps and a gap": ((0.1, 0.0), (0.2, 1.0), (0.3, 0.0), (0.7, 0.0), (0.8, 2.0), (1.0, 0.0)),
    "flat": ((0.4, 1.0), (0.9, 1.0)),
    "needle": ((0.5, 0.0), (0.5001, 1.0), (0.5002, 0.0)),
}


@pytest.mark.parametrize("name", [*LENGTH_DISTRIBUTIONS, *DRAWN])
def test_lengths_pass_a_kolmogorov_smirnov_test_against_their_density(name):
    settings = WispSettings(length_curve=DRAWN[name]) if name in DRAWN else WispSettings(length_distribution=name)
    distribution = LengthDistribution.of(settings)
    lengths = distribution.sample(np.random.default_rng(1).random(100_000))
    # The distribution from its control points by another way: the integral of the density on a fine grid.
    x, y = distribution.points.T
    grid = np.unique(np.concatenate([np.linspace(x[0], x[-1], 20_001), x]))
    density = np.interp(grid, x, y)
    mass = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(grid))])
    assert stats.kstest(lengths, lambda u: np.interp(u, grid, mass / mass[-1])).pvalue > 0.01
    np.testing.assert_allclose(distribution.cumulative(grid), mass / mass[-1], atol=1e-6)


@pytest.mark.parametrize("name", DEVIATION_RADII)
def test_a_radius_is_smooth_and_never_negative(name):
    radius = deviation_radius(WispSettings(deviation_radius=name, radius=2.0), np.linspace(0, 1, 1001))
    assert radius.min() >= 0
    assert np.abs(np.diff(radius)).max() < 0.05


def test_a_radius_goes_through_its_control_points_and_no_further():
    points = ((0.0, 1.0), (0.4, 0.0), (0.6, 0.0), (1.0, 0.5))
    radius = deviation_radius(WispSettings(radius_curve=points), np.array([x for x, _ in points]))
    np.testing.assert_allclose(radius, [y for _, y in points], atol=1e-12)
    between = deviation_radius(WispSettings(radius_curve=points), np.linspace(0, 1, 500))
    assert 0 <= between.min() <= between.max() <= 1


@pytest.mark.parametrize(
    "points",
    [
        ((0.0, 1.0),),
        ((0.5, 1.0), (0.5, 1.0)),
        ((0.5, 1.0), (0.2, 1.0)),
        ((0.0, 1.0), (1.2, 1.0)),
        ((0.0, -1.0), (1.0, 1.0)),
        ((0.0, float("nan")), (1.0, 1.0)),
        tuple((k / 100, 1.0) for k in range(100)),
    ],
)
def test_what_is_no_curve_is_refused(points):
    with pytest.raises(ParameterError):
        checked_curve(points)


def test_a_density_of_nothing_is_refused():
    with pytest.raises(ParameterError, match="above zero"):
        LengthDistribution.of(WispSettings(length_curve=((0.0, 0.0), (1.0, 0.0))))
