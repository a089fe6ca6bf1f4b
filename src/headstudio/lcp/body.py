"""Head, neck and torso as hair meets them (thesis, section 3.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.contact import ContactField
from ..head.frame import HeadFrame
from ..head.hair_tight import hair_tight_surface
from ..head.head import Head
from ..head.mesh import Floats
from ..head.neck import NO_NECK, Neck, turned_by
from ..head.rows import cross_matrix, mapped, row_dot, row_length, rows_at

_VOXEL = 0.007
_SLIDING_DISTANCE = 0.006
_SAME = 1e-3  # shares of the turn that differ by less mean the same place


@dataclass(frozen=True, eq=False)
class Planes:
    """The body as n particles see it, in the head frame.

    distance: d to the nearest plane [m], infinite far from all, (n,). normals: its unit normal, zero far from all, and
    velocity: that of the body there [m/s], (n, 3).
    """

    distance: Floats
    normals: Floats
    velocity: Floats


@dataclass(frozen=True, eq=False)
class Body:
    """The contact planes of a bust at rest, and the neck that bends them.

    The thesis has rigid bodies. Skin of the neck turns with a part of the head's turn (Head.neck), and hair lies on it: so
    a particle is led back to where the place that it is in is at rest, and the plane that it finds there is bent.
    """

    surface: ContactField
    neck: Neck = NO_NECK

    @classmethod
    def around(cls, head: Head, voxel: float = _VOXEL) -> Body:
        """The planes of a head with its neck and shoulders."""
        return cls(ContactField.around(hair_tight_surface(head), voxel), head.neck)

    def planes(self, positions: Floats, frame: HeadFrame | None = None) -> Planes:
        """The nearest plane of the bent body. positions: head frame [m], (n, 3).

        frame: how far the head has turned on the torso, and how fast; None at rest.
        """
        if frame is None or self.neck is NO_NECK:
            distance, normals = self.surface.at(positions)
            return Planes(distance, normals, np.zeros_like(positions))
        standing = mapped(positions, frame.axes)
        low = np.flatnonzero(self.neck.reaches(positions) | self.neck.reaches(standing))
        turn, seen = frame.rotation.as_rotvec(), rows_at(standing, low)
        # Between head and shoulders there may be a plane of either: as skin folds there, two places come to one.
        share, other = self.neck.shares_when_bent(seen, turn)
        rest = positions.copy(order="F")
        rest.T[:, low] = turned_by(seen, turn, -share).T
        distance, normals = self.surface.at(rest)
        two = np.flatnonzero(share - other > _SAME)
        rest_of_other = turned_by(rows_at(seen, two), turn, -other[two])
        distance_of_other, normals_of_other = self.surface.at(rest_of_other)
        nearer = distance_of_other < distance[low[two]]
        two = two[nearer]
        share[two], rest[low[two]] = other[two], rest_of_other[nearer]
        distance[low[two]], normals[low[two]] = distance_of_other[nearer], normals_of_other[nearer]

        bent = self.neck.bent_normals(rows_at(rest, low), rows_at(normals, low), turn)
        length = np.maximum(row_length(bent), 1e-12)
        distance[low] /= length
        normals.T[:, low] = mapped(turned_by(bent / length[:, None], turn, share), frame.axes.T).T
        spin = frame.angular_velocity @ frame.axes
        velocity = np.zeros_like(rest)
        velocity.T[:, low] = (share - 1.0) * mapped(rows_at(positions, low), cross_matrix(spin)).T
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
