"""Lips, philtrum and the folds around them."""

from __future__ import annotations

from ..mesh import Floats
from .fields import Tube, carve, cone, ellipsoid, join, shaped

UPPER_LIP = Tube(
    [(-5, -22.6, 103.0), (0, -23.8, 103.8), (5, -22.6, 103.0), (14, -25.2, 99.2), (23.5, -28.0, 89.5)],
    [6.2, 6.0, 6.2, 4.9, 2.2],
)
LOWER_LIP = Tube(
    [(-8, -34.4, 100.8), (0, -34.8, 101.4), (8, -34.2, 100.6), (16, -32, 96.6), (23.5, -28.5, 89.5)],
    [6.4, 6.5, 6.4, 5.0, 2.2],
)
PARTING = Tube(
    [
        (-8, -28.6, 108.2),
        (0, -29.5, 108.6),
        (8, -28.4, 107.7),
        (16, -28.6, 103.5),
        (22, -28.6, 99.4),
        (26, -28.4, 98.0),
    ],
    [1.3, 1.3, 1.3, 1.3, 1.2, 1.0],
)


def _shape(p: Floats, head: Floats) -> Floats:
    head = join(head, join(UPPER_LIP(p), LOWER_LIP(p), 2.0), 6)
    head = carve(head, PARTING(p), 3.0)
    head = carve(head, cone(p, (0, -11, 113.2), (0, -21, 114.8), 2.4, 4.4), 8)  # philtrum
    return carve(head, ellipsoid(p, (0, -45, 106), (17, 4.5, 5.5)), 12)  # fold above the chin


def mouth(p: Floats, head: Floats) -> Floats:
    """``head`` with lips, for points with x >= 0 [mm]."""
    return shaped(p, head, (-1, -62, 50), (50, 5, 140), _shape)
