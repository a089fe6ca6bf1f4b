"""Layers of hair: what passes over the scalp lies on the hair that is rooted there, the higher the farther it has come."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats
from ..head.scalp import Scalp
from .grid import Grid
from .strands import Singles
from .surroundings import Surroundings

# So much higher at most [m], after which way over the scalp [m] which part of it.
_HIGHEST, _AFTER = 0.010, ((0.0, 0.03, 0.15), (0.0, 0.4, 1.0))
# Far down its length hair hangs beside the rest, and lies on none [m].
_BESIDE = (0.15, 0.28)
_SPACING = 0.01  # of the nodes that know whether there is scalp below [m]
# A place is over the scalp if that is not farther than the skin, or by so little, and no more if by so much [m].
_WITHIN = (0.004, 0.012)
_NEAR = 0.03  # off the scalp by more than this hair is over none [m]


@dataclass(frozen=True, eq=False)
class Layers:
    """Whether there is scalp below a place: ``rooted`` at the nodes of a grid, 0 to 1, (size,)."""

    grid: Grid
    rooted: Singles

    @classmethod
    @lru_cache(maxsize=4)
    def over(cls, scalp: Scalp, surroundings: Surroundings) -> Layers:
        """The layers of hair that grows on ``scalp``."""
        low, high = scalp.patch.bounds
        grid = Grid.over(low - _NEAR - _SPACING, high + _NEAR + _SPACING, _SPACING)
        to_scalp = cKDTree(scalp.patch.vertices).query(grid.nodes, distance_upper_bound=_NEAR)[0]
        beside = to_scalp - np.abs(surroundings.distance(grid.nodes))
        rooted = np.interp(beside, _WITHIN, (1.0, 0.0))
        return cls(grid, rooted.astype(np.float32))

    def passed(self, points: Floats) -> Singles:
        """The part of a step at ``points`` [m], (k, 3), that is made over the scalp, (k,)."""
        return self.grid.value(self.rooted, points)

    @staticmethod
    def heights(way: Floats, length: Floats) -> Floats:
        """How high above the skin's own clearance hair lies [m] after a ``way`` over the scalp and a ``length`` in all [m]."""
        return _HIGHEST * np.interp(way, *_AFTER) * np.interp(length, _BESIDE, (1.0, 0.0))
