"""Keeping strands out of the body between their points, too: a straight way from point to point may cut an ear."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Ints
from .strands import Singles
from .surroundings import Surroundings

_PARTS = (0.2, 0.5, 0.8)  # where on a chord its depth is taken
_CLEARANCE = 0.0006  # of chords from the skin, which is as uncertain at the rim of an ear [m]
_LONG = 0.015  # a shorter chord goes less than .3 mm into anything as round as a skull or a shoulder [m]
# Straight out of the body a chord is moved so often. What lies across an ear, one end behind it, would go to and fro for
# ever: after that it is taken around the ear, so often, and each time by so many times its depth.
_STRAIGHT, _AROUND, _FARTHER = 5, 12, 2.0


def keep_chords_outside(surroundings: Surroundings, strands: Singles, margin: float) -> Singles:
    """``strands`` [m], float32, (S, n, 3), with points of chords that cut an ear moved out of it.

    Strands are changed in place, and returned. A chord that is too deep is moved as a whole, the more at the end that is
    nearer to where it is deepest, and then its neighbours are looked at again. Points have the last word: no nearer to the
    skin than ``margin`` [m].
    """
    points = strands.reshape(-1, 3)
    chords = _near_chords(surroundings, strands)
    near = np.zeros(len(points) + 1, dtype=bool)
    near[chords] = True
    moved = chords[:0]
    for attempt in range(_STRAIGHT + _AROUND):
        start, end = points[chords], points[chords + 1]
        between = np.stack([(1 - t) * start + t * end for t in _PARTS])
        depth = surroundings.distance(between.reshape(-1, 3)).reshape(len(_PARTS), -1)
        deepest = depth.argmin(axis=0)
        too_deep = np.flatnonzero(depth[deepest, np.arange(len(chords))] < _CLEARANCE)
        if len(too_deep) == 0:
            break
        chords, deepest = chords[too_deep], deepest[too_deep]
        distance, outward = surroundings.distance_and_gradient(between[deepest, too_deep])
        out = _CLEARANCE - distance
        if attempt >= _STRAIGHT:
            outward, out = surroundings.around_ears(between[deepest, too_deep]), np.float32(_FARTHER) * out
        part = np.array(_PARTS, dtype=np.float32)[deepest]
        # The least move of both ends that takes the place between them out.
        by = out / ((1 - part) ** 2 + part**2)
        points[chords] += ((1 - part) * by)[:, None] * outward
        points[chords + 1] += (part * by)[:, None] * outward
        moved = np.concatenate([moved, chords])
        beside = np.unique(np.concatenate([chords - 1, chords, chords + 1]))
        chords = beside[near[beside]]
    touched = np.unique(np.concatenate([moved, moved + 1]))
    points[touched] = surroundings.keep_outside(points[touched], margin)
    return strands


def _near_chords(surroundings: Surroundings, strands: Singles) -> Ints:
    """Chords that may be too deep in an ear, or long and too deep in anything, as the number of the point that each starts
    from, (k,).
    """
    count = strands.shape[1]
    # Every other point tells for its neighbours.
    ears = surroundings.beside_ears[surroundings.nearest_nodes(strands[:, ::2])]
    before = np.arange(count - 1) // 2
    steps = np.diff(strands, axis=1)
    squared = np.einsum("snk,snk->sn", steps, steps)
    asked = ears[:, before] | ears[:, np.minimum(before + 1, ears.shape[1] - 1)]
    asked |= squared > _LONG * _LONG
    strand, place = np.nonzero(asked)
    chords = strand * count + place
    points = strands.reshape(-1, 3)
    start, end = points.take(chords, axis=0), points.take(chords + 1, axis=0)
    reach = np.float32(_CLEARANCE) + 0.5 * np.sqrt(squared[strand, place])
    # No place on a chord is nearer to the skin than its middle by more than half its length: most are told by the node
    # beside it, and few of the others need more than one look.
    middle = 0.5 * (start + end)
    near = surroundings.distances[surroundings.nearest_nodes(middle)] < reach + 2 * surroundings.skin_grid.spacing
    chords, middle, reach = chords[near], middle[near], reach[near]
    return chords[surroundings.distance(middle) < reach + 0.5 * surroundings.skin_grid.spacing]
