"""Rectangles of a picture, for passes that have something to do in a part of it only."""

from __future__ import annotations

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints
from .view import View

Area = tuple[int, int, int, int]
"""x and y of the lower left corner, width and height, in pixels; nothing where the width or the height is 0."""

# So many directions find the points of a body that reach farthest; the points between them reach a little farther [m].
_DIRECTIONS = 100
_BEYOND = 0.006


class Outline:
    """The points of a part of a skin that bound it in any picture, whatever pose it takes."""

    def __init__(self, points: Floats, turning: Floats, inside: np.ndarray) -> None:
        """points: of the skin at rest [m], (n, 3). turning: how far each turns with the head, (n,). inside: which of them
        are of this part, (n,)."""
        among = np.flatnonzero(inside)
        farthest = (points[among] @ _directions(_DIRECTIONS).T).argmax(axis=0) if len(among) else among
        self._vertices: Ints = np.unique(among[farthest])
        self._turning = turning[self._vertices]
        self._posed = points[self._vertices]

    def pose(self, positions: Floats) -> None:
        """The skin is at ``positions`` [m], (n, 3), of the head at rest."""
        self._posed = positions[self._vertices]

    def area(self, view: View, frame: HeadFrame, size: tuple[int, int]) -> Area:
        """Where a picture of ``size`` shows it, of the head at ``frame``."""
        if not len(self._vertices):
            return 0, 0, 0, 0
        points = frame.skinned(self._posed, self._turning)
        depth = view.depth(points)
        if depth.min() < view.near:
            return 0, 0, *size
        clip = np.column_stack([points, np.ones(len(points))]) @ view.clip_from_world.T
        beyond = _BEYOND * view.focal / depth[:, None] * [size[1] / size[0], 1.0]
        at = clip[:, :2] / clip[:, 3:]
        low, high = (at - beyond).min(axis=0), (at + beyond).max(axis=0)
        first = np.clip(np.floor((0.5 * low + 0.5) * size), 0, size).astype(int)
        last = np.clip(np.ceil((0.5 * high + 0.5) * size), 0, size).astype(int)
        return int(first[0]), int(first[1]), int(last[0] - first[0]), int(last[1] - first[1])


def around(area: Area, size: tuple[int, int]) -> list[Area]:
    """The rest of a picture of ``size`` as rectangles: above and below the area, and at its sides."""
    x, y, width, height = area
    rest = [
        (0, 0, size[0], y),
        (0, y + height, size[0], size[1] - y - height),
        (0, y, x, height),
        (x + width, y, size[0] - x - width, height),
    ]
    return [piece for piece in rest if piece[2] and piece[3]]


def _directions(count: int) -> Floats:
    """Unit vectors to all sides, evenly spread along a spiral, (count, 3)."""
    height = (2 * np.arange(count) + 1) / count - 1
    turn = np.pi * (1 + np.sqrt(5)) * np.arange(count)
    level = np.sqrt(1 - height**2)
    return np.stack([level * np.cos(turn), height, level * np.sin(turn)], axis=1)
