"""Distance fields: the clay of the mannequin.

A field gives for every point how far it lies from a surface, negative inside [mm]. Shapes are joined, carved and
pushed by arithmetic on those numbers. Points have shape (n, 3) and fields shape (n,); lengths are millimetres, as in
anthropometry, until the finished head is scaled to metres.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from ..mesh import Floats

Vector = Sequence[float]
Field = Callable[[Floats], Floats]


def ellipsoid(p: Floats, centre: Vector, radii: Vector, turn: Vector = (0.0, 0.0, 0.0)) -> Floats:
    """Ellipsoid, turned about x, then y, then z [degrees]; exact on its surface and to first order around it."""
    q = p - np.asarray(centre)
    if any(turn):
        q = Rotation.from_euler("xyz", turn, degrees=True).inv().as_matrix() @ q.T
        q = q.T
    scaled = q / np.asarray(radii)
    size = np.sqrt(np.einsum("ij,ij->i", scaled, scaled))
    slope = scaled / np.asarray(radii)
    steep = np.sqrt(np.einsum("ij,ij->i", slope, slope))
    return size * (size - 1.0) / np.maximum(steep, 1e-9)


def cone(p: Floats, start: Vector, end: Vector, start_radius: float, end_radius: float) -> Floats:
    """A capsule whose radius goes evenly from one end to the other."""
    a = np.asarray(start, dtype=float)
    along = np.asarray(end, dtype=float) - a
    q = p - a
    t = np.clip(q @ along / (along @ along), 0.0, 1.0)
    q -= t[:, None] * along
    return np.sqrt(np.einsum("ij,ij->i", q, q)) - (start_radius + t * (end_radius - start_radius))


class Tube:
    """A tube along the spline through ``knots``, its radius a spline through ``radii``."""

    def __init__(self, knots: Sequence[Vector], radii: Sequence[float]) -> None:
        columns = np.column_stack([np.asarray(knots, dtype=float), np.asarray(radii, dtype=float)])
        self._path = CubicSpline(np.arange(len(columns)), columns)
        self._end = len(columns) - 1.0
        self._starts = np.linspace(0.0, self._end, 6 * len(columns))
        self._samples = self._path(self._starts)[:, :3]

    def __call__(self, p: Floats) -> Floats:
        """Distance [mm]: from the nearest of a few samples, Newton's method finds the foot on the curve."""
        squares = np.einsum("ij,ij->i", self._samples, self._samples) - 2.0 * p @ self._samples.T
        at = self._starts[np.argmin(squares, axis=1)]
        for _ in range(2):
            away = self._path(at)[:, :3] - p
            tangent, bend = self._path(at, 1)[:, :3], self._path(at, 2)[:, :3]
            speed = np.einsum("ij,ij->i", tangent, tangent)
            curvature = np.maximum(speed + np.einsum("ij,ij->i", away, bend), 0.3 * speed)
            at = np.clip(at - np.einsum("ij,ij->i", away, tangent) / curvature, 0.0, self._end)
        foot = self._path(at)
        away = p - foot[:, :3]
        return np.sqrt(np.einsum("ij,ij->i", away, away)) - foot[:, 3]


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
    q = (p - np.asarray(centre)) / np.asarray(widths)
    return np.exp(-np.einsum("ij,ij->i", q, q))


def inside_box(p: Floats, low: Vector, high: Vector) -> np.ndarray:
    """Which points lie in an axis-aligned box; shapes far from a point need not be worked out there."""
    return ((p > np.asarray(low)) & (p < np.asarray(high))).all(axis=1)
