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
    """One level section, millimetres: two halves of full ellipses that meet where the body is broadest.

    height: y of the section. half_breadth: largest x. widest: z where it is reached. front, back: z of the two ends on
    the middle line. fullness: how far the front and the back half go beyond an ellipse on the diagonals, 0 being an
    ellipse.
    """

    height: float
    half_breadth: float
    widest: float
    front: float
    back: float
    front_fullness: float = 0.0
    back_fullness: float = 0.0


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
        """Distance [mm] to first order, at points of shape (3, n)."""
        x, y, z = p
        slope = self._breadth_squared(y, 1)
        beyond = y - np.clip(y, self._breadth_squared.low, self._breadth_squared.high)
        squared = self._breadth_squared(y) + slope * beyond
        widest, front_ratio, back_ratio, front_fullness, back_fullness = self._shape(y).T
        ahead = z > widest
        ratio = np.where(ahead, front_ratio, back_ratio)
        fullness = np.where(ahead, front_fullness, back_fullness)
        across, along = x * x, (ratio * (z - widest)) ** 2
        round_ = across + along + 1e-9
        value = round_ - 2.0 * fullness * across * along / round_ - squared
        gradient = np.sqrt(4.0 * (across + ratio**2 * along) + slope**2)
        return value / np.maximum(gradient, 20.0)
