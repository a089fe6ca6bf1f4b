"""The nose."""

from __future__ import annotations

from ..mesh import Floats
from .fields import carve, cone, ellipsoid, inside_box, join


def nose(p: Floats, head: Floats) -> Floats:
    """``head`` with a nose, for points with x >= 0 [mm]."""
    near = inside_box(p, (-1, -40, 60), (50, 75, 160))
    q, h = p[near], head[near]
    bridge = cone(q, (0, 46, 92), (0, 8, 112), 7.5, 8.5)
    bridge = join(bridge, ellipsoid(q, (0, 16, 96), (16, 26, 14)), 14)  # side walls
    bridge = join(bridge, ellipsoid(q, (0, 3.5, 114.5), (8.5, 8, 9)), 8)  # tip
    bridge = join(bridge, ellipsoid(q, (11, 0.5, 103), (6.4, 7.4, 9.5), (0, 0, -10)), 6)  # wing
    bridge = join(bridge, cone(q, (0, -3.5, 112), (0, -6, 102), 3.4, 4), 5)  # columella
    h = join(h, bridge, 9)
    h = carve(h, ellipsoid(q, (7.0, -5.0, 107), (2.8, 5, 5.2), (-10, -18, 0)), 2.5)  # nostril
    result = head.copy()
    result[near] = h
    return result
