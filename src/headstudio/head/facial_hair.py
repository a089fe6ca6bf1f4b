"""Where a beard and a moustache grow: curves around two more patches of skin, from landmarks.

They are cut out and mapped to the unit square as the scalp is. Seen from outside a patch lies to the left of its curves,
so here the front curve is the lower edge: v runs from the throat (0) to the cheeks and the lower lip (1), or over the
upper lip toward the nose.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from .hairline import AroundHead
from .head import Head, HeadError
from .mesh import Floats

# As ScalpSettings takes them.
Curves = tuple[tuple[tuple[float, float, float], ...], ...]

# Azimuth [deg] and height, 0 at the tragus and -1 at the chin.
_THROAT = ((64, -0.98), (40, -1.06), (20, -1.1), (0, -1.12))
_JAW = ((82, -0.62), (86, -0.3))
# It reaches as far up before the ear as the hair of the head reaches down.
_SIDEBURN = ((85, -0.02), (84, 0.18), (72, 0.18))
_CHEEK = ((72, -0.05), (68, -0.22), (58, -0.42), (46, -0.58))
# Azimuth beyond the corner of the mouth [deg] and height, 0 at the mouth and -1 at the chin.
_BESIDE_MOUTH = ((9, 0.05), (2, -0.28))
_BELOW_LIP = -0.33
# Azimuth as a part of that of the mouth's corner and height, 0 at the mouth and 1 at the tip of the nose.
_MOUSTACHE_CORNER = ((1.42, -0.25), (1.38, 0.12))
_UPPER_LIP = ((0.95, 0.14), (0.6, 0.3), (0.25, 0.36), (0.0, 0.34))
_UNDER_NOSE = ((0.95, 0.4), (0.65, 0.6), (0.4, 0.67), (0.0, 0.68))


def beard_curves(head: Head) -> Curves:
    """The curves around cheeks, jaw, chin and throat: a band from one ear to the other below the mouth.

    Four curves of control points [m], as ScalpSettings takes them. Raises HeadError when the landmarks do not lie as on a
    head.
    """
    around = AroundHead.of(head)
    marks = head.landmarks
    ear, chin = around.middle[1], marks.chin[1]
    if not ear > marks.mouth_left[1] > chin:
        raise HeadError("the landmarks do not lie as on a head: the mouth between ears and chin")
    drop, corner, mouth = ear - chin, _corner_azimuth(head, around), marks.mouth_left[1] - ear
    lip = marks.mouth_left[1] - chin

    def place(azimuth: float, height: float) -> tuple[float, float]:
        return azimuth, height * drop

    def beside(azimuth: float, height: float) -> tuple[float, float]:
        return corner + azimuth, mouth + height * lip

    lower = [place(*_JAW[1]), place(*_JAW[0]), *(place(*point) for point in _THROAT)]
    upper = [place(*_SIDEBURN[-1]), *(place(*p) for p in _CHEEK), *(beside(*p) for p in _BESIDE_MOUTH)]
    upper.append((0.0, mouth + _BELOW_LIP * lip))
    return _around(around, lower, [place(*point) for point in _SIDEBURN[:-1]], upper)


def moustache_curves(head: Head) -> Curves:
    """The curves around the skin between nose and upper lip; as ``beard_curves``."""
    around = AroundHead.of(head)
    marks = head.landmarks
    if not marks.nose_tip[1] > marks.mouth_left[1]:
        raise HeadError("the landmarks do not lie as on a head: the nose above the mouth")
    corner, mouth = _corner_azimuth(head, around), marks.mouth_left[1] - around.middle[1]
    rise = marks.nose_tip[1] - marks.mouth_left[1]

    def place(azimuth: float, height: float) -> tuple[float, float]:
        return azimuth * corner, mouth + height * rise

    lower = [place(*_MOUSTACHE_CORNER[0]), *(place(*point) for point in _UPPER_LIP)]
    upper = [place(*_MOUSTACHE_CORNER[1]), *(place(*point) for point in _UNDER_NOSE)]
    return _around(around, lower, [], upper)


REGIONS: Mapping[str, Callable[[Head], Curves]] = {"beard": beard_curves, "moustache": moustache_curves}


def _corner_azimuth(head: Head, around: AroundHead) -> float:
    """Azimuth of the corner of the mouth [deg]."""
    across, ahead = (head.landmarks.mouth_left - around.middle)[[0, 2]]
    return math.degrees(math.atan2(abs(across), ahead))


def _around(
    around: AroundHead,
    lower: list[tuple[float, float]],
    side: list[tuple[float, float]],
    upper: list[tuple[float, float]],
) -> Curves:
    """The four curves from the left half of each edge, outermost point first, and of what lies between them."""

    def half(points: list[tuple[float, float]], sign: int) -> Floats:
        azimuth, height = np.array(points).T
        return around.place(sign * azimuth, height)

    def edge(points: list[tuple[float, float]]) -> Floats:
        return np.concatenate([half(points, -1), half(points, 1)[-2::-1]])

    front, back = edge(lower), edge(upper)[::-1]
    left, right = (half(side, sign) if side else np.zeros((0, 3)) for sign in (1, -1))
    sides = [np.concatenate([front[-1:], left, back[:1]]), np.concatenate([back[-1:], right[::-1], front[:1]])]
    return tuple(tuple((x, y, z) for x, y, z in curve.tolist()) for curve in (front, sides[0], back, sides[1]))
