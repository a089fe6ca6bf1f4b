"""The deformation solver: Choe, Ko 2005, Algorithm 1."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from .density import DensityField
from .field import force_field
from .flow import Flow
from .outlines import Outlines
from .styling_settings import StylingSettings
from .surroundings import Surroundings

# The wisps of one joint are laid in so many turns, each of which sees the density that those before it left.
_TURNS = 2


@dataclass(frozen=True)
class DeformReport:
    """What the solver did. segments: how many were laid. colliding: how many met eq. 6 at first. unresolved: how many of
    these still collided after the last bend and took the least dense direction.
    """

    segments: int
    colliding: int
    unresolved: int


def deform(
    outlines: Outlines, surroundings: Surroundings, styling: StylingSettings, scalp: Scalp, rng: np.random.Generator
) -> tuple[Outlines, DeformReport]:
    """``outlines`` at rest, deformed by the styling force, by each other and by the head (Algorithm 1).

    The algorithm goes from joint to joint, and at every joint from wisp to wisp. Here all wisps of a joint are laid at
    once, in two interleaved turns: within a turn a wisp does not see what its neighbours add at the same joint, but its
    nearest neighbours over the scalp are in the other turn, and at the next joint everybody sees everything.
    """
    density = DensityField.empty(surroundings, scalp.area, int(outlines.strands.sum()))
    flow = Flow(
        outlines,
        density,
        force_field(styling, surroundings),
        styling.bending_stiffness,
        styling.density_threshold,
    )
    turns = _turns(scalp.locate(outlines.roots))
    for _ in range(outlines.frames.shape[1]):
        for turn in turns:
            wisps = flow.unfinished(turn)
            flow.lay(wisps, flow.styling_force(wisps), np.full(len(wisps), styling.density_threshold))
    tally = flow.tally
    return replace(outlines, frames=flow.result()), DeformReport(tally.laid, tally.colliding, tally.unresolved)


def _turns(uv: Floats) -> list[Ints]:
    """All wisps by the turn they are laid in: neighbours along a space-filling curve through the scalp alternate."""
    order = np.argsort(_along_curve(uv), kind="stable")
    return [np.sort(order[start::_TURNS]) for start in range(_TURNS)]


def _along_curve(uv: Floats) -> Ints:
    """Place of points of the unit square, (k, 2), along Morton's curve: the bits of both coordinates interleaved, (k,)."""
    cells = (np.clip(uv, 0.0, 1.0) * 1023).astype(np.int64)
    bits = (cells[:, :, None] >> np.arange(10)) & 1
    return (bits[:, 0] << 2 * np.arange(10)).sum(axis=1) + (bits[:, 1] << 2 * np.arange(10) + 1).sum(axis=1)
