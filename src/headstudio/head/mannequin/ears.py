"""The ears."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from ..mesh import Floats
from .fields import Tube, carve, cone, ellipsoid, join, shaped

EAR = np.array([71.0, 20.0, -2.0])  # the hole of the ear [mm]
# Columns: backward, up and outward of the ear. It stands off the head by 24 degrees, leans back by 10, out by 6.
_FRAME = (
    Rotation.from_euler("zyx", [-6, 0, -10], degrees=True) * Rotation.from_euler("y", 66, degrees=True)
).as_matrix()

HELIX = Tube(
    [
        (2, 3, 2),
        (0, 14, 4),
        (5, 29, 5),
        (15, 34, 5.2),
        (25, 27, 5),
        (28, 12, 4.6),
        (24, -5, 4),
        (17, -17, 3),
        (10, -27, 2),
        (3, -30, 1.2),
        (-2, -23, 0.5),
    ],
    [1.5, 2.4, 3.0, 3.2, 3.2, 3.0, 2.8, 2.7, 2.8, 2.8, 2.4],
)
ANTIHELIX = Tube([(12, 26, 4), (18, 16, 5), (17, 4, 5.5), (11, -9, 4.5), (5, -13, 4)], [1.8, 2.4, 2.6, 2.4, 2.4])


def _shape(p: Floats, head: Floats) -> Floats:
    q = _FRAME.T @ (p - EAR[:, None])
    head = join(head, cone(q, (6, 0, -3.5), (-2, 0, -16), 13, 14), 8)  # back of the concha
    shell = ellipsoid(q, (12, 7, 1.5), (18.5, 28.5, 4.2))
    shell = join(shell, ellipsoid(q, (5, -21, 1), (7.5, 10, 3.4), (0, 0, 10)), 8)  # lobe
    shell = join(shell, HELIX(q), 4)
    head = join(head, shell, 8)
    head = carve(head, ellipsoid(q, (8.5, 0.5, 9), (8, 10.5, 9)), 4)  # concha
    head = join(head, ANTIHELIX(q), 4)
    head = join(head, ellipsoid(q, (-1.5, 0, 2.5), (3.4, 5.5, 3.4)), 4)  # tragus
    return carve(head, cone(q, (5, -1, 4), (3, -1, -0.5), 3.2, 3.0), 4)  # ear hole


def ears(p: Floats, head: Floats) -> Floats:
    """``head`` with an ear, for points with x >= 0 [mm]."""
    return shaped(p, head, (45, -40, -60), (125, 80, 40), _shape)
