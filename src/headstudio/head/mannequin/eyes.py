"""Eye sockets and lids, made to the ball that lies in them."""

from __future__ import annotations

import numpy as np

from ..mesh import Floats
from .fields import Tube, carve, ellipsoid, join, shaped

EYE = np.array([31.6, 38.0, 76.0])  # centre of the left ball, half the pupil distance from the middle [mm]
EYE_RADIUS = 12.2
EYE_AXIS = np.array([0.0, 0.0, 1.0])

INNER, OUTER = np.array([17.0, 36.2]), np.array([46.5, 38.4])  # corners of the lids, x and y
RISE, FALL = 4.8, 3.9  # of the upper and the lower lid over the line between the corners
LID = 2.5  # thickness of the lids over the ball
CREASE = Tube([(15, 39, 91), (23, 45.6, 91.5), (33, 46.9, 91.5), (42, 44.8, 87), (51, 39, 80)], [1.5] * 5)


def _almond(p: Floats) -> Floats:
    """The opening between the lids, seen from the front: what two circles share."""
    half = np.linalg.norm(OUTER - INNER) / 2.0
    along = (OUTER - INNER) / (2.0 * half)
    q = p[:2] - ((INNER + OUTER) / 2.0)[:, None]
    u, v = along @ q, np.array([-along[1], along[0]]) @ q

    def disc(rise: float, sign: float) -> Floats:
        radius = (half**2 + rise**2) / (2.0 * rise)
        return np.hypot(u, v - sign * (rise - radius)) - radius

    return np.maximum(disc(RISE, 1.0), disc(FALL, -1.0))


def _shape(p: Floats, head: Floats) -> Floats:
    head = carve(head, ellipsoid(p, (29, 38, 97), (21, 12, 11), (0, 18, 0)), 20)  # socket
    head = join(head, ellipsoid(p, EYE, (EYE_RADIUS + LID + 2.5, EYE_RADIUS + LID, EYE_RADIUS + LID)), 8)  # lids
    head = carve(head, CREASE(p), 3.0)
    # The floor of the slit lies under the ball, and before it only in the corners.
    return carve(head, np.maximum(_almond(p), EYE[2] + 6.2 - p[2]), 3.0)


def eyes(p: Floats, head: Floats) -> Floats:
    """``head`` with sockets, lids and the slit between them, for points with x >= 0 [mm]."""
    return shaped(p, head, (-1, 0, 40), (75, 75, 130), _shape)
