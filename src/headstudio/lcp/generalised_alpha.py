"""The generalised-alpha method (Jansen, Whiting, Hulbert 2000): time integration of second order with a chosen damping.

For y' = f(y) it keeps a slope s beside y and asks for the slope at one point of the step what it is at another:

    (1 - a_m) s_n + a_m s_n+1 = f((1 - a_f) y_n + a_f y_n+1),     y_n+1 = y_n + dt ((1 - c) s_n + c s_n+1),

with a_m = (3 - r) / (2 + 2 r), a_f = 1 / (1 + r), c = 1/2 + a_m - a_f. What is far too fast for the step keeps the part r of
itself, slow motion an error of 1/12 + (1 - r)^2 / (1 + r)^2 / 4 in dt^3 y''': r = 0 is the backward difference formula
BDF2, which damps best and is four times less exact than r = 1, the midpoint rule, which damps nothing.

The slope is kept as where y would have been a step before if it had gone straight on: y - dt s.
"""

from __future__ import annotations

from ..head.mesh import Floats

_KEPT = 0.4
"""r: stiff springs calm down within three or four steps, and a step is 2.5 times as exact as one of BDF2."""

FORCE_AT = 1.0 / (1.0 + _KEPT)
"""a_f: the part of the step after which forces are felt."""
_SLOPE_AT = 0.5 * (3.0 - _KEPT) / (1.0 + _KEPT)
_TO_COME = 0.5 + _SLOPE_AT - FORCE_AT
WEIGHT = _TO_COME * FORCE_AT / _SLOPE_AT
"""Of the velocity at the end of a step, times the step, in the way that the step goes."""


def gone_on(now: Floats, before: Floats) -> Floats:
    """What ``now`` comes to at the end of the step without the force that is felt in it, (n, 3)."""
    return now + (1.0 - _TO_COME / _SLOPE_AT) * (now - before)


def on_the_way(now: Floats, then: Floats) -> Floats:
    """What is ``now`` at the beginning and ``then`` at the end, when forces are felt, (n, 3)."""
    return now + FORCE_AT * (then - now)


def way_begun(velocities: Floats, dt: float) -> Floats:
    """The way of a step of dt [s] that the velocity at its beginning [m/s] sees to, (n, 3) [m]."""
    return (dt * _TO_COME * (1.0 - FORCE_AT) / _SLOPE_AT) * velocities


def looking_back(then: Floats, now: Floats, before: Floats) -> Floats:
    """What ``then``, at the end of a step that began at ``now`` and looked back to ``before``, will look back to, (n, 3)."""
    return then - (then - now - (1.0 - _TO_COME) * (now - before)) / _TO_COME
