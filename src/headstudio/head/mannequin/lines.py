"""A body drawn like a ship: a few level sections, and everything between them by splines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.ndimage import gaussian_filter1d

from ..mesh import Floats

_REACH = 5  # how far fairing reaches along the height [mm]


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


class _Batten:
    """A smooth curve over the height near the values given: as a batten fairs the lines of a ship, without kinks."""

    def __init__(self, height: Floats, values: Floats) -> None:
        self.low, self.high = height[0], height[-1]
        fine = np.linspace(self.low, self.high, int(self.high - self.low) + 1)
        margin = 4 * _REACH
        drawn = PchipInterpolator(height, values)(fine)
        padding = [(margin, margin)] + [(0, 0)] * (drawn.ndim - 1)
        padded = np.pad(drawn, padding, mode="reflect", reflect_type="odd")
        self._curve = CubicSpline(fine, gaussian_filter1d(padded, _REACH, axis=0)[margin:-margin])

    def __call__(self, y: Floats, derivative: int = 0) -> Floats:
        return self._curve(np.clip(y, self.low, self.high), derivative)


class Lines:
    """The field of a body given by its sections, from the lowest to the highest.

    A section of no breadth closes the body there with a round cap: the square of the breadth is what the spline runs
    through, and that crosses zero with a slope.
    """

    def __init__(self, sections: Sequence[Section]) -> None:
        rows = np.array(sorted(sections), dtype=float)
        height, breadth = rows[:, 0], rows[:, 1]
        broad = breadth > 0
        ratios = np.abs(breadth[broad, None] / (rows[broad, 3:5] - rows[broad, 2:3]))
        shape = np.concatenate([rows[broad, 2:3], ratios, rows[broad, 5:]], axis=1)
        self._breadth_squared = _Batten(height, breadth**2)
        self._shape = _Batten(height[broad], shape)

    def __call__(self, p: Floats) -> Floats:
        """Distance [mm] to first order, at points of shape (n, 3)."""
        y = p[:, 1]
        slope = self._breadth_squared(y, 1)
        beyond = y - np.clip(y, self._breadth_squared.low, self._breadth_squared.high)
        squared = self._breadth_squared(y) + slope * beyond
        widest, front_ratio, back_ratio, front_power, back_power = self._shape(y).T
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
