"""The density field rho: how full a place is, 1 inside the head (Choe, Ko 2005, section 3.2)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..head.mesh import Floats
from .grid import Grid, corner_weights
from .strands import Singles
from .surroundings import Surroundings

_SPACING = 0.01  # of the nodes: the breadth of a wisp [m]

# Strands through a square metre of hair whose density is 1. A real head of 100,000 strands hangs in a curtain of some
# 70 cm^2 across: 14 strands per mm^2, 7 % of it filled. With this unit tau goes from 0.9 (hair lies as it does)
# to 0.1 (nine times the room), which are the values of figure 9.
FULL = 14e6

# Strands per square metre of scalp of a real head: 100,000 on 600 cm^2.
GROWTH = 1.67e6

# Over this distance above the skin the head's density falls from 1 to 0 [m].
_SKIN_DEPTH = 0.006

# What part of a point's share is found at the point itself, after spreading and looking up trilinearly: (2/3)^3.
_SELF = 8.0 / 27.0


@dataclass(frozen=True, eq=False)
class DensityField:
    """Hair as a density on a grid, and the head from its signed distance. ``hair`` is changed in place.

    unit: density at one node for a metre of one strand [1/m].
    """

    grid: Grid
    surroundings: Surroundings
    unit: float
    hair: Singles = field(repr=False)

    @classmethod
    def empty(cls, surroundings: Surroundings, scalp_area: float, strands: int) -> DensityField:
        """Nothing but the head. However many ``strands`` stand for the hair of a scalp of this area [m^2], together they
        are as dense as real hair: a preview with a fifth of the strands has the same shape.
        """
        grid = Grid.over(surroundings.low, surroundings.high, _SPACING)
        thinned = GROWTH * scalp_area / max(strands, 1)
        return cls(grid, surroundings, thinned / (FULL * _SPACING**3), np.zeros(grid.size, dtype=np.float32))

    def at(self, points: Floats) -> tuple[Singles, Singles]:
        """rho, (k,), and its gradient [1/m], (k, 3), at ``points`` [m], (k, 3)."""
        density, slope = self.grid.value_and_gradient(self.hair, points)
        distance, outward = self.surroundings.distance_and_gradient(points)
        near = (distance < _SKIN_DEPTH).nonzero()[0]
        if len(near):
            density[near] += np.minimum(1 - distance[near] / np.float32(_SKIN_DEPTH), 1)
            slope.T[:, near] -= outward.T[:, near] / np.float32(_SKIN_DEPTH)
        return density, slope

    def added(self, amounts: Floats) -> Floats:
        """rho_Delta of eq. 6: what segments of ``amounts`` strand-metres would add in their own middle, (k,)."""
        return _SELF * self.unit * amounts

    def add(self, middles: Floats, across: Floats, radii: Floats, amounts: Floats) -> None:
        """Add segments: their middles [m], (3, k), two directions across each, (3, 2, k), radii of their wisps [m], (k,),
        and amounts of hair [strand-metres], (k,); negative amounts take hair away again.

        A wisp is spread as four points of a cross, whose second moment is that of a disc of its radius.
        """
        offset = np.sqrt(0.5) * radii * across
        middle = middles[:, None]
        points = np.concatenate([middle + offset, middle - offset], axis=1)
        corners, place = self.grid.cells(points.reshape(3, -1).T)
        share = np.tile((0.25 * self.unit * amounts).astype(np.float32), 4) * corner_weights(place)
        # numpy 2 adds at so few nodes faster than a count over the grid, which looks at every node for every joint.
        np.add.at(self.hair, corners.ravel(), share.ravel())
