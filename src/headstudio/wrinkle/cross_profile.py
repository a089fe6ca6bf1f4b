"""A furrow whose cross section is several of the shape (2.1) that add up: real grooves have round floors and rims of
their own, and the shape (2.1) has a sharp floor.

Each of these strands lies beside the line of the furrow and is zero in volume (eq. 2.2), so the sum is, too. A strand of
negative depth is a ridge.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..head.mesh import Floats
from .shape import REACH, bounded_shape, bounded_slope

Strands = tuple[tuple[float, float, float], ...]
"""(offset, depth, width) of each: how far to the left of the line it lies and its w, in widths of the furrow, and its d
as a part of the furrow's depth."""


def strands_reach(strands: Strands) -> float:
    """How far from its line a furrow of these strands displaces the skin, in widths."""
    return max((abs(offset) + REACH * width for offset, _, width in strands), default=REACH)


def section(across: Floats, depth: float, width: float, strands: Strands) -> Floats:
    """Height at distances to the left of a furrow [m], (k,); without strands it is that of (2.1)."""
    if not strands:
        return bounded_shape(np.abs(across), depth, width)
    return depth * strand_heights(across, width, strands) @ np.array([share for _, share, _ in strands])


def section_slope(across: Floats, depth: float, width: float, strands: Strands) -> Floats:
    """The derivative of ``section`` towards the left, (k,). On a sharp floor it is that of the left wall."""
    slope = np.zeros_like(across)
    for offset, share, v in strands or ((0.0, 1.0, 1.0),):
        away = across - offset * width
        slope += np.where(away < 0, -1.0, 1.0) * bounded_slope(np.abs(away), share * depth, v * width)
    return slope


def strand_heights(across: Floats, width: float, strands: Sequence[tuple[float, float, float]]) -> Floats:
    """Height of each strand if it were 1 deep, (k, strands)."""
    heights = [bounded_shape(np.abs(across - offset * width), 1.0, v * width) for offset, _, v in strands]
    return np.stack(heights, axis=1)
