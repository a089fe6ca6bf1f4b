"""A force field on a grid: which way hair is pulled at every place, whoever made it."""

from __future__ import annotations

from dataclasses import dataclass

from ..head.mesh import Floats
from .grid import Grid
from .strands import Singles


@dataclass(frozen=True, eq=False)
class ForceField:
    """Vectors at the nodes of a grid, a column each, (3, size), looked up trilinearly."""

    grid: Grid
    vectors: Singles

    def at(self, points: Floats) -> Singles:
        """Phi at ``points`` [m], (k, 3): (k, 3)."""
        return self.grid.value(self.vectors, points)
