"""Keeping strands out of the body between their points, too: a straight way from point to point may cut an ear."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Ints
from .strands import Singles
from .surroundings import Surroundings

_PARTS = (0.2, 0.5, 0.8)  # where on a chord its depth is taken
_CLEARANCE = 0.0006  # of chords from the skin, which is as uncertain at the rim of an ear [m]
_ROUNDS = 8


def keep_chords_outside(surroundings: Surroundings, strands: Singles, margin: float) -> Singles:
    """``strands`` [m], float32, (S, n, 3), with points of chords that cut an ear moved out of it.

    Strands are changed in place, and returned. A chord that is too deep is moved as a whole, straight out, the more at
    the end that is nearer to where it is deepest. Points have the last word: no nearer to the skin than ``margin`` [m].
    """
    points = strands.reshape(-1, 3)
    chords = _near_chords(surroundings, strands)
    moved = chords[:0]
    for _ in range(_ROUNDS):
        start, end = points[chords], points[chords + 1]
        between = np.stack([(1 - t) * start + t * end for t in _PARTS])
        depth = surroundings.distance(between.reshape(-1, 3)).reshape(len(_PARTS), -1)
        deepest = depth.argmin(axis=0)
        too_deep = np.flatnonzero(depth[deepest, np.arange(len(chords))] < _CLEARANCE)
        if len(too_deep) == 0:
            break
        chords, deepest = chords[too_deep], deepest[too_deep]
        distance, outward = surroundings.distance_and_gradient(between[deepest, too_deep])
        part = np.array(_PARTS, dtype=np.float32)[deepest]
        # The least move of both ends that takes the place between them out.
        by = (_CLEARANCE - distance) / ((1 - part) ** 2 + part**2)
        points[chords] += ((1 - part) * by)[:, None] * outward
        points[chords + 1] += (part * by)[:, None] * outward
        moved = np.concatenate([moved, chords])
    touched = np.unique(np.concatenate([moved, moved + 1]))
    points[touched] = surroundings.keep_outside(points[touched], margin)
    return strands


def _near_chords(surroundings: Surroundings, strands: Singles) -> Ints:
    """Chords that may be too deep in an ear, as the number of the point that each starts from, (k,)."""
    count = strands.shape[1]
    # Every other point tells for its neighbours.
    ears = surroundings.beside_ears[surroundings.nearest_nodes(strands[:, ::2])]
    before = np.arange(count - 1) // 2
    strand, place = np.nonzero(ears[:, before] | ears[:, np.minimum(before + 1, ears.shape[1] - 1)])
    chords = strand * count + place
    points = strands.reshape(-1, 3)
    start, end = points.take(chords, axis=0), points.take(chords + 1, axis=0)
    reach = np.float32(_CLEARANCE) + 0.5 * np.sqrt(np.einsum("ij,ij->i", end - start, end - start))
    # No place on a chord is nearer to the skin than its middle by more than half its length: most are told by the node
    # beside it, and few of the others need more than one look.
    middle = 0.5 * (start + end)
    near = surroundings.distances[surroundings.nearest_nodes(middle)] < reach + 2 * surroundings.skin_grid.spacing
    chords, middle, reach = chords[near], middle[near], reach[near]
    return chords[surroundings.distance(middle) < reach + 0.5 * surroundings.skin_grid.spacing]
