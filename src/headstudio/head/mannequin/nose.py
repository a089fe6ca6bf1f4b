"""The nose."""

from __future__ import annotations

from ..mesh import Floats
from .fields import carve, cone, ellipsoid, join, shaped


def _shape(p: Floats, head: Floats) -> Floats:
    shape = cone(p, (0, 41.5, 85.5), (0, 9, 109.3), 6.5, 7.5)  # bridge
    shape = join(shape, ellipsoid(p, (0, 14, 92.5), (15, 27.5, 14)), 14)  # side walls
    shape = join(shape, ellipsoid(p, (0, 2.8, 112), (8, 7.4, 8)), 10)  # tip
    shape = join(shape, ellipsoid(p, (9.8, 2.0, 102.5), (6.8, 7.0, 10), (0, -12, -10)), 6.5)  # wing
    shape = join(shape, ellipsoid(p, (0, 0.2, 105.5), (12, 4.6, 10)), 6)  # base
    head = join(head, shape, 8)
    return carve(head, ellipsoid(p, (6.6, -3.4, 104.8), (2.7, 5.0, 4.0), (6, -24, 8)), 2.2)  # nostril


def nose(p: Floats, head: Floats) -> Floats:
    """``head`` with a nose, for points with x >= 0 [mm]."""
    return shaped(p, head, (-1, -40, 60), (50, 75, 160), _shape)
