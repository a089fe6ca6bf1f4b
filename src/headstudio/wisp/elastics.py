"""Elastics: where the hair that lies in them runs, and how they hold it together.

A constraint brings a joint of every wisp near a knot, from any side and in its own direction. An elastic is a ring that
all of it goes through: it lies where the hair does, square to it, and what would pass outside is pressed in.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints
from ..head.rows import row_dot, row_unit
from ..head.smooth import smoothstep
from .force import ForceField
from .hairdressing import Grip, grip_of
from .operations import Operation
from .outlines import Outlines
from .strands import Singles
from .surroundings import Surroundings

# A wisp that comes no nearer to the knot than this is not in the elastic, in radii.
_MISSED = 1.5
# An elastic is as wide as this part of its wisps wants, if that is less than it may be.
_WIDE = 0.75
# Beside the elastic hair is pressed less and less over one radius; hair so far off its axis passes it by, in radii.
_PASSING, _PAST = 2.0, 3.0
# How hard the edge is: hair at the radius itself goes in by a sixth, and hair well within is left alone.
_EDGE = 4


@dataclass(frozen=True, eq=False)
class Elastic:
    """A ring around hair: its middle [m], (3,), the direction the hair runs in it, (3,), its radius [m], which wisps it
    holds, (W,), and its colour, None if it is not seen.
    """

    middle: Floats
    axis: Floats
    radius: float
    wisps: NDArray[np.bool_]
    colour: tuple[float, float, float] | None

    @classmethod
    def around(cls, outlines: Outlines, grip: Grip, wisps: NDArray[np.bool_]) -> Elastic:
        """The elastic that holds ``wisps``, (W,), of the hair as it lies at ``grip``."""
        chosen = np.flatnonzero(wisps)
        start, run = outlines.joints[chosen, :-1], outlines.segment * outlines.directions[chosen]
        along = np.clip(np.einsum("wji,wji->wj", grip.middle - start, run) / outlines.segment**2, 0.0, 1.0)
        nearest = start + along[..., None] * run - grip.middle
        apart = np.linalg.norm(nearest, axis=2)
        apart[np.arange(apart.shape[1]) >= outlines.counts[chosen, None]] = np.inf
        segment = apart.argmin(axis=1)
        row = np.arange(len(chosen))
        held = np.flatnonzero(apart[row, segment] <= _MISSED * grip.radius)
        if len(held) == 0:
            return cls(grip.middle, grip.axis, grip.radius, wisps, grip.colour)
        passing, segment = nearest[held, segment[held]], segment[held]
        weight = outlines.strands[chosen[held]][:, None] / outlines.strands[chosen[held]].sum()
        way = (weight * outlines.directions[chosen[held], segment]).sum(axis=0)
        axis = row_unit(way[None], otherwise=grip.axis[None])[0]
        offset = (weight * passing).sum(axis=0)
        beside = passing - offset
        beside -= (beside @ axis)[:, None] * axis
        reach = np.linalg.norm(beside, axis=1) + outlines.radii[chosen[held], segment]
        return cls(grip.middle + offset, axis, min(grip.radius, float(np.quantile(reach, _WIDE))), wisps, grip.colour)

    def pressed(self, points: Singles, owner: Ints) -> Singles:
        """Strands, (n, k, 3) [m], with those that the elastic holds pressed into it; in place. owner: their wisps, (n,)."""
        mine = np.flatnonzero(self.wisps[owner])
        offset = points[mine] - self.middle.astype(np.float32)
        axis = self.axis.astype(np.float32)
        along = np.abs(offset @ axis)
        # Between two points a strand is straight, so both beside the elastic have to be in it.
        spacing = np.linalg.norm(np.diff(offset, axis=1), axis=2).mean(axis=1, keepdims=True)
        nearness = 1.0 - np.clip((along - 0.5 * spacing) / self.radius, 0.0, 1.0)
        strand, place = np.nonzero(nearness > 0.0)
        offset, nearness = offset[strand, place], nearness[strand, place]
        across = offset - (offset @ axis)[:, None] * axis
        apart = np.sqrt(row_dot(across, across)) / np.float32(self.radius)
        # Smoothly to the ring for all that is near, and not at all for what passes by.
        ringed = (1.0 + apart**_EDGE) ** (-1.0 / _EDGE)
        strength = smoothstep(nearness) * smoothstep(apart, _PAST, _PASSING)
        points[mine[strand], place] += (strength * (ringed - 1.0))[:, None] * across
        return points


def elastics_of(
    operations: Sequence[Operation], outlines: Outlines, surroundings: Surroundings, force: ForceField, uv: Floats
) -> tuple[Elastic, ...]:
    """The elastics of ``operations`` around hair as it lies under ``force``, whose wisps are rooted at (u, v), (W, 2). Hair
    that several operations select is held by the last.
    """
    longest = float(outlines.counts.max(initial=0) * outlines.segment)
    free = np.ones(len(uv), dtype=bool)
    elastics = []
    for operation in reversed(operations):
        wisps = operation.selection.of(uv) & free
        free &= ~wisps
        grip = grip_of(operation, surroundings, force, longest)
        if grip is not None:
            elastics.append(Elastic.around(outlines, grip, wisps))
    return tuple(reversed(elastics))
