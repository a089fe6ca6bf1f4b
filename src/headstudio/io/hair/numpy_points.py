"""Points as a numpy array (strands, points, 3) of float32."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...wisp.strands import Strands
from .contents import Contents, HairFileError


def read(path: Path) -> Contents:
    """Raises HairFileError for an array of another shape or kind."""
    try:
        points = np.load(path, allow_pickle=False)
    except (ValueError, EOFError):
        raise HairFileError(f"{path}: this is no .npy array of numbers") from None
    if not isinstance(points, np.ndarray) or points.ndim != 3 or points.shape[2] != 3 or points.dtype.kind not in "fiu":
        raise HairFileError(f"{path}: hair as .npy is an array (strands, points, 3) of numbers")
    return Contents(points.reshape(-1, 3), np.full(len(points), points.shape[1]))


def write(strands: Strands, path: Path) -> None:
    """Raises HairFileError when strands differ in their count of points: an array has no place for that."""
    counts = strands.counts
    if (counts != counts[0]).any():
        raise HairFileError(f"{path}: .npy needs strands of one count of points; .hair and .ply hold any")
    np.save(path, strands.points.reshape(strands.count, -1, 3))
