"""Chains of cubic Bezier curves in a plane: where a furrow runs (Bando's thesis, section 2.5.1), and fitting them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..head.mesh import Floats, Ints

# From (1, t, t^2, t^3) to the weights of the four control points.
_BASIS = np.array([[1.0, 0, 0, 0], [-3, 3, 0, 0], [3, -6, 3, 0], [-1, 3, -3, 1]])
# Rounds of a fit, how much a difference along the curve counts in it, and the pull that keeps it bounded.
_ROUNDS, _SLIDING, _PULL = 24, 0.1, 1e-6
# Whether a fit will do is seen after so many rounds, if from then on it does not go so many times as fast.
_TREND, _HOPE = 3, 2.0
# Points on either side that decide the tangent where a stroke is cut in two.
_TANGENT_POINTS = 3


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

    def between(self, start: float, end: float) -> BezierChain:
        """The part from t = start to t = end, 0 <= start < end <= k, as a chain of its own."""
        pieces = []
        for piece in range(int(np.floor(start)), int(np.ceil(end))):
            low, high = max(start - piece, 0.0), min(end - piece, 1.0)
            # Blossoming: each control point mixes both ends of the part (de Casteljau).
            quad = self.controls[3 * piece : 3 * piece + 4]
            pieces.append(np.stack([_blossom(quad, (low,) * (3 - k) + (high,) * k) for k in range(4)]))
        return BezierChain(np.concatenate([pieces[0], *(piece[1:] for piece in pieces[1:])]))

    def sampled(self, per_curve: int) -> tuple[Floats, Floats]:
        """Evenly spaced t, (k * per_curve + 1,), and the points there."""
        t = np.linspace(0.0, self.count, self.count * per_curve + 1)
        return t, self.at(t)


def _blossom(quad: Floats, at: tuple[float, ...]) -> Floats:
    """The polar form of a cubic, (4, 2), at three parameters: (2,)."""
    for u in at:
        quad = (1.0 - u) * quad[:-1] + u * quad[1:]
    return quad[0]


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
        third = np.linalg.norm(points[1] - points[0]) / 3
        middle = straight(points[0], points[1]).controls
        if first is not None:
            middle[1] = points[0] + third * first
        if last is not None:
            middle[2] = points[1] - third * last
        return [middle]
    controls, error = _fit_one(points, first, last, tolerance)
    if error.max() <= tolerance:
        return [controls]
    worst = int(np.clip(error.argmax(), 1, len(points) - 2))
    tangent = _tangent(points[max(worst - _TANGENT_POINTS, 0) : worst + _TANGENT_POINTS + 1], points[worst])
    return _fit_pieces(points[: worst + 1], tolerance, first, tangent) + _fit_pieces(
        points[worst:], tolerance, tangent, last
    )


def _tangent(around: Floats, at: Floats) -> Floats:
    """The unit tangent of a stroke at one of its points, by a parabola through its neighbours."""
    u = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(around, axis=0), axis=1))])
    u -= u[np.linalg.norm(around - at, axis=1).argmin()]
    powers = u[:, None] ** np.arange(min(len(u), 3))
    tangent = np.linalg.lstsq(powers, around, rcond=None)[0][1]
    length = np.linalg.norm(tangent)
    return tangent / length if length > 0 else np.array([1.0, 0.0])


def _fit_one(points: Floats, first: Floats | None, last: Floats | None, tolerance: float) -> tuple[Floats, Floats]:
    """The best single cubic through both ends, and how far it passes from every point.

    Points may slide along the curve: they are put where they are nearest, and what is then fitted is hardly more than
    the distance square to the curve (Wang, Pottmann and Liu 2006).
    """
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    u = np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum()
    along, sliding = np.zeros_like(points), 1.0
    best: tuple[Floats, Floats] | None = None
    worst: list[float] = []
    for left in reversed(range(_ROUNDS)):
        controls = _least_squares(points, u, along, sliding, first, last, lengths.sum())
        c = (_BASIS @ controls)[None]
        for _ in range(2):
            away, tangent = polynomial(c, u) - points, slope(c, u)
            bottom = np.einsum("ij,ij->i", tangent, tangent) + np.einsum("ij,ij->i", away, bend(c, u))
            u = u - np.divide(np.einsum("ij,ij->i", away, tangent), bottom, out=np.zeros_like(u), where=bottom > 0)
            u = np.clip(u, 0.0, 1.0)
            u[0], u[-1] = 0.0, 1.0
        tangent = slope(c, u)
        along = tangent / np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), np.finfo(float).tiny)
        sliding = _SLIDING
        error = np.linalg.norm(polynomial(c, u) - points, axis=1)
        if best is None or error.max() < best[1].max():
            best = controls, error
        worst.append(float(best[1].max()))
        if error.max() <= 0.5 * tolerance or _hopeless(worst, left, tolerance):
            break
    assert best is not None
    return best


def _hopeless(worst: list[float], left: int, tolerance: float) -> bool:
    """Whether errors that fell as ``worst`` did so far will not be within the tolerance in the rounds that are left."""
    if len(worst) <= _TREND:
        return False
    fell = worst[-1] / worst[-1 - _TREND]
    return worst[-1] * fell ** (_HOPE * left / _TREND) > tolerance


def _least_squares(
    points: Floats, u: Floats, along: Floats, sliding: float, first: Floats | None, last: Floats | None, length: float
) -> Floats:
    """Control points with the ends fixed; an inner one is free, or slides along a tangent that is set.

    along: unit tangents, (m, 2); differences in their direction count ``sliding`` times.
    """
    weights = (u[:, None] ** np.arange(4)) @ _BASIS
    # Each inner control point is an anchor plus free directions: both axes, or the tangent alone.
    free = [np.eye(2) if first is None else first[None], np.eye(2) if last is None else -last[None]]
    target = points - weights[:, :2].sum(axis=1)[:, None] * points[0] - weights[:, 2:].sum(axis=1)[:, None] * points[-1]
    directions = np.concatenate(free)
    own = weights[:, np.repeat([1, 2], [len(side) for side in free])]
    # All of a difference counts, less what lies along the curve.
    off = 1.0 - sliding**2
    slid = own * (along @ directions.T)
    normal = (own.T @ own) * (directions @ directions.T) - off * slid.T @ slid
    wanted = ((own.T @ target) * directions).sum(axis=1) - off * slid.T @ (along * target).sum(axis=1)
    # A little pull toward the ends keeps control points near when few points decide them.
    solution = np.linalg.solve(normal + _PULL**2 * np.eye(len(normal)), wanted)
    split = len(free[0])
    second, third = (
        side * min(1.0, length / max(float(np.linalg.norm(side)), np.finfo(float).tiny))
        for side in (solution[:split] @ free[0], solution[split:] @ free[1])
    )
    # Few points could ask for handles longer than the stroke; a tangent that points backward would make a loop.
    if first is not None and second @ first <= 0:
        second = first * length / 3
    if last is not None and third @ last >= 0:
        third = -last * length / 3
    return np.stack([points[0], points[0] + second, points[-1] + third, points[-1]])
