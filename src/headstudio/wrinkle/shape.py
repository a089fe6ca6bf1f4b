"""The cross section of a large wrinkle and how it grows: Bando's thesis, equations 2.1, 2.2 and 2.4."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

# Where a displaced furrow leaves (2.1) and where it ends, in widths. In between the profile runs out to zero.
_LEAVES = 5.0
REACH = 8.0
# Over this much shrinkage a wrinkle that is not there at rest begins.
_CORNER = 0.01


def wrinkle_shape(distance: Floats, depth: Floats | float, width: Floats | float) -> Floats:
    """Height over the skin at a distance from a furrow, S(l) = d (l / w - 1) exp(-l / w): eq. 2.1.

    distance: l >= 0 [m]. depth: d [m]. width: w [m]. The floor is sharp at -d, the bulge is highest, 0.135 d, at 2 w, and
    the integral from 0 to infinity is zero (eq. 2.2): what the furrow gives, the bulge takes.
    """
    x = np.asarray(distance) / width
    return depth * (x - 1.0) * np.exp(-x)


def bounded_shape(distance: Floats, depth: Floats | float, width: Floats | float) -> Floats:
    """Eq. 2.1 on a strip: S(l) up to 5 w, zero from 8 w on, and its integral still exactly zero.

    S is the derivative of -d l exp(-l / w). Bringing that down to zero smoothly keeps the balance of eq. 2.2; the profile
    differs from the printed one by less than 0.8 % of d.
    """
    x = np.asarray(distance) / width
    fade, slope = _fade(x)
    return depth * np.exp(-x) * ((x - 1.0) * fade - x * slope)


def bounded_slope(distance: Floats, depth: Floats | float, width: Floats | float) -> Floats:
    """The derivative of ``bounded_shape`` by distance, dimensionless; at the floor, l = 0, it is 2 d / w."""
    x = np.asarray(distance) / width
    fade, slope, bend = (*_fade(x), _fade_bend(x))
    return depth / width * np.exp(-x) * ((2.0 - x) * fade + 2.0 * (x - 1.0) * slope - x * bend)


def amplitude(shrinkage: Floats, initial: Floats | float) -> Floats:
    """Amplitude modulation M(s) for skin that shrinks by s across the furrow: eq. 2.4.

    initial: r in [0, 1], the amplitude at rest relative to the largest. M is C1 at s = 0 for every r. The printed form is
    not at r = 0, where its branches 0 and s meet in a corner; there the corner is rounded over the first 0.01 of
    shrinkage, which lowers M by at most 0.005. M(0) = 0 and M(s < 0) = 0 stay.
    """
    s, r = np.broadcast_arrays(np.asarray(shrinkage, dtype=np.float64), np.asarray(initial, dtype=np.float64))
    grown = np.asarray((1.0 - r) * s + r)
    stretched = np.nonzero((s < 0) & (r > 0))
    kept = r[stretched]
    grown[stretched] = kept * np.exp(s[stretched] * (1.0 / kept - 1.0))
    # Where r is 0: a parabola up to the corner, and then the line that it runs into.
    none = np.nonzero(r == 0)
    low = np.clip(s[none], 0.0, _CORNER)
    grown[none] = low * (s[none] - 0.5 * low) / _CORNER
    return grown


def _fade(x: Floats) -> tuple[Floats, Floats]:
    """From 1 to 0 between the two ends, twice differentiable, and the slope."""
    part = np.clip((x - _LEAVES) / (REACH - _LEAVES), 0.0, 1.0)
    fade = 1.0 - part**3 * (10.0 - 15.0 * part + 6.0 * part**2)
    return fade, -30.0 * (part * (1.0 - part)) ** 2 / (REACH - _LEAVES)


def _fade_bend(x: Floats) -> Floats:
    part = np.clip((x - _LEAVES) / (REACH - _LEAVES), 0.0, 1.0)
    return -60.0 * part * (1.0 - part) * (1.0 - 2.0 * part) / (REACH - _LEAVES) ** 2
