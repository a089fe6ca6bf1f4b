"""Distance fields: the clay of the mannequin.

A field gives for every point how far it lies from a surface, negative inside [mm]. Shapes are joined, carved and
pushed by arithmetic on those numbers. Points are columns here, shape (3, n), because numpy runs fastest along the long
axis; fields have shape (n,). Lengths are millimetres, as in anthropometry, until the finished head is scaled.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from ..mesh import Floats

Vector = Sequence[float] | Floats
Field = Callable[[Floats], Floats]
FAR = 100.0  # where a shape is too far away to matter [mm]


def _column(vector: Vector) -> Floats:
    return np.asarray(vector, dtype=float)[:, None]


def _dot(a: Floats, b: Floats) -> Floats:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def ellipsoid(p: Floats, centre: Vector, radii: Vector, turn: Vector = (0.0, 0.0, 0.0)) -> Floats:
    """Ellipsoid, turned about x, then y, then z [degrees]; right on its surface and to first order around it."""
    q = p - _column(centre)
    if any(turn):
        q = Rotation.from_euler("xyz", turn, degrees=True).as_matrix().T @ q
    q /= _column(radii)
    size = np.sqrt(_dot(q, q))
    q /= _column(radii)
    return size * (size - 1.0) / np.sqrt(np.maximum(_dot(q, q), 1e-12))


def cone(p: Floats, start: Vector, end: Vector, start_radius: float, end_radius: float) -> Floats:
    """A capsule whose radius goes evenly from one end to the other."""
    along = np.asarray(end, dtype=float) - np.asarray(start, dtype=float)
    q = p - _column(start)
    t = np.clip(along @ q / (along @ along), 0.0, 1.0)
    q -= along[:, None] * t
    return np.sqrt(_dot(q, q)) - (start_radius + t * (end_radius - start_radius))


class Tube:
    """The field of a tube along the spline through ``knots``, its radius a spline through ``radii``."""

    def __init__(self, knots: Sequence[Vector], radii: Sequence[float]) -> None:
        columns = np.column_stack([np.asarray(knots, dtype=float), np.asarray(radii, dtype=float)])
        self._path = CubicSpline(np.arange(len(columns)), columns)
        self._end = len(columns) - 1.0
        self._starts = np.linspace(0.0, self._end, 3 * len(columns))
        self._samples = self._path(self._starts)[:, :3]

    def __call__(self, p: Floats) -> Floats:
        """Distance [mm]: from the nearest of a few samples, Newton's method finds the foot on the curve."""
        squares = np.einsum("ij,ij->i", self._samples, self._samples)[:, None] - 2.0 * self._samples @ p
        at = self._starts[np.argmin(squares, axis=0)]
        for _ in range(2):
            away = self._path(at).T[:3] - p
            tangent, bend = self._path(at, 1).T, self._path(at, 2).T
            speed = _dot(tangent, tangent)
            curvature = np.maximum(speed + _dot(away, bend), 0.3 * speed)
            at = np.clip(at - _dot(away, tangent) / curvature, 0.0, self._end)
        foot = self._path(at).T
        away = p - foot[:3]
        return np.sqrt(_dot(away, away)) - foot[3]


def join(a: Floats, b: Floats, blend: float) -> Floats:
    """Union of two fields with a fillet about ``blend`` wide; twice differentiable."""
    near = np.maximum(blend - np.abs(a - b), 0.0) / blend
    return np.minimum(a, b) - near**3 * (blend / 6.0)


def meet(a: Floats, b: Floats, blend: float) -> Floats:
    """Intersection of two fields with a rounded edge."""
    return -join(-a, -b, blend)


def carve(a: Floats, b: Floats, blend: float) -> Floats:
    """``a`` without ``b``, with a rounded edge."""
    return -join(-a, b, blend)


def bump(p: Floats, centre: Vector, widths: Vector) -> Floats:
    """A smooth weight, 1 at the centre and fading over ``widths``: the touch of a thumb."""
    q = (p - _column(centre)) / _column(widths)
    return np.exp(-_dot(q, q))


def shaped(p: Floats, field: Floats, low: Vector, high: Vector, shape: Callable[[Floats, Floats], Floats]) -> Floats:
    """``field`` with its part in an axis-aligned box replaced by ``shape(points, field)`` of that part.

    Away from the box the shape must change nothing: this only saves the work.
    """
    near = ((p > _column(low)) & (p < _column(high))).all(axis=0)
    result = field.copy()
    result[near] = shape(p[:, near], field[near])
    return result
