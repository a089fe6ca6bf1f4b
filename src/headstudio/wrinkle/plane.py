"""Vectors in the plane."""

from __future__ import annotations

from ..head.mesh import Floats


def cross(first: Floats, second: Floats) -> Floats:
    """Third component of the cross product of vectors in the plane, (..., 2)."""
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]


def shorter_way(offsets: Floats, period: int) -> Floats:
    """Offsets [texels], (..., 2), the short way around when x comes round again after ``period`` texels (0: never)."""
    if not period:
        return offsets
    around = offsets.copy()
    around[..., 0] -= period * (offsets[..., 0] / period).round()
    return around
