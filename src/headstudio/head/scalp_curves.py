"""The four curves around the scalp: Bando et al. 2006, figure 2 (a)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from .head import HeadError
from .locate import Locator
from .mesh import Floats

SIDES = ("front", "left", "back", "right")
# A control point farther than this from the skin was not meant to be on it.
_FARTHEST = 0.02
SPACING = 0.004


def catmull_rom(points: Floats) -> CubicHermiteSpline:
    """The centripetal Catmull-Rom curve through control points [m], shape (k, 3), at parameters 0 to 1.

    Knots are spaced by the square root of the chord, which keeps uneven control points from making loops; the tangents
    are those of Barry and Goldman 1988, and each end is continued straight. Raises HeadError for fewer than two points
    or for two that coincide.
    """
    if len(points) < 2:
        raise HeadError("a curve around the scalp needs at least two control points")
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    if chords.min() < 1e-6:
        raise HeadError("two control points of a curve around the scalp coincide")
    padded = np.concatenate([[2 * points[0] - points[1]], points, [2 * points[-1] - points[-2]]])
    step = np.sqrt(np.concatenate([chords[:1], chords, chords[-1:]]))[:, None]
    slope = np.diff(padded, axis=0) / step
    across = (padded[2:] - padded[:-2]) / (step[1:] + step[:-1])
    parameter = np.concatenate([[0.0], np.cumsum(step[1:-1, 0])])
    return CubicHermiteSpline(parameter / parameter[-1], points, (slope[1:] + slope[:-1] - across) * parameter[-1])


def sample_curves(curves: Sequence[Floats], skin: Locator) -> tuple[Floats, ...]:
    """Points along the four curves [m], each (k, 3) with both ends, at most 4 mm apart and not yet on the skin.

    Raises HeadError when a curve does not start where the one before it ends, or a control point is off the skin.
    """
    _check(curves, skin)
    return tuple(_evenly(catmull_rom(points), 20 * len(points)) for points in curves)


def _evenly(curve: CubicHermiteSpline, pieces: int) -> Floats:
    parameter = np.linspace(0, 1, pieces + 1)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve(parameter), axis=0), axis=1))])
    count = max(int(np.ceil(length[-1] / SPACING)), 4)
    return curve(np.interp(np.linspace(0, length[-1], count + 1), length, parameter))


def _check(curves: Sequence[Floats], skin: Locator) -> None:
    if len(curves) != 4:
        raise HeadError(f"the scalp is bounded by four curves, got {len(curves)}")
    for k, points in enumerate(curves):
        if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
            raise HeadError(f"the {SIDES[k]} curve of the scalp has control points that are not points")
        gap = np.linalg.norm(points[0] - curves[k - 1][-1])
        if gap > 1e-6:
            raise HeadError(
                f"the {SIDES[k]} curve of the scalp starts {1000 * gap:.1f} mm from the end of the one before"
            )
        _, distance = skin.nearest(points)
        if distance.max() > _FARTHEST:
            raise HeadError(f"the {SIDES[k]} curve of the scalp leaves the skin by {1000 * distance.max():.0f} mm")
