"""Who ends on whom, when many furrows grew at once.

Furrows are numbered. One that comes later ends where it first meets one that came before, and does not grow at all if
its starting point lies in the strip that an earlier one occupies: exactly what happens when they grow one after the
other. How far a furrow gets depends only on earlier ones, so repeating the rule from "all grow freely" settles the
first furrow at once, then the second, and so on; in practice everything in a few rounds, since chains of furrows that
decide about one another are short.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from .segments import TOUCH
from .texels import Flags


@dataclass(frozen=True, eq=False)
class Encounters:
    """What may happen between the sides of furrows that grow together; a side is furrow * 2 + side.

    A place on a side counts segments: 3.25 is a quarter into the fourth. ended: the sides that would end, at what place
    ``ended_at``, if the side ``by`` gets as far as ``by_at``; all (p,). covered: the furrows that would not start if the
    side ``cover`` gets as far as ``cover_at``; all (q,).
    """

    ended: Ints
    ended_at: Floats
    by: Ints
    by_at: Floats
    covered: Ints
    cover: Ints
    cover_at: Floats


def settle(limits: Floats, encounters: Encounters) -> tuple[Flags, Floats]:
    """Which furrows grow, (k,), and how far each of their sides gets, (2 k,), as places.

    limits: how far each side gets for reasons of older furrows, infinite for as far as it grew, (2 k,).
    """
    grows = np.ones(len(limits) // 2, dtype=bool)
    reach = limits
    while True:
        # A little more than it gets, as everywhere a furrow counts as met at its very end.
        extent = np.where(np.repeat(grows, 2), reach + TOUCH, -1.0)
        ending = encounters.by_at <= extent[encounters.by]
        next_reach = limits.copy()
        np.minimum.at(next_reach, encounters.ended[ending], encounters.ended_at[ending])
        covering = encounters.cover_at <= extent[encounters.cover]
        next_grows = np.ones(len(grows), dtype=bool)
        next_grows[encounters.covered[covering]] = False
        if np.array_equal(next_reach, reach) and np.array_equal(next_grows, grows):
            return grows, reach
        grows, reach = next_grows, next_reach
