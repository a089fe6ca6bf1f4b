"""The cross section of a furrow: the shape (2.1), or a curve of its own that was drawn or measured.

Real grooves have round floors and rims of any height, where the shape (2.1) has a sharp floor and rims that take just what
the floor gives. A *section* is a row of control heights across the furrow, evenly spaced and the same number on both sides
of its line; between them runs a uniform cubic B-spline, which is smooth in slope and bend and ends flat on the skin.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .shape import REACH, bounded_shape, bounded_slope

Section = tuple[float, ...]
"""Control heights from right to left, as parts of the furrow's depth (-1: its floor); none: the section is (2.1)."""

SPACING = 0.3
"""How far apart the control heights of a section are, in widths of the furrow."""


def section_places(count: int) -> Floats:
    """Where the control heights of a section are, to the left of the line in widths, (count,)."""
    return np.asarray(SPACING * (np.arange(count) - 0.5 * (count - 1)))


def section_reach(section: Section) -> float:
    """How far from its line a furrow of this section displaces the skin, in widths."""
    # The spline of a control height is two spacings long on either side.
    return SPACING * (0.5 * (len(section) - 1) + 2.0) if section else REACH


def section_height(across: Floats, depth: float, width: float, section: Section) -> Floats:
    """Height at distances to the left of a furrow [m], (k,)."""
    if not section:
        return bounded_shape(np.abs(across), depth, width)
    return _summed(across / width, depth * np.array(section), slopes=False)


def section_slope(across: Floats, depth: float, width: float, section: Section) -> Floats:
    """The derivative of ``section_height`` towards the left, (k,). On the sharp floor of (2.1) it is that of the left wall."""
    if not section:
        return np.where(across < 0, -1.0, 1.0) * bounded_slope(np.abs(across), depth, width)
    return _summed(across / width, depth / width * np.array(section), slopes=True)


def section_shares(across: Floats, width: float, count: int) -> Floats:
    """What each of ``count`` control heights says at distances to the left of a furrow [m], (k, count)."""
    shares = np.zeros((len(across), count + 6))
    first, weights, _ = _spline(across / width, count)
    rows = np.arange(len(across))
    for k, weight in enumerate(weights):
        shares[rows, first + k] = weight
    return shares[:, 3:-3]


def _summed(x: Floats, heights: Floats, slopes: bool) -> Floats:
    padded = np.pad(heights, 3)
    first, *weights = _spline(x, len(heights))
    total: Floats = sum(padded[first + k] * weight for k, weight in enumerate(weights[slopes]))
    return total


def _spline(x: Floats, count: int) -> tuple[np.ndarray, tuple[Floats, ...], tuple[Floats, ...]]:
    """At x, (k,), in widths: the first of four control heights, three zeros before the first counted, and what each says
    and how that changes per width."""
    # Beyond the ends all four are zeros.
    place = np.clip(x / SPACING + 0.5 * (count - 1), -2.0, count + 1.0) + 2.0
    first = np.minimum(place.astype(np.int64), count + 2)
    u = place - first
    weights = (1 - u) ** 3, 4 - 6 * u**2 + 3 * u**3, 1 + 3 * u + 3 * u**2 - 3 * u**3, u**3
    slopes = -((1 - u) ** 2), 3 * u**2 - 4 * u, 1 + 2 * u - 3 * u**2, u**2
    return first, tuple(w / 6.0 for w in weights), tuple(0.5 * s / SPACING for s in slopes)
