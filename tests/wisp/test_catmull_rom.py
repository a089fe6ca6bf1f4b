"""Catmull-Rom splines as matrices."""

import numpy as np
import pytest

from headstudio.wisp.catmull_rom import catmull_rom_matrix


@pytest.mark.parametrize("count", [1, 2, 3, 4, 9])
def test_it_passes_through_its_control_points(count):
    np.testing.assert_allclose(catmull_rom_matrix(count, np.arange(count)), np.eye(count), atol=1e-12)


@pytest.mark.parametrize("count", [2, 3, 9])
def test_points_on_a_line_stay_on_it(count):
    at = np.linspace(0, count - 1, 31)
    np.testing.assert_allclose(catmull_rom_matrix(count, at) @ np.arange(count), at, atol=1e-12)
    np.testing.assert_allclose(catmull_rom_matrix(count, at).sum(axis=1), 1)


def test_its_tangent_at_a_control_point_is_half_the_chord_of_the_neighbours():
    points = np.random.default_rng(1).normal(size=(6, 3))
    step = 1e-6
    slope = (catmull_rom_matrix(6, [2 + step]) - catmull_rom_matrix(6, [2 - step])) @ points / (2 * step)
    np.testing.assert_allclose(slope[0], 0.5 * (points[3] - points[1]), atol=1e-5)


def test_parameters_beyond_the_ends_are_the_ends():
    np.testing.assert_allclose(catmull_rom_matrix(4, [-1, 9]), np.eye(4)[[0, 3]])
