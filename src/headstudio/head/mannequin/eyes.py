"""Eye sockets and lids, made to the ball that lies in them."""

from __future__ import annotations

import numpy as np

from ..mesh import Floats
from .fields import carve, ellipsoid, inside_box, join, tube

EYE = np.array([31.6, 38.0, 77.5])  # centre of the left ball, half the pupil distance from the middle [mm]
EYE_RADIUS = 12.2
EYE_AXIS = np.array([0.0, 0.0, 1.0])

INNER, OUTER = (15.5, 36.6), (46.0, 39.2)  # corners of the lids, x and y
LID = 1.9  # thickness of the lids over the ball


def _slit(p: Floats) -> Floats:
    """The opening between the lids: an almond between two circles, seen from the front."""
    inner, outer = np.array(INNER), np.array(OUTER)
    middle, half = (inner + outer) / 2.0, np.linalg.norm(outer - inner) / 2.0
    along = (outer - inner) / (2.0 * half)
    q = p[:, :2] - middle
    u, v = q @ along, q @ np.array([-along[1], along[0]])

    def disc(rise: float, sign: float) -> Floats:
        radius = (half**2 + rise**2) / (2.0 * rise)
        return np.hypot(u, v - sign * (rise - radius)) - radius

    almond = np.maximum(disc(5.6, 1.0), disc(4.6, -1.0))
    return np.maximum(almond, EYE[2] + 1.0 - p[:, 2])


def eyes(p: Floats, head: Floats) -> Floats:
    """``head`` with sockets, lids and the slit between them, for points with x >= 0 [mm]."""
    near = inside_box(p, (-1, 0, 40), (75, 75, 130))
    q, h = p[near], head[near]
    h = carve(h, ellipsoid(q, (30, 36, 98), (22, 14, 14), (0, 18, 0)), 16)  # socket
    lids = ellipsoid(q, EYE, (EYE_RADIUS + LID + 3.0, EYE_RADIUS + LID, EYE_RADIUS + LID))
    h = join(h, lids, 7)
    fold = tube(
        q, [(15, 40, 84), (24, 46.6, 89), (34, 47.6, 88), (44, 44.5, 81), (49, 40, 74)], [0.3, 0.8, 0.9, 0.7, 0.3]
    )
    h = carve(h, fold, 3.0)
    h = carve(h, _slit(q), 1.0)
    result = head.copy()
    result[near] = h
    return result
