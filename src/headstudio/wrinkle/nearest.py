"""The nearest point of a furrow, with lengths as they are on the skin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from .bezier import BezierChain, bend, polynomial, slope

# A curve is first looked at in this many places; what may be nearest is then made exact by Newton's method.
_SAMPLES = 16
_NEWTON_STEPS = 40
_SETTLED, _NEARLY = 1e-10, 1e-5
# So many points are treated at a time, to bound memory.
_BATCH = 4096


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


def slid_to_nearest(chain: BezierChain, points: Floats, metrics: Floats, t: Floats) -> NearestOnCurve:
    """The nearest point of a chain for each point, on the same curve as t and close to it, (k,).

    Its parameter is within some 1e-5 of it, and so the distance, which is least there, within rounding.
    """
    piece, u = chain.split(t)
    return _measured(chain, points, metrics, piece, _newton(chain.coefficients[piece], u, points, metrics, _NEARLY))


def _nearest(chain: BezierChain, points: Floats, metrics: Floats) -> NearestOnCurve:
    row, piece, u = _candidates(chain, points, metrics)
    u = _newton(chain.coefficients[piece], u, points[row], metrics[row])
    away = points[row] - polynomial(chain.coefficients[piece], u)
    order = np.lexsort((_form(metrics[row], away, away), row))
    best = order[np.unique(row[order], return_index=True)[1]]
    return _measured(chain, points, metrics, piece[best], u[best])


def _measured(chain: BezierChain, points: Floats, metrics: Floats, piece: Ints, u: Floats) -> NearestOnCurve:
    away = points - polynomial(chain.coefficients[piece], u)
    tangent = slope(chain.coefficients[piece], u)
    squared = _form(metrics, away, away)
    side = np.where(tangent[:, 0] * away[:, 1] - tangent[:, 1] * away[:, 0] >= 0, 1.0, -1.0)
    # Beside an end, and not past it, the way to the curve is square to it.
    lengths = np.sqrt(squared * _form(metrics, tangent, tangent))
    past = np.abs(_form(metrics, away, tangent)) > 1e-6 * np.maximum(lengths, np.finfo(float).tiny)
    t = piece + u
    return NearestOnCurve(t, np.sqrt(squared), side, ((t <= 0) | (t >= chain.count)) & past)


def _candidates(chain: BezierChain, points: Floats, metrics: Floats) -> tuple[Ints, Ints, Floats]:
    """Where to look: points, curves and parameters on them, (c,) each, near all minima that can be the lowest."""
    u = np.linspace(0.0, 1.0, _SAMPLES + 1)
    samples = polynomial(chain.coefficients[:, None], u)
    away = points[:, None, None] - samples
    distance = np.sqrt(_form(metrics[:, None, None], away, away))
    lowest = np.ones(distance.shape, dtype=bool)
    lowest[..., 1:] &= distance[..., 1:] <= distance[..., :-1]
    lowest[..., :-1] &= distance[..., :-1] <= distance[..., 1:]
    # The curve comes nearer than its samples by less than the way between two of them.
    step = np.linalg.norm(np.diff(samples, axis=1), axis=2).max()
    bound = distance.min(axis=(1, 2)) + step * np.sqrt(metrics[:, 0, 0] + metrics[:, 1, 1])
    row, piece, sample = np.nonzero(lowest & (distance <= bound[:, None, None]))
    return row, piece, u[sample]


def _newton(coefficients: Floats, u: Floats, points: Floats, metrics: Floats, settled: float = _SETTLED) -> Floats:
    """The parameters where the distances are least, near u, (k,): Newton's method between the neighbouring samples."""
    found, moving = u.copy(), np.arange(len(u))
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
        found[moving] = step
        left = np.abs(step - u) > settled
        if not left.any():
            break
        coefficients, points, metrics = coefficients[left], points[left], metrics[left]
        u, low, high, moving = step[left], low[left], high[left], moving[left]
    return found


def _form(metrics: Floats, a: Floats, b: Floats) -> Floats:
    """a . G b."""
    first = metrics[..., 0, 0] * b[..., 0] + metrics[..., 0, 1] * b[..., 1]
    second = metrics[..., 1, 0] * b[..., 0] + metrics[..., 1, 1] * b[..., 1]
    return a[..., 0] * first + a[..., 1] * second
