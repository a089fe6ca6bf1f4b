"""Chains of cubic Bezier curves in a plane: where a furrow runs (Bando's thesis, section 2.5.1), and fitting them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..head.mesh import Floats, Ints

# From (1, t, t^2, t^3) to the weights of the four control points.
_BASIS = np.array([[1.0, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]])
# How often a fit moves its points along the curve to where they are nearest.
_REPARAMETRISATIONS = 8
# Points that decide the tangent where a stroke is cut in two.
_TANGENT_POINTS = 4


@dataclass(frozen=True, eq=False)
class BezierChain:
    """Cubic Bezier curves end to end.

    controls: 3 k + 1 control points for k curves, (3 k + 1, 2); every third lies on the curve. The parameter t runs from 0
    to k. Raises ValueError for another number of points or numbers that are not finite.
    """

    controls: Floats

    def __post_init__(self) -> None:
        controls = np.array(self.controls, dtype=np.float64)
        if controls.ndim != 2 or controls.shape[1] != 2 or len(controls) < 4 or len(controls) % 3 != 1:
            raise ValueError("a chain of Bezier curves has 4, 7, 10, ... control points of two numbers")
        if not np.isfinite(controls).all():
            raise ValueError("the control points of a curve are finite numbers")
        object.__setattr__(self, "controls", controls)

    @property
    def count(self) -> int:
        """How many curves there are."""
        return len(self.controls) // 3

    @cached_property
    def coefficients(self) -> Floats:
        """Every curve as a polynomial, (k, 4, 2)."""
        quads = self.controls[3 * np.arange(self.count)[:, None] + np.arange(4)]
        return np.einsum("ij,kjd->kid", _BASIS, quads)

    def at(self, t: Floats) -> Floats:
        """Points at t, of any shape: (..., 2)."""
        piece, u = self.split(t)
        return polynomial(self.coefficients[piece], u)

    def tangents(self, t: Floats) -> Floats:
        """Derivatives by t, (..., 2)."""
        piece, u = self.split(t)
        return slope(self.coefficients[piece], u)

    def split(self, t: Floats) -> tuple[Ints, Floats]:
        """Which curve each t lies on, and where on it, 0 to 1."""
        t = np.asarray(t, dtype=np.float64)
        piece = np.clip(np.floor(t), 0, self.count - 1).astype(np.int64)
        return piece, t - piece

    def sampled(self, per_curve: int) -> tuple[Floats, Floats]:
        """Evenly spaced t, (k * per_curve + 1,), and the points there."""
        t = np.linspace(0.0, self.count, self.count * per_curve + 1)
        return t, self.at(t)


def polynomial(c: Floats, u: Floats) -> Floats:
    """The value of cubic polynomials, coefficients (..., 4, d), at u, (...)."""
    u = np.asarray(u)[..., None]
    return c[..., 0, :] + u * (c[..., 1, :] + u * (c[..., 2, :] + u * c[..., 3, :]))


def slope(c: Floats, u: Floats) -> Floats:
    """Their first derivative."""
    u = np.asarray(u)[..., None]
    return c[..., 1, :] + u * (2 * c[..., 2, :] + 3 * u * c[..., 3, :])


def bend(c: Floats, u: Floats) -> Floats:
    """Their second derivative."""
    return 2 * c[..., 2, :] + 6 * np.asarray(u)[..., None] * c[..., 3, :]


def straight(start: Floats, end: Floats) -> BezierChain:
    """A straight line as one curve."""
    part = np.linspace(0.0, 1.0, 4)[:, None]
    return BezierChain((1 - part) * np.asarray(start) + part * np.asarray(end))


def fit_stroke(points: Floats, tolerance: float) -> BezierChain:
    """The shortest chain that passes within ``tolerance`` of every point of a stroke, (m, 2), by least squares.

    The ends of the stroke are kept. Where one cubic does not do, the stroke is cut at its worst point and both halves
    share the tangent there. Raises ValueError for a stroke without two distinct points.
    """
    points = np.asarray(points, dtype=np.float64)
    moved = np.linalg.norm(np.diff(points, axis=0), axis=1) > 0
    points = points[np.concatenate([[True], moved])]
    if len(points) < 2:
        raise ValueError("a stroke has at least two points")
    if not tolerance > 0:
        raise ValueError("the tolerance of a fit is above zero")
    pieces = _fit_pieces(points, tolerance, None, None)
    return BezierChain(np.concatenate([pieces[0], *(piece[1:] for piece in pieces[1:])]))


def _fit_pieces(points: Floats, tolerance: float, first: Floats | None, last: Floats | None) -> list[Floats]:
    """Control points of each curve, (4, 2); ``first`` and ``last`` are unit tangents at the ends where they are set."""
    if len(points) == 2:
        return [straight(points[0], points[1]).controls]
    controls, error = _fit_one(points, first, last)
    if error.max() <= tolerance:
        return [controls]
    worst = int(np.clip(error.argmax(), 1, len(points) - 2))
    around = points[max(worst - _TANGENT_POINTS, 0) : worst + _TANGENT_POINTS + 1]
    tangent = around[-1] - around[0]
    length = np.linalg.norm(tangent)
    tangent = tangent / length if length > 0 else np.array([1.0, 0.0])
    return _fit_pieces(points[: worst + 1], tolerance, first, tangent) + _fit_pieces(
        points[worst:], tolerance, tangent, last
    )


def _fit_one(points: Floats, first: Floats | None, last: Floats | None) -> tuple[Floats, Floats]:
    """The best single cubic through both ends, and how far it passes from every point."""
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    u = np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum()
    for _ in range(_REPARAMETRISATIONS):
        controls = _least_squares(points, u, first, last, lengths.sum())
        c = _BASIS @ controls
        away, along = polynomial(c[None], u) - points, slope(c[None], u)
        bottom = np.einsum("ij,ij->i", along, along) + np.einsum("ij,ij->i", away, bend(c[None], u))
        step = np.divide(np.einsum("ij,ij->i", away, along), bottom, out=np.zeros_like(u), where=bottom > 0)
        u = np.clip(u - step, 0.0, 1.0)
        u[0], u[-1] = 0.0, 1.0
    return controls, np.linalg.norm(polynomial(c[None], u) - points, axis=1)


def _least_squares(points: Floats, u: Floats, first: Floats | None, last: Floats | None, length: float) -> Floats:
    """Control points with the ends fixed; an inner one is free, or slides along a tangent that is set."""
    weights = (u[:, None] ** np.arange(4)) @ _BASIS
    # Each inner control point is an anchor plus free directions: both axes, or the tangent alone.
    free = [np.eye(2) if first is None else first[None], np.eye(2) if last is None else -last[None]]
    target = points - weights[:, :2].sum(axis=1)[:, None] * points[0] - weights[:, 2:].sum(axis=1)[:, None] * points[-1]
    columns = [np.einsum("i,kd->idk", weights[:, 1 + k], free[k]).reshape(2 * len(points), -1) for k in (0, 1)]
    # A little pull toward thirds of the way keeps control points near when few points decide them.
    matrix = np.concatenate([np.concatenate(columns, axis=1), 1e-6 * np.eye(len(free[0]) + len(free[1]))])
    solution = np.linalg.lstsq(matrix, np.concatenate([target.ravel(), np.zeros(matrix.shape[1])]), rcond=None)[0]
    split = len(free[0])
    second, third = solution[:split] @ free[0], solution[split:] @ free[1]
    # A tangent that points backward would make a loop.
    if first is not None and second @ first <= 0:
        second = first * length / 3
    if last is not None and third @ last >= 0:
        third = -last * length / 3
    return np.stack([points[0], points[0] + second, points[-1] + third, points[-1]])
