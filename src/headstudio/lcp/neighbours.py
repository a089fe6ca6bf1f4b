"""Who is near whom: a grid of voxels, and a list that lives for several steps (Bando et al. 2006, section 3.1, step 1).

The grid has cells of the search radius, so all neighbours of a particle lie in the 27 cells around it. Sorting particles
by cell makes three cells in a row one run of the sorted array; half of the 27 cells are five such runs, and every pair is
found once.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.rows import row_dot

# The rows of cells from a cell on, in the order of the sorted array: (dy, dz, first dx, last dx). Of its own row those
# that come after it.
_HALF_ROWS = np.array([(0, 0, 0, 1), (1, 0, -1, 1), (-1, 1, -1, 1), (0, 1, -1, 1), (1, 1, -1, 1)])

_WIDEST = 100  # cells in a row


def find_pairs(positions: Floats, radius: float) -> Ints:
    """All pairs (i, j), each once, of particles closer than ``radius`` [m], shape (p, 2). positions: [m], (n, 3)."""
    count = len(positions)
    if count < 2:
        return np.zeros((0, 2), dtype=np.int64)
    columns = positions.T
    cell = _cells(columns, radius)
    nx, ny, nz = cell.max(axis=1) + 2
    key = (cell[2] * ny + cell[1]) * nx + cell[0]
    order = np.argsort(key, kind="stable")
    key, columns = key.take(order), columns.take(order, axis=1)
    begins = np.zeros(nx * ny * nz + 1, dtype=np.int64)
    np.cumsum(np.bincount(key, minlength=nx * ny * nz), out=begins[1:])
    dy, dz, first, last = _HALF_ROWS.T[:, :, None]
    row = key + (dz * ny + dy) * nx
    begin = begins.take(row + first)
    begin[0] = np.arange(1, count + 1)  # of a particle's own row those that come after it
    runs = (begins.take(row + last + 1) - begin).ravel()
    # The k-th candidate of a run stands k places behind the run's begin.
    ends = np.cumsum(runs)
    i = np.repeat(np.tile(np.arange(count), len(_HALF_ROWS)), runs)
    j = np.arange(ends[-1]) + np.repeat(begin.ravel() - ends + runs, runs)
    square = np.zeros(len(j))
    for x in columns:
        way = x.take(j) - x.take(i)
        square += way * way
    near = np.flatnonzero(square < radius * radius)
    return order[np.stack([i[near], j[near]], axis=1)]


def _cells(columns: Floats, radius: float) -> Ints:
    """The cell of every particle, (3, n), from 1 on. columns: their positions [m], (3, n).

    What lies beyond the widest grid counts to its border: those that were in cells side by side still are.
    """
    origin = columns.min(axis=1)[:, None]
    if np.ptp(columns, axis=1).max() > _WIDEST * radius:
        origin = np.maximum(origin, np.median(columns, axis=1)[:, None] - 0.5 * _WIDEST * radius)
    return np.fmin(np.fmax((columns - origin) / radius, 0.0), _WIDEST).astype(np.int64) + 1


class NeighbourList:
    """Pairs of particles near each other, kept for as long as they can be trusted (a Verlet list).

    radius: pairs closer than this are always in the list [m]. skin: how much farther the list looks, as a part of radius.
    """

    def __init__(self, radius: float, skin: float = 0.25) -> None:
        self.radius = radius
        self.skin = skin * radius
        self.searches = 0
        self.questions = 0
        self._pairs: Ints | None = None
        self._searched_at: Floats = np.zeros((0, 3))
        self._searched_skin = 0.0
        self._asked_at: Floats | None = None

    def pairs(self, positions: Floats) -> Ints:
        """Every pair closer than the radius, each once, and some that are farther, (p, 2). positions: [m], (n, 3)."""
        self.questions += 1
        if self._pairs is None or _approach(self._searched_at, positions) > self._searched_skin:
            # A skin that hair leaves behind in a single step only makes the list longer.
            hasty = self._asked_at is not None and _approach(self._asked_at, positions) > self.skin
            self._searched_skin = 0.0 if hasty else self.skin
            self._pairs = find_pairs(positions, self.radius + self._searched_skin)
            self._searched_at = positions.copy()
            self.searches += 1
        self._asked_at = positions
        return self._pairs


def _approach(before: Floats, now: Floats) -> float:
    """How much closer any two particles can have come at most [m]."""
    moved = now - before
    # What all particles do together changes no distance.
    moved = moved - moved.mean(axis=0)
    return 2.0 * float(np.sqrt(np.max(row_dot(moved, moved), initial=0.0)))
