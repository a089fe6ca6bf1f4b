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
# Segments that are compared with their neighbours in one go: the pairs fit into the cache of a processor.
_AT_ONCE = 2048


@dataclass(frozen=True, eq=False)
class Segments:
    """Straight pieces of furrows, k of them, in texels; x may run beyond the image where it wraps around.

    starts: P, (k, 2). steps: Q - P as it was grown, (k, 2). reach: the part of the step that was carved, below 1 where
    the furrow ended on another one, (k,). furrows: which furrow each belongs to, (k,). sides: 0 along the field, 1
    against it, (k,). order: how many segments lie between it and the starting point, on its side, (k,). left: n, how
    many segments might have followed, (k,). directions: of growth at P before it was turned by theta, unit, (k, 2).
    magnitudes: m there, (k,). units: what the unit of the laws is there [texels], (k,).
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
    units: Floats

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

    arriving: index of the one that arrives. present: number of the one that is there. parts: how far along the first,
    present_parts: how far along the second they meet, 0 to 1.
    """

    arriving: Ints
    present: Ints
    parts: Floats
    present_parts: Floats


class SegmentGrid:
    """Numbers segments as they come and finds those near a point.

    A grid whose cells list the segments that have their middle there. Cells are at least as large as the distance asked
    for, so that whatever is near lies in nine cells. A cell is a row of a table, which gets wider when one is full.
    """

    def __init__(self, size: int, period: int, distance: float) -> None:
        """size: edge of the image [texels]. period: see TexelMap. distance: the farthest two neighbours are apart."""
        self._cells_across = max(int(size / distance), 1)
        self._cell = size / self._cells_across
        self._period = period
        # Two empty cells all around: what lies outside the image is in the first, its neighbours may be in the second.
        self._side = self._cells_across + 4
        self._table = np.full((self._side**2, 4), -1, dtype=np.int64)
        self._fill = np.zeros(self._side**2, dtype=np.int64)
        self._lines = np.empty((1024, 5))
        self.count = 0

    def add(self, segments: Segments) -> None:
        """Enter segments as they were grown; their numbers go on from those that are there."""
        numbers = self.count + np.arange(len(segments))
        self.count += len(segments)
        if self.count > len(self._lines):
            self._lines = np.concatenate([self._lines, np.empty((2 * self.count, 5))])
        self._lines[numbers] = np.column_stack([segments.starts, segments.steps, segments.reach])

        cells = self._cells_of(numbers)
        order = np.argsort(cells, kind="stable")
        cells = cells[order]
        slots = self._fill[cells] + np.arange(len(cells)) - np.searchsorted(cells, cells)
        missing = int(slots.max(initial=-1)) + 1 - self._table.shape[1]
        if missing > 0:
            self._table = np.pad(self._table, ((0, 0), (0, missing)), constant_values=-1)
        self._table[cells, slots] = numbers[order]
        np.add.at(self._fill, cells, 1)

    def clear(self) -> None:
        """Take out all segments."""
        cells = self._cells_of(np.arange(self.count))
        self._table[cells] = -1
        self._fill[cells] = 0
        self.count = 0

    def near(self, points: Floats) -> tuple[Ints, Ints]:
        """Pairs (index of a point, number of a segment) of all that may be near, both (p,). points: (k, 2)."""
        row, column = self._place(points)
        around = np.arange(-1, 2)
        cells = self._cells(row[:, None, None] + around[:, None], column[:, None, None] + around)
        found = self._table[cells].reshape(len(points), around.size**2 * self._table.shape[1])
        at, slot = np.nonzero(found >= 0)
        return at, found[at, slot]

    def meetings(self, arriving: Segments) -> Meetings:
        """Where segments, taken as grown, meet those in the grid as far as these reach; parallel ones do not meet."""
        portions = np.array_split(np.arange(len(arriving)), -(-len(arriving) // _AT_ONCE) or 1)
        found = [self._meetings(arriving, portion) for portion in portions]
        return Meetings(*(np.concatenate(column) for column in zip(*found)))

    def _meetings(self, arriving: Segments, portion: Ints) -> Meetings:
        at, number = self.near(arriving.starts[portion] + 0.5 * arriving.steps[portion])
        at = portion[at]
        step, across = arriving.steps[at], self._lines[number, 2:4]
        offset = shorter_way(self._lines[number, :2] - arriving.starts[at], self._period)
        turn = cross(step, across)
        turn = np.where(turn == 0, np.nan, turn)
        part, other = cross(offset, across) / turn, cross(offset, step) / turn
        met = (np.abs(part - 0.5) <= 0.5 + TOUCH) & (other >= -TOUCH) & (other <= self._lines[number, 4] + TOUCH)
        return Meetings(at[met], number[met], part[met].clip(0, 1), other[met].clip(0, 1))

    def covering(self, points: Floats, radii: Floats) -> Meetings:
        """Which segments, as they grow, come as near to ``points`` [texels], (k, 2), as they claim, and when first.

        radii: what each segment of the grid claims on both sides [texels], (count,). Here ``arriving`` are the points,
        and their ``parts`` are 0.
        """
        at, number = self.near(points)
        step = self._lines[number, 2:4]
        offset = shorter_way(points[at] - self._lines[number, :2], self._period)
        length = np.hypot(step[:, 0], step[:, 1])
        along = (offset * step).sum(axis=1) / length
        away, radius = (offset**2).sum(axis=1), radii[number]
        chord = np.sqrt(np.maximum(radius**2 - (away - along**2), 0.0))
        part = np.where(away <= radius**2, 0.0, (along - chord) / length)
        within = (away - along**2 <= radius**2) & (part >= 0) & (part <= 1)
        return Meetings(at[within], number[within], np.zeros(within.sum()), part[within])

    def _cells_of(self, numbers: Ints) -> Ints:
        lines = self._lines[numbers]
        return self._cells(*self._place(lines[:, :2] + 0.5 * lines[:, 2:4]))

    def _place(self, points: Floats) -> tuple[Ints, Ints]:
        """Row and column of the cell of each point, (k, 2); those outside the image in the border."""
        place = np.floor(points / self._cell).astype(np.int64)
        column = place[:, 0] if self._period else place[:, 0].clip(-1, self._cells_across)
        return place[:, 1].clip(-1, self._cells_across), column

    def _cells(self, row: Ints, column: Ints) -> Ints:
        if self._period:
            column = column % self._cells_across
        return (row + 2) * self._side + column + 2
