"""The nose."""

from __future__ import annotations

from ..mesh import Floats
from .fields import carve, cone, ellipsoid, join, shaped


def _shape(p: Floats, head: Floats) -> Floats:
    shape = cone(p, (0, 46, 87.5), (0, 8, 110), 6.5, 7.5)  # bridge
    shape = join(shape, ellipsoid(p, (0, 14, 93), (15, 29, 14)), 14)  # side walls
    shape = join(shape, ellipsoid(p, (0, 2.3, 113), (8, 7.4, 8)), 10)  # tip
    shape = join(shape, ellipsoid(p, (9.8, 0.0, 102.5), (6.6, 7.0, 10), (0, -12, -10)), 6.5)  # wing
    shape = join(shape, ellipsoid(p, (0, -1.6, 105), (12, 4.8, 10)), 6)  # base
    head = join(head, shape, 10)
    return carve(head, ellipsoid(p, (6.4, -5.0, 106.0), (2.7, 5.2, 4.4), (14, -22, 8)), 2.4)  # nostril


def nose(p: Floats, head: Floats) -> Floats:
    """``head`` with a nose, for points with x >= 0 [mm]."""
    return shaped(p, head, (-1, -40, 60), (50, 75, 160), _shape)
