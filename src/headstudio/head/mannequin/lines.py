"""A body drawn like a ship: a few level sections, and everything between them by splines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

from ..mesh import Floats


class Section(NamedTuple):
    """One level section, millimetres: two half superellipses that meet where the body is broadest.

    height: y of the section. half_breadth: largest x. widest: z where it is reached. front, back: z of the two ends on
    the middle line. squareness: exponent of the superellipse, 2 being an ellipse, for the front and the back half.
    """

    height: float
    half_breadth: float
    widest: float
    front: float
    back: float
    front_squareness: float = 2.0
    back_squareness: float = 2.0


class Lines:
    """The field of a body given by its sections, from the lowest to the highest.

    A section of no breadth closes the body there with a round cap: the square of the breadth is what the spline runs
    through, and that crosses zero with a slope.
    """

    def __init__(self, sections: Sequence[Section]) -> None:
        rows = np.array(sorted(sections), dtype=float)
        height, breadth = rows[:, 0], rows[:, 1]
        self._ends = (height[0], height[-1])
        self._breadth_squared = CubicSpline(height, breadth**2)
        broad = breadth > 0
        level, breadth = height[broad], breadth[broad]
        front_ratio = breadth / (rows[broad, 3] - rows[broad, 2])
        back_ratio = breadth / (rows[broad, 2] - rows[broad, 4])
        shape = np.stack([rows[broad, 2], front_ratio, back_ratio, rows[broad, 5], rows[broad, 6]], axis=1)
        self._shape = PchipInterpolator(level, shape)
        self._level = (level[0], level[-1])

    def __call__(self, p: Floats) -> Floats:
        """Distance [mm] to first order, at points of shape (n, 3)."""
        y = np.clip(p[:, 1], *self._ends)
        slope = self._breadth_squared(y, 1)
        squared = self._breadth_squared(y) + slope * (p[:, 1] - y)
        level = np.clip(p[:, 1], *self._level)
        widest, front_ratio, back_ratio, front_power, back_power = self._shape(level).T
        depth = p[:, 2] - widest
        ahead = depth > 0
        ratio, power = np.where(ahead, front_ratio, back_ratio), np.where(ahead, front_power, back_power)
        across, along = np.abs(p[:, 0]) + 1e-6, np.abs(depth) * ratio + 1e-6
        radius = (across**power + along**power) ** (1.0 / power)
        value = radius**2 - squared
        gradient = np.hypot(
            2.0 * radius * np.hypot((across / radius) ** (power - 1), ratio * (along / radius) ** (power - 1)), slope
        )
        return value / np.maximum(gradient, 20.0)
