"""Where the picture is taken from, and where the light comes from, as matrices."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from ..scene.settings import Camera, Look

_UP = np.array([0.0, 1.0, 0.0])
# The bust and its hair fit into this much around the point looked at [m].
_REACH = 1.5


@dataclass(frozen=True, eq=False)
class View:
    """A camera or a parallel light.

    clip_from_world: 4 x 4, for column vectors. eye: where the camera stands [m], or for a light some point on its side.
    forward, right, up: unit vectors, (3,). near, far: distances of the clip planes [m]. focal: of a camera,
    1 / tan(half its vertical angle of view).
    """

    clip_from_world: Floats
    eye: Floats
    forward: Floats
    right: Floats
    up: Floats
    near: float
    far: float
    focal: float = 1.0

    def depth(self, points: Floats) -> Floats:
        """How far points [m], (..., 3), lie in front of the eye along the direction of looking [m], (...,)."""
        return (points - self.eye) @ self.forward


def orbit_direction(azimuth: float, elevation: float) -> Floats:
    """Unit vector from the head to something that stands at these angles [rad]: azimuth 0 in front, 90 degrees on the
    person's left."""
    level = np.cos(elevation)
    return np.array([level * np.sin(azimuth), np.sin(elevation), level * np.cos(azimuth)])


def camera_view(camera: Camera, aspect: float) -> View:
    """The perspective view of an orbiting camera; ``aspect`` is width over height."""
    target = np.array([camera.target_x, camera.target_y, camera.target_z])
    eye = target + camera.distance * orbit_direction(camera.azimuth, camera.elevation)
    near = max(0.02 * camera.distance, camera.distance - _REACH)
    far = camera.distance + _REACH
    return _perspective(eye, target, camera.field_of_view, aspect, near, far)


def perspective_view(eye: Floats, target: Floats, field_of_view: float, aspect: float) -> View:
    """The view from ``eye`` to ``target`` [m] with this vertical angle [rad]; ``aspect`` is width over height."""
    distance = float(np.linalg.norm(target - eye))
    return _perspective(eye, target, field_of_view, aspect, 0.02 * distance, distance + _REACH)


def fitting(camera: Camera, points: Floats, aspect: float, margin: float = 1.08) -> Camera:
    """The camera that sees all of ``points`` [m], (n, 3), from the same side, with some room about them.

    ``aspect``: width over height of the picture.
    """
    view = camera_view(camera, 1.0)
    axes = np.stack([view.right, view.up, -view.forward])
    seen = points @ axes.T
    middle = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
    across, up, back = (seen - middle).T
    rise = np.tan(0.5 * camera.field_of_view) / margin
    # Nearest distance at which each point is still inside the side planes of the view.
    needed = np.maximum(np.abs(up) / rise, np.abs(across) / (rise * aspect)) + back
    x, y, z = (float(value) for value in middle @ axes)
    return replace(camera, target_x=x, target_y=y, target_z=z, distance=float(needed.max()))


@dataclass(frozen=True, eq=False)
class Sphere:
    """A ball of space: centre [m], (3,), and radius [m]."""

    centre: Floats
    radius: float

    @property
    def uniform(self) -> tuple[float, float, float, float]:
        """Centre and radius, for a shader."""
        x, y, z = (float(value) for value in self.centre)
        return x, y, z, self.radius


def bounding_sphere(points: NDArray[np.floating]) -> Sphere:
    """A sphere around points [m], (n, 3), with a little room to spare."""
    if len(points) == 0:
        return Sphere(np.zeros(3), 1.0)
    low, high = bounds_of(points)
    centre = (low + high) / 2
    away = points - centre.astype(points.dtype)
    return Sphere(centre, max(1.02 * float(np.einsum("ij,ij->i", away, away).max()) ** 0.5, 1e-3))


def bounds_of(points: NDArray[np.floating]) -> tuple[Floats, Floats]:
    """The corners of the box around points [m], (n, 3), n > 0: (3,) each. Column by column, which is ten times as fast."""
    low, high = (np.array([float(part(points[:, k])) for k in range(3)]) for part in (np.min, np.max))
    return low, high


def light_view(look: Look, centre: Floats, radius: float) -> View:
    """The parallel projection from the light onto the sphere around ``centre`` [m] with ``radius`` [m]."""
    return parallel_view(orbit_direction(look.light_azimuth, look.light_height), centre, radius)


def parallel_view(direction: Floats, centre: Floats, radius: float) -> View:
    """The parallel projection from the unit ``direction`` onto the sphere around ``centre`` [m] with ``radius`` [m]."""
    projection = np.diag([1 / radius, 1 / radius, -1 / radius, 1.0])
    projection[2, 3] = -1.0
    return _view(centre + radius * direction, -direction, projection, 0.0, 2 * radius)


def _perspective(eye: Floats, target: Floats, field_of_view: float, aspect: float, near: float, far: float) -> View:
    focal = 1.0 / np.tan(field_of_view / 2)
    projection = np.zeros((4, 4))
    projection[0, 0] = focal / aspect
    projection[1, 1] = focal
    projection[2, 2:] = (near + far) / (near - far), 2 * near * far / (near - far)
    projection[3, 2] = -1.0
    return _view(eye, target - eye, projection, near, far, focal)


def _view(eye: Floats, direction: Floats, projection: Floats, near: float, far: float, focal: float = 1.0) -> View:
    forward = direction / np.linalg.norm(direction)
    # Straight up or down "up" names no direction: then the face's own (+Z) does.
    reference = _UP if abs(forward[1]) < 0.9999 else np.array([0.0, 0.0, np.sign(forward[1])])
    right = np.cross(forward, reference)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    look_at = np.eye(4)
    look_at[:3, :3] = right, up, -forward
    look_at[:3, 3] = -look_at[:3, :3] @ eye
    return View(projection @ look_at, eye, forward, right, up, near, far, focal)
