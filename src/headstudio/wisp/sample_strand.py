"""A strand of hair from elsewhere as the prototype that all strands resemble."""

from __future__ import annotations

import numpy as np

from .resample import resampled
from .settings import Path3D
from .strands import Strands

# A prototype is bent by its points: more than so many could not be told apart.
_MOST_POINTS = 48
_UNITS = (1.0, 0.01, 0.001)  # metres, centimetres, millimetres
_USUAL = 0.2  # length of hair [m]; the unit is the one that comes nearest to it


def sample_strand(strands: Strands) -> Path3D:
    """The strand of middle length [m], root first and at the origin, through 48 points at most.

    The file's unit is guessed: metres, centimetres or millimetres.
    """
    lengths = strands.lengths
    middle = int(np.argsort(lengths, kind="stable")[len(lengths) // 2])
    points = strands.points[strands.first[middle] : strands.first[middle + 1]]
    if len(points) > _MOST_POINTS:
        points = resampled(Strands(points, np.array([0, len(points)])), _MOST_POINTS).points
    unit = min(_UNITS, key=lambda unit: abs(np.log(max(unit * lengths[middle], 1e-12) / _USUAL)))
    return tuple((float(x), float(y), float(z)) for x, y, z in unit * (points - points[0]).astype(np.float64))
