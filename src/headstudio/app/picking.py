"""What lies under the mouse: rays through the view, and where they meet the head."""

from __future__ import annotations

import math
from dataclasses import dataclass

import igl
import numpy as np

from ..head.frame import HeadFrame
from ..head.head import Head
from ..head.mesh import Floats
from ..scene.settings import Camera
from . import navigation


@dataclass(frozen=True, eq=False)
class Ray:
    """A half line in the world: origin [m] and unit direction, each of shape (3,)."""

    origin: Floats
    direction: Floats

    def at(self, distance: float) -> Floats:
        """The point ``distance`` [m] along the ray."""
        return self.origin + distance * self.direction

    def to_head(self, frame: HeadFrame) -> Ray:
        """The same ray seen from the head."""
        return Ray(frame.to_head(self.origin[None])[0], frame.rotation.inv().apply(self.direction))


@dataclass(frozen=True, eq=False)
class Hit:
    """Where a ray meets the skin: the point at rest [m] in the head frame, (3,), its face, and how far along [m]."""

    point: Floats
    face: int
    distance: float


@dataclass(frozen=True)
class View:
    """A camera and the size of its picture in window units: turns points of the picture into rays and back."""

    camera: Camera
    width: float
    height: float

    def ray(self, x: float, y: float) -> Ray:
        """The ray through a point of the picture, (0, 0) being its upper left corner."""
        right, up, back = navigation.axes(self.camera)
        rise = math.tan(self.camera.field_of_view / 2)
        across = (2 * x - self.width) / self.height * rise
        direction = across * right + (1 - 2 * y / self.height) * rise * up - back
        return Ray(self.eye, direction / np.linalg.norm(direction))

    @property
    def eye(self) -> Floats:
        """Where the camera stands [m], shape (3,)."""
        return navigation.target(self.camera) + self.camera.distance * navigation.axes(self.camera)[2]

    def project(self, points: Floats) -> Floats:
        """Where points of the world [m], shape (n, 3), appear in the picture, shape (n, 2); NaN behind the camera."""
        right, up, back = navigation.axes(self.camera)
        offset = points - self.eye
        depth = -(offset @ back)
        depth = np.where(depth > 1e-6, depth, np.nan)
        half = self.height / 2 / math.tan(self.camera.field_of_view / 2)
        return np.stack(
            [self.width / 2 + half * (offset @ right) / depth, self.height / 2 - half * (offset @ up) / depth], axis=1
        )


def pick_head(head: Head, ray: Ray, frame: HeadFrame) -> Hit | None:
    """The nearest point of the skin on a ray of the world, or None. The neck counts as stiff."""
    local = ray.to_head(frame)
    hits = igl.ray_mesh_intersect(local.origin, local.direction, head.skin.vertices, head.skin.faces)
    if not hits:
        return None
    face, distance, *_ = min(hits, key=lambda hit: hit[1])
    return Hit(local.at(distance), int(face), float(distance))
