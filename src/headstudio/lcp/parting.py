"""Holding hair apart, and letting go: the experiment of figure 6 of Bando et al. 2006."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..head.mesh import Floats
from .model import HairModel

# Hands take hair to their sides at this rate [1/s], and no faster than this [m/s].
_PULL = 8.0
_TOP_SPEED = 0.5
_LETTING_GO = 0.1  # how fast each hand comes back [m/s]
_STRAYS = 0.03
# Hair this close to the scalp is not taken along: it cannot go [m].
_FREE_LENGTH = 0.05


@dataclass(frozen=True, eq=False)
class Parting:
    """Two hands that hold the hair of the back of the head to the left and right of a plane through the head's origin.

    normal: unit, from the right hand to the left, head frame, (3,). width: distance of the hands [m]. side: for each
    particle the hand that holds it, -1 right, +1 left, 0 none, (n,).
    """

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
        return cls(normal, width, side)

    def letting_go(self, dt: float) -> Parting | None:
        """The hands dt [s] later when they come together again, and None when they are. Hair that is drawn back all at once
        snaps shut: links that were held across the gap are as stiff as any."""
        width = self.width - 2.0 * _LETTING_GO * dt
        return replace(self, width=width) if width > 0 else None

    def guided(self, positions: Floats, velocities: Floats) -> Floats:
        """Velocities [m/s] of hair that the hands take to their sides, (n, 3): hands are stronger than any link.

        positions: [m], (n, 3). Hair that is already past its hand is free.
        """
        lack = np.where(self.side != 0, 0.5 * self.width - (positions @ self.normal) * self.side, 0.0)
        wanted = np.clip(_PULL * lack, 0.0, _TOP_SPEED)
        speed = (velocities @ self.normal) * self.side
        push = np.where(lack > 0, np.maximum(wanted - speed, 0.0), 0.0)
        return velocities + (push * self.side)[:, None] * self.normal


def gap(model: HairModel, parting: Parting, positions: Floats) -> float:
    """Width of the gap between the two sides of a parting in the lower half of the hair [m], 0 when they overlap.

    The edge of a side is where few of its particles lie further in, so that a stray does not close the gap.
    """
    lower = model.arc_length > 0.5 * model.arc_length.max()
    across = positions @ parting.normal
    left, right = across[lower & (parting.side > 0)], across[lower & (parting.side < 0)]
    if len(left) == 0 or len(right) == 0:
        return 0.0
    return max(0.0, float(np.quantile(left, _STRAYS) - np.quantile(right, 1.0 - _STRAYS)))
