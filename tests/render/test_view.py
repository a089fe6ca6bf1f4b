from __future__ import annotations

import math

import numpy as np
import pytest

from headstudio.head.mesh import Floats
from headstudio.render.view import View, camera_view, fitting, light_view, orbit_direction
from headstudio.scene.settings import Camera, Look


def projected(view: View, point: Floats) -> Floats:
    clip = view.clip_from_world @ np.append(point, 1.0)
    return clip[:3] / clip[3]


def test_camera_looks_at_its_target_from_the_side_it_says() -> None:
    camera = Camera(azimuth=math.pi / 2, elevation=0.0, distance=2.0, target_x=0.1, target_y=0.2, target_z=0.3)
    view = camera_view(camera, 1.5)
    np.testing.assert_allclose(view.eye, [2.1, 0.2, 0.3], atol=1e-12)  # the person's left is +X
    np.testing.assert_allclose(projected(view, np.array([0.1, 0.2, 0.3]))[:2], 0, atol=1e-12)
    assert projected(view, np.array([0.1, 0.3, 0.3]))[1] > 0  # up stays up
    assert projected(view, np.array([0.1, 0.2, 0.2]))[0] > 0  # from the left, backwards is to the right


def test_field_of_view_is_vertical() -> None:
    camera = Camera(azimuth=0.0, elevation=0.0, distance=1.0, target_y=0.0, field_of_view=math.radians(40))
    top = np.array([0.0, math.tan(math.radians(20)), 0.0])
    for aspect in (0.5, 1.0, 2.0):
        assert projected(camera_view(camera, aspect), top)[1] == pytest.approx(1.0)


@pytest.mark.parametrize("height", [-0.3, 0.0, 1.0, math.pi / 2])
def test_light_box_holds_its_sphere(height: float) -> None:
    centre, radius = np.array([0.1, -0.2, 0.05]), 0.3
    view = light_view(Look(light_azimuth=0.7, light_height=height), centre, radius)
    np.testing.assert_allclose(projected(view, centre), [0, 0, 0], atol=1e-12)
    nearest = centre + radius * orbit_direction(0.7, height)
    np.testing.assert_allclose(projected(view, nearest), [0, 0, -1], atol=1e-9)
    assert view.depth(nearest) == pytest.approx(0.0, abs=1e-12)
    axes = np.stack([view.right, view.up, view.forward])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)


@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.0])
def test_a_fitting_camera_sees_all_points_and_little_else(aspect: float) -> None:
    points = np.random.default_rng(3).normal(0.3, 0.1, (200, 3)) * [0.3, 2.0, 0.5]
    camera = Camera(azimuth=0.7, elevation=0.3)
    fitted = fitting(camera, points, aspect)
    assert (fitted.azimuth, fitted.elevation) == (camera.azimuth, camera.elevation)
    clip = np.column_stack([points, np.ones(200)]) @ camera_view(fitted, aspect).clip_from_world.T
    seen = np.abs(clip[:, :2] / clip[:, 3:])
    assert 0.8 < seen.max() < 1.0
