"""Editable curves over 0 to 1: the length distribution l(u) and the deviation radius r(s) of Choe, Ko 2005, section 2.1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from ..head.mesh import Floats
from ..params import ParameterError
from .settings import CurvePoints, WispSettings

MOST_POINTS = 64

# Densities over the relative length u, up to a factor.
_LENGTH_DISTRIBUTIONS: dict[str, CurvePoints] = {
    "blunt": ((0.985, 1.0), (1.0, 1.0)),
    "trimmed": ((0.8, 0.0), (0.97, 1.0), (1.0, 0.8)),
    "layered": ((0.5, 0.3), (0.75, 0.8), (1.0, 1.0)),
    "feathered": ((0.3, 0.0), (0.6, 1.0), (0.85, 0.7), (1.0, 0.2)),
    "frayed": ((0.1, 0.4), (0.4, 0.6), (0.9, 1.0), (1.0, 0.6)),
}

# Radii over the parameter s, relative to that at the root.
_DEVIATION_RADII: dict[str, CurvePoints] = {
    "constant": ((0.0, 1.0), (1.0, 1.0)),
    "tapering": ((0.0, 1.0), (0.5, 0.85), (1.0, 0.35)),
    "bell": ((0.0, 0.4), (0.3, 0.5), (0.7, 1.2), (1.0, 1.8)),
    "pinched": ((0.0, 1.0), (0.25, 0.8), (0.5, 0.12), (0.75, 0.7), (1.0, 0.8)),
    "flaring": ((0.0, 1.0), (0.6, 1.1), (1.0, 2.2)),
}


def checked_curve(points: CurvePoints) -> Floats:
    """The control points as an array, (k, 2). Raises ParameterError unless they are a curve over 0 to 1, nowhere negative.

    There are 2 to 64 of them, and x rises from each to the next.
    """
    if not 2 <= len(points) <= MOST_POINTS:
        raise ParameterError(f"a curve has 2 to {MOST_POINTS} control points, got {len(points)}")
    curve = np.array(points, dtype=np.float64)
    if curve.shape != (len(points), 2) or not np.isfinite(curve).all():
        raise ParameterError("the control points of a curve are pairs of finite numbers")
    x, y = curve.T
    if x[0] < 0 or x[-1] > 1 or (np.diff(x) <= 0).any() or y.min() < 0:
        raise ParameterError("a curve goes from left to right between 0 and 1 and is nowhere negative")
    return curve


@dataclass(frozen=True, eq=False)
class LengthDistribution:
    """l(u): a density that is linear between control points (u, density), (k, 2), and zero outside them."""

    points: Floats

    @classmethod
    def of(cls, settings: WispSettings) -> LengthDistribution:
        """The distribution that the settings ask for. Raises ParameterError for a curve that is no density."""
        points = checked_curve(settings.length_curve or _LENGTH_DISTRIBUTIONS[settings.length_distribution])
        if points[:, 1].max() <= 0 or points[-1, 0] <= 0:
            raise ParameterError("a length distribution is above zero somewhere")
        return cls(points)

    def cumulative(self, u: Floats) -> Floats:
        """The probability of a length of at most ``u``, any shape."""
        mass, (x, y) = self._mass, self.points.T
        piece = np.clip(np.searchsorted(x, u, side="right") - 1, 0, len(x) - 2)
        step = np.clip(u, x[0], x[-1]) - x[piece]
        slope = np.diff(y) / np.diff(x)
        return (mass[piece] + step * (y[piece] + 0.5 * slope[piece] * step)) / mass[-1]

    def sample(self, probability: Floats) -> Floats:
        """The lengths u of which a part ``probability`` is shorter: uniform random numbers become l(u). Any shape."""
        mass, (x, y) = self._mass, self.points.T
        wanted = probability * mass[-1]
        piece = np.clip(np.searchsorted(mass, wanted, side="right") - 1, 0, len(x) - 2)
        rest = np.maximum(wanted - mass[piece], 0.0)
        slope = (np.diff(y) / np.diff(x))[piece]
        # The root of a quadratic, written so that neither a flat piece nor one that starts at zero divides by zero.
        root = y[piece] + np.sqrt(np.maximum(y[piece] ** 2 + 2 * slope * rest, 0.0))
        step = np.divide(2 * rest, root, out=np.zeros_like(rest), where=root > 0)
        return np.minimum(x[piece] + step, x[piece + 1])

    @property
    def _mass(self) -> Floats:
        x, y = self.points.T
        return np.concatenate([[0.0], np.cumsum(0.5 * (y[1:] + y[:-1]) * np.diff(x))])


def radius_points(settings: WispSettings) -> CurvePoints:
    """The control points (s, r) of the deviation radius that the settings ask for, relative to that at the root."""
    return settings.radius_curve or _DEVIATION_RADII[settings.deviation_radius]


def deviation_radius(settings: WispSettings, s: Floats) -> NDArray[np.float64]:
    """r(s) as a multiple of the radius at the root, at parameters ``s``, any shape; smooth, and nowhere beyond its points.

    Raises ParameterError for control points that are no curve.
    """
    x, y = checked_curve(radius_points(settings)).T
    return settings.radius * PchipInterpolator(x, y)(np.clip(s, x[0], x[-1]))
