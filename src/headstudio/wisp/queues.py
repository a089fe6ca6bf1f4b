"""Constraint queues: one constraint after the other for a set of wisps (Choe, Ko 2005, section 4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.rows import row_unit
from .constraints import Constraint, Joint, Progress
from .flow import Flow
from .selection import Selection

# After a tie hair spreads again: over this length the density it was pressed to falls by e [m].
_SPREAD = 0.20


@dataclass(frozen=True, eq=False)
class Queue:
    """Constraints for the wisps of a selection, first to last.

    part, parts: of the selected wisps, ordered from the person's right to the left, only the part-th of ``parts`` equal
    groups, as the three of a braid.
    """

    selection: Selection
    constraints: tuple[Constraint, ...]
    part: int = 0
    parts: int = 1

    def wisps(self, uv: Floats) -> Ints:
        """The wisps chosen among roots at (u, v), (W, 2)."""
        chosen = np.flatnonzero(self.selection.of(uv))
        across = chosen[np.argsort(uv[chosen, 0], kind="stable")]
        return np.sort(np.array_split(across, self.parts)[self.part])


@dataclass(frozen=True, eq=False)
class QueueReport:
    """What became of one queue. selected: how many wisps. too_short: how many ended before they met a constraint."""

    selected: int
    too_short: int


@dataclass(frozen=True, eq=False)
class Order:
    """The next segment of ``wisps``, (k,): the force on it, (k, 3), and above which density it collides, (k,)."""

    wisps: Ints
    force: Floats
    ceiling: Floats


class QueueRun:
    """One queue at work on its wisps.

    The first constraint holds until all wisps have met it, then comes the next. A wisp that has met its constraint early
    waits: it gets no segment until the last of the others is there, and so loses no length. A wisp too short to get
    there ends on its way and nobody waits for it, so that the last word is bounded by the longest hair.
    """

    def __init__(self, queue: Queue, wisps: Ints, flow: Flow, tau: float) -> None:
        self.wisps = wisps
        self._queue = queue
        self._flow = flow
        self._tau = tau
        self._step = 0
        self._lanes = _lanes(flow.outlines.roots[wisps])
        self._pressed = np.zeros(len(wisps))
        self._failed = np.zeros(len(wisps), dtype=bool)
        self._progress: Progress | None = self._begin()

    @property
    def report(self) -> QueueReport:
        """How it went, once nothing is left to lay."""
        return QueueReport(len(self.wisps), int(self._failed.sum()))

    def active(self) -> Ints:
        """Which of its wisps, by their place in ``wisps``, get a segment now; none when all hair is laid."""
        unfinished = self._flow.laid[self.wisps] < self._flow.outlines.counts[self.wisps]
        while self._progress is not None and not (unfinished & ~self._progress.done).any():
            self._failed |= ~self._progress.met
            self._step += 1
            self._progress = self._begin()
        return np.flatnonzero(unfinished if self._progress is None else unfinished & ~self._progress.done)

    def ask(self, active: Ints) -> Order:
        """What the next segment of the wisps ``active`` in ``wisps`` is to obey."""
        wisps, flow = self.wisps[active], self._flow
        force = flow.styling_force(wisps)
        if self._progress is None:
            self._pressed[active] *= np.exp(-flow.outlines.segment / _SPREAD)
            return Order(wisps, force, np.maximum(self._tau, self._pressed[active]))
        constraint = self._queue.constraints[self._step]
        progress = _part(self._progress, active)
        pull = constraint.pull(
            flow.ends[wisps], self._lanes[active], progress, Joint(flow.outlines.segment, flow.stiffness)
        )
        weight = pull.weight[:, None]
        return Order(wisps, (1.0 - weight) * force + weight * pull.psi, self._tau * pull.press)

    def see(self, active: Ints) -> None:
        """Where the wisps ``active`` stand after that segment."""
        if self._progress is None:
            return
        wisps, flow = self.wisps[active], self._flow
        constraint = self._queue.constraints[self._step]
        progress = _part(self._progress, active)
        flow.narrow(wisps, constraint.widest(flow.ends[wisps], progress))
        self._pressed[active] = np.maximum(flow.density_at_ends(wisps), self._tau)
        _put(self._progress, active, constraint.judge(flow.ends[wisps], self._lanes[active], progress))

    def _begin(self) -> Progress | None:
        if self._step == len(self._queue.constraints):
            return None
        return self._queue.constraints[self._step].begin(self._flow.ends[self.wisps], self._lanes)


def run(queues: Sequence[tuple[Queue, Ints]], flow: Flow, tau: float) -> list[QueueReport]:
    """Lay the wisps of all queues, which have none in common, from their roots to their tips, side by side."""
    runs = [QueueRun(queue, wisps, flow, tau) for queue, wisps in queues]
    while True:
        active = [each.active() for each in runs]
        if not any(map(len, active)):
            return [each.report for each in runs]
        # Two turns, as for hair that flows freely.
        for start in range(2):
            turn = [(each, wisps[start::2]) for each, wisps in zip(runs, active)]
            orders = [each.ask(wisps) for each, wisps in turn]
            flow.lay(*(np.concatenate(column) for column in zip(*((o.wisps, o.force, o.ceiling) for o in orders))))
            for each, wisps in turn:
                each.see(wisps)


def _part(progress: Progress, active: Ints) -> Progress:
    return Progress(progress.along[active], progress.met[active], progress.done[active])


def _put(progress: Progress, active: Ints, part: Progress) -> None:
    progress.along[active], progress.met[active], progress.done[active] = part.along, part.met, part.done


def _lanes(roots: Floats) -> Floats:
    """A place in the unit ball for every wisp, (k, 3): to the side its root is on, and evenly filled."""
    if len(roots) == 0:
        return roots
    away = roots - roots.mean(axis=0)
    # A strip of scalp is as good as a round patch: distances are measured in its own breadth each way.
    size, axes = np.linalg.eigh(away.T @ away / len(roots))
    away = (away @ axes) / np.sqrt(np.maximum(size, 1e-12)) @ axes.T
    rank = np.argsort(np.argsort(np.linalg.norm(away, axis=1), kind="stable"), kind="stable")
    return np.sqrt((rank + 0.5) / len(roots))[:, None] * row_unit(away, otherwise=np.zeros_like(away))
