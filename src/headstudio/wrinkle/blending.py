"""Furrows that cross: neither is buried under the other's bulge, and the crossing is no deeper than the deeper one.

Heights add up, so that every furrow keeps its volume, but for places that lie below the skin in several furrows at once.
There the depths a_i are joined as (sum a_i^p)^(1/p), a smooth maximum. A furrow that *adds up* takes no part in that: its
height is added to whatever else is there, as in a scan where one groove runs through another.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints

_POWER = 6.0


class Blending:
    """Which entries (a vertex beside a furrow) share their depth with others at the same vertex."""

    def __init__(self, rows: Ints, unit_height: Floats, adds: NDArray[np.bool_]) -> None:
        """rows: the vertex of each entry, (i,). unit_height: its height at full amplitude [m], (i,). adds: whether it belongs
        to a furrow that adds up, (i,)."""
        below = np.flatnonzero((unit_height < 0) & ~adds)
        count = np.bincount(rows[below], minlength=int(rows.max(initial=0)) + 1)
        self._shared = below[count[rows[below]] > 1]
        self._group = np.unique(rows[self._shared], return_inverse=True)[1].reshape(-1)
        self._depth = -unit_height[self._shared]

    def applied(self, amplitude: Floats) -> Floats:
        """Amplitudes, (i,), lowered so that the sum over the entries of a vertex is the joined height.

        The same factors join the gradients: the derivative of the smooth maximum by each a_i is (a_i / maximum)^(p - 1).
        """
        if not len(self._shared):
            return amplitude
        depth = amplitude[self._shared] * self._depth
        total = np.bincount(self._group, depth**_POWER) ** (1.0 / _POWER)
        lowered = amplitude.copy()
        part = depth / np.maximum(total[self._group], np.finfo(float).tiny)
        lowered[self._shared] *= np.minimum(part, 1.0) ** (_POWER - 1.0)
        return lowered
