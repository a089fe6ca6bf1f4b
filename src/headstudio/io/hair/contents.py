"""What a reader found in a file, and the checks that are the same for every format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...wisp.strands import Singles, Strands


class HairFileError(ValueError):
    """A file that holds no usable hair, or hair that a format cannot hold. The message is one line for the user."""


@dataclass(frozen=True, eq=False)
class Contents:
    """Points of all strands one after the other, (p, 3), how many each strand has, (n,), and what else was there:
    half thickness, (p,), and linear colour, (p, 3)."""

    points: NDArray[Any]
    counts: NDArray[Any]
    radius: NDArray[Any] | None = None
    colour: NDArray[Any] | None = None

    def checked(self, path: Path, remark: Callable[[str], None]) -> Strands:
        """The strands, without those that are none: fewer than two points, or points that are no numbers.

        Raises HairFileError when nothing is left, or when the counts are not those of the points.
        """
        counts = np.asarray(self.counts, dtype=np.int64)
        points = np.asarray(self.points, dtype=np.float32).reshape(-1, 3)
        if (counts < 0).any() or counts.sum() != len(points):
            raise HairFileError(f"{path}: damaged: {len(points)} points, but its strands ask for {counts.sum()}")
        strand = np.repeat(np.arange(len(counts)), counts)
        bad = np.bincount(strand, ~np.isfinite(points).all(axis=1), minlength=len(counts)) > 0
        kept = (counts >= 2) & ~bad
        if not kept.any():
            raise HairFileError(f"{path}: no strand of two points or more in it")
        for count, what in (
            (int(np.sum(bad)), "with points that are no numbers"),
            (int(np.sum(counts < 2)), "of one point or none"),
        ):
            if count:
                remark(f"{path}: left out {count} strands {what}")
        chosen = kept[strand]
        first = np.concatenate([[0], np.cumsum(counts[kept])])

        def of_kept(values: NDArray[Any] | None) -> Singles | None:
            return None if values is None else np.ascontiguousarray(np.asarray(values, dtype=np.float32)[chosen])

        return Strands(points[chosen], first, of_kept(self.radius), of_kept(self.colour))


def exactly(file: bytes, dtype: str, count: int, start: int, path: Path) -> NDArray[Any]:
    """``count`` values of ``dtype`` at ``start`` of a binary file. Raises HairFileError when it ends before."""
    end = start + count * np.dtype(dtype).itemsize
    if count < 0 or start < 0 or end > len(file):
        raise HairFileError(f"{path}: damaged: it ends at byte {len(file)}, its header promises {end}")
    return np.frombuffer(file, dtype, count, start)


def as_text(values: NDArray[Any], pattern: str) -> str:
    """Every row of ``values`` through ``pattern``, which has one %.9g a column: as many digits as a float32 needs."""
    rows = np.atleast_2d(values)
    return (pattern * len(rows)) % tuple(rows.ravel().tolist())
