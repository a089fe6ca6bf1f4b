"""Segments of furrows, and where they meet."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from ..head.mesh import Floats, Ints
from .plane import cross, shorter_way
from .texels import Flags

# How near to its end, as a part of its length, a segment still counts as met: nothing slips through a joint.
TOUCH = 1e-9


@dataclass(frozen=True, eq=False)
class Segments:
    """Straight pieces of furrows, k of them, in texels; x may run beyond the image where it wraps around.

    starts: P, (k, 2). steps: Q - P as it was grown, (k, 2). reach: the part of the step that was carved, below 1 where
    the furrow ended on another one, (k,). furrows: which furrow each belongs to, (k,). sides: 0 along the field, 1
    against it, (k,). order: how many segments lie between it and the starting point, on its side, (k,). left: n, how
    many segments might have followed, (k,). directions: of the field at P, unit, (k, 2). magnitudes: m there, (k,).
    """

    starts: Floats
    steps: Floats
    reach: Floats
    furrows: Ints
    sides: Ints
    order: Ints
    left: Floats
    directions: Floats
    magnitudes: Floats

    def __len__(self) -> int:
        return len(self.starts)

    @property
    def ends(self) -> Floats:
        """Where the carved pieces end [texels], (k, 2)."""
        return self.starts + self.reach[:, None] * self.steps

    def __getitem__(self, chosen: Ints | Flags | slice) -> Segments:
        return Segments(*(getattr(self, field.name)[chosen] for field in fields(self)))

    @staticmethod
    def joined(pieces: list[Segments]) -> Segments:
        """All segments of several lists, at least one, in their order."""
        return Segments(*(np.concatenate([getattr(p, field.name) for p in pieces]) for field in fields(Segments)))


class Meetings(NamedTuple):
    """Pairs of a segment and one that stands in its way, each (p,).

    segments: index of the one that arrives. others: index of the one that is there. parts: how far along the first,
    other_parts: how far along the second they meet, 0 to 1.
    """

    segments: Ints
    others: Ints
    parts: Floats
    other_parts: Floats


class SegmentGrid:
    """Finds segments near a point: a grid whose cells list the segments that have their middle there.

    Cells are at least as large as the distance asked for, so that whatever is near lies in nine cells. A cell is a row
    of a table; the table gets wider when one is full.
    """

    def __init__(self, size: int, period: int, distance: float) -> None:
        """size: edge of the image [texels]. period: see TexelMap. distance: the farthest two neighbours are apart."""
        self._count = max(int(size / distance), 1)
        self._cell = size / self._count
        self._wrapped = period > 0
        # Two empty cells all around: what lies outside the image is in the first, its neighbours may be in the second.
        self._side = self._count + 4
        self._table = np.full((self._side**2, 4), -1, dtype=np.int64)
        self._fill = np.zeros(self._side**2, dtype=np.int64)

    def add(self, middles: Floats, numbers: Ints) -> None:
        """Enter segments, by number, (k,), at their middles [texels], (k, 2)."""
        cells = self._cells(*self._place(middles))
        order = np.argsort(cells, kind="stable")
        cells = cells[order]
        slots = self._fill[cells] + np.arange(len(cells)) - np.searchsorted(cells, cells)
        missing = int(slots.max(initial=-1)) + 1 - self._table.shape[1]
        if missing > 0:
            self._table = np.pad(self._table, ((0, 0), (0, missing)), constant_values=-1)
        self._table[cells, slots] = numbers[order]
        np.add.at(self._fill, cells, 1)

    def forget(self, middles: Floats) -> None:
        """Take out as many of the last entries as there are ``middles`` [texels], (k, 2), in their cells."""
        cells = self._cells(*self._place(middles))
        np.subtract.at(self._fill, cells, 1)
        for slot in range(self._table.shape[1]):
            self._table[cells[self._fill[cells] <= slot], slot] = -1

    def near(self, points: Floats) -> tuple[Ints, Ints]:
        """Pairs (index of a point, number of a segment) of all that may be near, both (p,). points: (k, 2)."""
        row, column = self._place(points)
        around = np.arange(-1, 2)
        cells = self._cells(row[:, None, None] + around[:, None], column[:, None, None] + around)
        found = self._table[cells].reshape(len(points), -1)
        at, slot = np.nonzero(found >= 0)
        return at, found[at, slot]

    def _place(self, points: Floats) -> tuple[Ints, Ints]:
        """Row and column of the cell of each point, (k, 2); those outside the image in the border."""
        place = np.floor(points / self._cell).astype(np.int64)
        column = place[:, 0] % self._count if self._wrapped else place[:, 0].clip(-1, self._count)
        return place[:, 1].clip(-1, self._count), column

    def _cells(self, row: Ints, column: Ints) -> Ints:
        if self._wrapped:
            column = column % self._count
        return (row + 2) * self._side + column + 2


def meetings(grid: SegmentGrid, arriving: Segments, present: Segments, period: int) -> Meetings:
    """Where ``arriving`` segments meet any of ``present``, all of which stand in the grid by their index.

    Both are taken as grown; the caller knows how far they reach. Parallel segments do not meet.
    """
    at, other = grid.near(arriving.starts + 0.5 * arriving.steps)
    step, across = arriving.steps[at], present.steps[other]
    offset = shorter_way(present.starts[other] - arriving.starts[at], period)
    turn = cross(step, across)
    turn = np.where(turn == 0, np.nan, turn)
    part, other_part = cross(offset, across) / turn, cross(offset, step) / turn
    met = (np.abs(part - 0.5) <= 0.5 + TOUCH) & (np.abs(other_part - 0.5) <= 0.5 + TOUCH)
    return Meetings(at[met], other[met], part[met].clip(0, 1), other_part[met].clip(0, 1))
