"""Moving the camera: orbit, pan, zoom, and the framing keys. Pure functions from a camera to the next."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..head.mesh import Floats
from ..params import parameters_of
from ..render.view import camera_view, fitting
from ..scene.settings import Camera

ORBIT_RATE = math.pi  # a drag over the height of the view turns by half a turn
ZOOM_RATE = 1.12  # one notch of the wheel


def orbit(camera: Camera, across: float, down: float) -> Camera:
    """Turn about the target; ``across`` and ``down`` are the drag in heights of the view."""
    azimuth = camera.azimuth - ORBIT_RATE * across
    elevation = camera.elevation + ORBIT_RATE * down
    return _within_range(replace(camera, azimuth=math.remainder(azimuth, 2 * math.pi), elevation=elevation))


def pan(camera: Camera, across: float, down: float) -> Camera:
    """Move sideways, so that the target plane follows the mouse; the drag in heights of the view."""
    right, up, _ = axes(camera)
    height = 2 * camera.distance * math.tan(camera.field_of_view / 2)
    return _looking_at(camera, target(camera) + height * (down * up - across * right))


def zoom(camera: Camera, notches: float) -> Camera:
    """Come nearer by notches of the wheel (or go away, when negative)."""
    return _within_range(replace(camera, distance=camera.distance / ZOOM_RATE**notches))


def frame(camera: Camera, points: Floats, aspect: float, margin: float = 1.08) -> Camera:
    """See all of ``points`` [m], shape (n, 3), from the same side. ``aspect``: width over height of the view."""
    return _within_range(fitting(camera, points, aspect, margin))


def target(camera: Camera) -> Floats:
    """What the camera looks at [m], shape (3,)."""
    return np.array([camera.target_x, camera.target_y, camera.target_z])


def axes(camera: Camera) -> tuple[Floats, Floats, Floats]:
    """Unit vectors to the right, up, and backward (towards the viewer), each of shape (3,)."""
    view = camera_view(camera, 1.0)
    return view.right, view.up, -view.forward


def _looking_at(camera: Camera, point: Floats) -> Camera:
    x, y, z = (float(value) for value in point)
    return _within_range(replace(camera, target_x=x, target_y=y, target_z=z))


def _within_range(camera: Camera) -> Camera:
    """The mouse may ask for more than a parameter's range: stop at its end."""
    limited = {
        name: min(max(getattr(camera, name), declared.low), declared.high)
        for name, declared in parameters_of(camera).items()
        if declared.low is not None and declared.high is not None
    }
    return replace(camera, **limited)
