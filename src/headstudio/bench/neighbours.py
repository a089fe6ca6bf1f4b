"""The neighbour search beside scipy's k-d tree, on hair as it is in the middle of a motion."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median

from scipy.spatial import cKDTree

from ..head.mesh import Floats
from ..lcp.neighbours import find_pairs

REPEATS = 7


@dataclass(frozen=True)
class NeighbourCost:
    """Milliseconds, medians. pairs: how many lie within the radius.

    kdtree_ms: building a cKDTree and asking it for all pairs, as every integration would without a list. search_ms: one
    search of the grid. step_ms: what the list costs an integration of the equations of motion on average. searches,
    steps: how many searches and integrations there were in the animation that was measured.
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


def neighbour_cost(positions: Floats, radius: float, step_ms: float, searches: int, steps: int) -> NeighbourCost:
    """Measure both searches for ``positions`` [m], (n, 3), and ``radius`` [m]; the rest is from the animation."""
    return NeighbourCost(
        pairs=len(find_pairs(positions, radius)),
        kdtree_ms=median(_timed(lambda: cKDTree(positions).query_pairs(radius, output_type="ndarray"))),
        search_ms=median(_timed(lambda: find_pairs(positions, radius))),
        step_ms=step_ms,
        searches=searches,
        steps=steps,
    )


def _timed(work: Callable[[], object]) -> list[float]:
    def once() -> float:
        start = time.perf_counter()
        work()
        return 1e3 * (time.perf_counter() - start)

    once()
    return [once() for _ in range(REPEATS)]
