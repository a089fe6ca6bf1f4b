"""The deformation solver: Choe, Ko 2005, Algorithm 1, with the constraint-based styler on top."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from .density import DensityField
from .field import force_field
from .flow import Flow
from .hairdressing import queues_of
from .layers import Layers
from .outlines import Outlines
from .queues import Queue, QueueReport, run
from .styling_settings import StylingSettings
from .surroundings import Surroundings

# The wisps of one joint are laid in so many turns, each of which sees the density that those before it left.
_TURNS = 2


@dataclass(frozen=True)
class DeformReport:
    """What the solver did. segments: how many were laid. colliding: how many met eq. 6 at first. unresolved: how many of
    these still collided after the last bend and took the least dense direction. queues: what became of every constraint
    queue, in order.
    """

    segments: int
    colliding: int
    unresolved: int
    queues: tuple[QueueReport, ...] = ()


class Deformer:
    """Deforms hair again and again, and does again only what a change concerns: hair that was let down stays so while what is
    done to it afterwards changes, and so do the operations before the first that is another.
    """

    def __init__(self) -> None:
        # Hair let down, and after each operation: from what, the flow as it was then, and what became of the queues.
        self._known: list[tuple[Any, Flow, list[QueueReport]]] = []

    def deform(
        self, outlines: Outlines, surroundings: Surroundings, styling: StylingSettings, scalp: Scalp
    ) -> tuple[Outlines, DeformReport]:
        """``outlines`` at rest, deformed by the styling force, by each other and by the head, and dressed.

        First all hair is let down (Algorithm 1). Then the operations are carried out one after the other: the wisps that
        an operation selects are picked up, their hair leaves the density field, and they are laid again under their
        queues, among all hair that lies as it lay. So an operation moves no hair but its own, not by a hair's breadth,
        and what was done before it stays. Hair that several operations select belongs to the last.
        """
        uv, tau = scalp.locate(outlines.roots), styling.density_threshold
        longest = float(outlines.counts.max(initial=0) * outlines.segment)
        free = replace(styling, operations=(), cuts=(), accessories=())
        force = force_field(free, surroundings)
        steps = [_members(queues_of(operation, surroundings, force, longest), uv) for operation in styling.operations]
        # Nobody sees how hair lies that is all picked up at once.
        in_vain = bool(steps) and sum(len(wisps) for _, wisps in steps[0]) == len(uv)

        def let_down() -> tuple[Flow, list[QueueReport]]:
            density = DensityField.empty(surroundings, scalp.area, int(outlines.strands.sum()))
            layers = Layers.over(scalp, surroundings)
            flow = Flow(outlines, density, layers, force, styling.bending_stiffness, tau, styling.unevenness)
            if not in_vain:
                _let_down(flow, uv, tau)
            return flow, []

        flow = self._step(0, (outlines, surroundings, free, scalp, in_vain), let_down)
        for k, (operation, queues) in enumerate(zip(styling.operations, steps)):

            def dress(before: Flow = flow, queues: list[tuple[Queue, Ints]] = queues) -> tuple[Flow, list[QueueReport]]:
                after = before.copy()
                after.pick_up(np.concatenate([wisps for _, wisps in queues]))
                return after, run(queues, after, tau)

            flow = self._step(k + 1, operation, dress)
        del self._known[len(steps) + 1 :]
        tally, reports = flow.tally, [report for _, _, some in self._known for report in some]
        return flow.result(), DeformReport(tally.laid, tally.colliding, tally.unresolved, tuple(reports))

    def _step(self, k: int, wanted: Any, make: Callable[[], tuple[Flow, list[QueueReport]]]) -> Flow:
        """The flow after step ``k``, all before it being known: the one there is if it was made from the same."""
        if k == len(self._known) or self._known[k][0] != wanted:
            del self._known[k:]
            self._known.append((wanted, *make()))
        return self._known[k][1]


def deform(
    outlines: Outlines, surroundings: Surroundings, styling: StylingSettings, scalp: Scalp
) -> tuple[Outlines, DeformReport]:
    """As ``Deformer.deform``, once."""
    return Deformer().deform(outlines, surroundings, styling, scalp)


def _let_down(flow: Flow, uv: Floats, tau: float) -> None:
    """Lay all hair as it flows, joint by joint.

    At every joint the algorithm goes from wisp to wisp. Here all wisps of a joint are laid at once, in two interleaved
    turns: within a turn a wisp does not see what others add at the same joint, but its nearest neighbours over the scalp
    are in the other turn, and at the next joint everybody sees everything.
    """
    turns = _turns(uv)
    for _ in range(flow.outlines.frames.shape[1]):
        for turn in turns:
            wisps = flow.unfinished(turn)
            flow.lay(wisps, flow.styling_force(wisps), np.full(len(wisps), tau))


def _members(queues: tuple[Queue, ...], uv: Floats) -> list[tuple[Queue, Ints]]:
    """The queues of one operation with their wisps; a wisp that several select belongs to the first."""
    taken = np.zeros(len(uv), dtype=bool)
    members = []
    for queue in queues:
        wisps = queue.wisps(uv)
        wisps = wisps[~taken[wisps]]
        taken[wisps] = True
        members.append((queue, wisps))
    return members


def _turns(uv: Floats) -> list[Ints]:
    """All wisps by the turn they are laid in: neighbours along a space-filling curve through the scalp alternate."""
    order = np.argsort(_along_curve(uv), kind="stable")
    return [np.sort(order[start::_TURNS]) for start in range(_TURNS)]


def _along_curve(uv: Floats) -> Ints:
    """Place of points of the unit square, (k, 2), along Morton's curve: the bits of both coordinates interleaved, (k,)."""
    cells = (np.clip(uv, 0.0, 1.0) * 1023).astype(np.int64)
    bits = (cells[:, :, None] >> np.arange(10)) & 1
    return (bits[:, 0] << 2 * np.arange(10)).sum(axis=1) + (bits[:, 1] << 2 * np.arange(10) + 1).sum(axis=1)
