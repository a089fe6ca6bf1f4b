"""The .data files of the USC-HairSalon set: a count of strands, then each strand's count and points, and no header."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError, exactly


def read(path: Path) -> Contents:
    """Strands lie one behind the other, each behind its count, so where one begins is known only from the one before."""
    file = path.read_bytes()
    if len(file) < 4 or len(file) % 4:
        raise HairFileError(f"{path}: this is no .data file of strands (its size is 0 or no multiple of 4)")
    words = np.frombuffer(file, "<i4")
    strands = int(words[0])
    counts, starts, at = [], [], 1
    for _ in range(max(strands, 0)):
        count = int(exactly(file, "<i4", 1, 4 * at, path)[0])
        if count < 0:
            raise HairFileError(f"{path}: damaged: a strand of {count} points")
        counts.append(count)
        starts.append(at + 1)
        at += 1 + 3 * count
    exactly(file, "<i4", at, 0, path)
    inside = np.zeros(len(words), dtype=bool)
    # +1 where a strand's points begin, -1 behind them: the running sum marks them.
    steps = np.zeros(len(words) + 1, dtype=np.int64)
    np.add.at(steps, starts, 1)
    np.add.at(steps, np.array(starts, dtype=np.int64) + 3 * np.array(counts, dtype=np.int64), -1)
    inside = np.cumsum(steps[:-1]) > 0
    return Contents(words[inside].view("<f4").reshape(-1, 3), np.array(counts, dtype=np.int64))


def write(strands: Strands, path: Path) -> None:
    """Only points have a place in this format."""
    counts = strands.counts
    words = np.empty(1 + len(counts) + strands.points.size, dtype="<i4")
    words[0] = len(counts)
    heads = 1 + np.arange(len(counts)) + 3 * strands.first[:-1]
    words[heads] = counts
    rest = np.ones(len(words), dtype=bool)
    rest[0] = False
    rest[heads] = False
    words[rest] = strands.points.astype("<f4").view("<i4").ravel()
    path.write_bytes(words.tobytes())
