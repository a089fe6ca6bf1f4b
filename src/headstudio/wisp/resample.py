"""The same strands through another number of points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .catmull_rom import catmull_rom_matrix
from .strands import Singles, Strands


def resampled(strands: Strands, count: int) -> Strands:
    """Every strand with ``count`` points, evenly along its Catmull-Rom spline; radius and colour go along."""
    if (strands.counts == count).all():
        return strands
    own = strands.counts
    points = np.empty((strands.count, count, 3), dtype=np.float32)
    radius = None if strands.radius is None else np.empty((strands.count, count), dtype=np.float32)
    colour = None if strands.colour is None else np.empty((strands.count, count, 3), dtype=np.float32)
    # Strands with the same number of points share one matrix.
    for given in np.unique(own):
        chosen = np.flatnonzero(own == given)
        index = strands.first[chosen, None] + np.arange(given)
        matrix = catmull_rom_matrix(int(given), np.linspace(0, given - 1, count)).astype(np.float32)
        points[chosen] = _through(matrix, strands.points, index)
        if radius is not None and strands.radius is not None:
            radius[chosen] = np.maximum(_through(matrix, strands.radius, index), strands.radius[index].min(1)[:, None])
        if colour is not None and strands.colour is not None:
            colour[chosen] = np.clip(_through(matrix, strands.colour, index), 0.0, 1.0)
    return replace(Strands.of_equal_count(points, radius, colour), wisp=strands.wisp)


def _through(matrix: Singles, values: Singles, index: np.ndarray) -> Singles:
    """Values at the points of each strand, gathered and taken through the spline."""
    gathered = values[index]
    flat = gathered.reshape(*gathered.shape[:2], -1)
    return np.matmul(matrix, flat).reshape(len(index), len(matrix), *values.shape[1:])
