"""Poisson discs in the hair volume (u, v, s): Bando et al. 2006, section 3.2 and eq. 3."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp

_CANDIDATES_PER_PARTICLE = 14
_RADIUS_SEARCH_STEPS = 14
_COUNT_TOLERANCE = 0.01
_FEWEST_ROOTS = 8


def distribute(scalp: Scalp, longest: float, root_depth: float, count: int, rng: np.random.Generator) -> Floats:
    """Coordinates (u, v, s) of ``count`` particles that sample the hair volume evenly, shape (count, 3).

    The volume stands on the scalp square from s = -root_depth [m] up to longest * L(u, v) [m], L being the scalp's length
    map. The distance of eq. 3 is Euclidean in the four coordinates (scalp point, s), so the discs are found by a kd-tree.
    """
    candidates = _uniform_candidates(scalp, longest, root_depth, _CANDIDATES_PER_PARTICLE * count, rng)
    place = np.column_stack([scalp.points(candidates[:, :2]), candidates[:, 2]])
    radius = _first_guess(scalp, candidates, root_depth, longest, count)
    low, high = 0.0, np.inf
    best: Ints = np.arange(len(candidates))
    for _ in range(_RADIUS_SEARCH_STEPS):
        kept = poisson_discs(place, radius)
        if len(kept) >= count:
            low, best = radius, kept
            if len(kept) <= count * (1.0 + _COUNT_TOLERANCE):
                break
        else:
            high = radius
        radius = 0.5 * (low + high) if np.isfinite(high) else radius * 1.15
    # What is over the wanted count goes at random: it is under a hundredth, and leaves no visible hole.
    return _rooted(candidates[np.sort(rng.permutation(best)[:count])], root_depth)


def _rooted(coordinates: Floats, root_depth: float) -> Floats:
    """``coordinates`` with at least a few below the scalp: where a thin layer caught none, the lowest are put there."""
    lacking = _FEWEST_ROOTS - np.count_nonzero(coordinates[:, 2] < 0)
    if lacking <= 0:
        return coordinates
    above = np.flatnonzero(coordinates[:, 2] >= 0)
    lowest = above[np.argsort(coordinates[above, 2], kind="stable")[:lacking]]
    coordinates[lowest, 2] = -0.5 * root_depth
    return coordinates


def poisson_discs(points: Floats, radius: float) -> Ints:
    """Indices of a maximal subset of ``points`` (k, d) no two of which are closer than ``radius``.

    The points throw darts in their own order, as if one after the other, but all at once: in every round each point that
    comes before all its undecided neighbours is kept, and its neighbours drop out.
    """
    pairs = cKDTree(points).query_pairs(radius, output_type="ndarray")
    early, late = pairs.min(axis=1), pairs.max(axis=1)
    undecided = np.ones(len(points), dtype=bool)
    kept = np.zeros(len(points), dtype=bool)
    while undecided.any():
        waits = np.zeros(len(points), dtype=bool)
        waits[late] = True
        winners = undecided & ~waits
        kept |= winners
        undecided &= ~winners
        undecided[late[winners[early]]] = False
        alive = undecided[early] & undecided[late]
        early, late = early[alive], late[alive]
    return np.flatnonzero(kept)


def _uniform_candidates(
    scalp: Scalp, longest: float, root_depth: float, count: int, rng: np.random.Generator
) -> Floats:
    """Random (u, v, s), uniform in the volume over the scalp's area, in random order, (count, 3)."""
    pieces, have = [], 0
    while have < count:
        uv = scalp.random_points(2 * count, rng)
        s = rng.uniform(-root_depth, longest, len(uv))
        inside = s <= longest * scalp.lengths(uv)
        pieces.append(np.column_stack([uv, s])[inside])
        have += len(pieces[-1])
    return np.concatenate(pieces)[:count]


def _first_guess(scalp: Scalp, candidates: Floats, root_depth: float, longest: float, count: int) -> float:
    """A disc radius for ``count`` discs in the volume: maximal discs fill space to about this density."""
    height = longest * scalp.lengths(candidates[:, :2]) + root_depth
    # Candidates are uniform in the volume, so the harmonic mean of their columns' height is the mean height.
    volume = scalp.area / np.mean(1.0 / height)
    return 0.86 * float((volume / count) ** (1.0 / 3.0))
