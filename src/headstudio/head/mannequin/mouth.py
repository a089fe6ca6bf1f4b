"""Lips, philtrum and the folds around them."""

from __future__ import annotations

from ..mesh import Floats
from .fields import carve, cone, ellipsoid, inside_box, join, tube


def mouth(p: Floats, head: Floats) -> Floats:
    """``head`` with lips, for points with x >= 0 [mm]."""
    near = inside_box(p, (-1, -60, 50), (50, 5, 140))
    q, h = p[near], head[near]
    upper = tube(
        q,
        [(-6, -22.3, 101.5), (0, -23.4, 102.2), (6, -22.3, 101.5), (15, -25, 97.5), (25, -28.5, 88)],
        [5.2, 5.0, 5.2, 4.0, 1.2],
    )
    lower = tube(
        q,
        [(-8, -34, 99.8), (0, -34.2, 100.5), (8, -33.8, 99.6), (17, -31.6, 95), (24.5, -28.6, 88)],
        [5.6, 5.6, 5.6, 4.2, 1.2],
    )
    h = join(h, upper, 5)
    h = join(h, lower, 5)
    line = tube(
        q,
        [(-8, -28.6, 107), (0, -29.0, 107.5), (8, -28.4, 106.6), (17, -28.6, 101), (25.2, -29, 92.5)],
        [1.0, 1.0, 1.0, 0.9, 0.6],
    )
    h = carve(h, line, 2.2)
    h = carve(h, cone(q, (0, -8, 109), (0, -18, 110.5), 2.6, 3.4), 5)  # philtrum
    h = carve(h, ellipsoid(q, (0, -43.5, 106), (16, 4.5, 6)), 9)  # fold above the chin
    result = head.copy()
    result[near] = h
    return result
