"""Holding hair apart, and letting go: the experiment of figure 6 of Bando et al. 2006."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats
from .model import HairModel

# A firm hand: it moves hair to its side at this rate and has it stay there [1/s].
_GRIP = 18.0
# Hair this close to the scalp is not taken along: it cannot go [m].
_FREE_LENGTH = 0.05


@dataclass(frozen=True, eq=False)
class Parting:
    """Two hands that hold the hair of the back of the head to the left and right of a plane through ``origin``.

    normal: unit, from the right hand to the left, head frame, (3,). width: distance of the hands [m]. side: for each
    particle the hand that holds it, -1 right, +1 left, 0 none, (n,).
    """

    origin: Floats
    normal: Floats
    width: float
    side: Floats

    @classmethod
    def take(cls, model: HairModel, positions: Floats, width: float, behind: float = -0.02) -> Parting:
        """Take the back hair as it hangs at ``positions`` [m], (n, 3), each particle to the side it is on.

        behind: hair in front of this z is left alone [m].
        """
        normal = np.array([1.0, 0.0, 0.0])
        back = model.rest_positions[:, 2] < behind
        loose = model.arc_length > _FREE_LENGTH
        side = np.where(back & loose, np.where(positions[:, 0] >= 0, 1.0, -1.0), 0.0)
        return cls(np.zeros(3), normal, width, side)

    def forces(self, model: HairModel, positions: Floats, velocities: Floats) -> Floats:
        """What the hands exert [N], (n, 3): nothing on hair that is already past them."""
        across = (positions - self.origin) @ self.normal * self.side
        lack = np.where(self.side != 0, np.maximum(0.5 * self.width - across, 0.0), 0.0)
        speed = np.where(lack > 0, velocities @ self.normal * self.side, 0.0)
        push = model.mass * (_GRIP**2 * lack - 2.0 * _GRIP * speed)
        return (push * self.side)[:, None] * self.normal


def gap(model: HairModel, parting: Parting, positions: Floats) -> float:
    """Width of the gap between the two sides of a parting in the lower half of the hair [m], 0 when they overlap.

    The sides' edges are taken where a tenth of each side's particles lies further in, so that a stray does not close it.
    """
    lower = model.arc_length > 0.5 * model.arc_length.max()
    across = (positions - parting.origin) @ parting.normal
    left, right = across[lower & (parting.side > 0)], across[lower & (parting.side < 0)]
    if len(left) == 0 or len(right) == 0:
        return 0.0
    return max(0.0, float(np.quantile(left, 0.1) - np.quantile(right, 0.9)))
