"""Keeping strands out of the body between their points, too: a straight way from point to point may cut an ear."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Ints
from .strands import Singles
from .surroundings import Surroundings

_PARTS = (0.0, 0.25, 0.5, 0.75, 1.0)  # where on a chord its depth is taken
_CLEARANCE = 0.0008  # of chords from the skin, which is as uncertain between nodes at the rim of an ear [m]
_ROUNDS = 10


def keep_chords_outside(surroundings: Surroundings, strands: Singles, margin: float) -> Singles:
    """``strands`` [m], float32, (S, n, 3), with points of chords that cut a thin part of the body moved out of it.

    Strands are changed in place, and returned. A chord that is too deep is moved as a whole, straight out, the more at
    the end that is nearer to where it is deepest. Points have the last word: no nearer to the skin than ``margin`` [m].
    """
    points = strands.reshape(-1, 3)
    chords = _near_chords(surroundings, strands)
    moved = np.zeros(len(points), dtype=bool)
    for _ in range(_ROUNDS):
        if len(chords) == 0:
            break
        start, end = points[chords], points[chords + 1]
        between = np.stack([(1 - t) * start + t * end for t in _PARTS])
        distance, outward = surroundings.distance_and_gradient(between.reshape(-1, 3))
        deepest = distance.reshape(len(_PARTS), -1).argmin(axis=0)
        at = deepest * len(chords) + np.arange(len(chords))
        too_deep = distance[at] < _CLEARANCE
        chords, at, part = chords[too_deep], at[too_deep], np.array(_PARTS, dtype=np.float32)[deepest[too_deep]]
        moved[chords] = moved[chords + 1] = True
        # The least move of both ends that takes the place between them out.
        by = (_CLEARANCE - distance[at]) / ((1 - part) ** 2 + part**2)
        np.add.at(points, chords, ((1 - part) * by)[:, None] * outward[at])
        np.add.at(points, chords + 1, (part * by)[:, None] * outward[at])
    points[moved] = surroundings.keep_outside(points[moved], margin)
    return strands


def _near_chords(surroundings: Surroundings, strands: Singles) -> Ints:
    """Chords that may be too deep in a thin part of the body, as the number of the point that each starts from, (k,)."""
    count = strands.shape[1]
    # Every other point tells for its neighbours.
    thin = surroundings.beside_thin_parts[surroundings.nearest_nodes(strands[:, ::2])]
    before = np.arange(count - 1) // 2
    strand, place = np.nonzero(thin[:, before] | thin[:, np.minimum(before + 1, thin.shape[1] - 1)])
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
