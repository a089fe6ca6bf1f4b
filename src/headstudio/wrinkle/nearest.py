"""The nearest point of a furrow, with lengths as they are on the skin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from .bezier import BezierChain, bend, polynomial, slope

# A curve is first looked at in this many places; the best few are then made exact by Newton's method.
_SAMPLES = 16
_CANDIDATES = 3
_NEWTON_STEPS = 30
_SETTLED = 1e-10
# So many points are treated at a time, to bound memory.
_BATCH = 8192


@dataclass(frozen=True, eq=False)
class NearestOnCurve:
    """Where k points find a curve. t: its parameter, (k,). distance: l, (k,). side: 1 left of the curve, -1 right, (k,).

    beyond: whether the nearest point is an end of the chain, so that the point lies past it, (k,).
    """

    t: Floats
    distance: Floats
    side: Floats
    beyond: np.ndarray


def nearest_on_curve(chain: BezierChain, points: Floats, metrics: Floats | None = None) -> NearestOnCurve:
    """The nearest point of a chain for each of ``points``, (k, 2), to rounding.

    metrics: G of each point, (k, 2, 2), to measure lengths with; without it they are those of the plane.
    """
    if metrics is None:
        metrics = np.broadcast_to(np.eye(2), (len(points), 2, 2))
    starts = range(0, max(len(points), 1), _BATCH)
    batches = [_nearest(chain, points[k : k + _BATCH], metrics[k : k + _BATCH]) for k in starts]
    return NearestOnCurve(
        *(np.concatenate([getattr(batch, name) for batch in batches]) for name in ("t", "distance", "side", "beyond"))
    )


def _nearest(chain: BezierChain, points: Floats, metrics: Floats) -> NearestOnCurve:
    u = np.linspace(0.0, 1.0, _SAMPLES + 1)
    samples = polynomial(chain.coefficients[:, None], u)
    piece, rough = _candidates(points, metrics, samples)
    coefficients = chain.coefficients[piece]
    local = _newton(coefficients, u[rough], points[:, None], metrics[:, None])
    away = points[:, None] - polynomial(coefficients, local)
    squared = _form(metrics[:, None], away, away)
    row, best = np.arange(len(points)), squared.argmin(axis=1)
    t, away = (piece + local)[row, best], away[row, best]
    tangent = slope(coefficients[row, best], local[row, best])
    side = np.where(tangent[:, 0] * away[:, 1] - tangent[:, 1] * away[:, 0] >= 0, 1.0, -1.0)
    off_end = np.abs(_form(metrics, away, tangent)) > 1e-6 * np.sqrt(
        np.maximum(squared[row, best] * _form(metrics, tangent, tangent), np.finfo(float).tiny)
    )
    beyond = ((t <= 0) | (t >= chain.count)) & off_end
    return NearestOnCurve(t, np.sqrt(squared[row, best]), side, beyond)


def _candidates(points: Floats, metrics: Floats, samples: Floats) -> tuple[Ints, Ints]:
    """The curves and samples, (k, c) each, near the lowest local minima of the distance."""
    away = points[:, None, None] - samples
    distance = _form(metrics[:, None, None], away, away)
    padded = np.pad(distance, ((0, 0), (0, 0), (1, 1)), constant_values=np.inf)
    lowest = (distance <= padded[..., :-2]) & (distance <= padded[..., 2:])
    flat = np.where(lowest, distance, np.inf).reshape(len(points), samples.shape[0] * samples.shape[1])
    found = np.argpartition(flat, _CANDIDATES - 1, axis=1)[:, :_CANDIDATES]
    return np.divmod(found, samples.shape[1])


def _newton(coefficients: Floats, u: Floats, points: Floats, metrics: Floats) -> Floats:
    """The parameter where the distance is least, near u, (k, c): Newton's method within the two neighbouring samples."""
    low, high = np.maximum(u - 1.0 / _SAMPLES, 0.0), np.minimum(u + 1.0 / _SAMPLES, 1.0)
    for _ in range(_NEWTON_STEPS):
        away, tangent = polynomial(coefficients, u) - points, slope(coefficients, u)
        gradient = _form(metrics, away, tangent)
        # The minimum lies on the side to which the distance falls.
        low, high = np.where(gradient < 0, u, low), np.where(gradient > 0, u, high)
        speed = _form(metrics, tangent, tangent)
        curvature = speed + _form(metrics, away, bend(coefficients, u))
        # Where the distance is not convex, a Gauss-Newton step falls at least.
        curvature = np.maximum(np.where(curvature > 0, curvature, speed), np.finfo(float).tiny)
        step = u - gradient / curvature
        step = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        settled = np.abs(step - u).max(initial=0.0) < _SETTLED
        u = step
        if settled:
            break
    return u


def _form(metrics: Floats, a: Floats, b: Floats) -> Floats:
    """a . G b."""
    first = metrics[..., 0, 0] * b[..., 0] + metrics[..., 0, 1] * b[..., 1]
    second = metrics[..., 1, 0] * b[..., 0] + metrics[..., 1, 1] * b[..., 1]
    return a[..., 0] * first + a[..., 1] * second
