"""Room for every particle: hair that fell on other hair does not lie in the same place.

Poisson discs are even in (u, v, s). Beams that bend over a curved head bring hair from many roots together, and some of
their particles almost to one point, where no hair could be. Before the links are made such particles give way to each
other, sideways, as the hair they stand for would.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_dot, row_length
from .body import Body
from .neighbours import find_pairs

_ROUNDS = 24
_ROOM = 0.75  # of the mean distance: nearer than this, two particles are in each other's way
_YIELD = 0.5  # part of the overlap that a round takes away
_SLACK = 0.001  # deeper in the body than before [m]: what coarse planes may say
_FARTHEST = 0.25  # of its arc length: how far a particle may be moved, so that hair keeps its course


def spread(
    positions: Floats, directions: Floats, roots: Floats, arc_length: Floats, spacing: float, body: Body
) -> Floats:
    """``positions`` [m] with room around each, (n, 3). directions: unit, (n, 3). arc_length: [m], (n,), below 0 for roots.

    roots: where each hair leaves the scalp [m], (n, 3). spacing: mean distance of neighbours [m]. Particles stay out of the
    body, near where they were, and within the length of their hair.
    """
    start, room = positions, _ROOM * spacing
    clearance = np.minimum(body.clearance(start), room)
    farthest = _FARTHEST * np.maximum(arc_length, 0.0)
    for _ in range(_ROUNDS):
        moved = positions + _YIELD * _way_out(positions, directions, room)
        planes = body.planes(moved)
        lack = np.where(np.isfinite(planes.distance), np.maximum(clearance - planes.distance, 0.0), 0.0)
        moved = moved + lack[:, None] * planes.normals
        offset = moved - start
        length = row_length(offset)
        moved = start + np.minimum(1.0, farthest / np.maximum(length, 1e-12))[:, None] * offset
        from_root = moved - roots
        reach = np.maximum(row_length(from_root), 1e-12)
        within = roots + np.minimum(1.0, arc_length / reach)[:, None] * from_root
        # Drawn back along a straight line hair could end up in the body: rather than that it stays where it is.
        gives_way = (arc_length > 0) & (body.clearance(within) >= np.minimum(clearance, 0.0) - _SLACK)
        positions = np.where(gives_way[:, None], within, positions)
    return positions


def _way_out(positions: Floats, directions: Floats, room: float) -> Floats:
    """How far every particle has to go for half of its overlap with its neighbours [m], (n, 3), across the hair."""
    count = len(positions)
    i, j = find_pairs(positions, room).T
    offset = positions[j] - positions[i]
    along = directions[i] + directions[j]
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    across = offset - row_dot(offset, along)[:, None] * along
    length = row_length(across)
    overlap = room - row_length(offset)
    # One straight behind the other is no overlap that going sideways could end.
    push = np.where(length > 1e-6, 0.5 * overlap / np.maximum(length, 1e-6), 0.0)[:, None] * across
    way = np.empty_like(positions)
    for axis in range(3):
        way[:, axis] = np.bincount(j, push[:, axis], count) - np.bincount(i, push[:, axis], count)
    # Where many are in one place each would be pushed by all of them: it goes no farther than it needs to be beside one.
    return np.minimum(1.0, room / np.maximum(row_length(way), 1e-12))[:, None] * way
