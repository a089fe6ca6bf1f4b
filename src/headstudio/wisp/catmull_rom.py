"""Strands as Catmull-Rom splines through control points (Choe, Ko 2005, section 2.1), sampled by a matrix."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..head.mesh import Floats


def catmull_rom_matrix(count: int, at: ArrayLike) -> Floats:
    """The matrix (k, count) that takes ``count`` control points to the points of their spline at parameters ``at``, (k,).

    Control point i lies at the parameter i; parameters go from 0 to count - 1. Each end is continued straight, so that
    the spline runs through the first and the last point.
    """
    parameter = np.clip(np.atleast_1d(np.asarray(at, dtype=np.float64)), 0.0, count - 1)
    piece = np.minimum(parameter.astype(np.int64), max(count - 2, 0))
    t = parameter - piece
    t2, t3 = t * t, t * t * t
    weights = 0.5 * np.stack([2 * t2 - t - t3, 3 * t3 - 5 * t2 + 2, 4 * t2 - 3 * t3 + t, t3 - t2])
    # Columns stand for the control points -1 to count; the two beyond the ends follow from their neighbours.
    padded = np.zeros((len(parameter), count + 3))
    row = np.arange(len(parameter))
    for offset, weight in enumerate(weights):
        padded[row, piece + offset] += weight
    matrix = padded[:, 1 : count + 1]
    if count > 1:
        before, after = padded[:, 0], padded[:, count + 1]
        matrix[:, 0] += 2 * before
        matrix[:, 1] -= before
        matrix[:, -1] += 2 * after
        matrix[:, -2] -= after
    return matrix
