"""Places given in proportions of the head, so that they mean the same on every head."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.head import Landmarks
from ..head.mesh import Floats


@dataclass(frozen=True, eq=False)
class Proportions:
    """The frame of a skull: in it the left ear hole is at x = 1, the crown at y = 1, the glabella at z = 1 and the
    occiput at z = -1.

    centre: the skull's middle [m], (3,). extent: half the breadth between the ear holes, the height of the crown above
    the middle, half the depth from glabella to occiput [m], (3,).
    """

    centre: Floats
    extent: Floats

    @classmethod
    def of(cls, landmarks: Landmarks) -> Proportions:
        """The proportions of the head with these landmarks."""
        front, back = landmarks.glabella, landmarks.occiput
        middle = 0.5 * (front + back)
        side = 0.5 * (landmarks.left_tragus[0] + landmarks.right_tragus[0])
        centre = np.array([side, middle[1], middle[2]])
        breadth = 0.5 * (landmarks.left_tragus[0] - landmarks.right_tragus[0])
        extent = np.array([breadth, landmarks.crown[1] - centre[1], 0.5 * (front[2] - back[2])])
        return cls(centre, extent)

    def place(self, proportions: Floats) -> Floats:
        """Points in proportions, (..., 3), as points of the head frame [m]."""
        return self.centre + np.asarray(proportions, dtype=np.float64) * self.extent

    def measure(self, points: Floats) -> Floats:
        """Points of the head frame [m], (..., 3), in proportions."""
        return (np.asarray(points, dtype=np.float64) - self.centre) / self.extent
