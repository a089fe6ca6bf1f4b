"""Who is near whom: a grid of voxels, and a list that lives for several steps (Bando et al. 2006, section 3.1, step 1).

The grid has cells of the search radius, so all neighbours of a particle lie in the 27 cells around it. Sorting particles
by cell makes three cells in a row one run of the sorted array; half of the 27 cells are five such runs, and every pair is
found once.
"""

from __future__ import annotations

import math

import numpy as np

from ..head.mesh import Floats, Ints

# The rows of cells from a cell on, in the order of the sorted array: (dy, dz, first dx, last dx). Of its own row those
# that come after it.
_HALF_ROWS = np.array([(0, 0, 0, 1), (1, 0, -1, 1), (-1, 1, -1, 1), (0, 1, -1, 1), (1, 1, -1, 1)])

_WIDEST = 100  # cells in a row


def find_pairs(positions: Floats, radius: float) -> Ints:
    """All pairs (i, j), each once, of particles closer than ``radius`` [m], shape (p, 2). positions: [m], (n, 3)."""
    count = len(positions)
    if count < 2:
        return np.zeros((0, 2), dtype=np.int64)
    columns = np.ascontiguousarray(positions.T)
    cell = _cells(columns, radius)
    nx, ny, nz = cell.max(axis=1) + 2
    key = (cell[2] * ny + cell[1]) * nx + cell[0]
    # Keys of 16 bits are sorted by their digits.
    order = np.argsort(key.astype(np.min_scalar_type(nx * ny * nz)), kind="stable")
    key, columns = key.take(order), columns.take(order, axis=1)
    begins = np.zeros(nx * ny * nz + 1, dtype=np.int64)
    np.cumsum(np.bincount(key, minlength=nx * ny * nz), out=begins[1:])
    dy, dz, first, last = _HALF_ROWS.T[:, :, None]
    row = key + (dz * ny + dy) * nx
    begin = begins.take(row + first)
    begin[0] = np.arange(1, count + 1)  # of a particle's own row those that come after it
    runs = (begins.take(row + (last + 1)) - begin).ravel()
    # The k-th candidate of a run stands k places behind the run's begin.
    ends = np.cumsum(runs)
    j = np.repeat(begin.ravel() - ends + runs, runs)
    j += np.arange(len(j))
    square = np.zeros(len(j))
    for x in columns:
        way = x.take(j)
        way -= np.repeat(np.tile(x, len(_HALF_ROWS)), runs)
        way *= way
        square += way
    near = np.flatnonzero(square < radius * radius)
    i = np.repeat(np.tile(order, len(_HALF_ROWS)), runs)
    return np.stack([i.take(near), order.take(j.take(near))]).T


def _cells(columns: Floats, radius: float) -> Ints:
    """The cell of every particle, (3, n), from 1 on. columns: their positions [m], (3, n).

    What lies beyond the widest grid counts to its border: those that were in cells side by side still are.
    """
    origin = columns.min(axis=1)
    if (columns.max(axis=1) - origin).max() > _WIDEST * radius:
        origin = np.maximum(origin, np.median(columns, axis=1) - 0.5 * _WIDEST * radius)
    cell = (columns - origin[:, None]) * (1.0 / radius)
    np.fmin(np.fmax(cell, 0.0, out=cell), _WIDEST, out=cell)
    return cell.astype(np.int64) + 1


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
        self._asked_at = self._searched_at

    def pairs(self, positions: Floats) -> Ints:
        """Every pair closer than the radius, each once, and some that are farther, (p, 2). positions: [m], (n, 3)."""
        self.questions += 1
        if self._pairs is None:
            return self._search(positions, self.skin)
        approach = _approach(self._searched_at, positions)
        if approach <= self._searched_skin:
            self._asked_at = positions
            return self._pairs
        last = approach if self._asked_at is self._searched_at else _approach(self._asked_at, positions)
        # A skin that hair leaves behind in a single step only makes the list longer.
        return self._search(positions, 0.0 if last > self.skin else self.skin)

    def _search(self, positions: Floats, skin: float) -> Ints:
        self.searches += 1
        self._searched_at = self._asked_at = positions.copy(order="K")
        self._searched_skin = skin
        self._pairs = find_pairs(positions, self.radius + skin)
        return self._pairs


def _approach(before: Floats, now: Floats) -> float:
    """How much closer any two particles can have come at most [m]."""
    square = 0.0
    for moved in np.ascontiguousarray((now - before).T):
        moved -= moved.mean()  # What all particles do together changes no distance.
        square = square + moved * moved
    return 2.0 * math.sqrt(np.max(square, initial=0.0))
