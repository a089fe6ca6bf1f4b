"""The head and the torso as hair meets them: two rigid bodies, one turning on the other (thesis, section 3.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.contact import ContactField
from ..head.frame import HeadFrame
from ..head.hair_tight import hair_tight_surface
from ..head.head import Head
from ..head.mesh import Floats, TriangleMesh
from ..head.rows import row_dot
from .inertia import cross_matrix

_VOXEL = 0.007
_SLIDING_DISTANCE = 0.006


@dataclass(frozen=True, eq=False)
class Planes:
    """The body as n particles see it, in the head frame.

    distance: d to the nearest plane of head or torso [m], infinite far from both, (n,). normals: its unit normal, zero far
    from both, and velocity: that of the body there [m/s], (n, 3).
    """

    distance: Floats
    normals: Floats
    velocity: Floats


@dataclass(frozen=True, eq=False)
class Body:
    """Contact planes of the head, which stand still in the head frame, and of the torso, which turns against it."""

    head: ContactField
    torso: ContactField | None

    @classmethod
    def around(cls, head: Head, voxel: float = _VOXEL) -> Body:
        """The planes of a head: neck and head up to half the turn of the neck, the rest of the neck and the torso below."""
        surface, turning = hair_tight_surface(head)
        weight = turning[surface.faces].mean(axis=1)
        upper, lower = (TriangleMesh(surface.vertices, surface.faces[which]) for which in (weight >= 0.5, weight < 0.5))
        return cls(
            ContactField.around(upper, voxel),
            ContactField.around(lower, voxel) if len(lower.faces) else None,
        )

    def planes(self, positions: Floats, frame: HeadFrame | None = None) -> Planes:
        """The nearest plane of either body. positions: head frame [m], (n, 3).

        frame: how far the head has turned on the torso, and how fast; None at rest.
        """
        distance, normals = self.head.at(positions)
        velocity = np.zeros_like(positions)
        if self.torso is None:
            return Planes(distance, normals, velocity)
        if frame is None:
            torso_distance, torso_normals = self.torso.at(positions)
        else:
            torso_distance, torso_normals = self.torso.at(positions @ frame.axes.T)
            torso_normals = torso_normals @ frame.axes
        nearer = np.flatnonzero(torso_distance < distance)
        distance[nearer] = torso_distance[nearer]
        normals[nearer] = torso_normals[nearer]
        if frame is not None:
            spin = frame.angular_velocity @ frame.axes
            velocity[nearer] = positions[nearer] @ cross_matrix(spin)
        return Planes(distance, normals, velocity)

    def clearance(self, positions: Floats) -> Floats:
        """Distance d to the nearest plane at rest [m], infinite far from the body, (n,)."""
        return self.planes(positions).distance

    def slide(self, positions: Floats, directions: Floats) -> Floats:
        """Unit ``directions`` turned so that they do not lead into the body from ``positions`` [m], both (n, 3)."""
        planes = self.planes(positions)
        distance, normals = planes.distance, planes.normals
        inward = row_dot(directions, normals)
        # Below the sliding distance a direction must lead out again, the more the deeper it is.
        wanted = np.clip((_SLIDING_DISTANCE - distance) / _SLIDING_DISTANCE, 0.0, 1.0) * 0.5
        correction = np.where(distance < _SLIDING_DISTANCE, np.maximum(wanted - inward, 0.0), 0.0)
        turned = directions + correction[:, None] * normals
        return turned / np.linalg.norm(turned, axis=1, keepdims=True)
