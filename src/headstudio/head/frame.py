"""Where the head is, and how it moves."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from .mesh import Floats
from .neck import turned_by


def _zeros() -> Floats:
    return np.zeros(3)


@dataclass(frozen=True, eq=False)
class HeadFrame:
    """Pose of the head and its first two derivatives, at one instant.

    The frame sits at the base of the skull. A point p of the head [m] stands at ``translation + rotation(p)`` in the
    world. rotation: of the head against the world. translation: of the whole bust [m], shape (3,). velocity [m/s] and
    acceleration [m/s^2] of the frame's origin, angular_velocity [rad/s] and angular_acceleration [rad/s^2], all in
    world axes, shape (3,).

    The torso takes part in the translation and not in the rotation: the neck turns between them.
    """

    rotation: Rotation = field(default_factory=Rotation.identity)
    translation: Floats = field(default_factory=_zeros)
    velocity: Floats = field(default_factory=_zeros)
    acceleration: Floats = field(default_factory=_zeros)
    angular_velocity: Floats = field(default_factory=_zeros)
    angular_acceleration: Floats = field(default_factory=_zeros)

    @cached_property
    def axes(self) -> Floats:
        """The axes of the head in the world as columns, (3, 3): what turns many vectors with the least ado."""
        return self.rotation.as_matrix()

    def is_near(self, other: HeadFrame, tolerance: float) -> bool:
        """Whether both stand in the same place, to ``tolerance`` [rad, m], however they move there."""
        turned = np.abs(self.axes - other.axes).max()
        return bool(max(turned, np.abs(self.translation - other.translation).max()) <= tolerance)

    def to_world(self, points: Floats) -> Floats:
        """Points of the head frame [m], shape (n, 3), in the world."""
        return self.rotation.apply(points) + self.translation

    def to_head(self, points: Floats) -> Floats:
        """Points of the world [m], shape (n, 3), in the head frame."""
        return self.rotation.inv().apply(points - self.translation)

    def skinned(self, points: Floats, head_weight: Floats) -> Floats:
        """Points of the bust at rest [m], shape (n, 3), posed in the world.

        ``head_weight`` is 1 on the head, 0 on the torso and between them on the neck, shape (n,). The rotation vector
        is weighted (not the matrix), so the neck twists without collapsing.
        """
        return turned_by(points, self.rotation.as_rotvec(), head_weight) + self.translation
