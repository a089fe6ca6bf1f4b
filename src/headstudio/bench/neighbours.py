"""The neighbour search beside scipy's k-d tree, on hair as it is in the middle of a motion."""

from __future__ import annotations

import time
from dataclasses import dataclass
from statistics import median
from typing import NamedTuple

from scipy.spatial import cKDTree

from ..head.mesh import Floats
from ..lcp.neighbours import find_pairs


class Search(NamedTuple):
    """How long one cKDTree, built and asked for all pairs, and one search of the grid took [ms]; the pairs found."""

    kdtree_ms: float
    grid_ms: float
    pairs: int


@dataclass(frozen=True)
class NeighbourCost:
    """Milliseconds. pairs: how many lie within the radius at last.

    kdtree_ms: building a cKDTree and asking it for all pairs, as every integration would without a list. search_ms: one
    search of the grid; both medians. step_ms: what the list costs an integration of the equations of motion on average.
    searches, steps: how many searches and integrations there were in the animation that was measured.
    """

    pairs: int
    kdtree_ms: float
    search_ms: float
    step_ms: float
    searches: int
    steps: int

    @property
    def part_of_kdtree(self) -> float:
        """The list's cost a step over that of the k-d tree."""
        return self.step_ms / self.kdtree_ms


def search_both(positions: Floats, radius: float) -> Search:
    """Both searches, once, for ``positions`` [m], (n, 3), and ``radius`` [m].

    To be asked where the list is: the caches of the processor are full of other things there.
    """
    begin = time.perf_counter()
    cKDTree(positions).query_pairs(radius, output_type="ndarray")
    between = time.perf_counter()
    pairs = find_pairs(positions, radius)
    return Search(1e3 * (between - begin), 1e3 * (time.perf_counter() - between), len(pairs))


def neighbour_cost(measured: list[Search], step_ms: float, searches: int, steps: int) -> NeighbourCost:
    """What the list costs beside the searches that were ``measured`` in the same animation; the rest is from there."""
    return NeighbourCost(
        pairs=measured[-1].pairs,
        kdtree_ms=median(search.kdtree_ms for search in measured),
        search_ms=median(search.grid_ms for search in measured),
        step_ms=step_ms,
        searches=searches,
        steps=steps,
    )
