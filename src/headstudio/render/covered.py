"""Hair that other hair covers need not be drawn: most of a head of hair lies under its surface."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .strands import HairCurves
from .view import View

_LAYERS = (2, 4)
"""With so many sections in front a particle begins to be left out, and is gone. The ends of a curve are thin and are not
counted, and a cell holds about two of every five particles that cross it: so more than twice as many particles stand
before what goes, each lets less than half of the light past, and what goes shone through by less than 1 %."""


def shown_through_hair(curves: HairCurves, view: View, cell: float) -> Floats:
    """How much of each particle need be drawn for the hair in front of it, 0 to 1, (n,).

    The picture is divided into cells of ``cell`` [m] (at the depth of the hair); what counts is the section of the curve
    that has the fewest other sections before it in its cell.
    """
    path = curves.path[:, 1:-1]
    count, sections = path.shape[:2]
    across, depth = _projected(path, view)
    cells = np.floor(across / cell).astype(np.int64)
    cells -= cells.min(axis=(0, 1))
    key = (cells[..., 0] * (cells[..., 1].max() + 1) + cells[..., 1]).ravel()
    # Cell by cell, nearest first: one sort of numbers whose whole part is the cell is faster than a sort by two keys.
    behind = (depth - depth.min()) / (2 * max(np.ptp(depth), 1e-9))
    nearest_first = np.argsort(key + behind.ravel())
    sorted_key = key[nearest_first]
    place = np.arange(len(key))
    starts = np.concatenate([[True], sorted_key[1:] != sorted_key[:-1]])
    rank = np.empty(len(key), np.int64)
    rank[nearest_first] = place - np.maximum.accumulate(np.where(starts, place, 0))
    least = rank.reshape(count, sections).min(axis=1)
    return np.clip((_LAYERS[1] - least) / (_LAYERS[1] - _LAYERS[0]), 0.0, 1.0)


def _projected(points: Floats, view: View) -> tuple[Floats, Floats]:
    """Points [m], (..., 3), on the plane through their middle that faces the eye [m], (..., 2), and their depth [m]."""
    depth = view.depth(points)
    scale = float(np.median(depth)) / np.maximum(depth, view.near)
    offset = points - view.eye
    return np.stack([offset @ view.right, offset @ view.up], axis=-1) * scale[..., None], depth
