"""The simulation in a process of its own, one frame ahead of the picture.

While a frame is drawn the next one is worked out elsewhere, so that a frame takes as long as the slower of the two.

The other process keeps nothing between two frames but the neighbour list. It is told the moment to go on from, the
parameters, and where the head will be, and it answers with the moment that it has come to. So whatever happens here in
between (hands, a reset, another slider) is simply part of what it is told next.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..head.frame import HeadFrame
from ..lcp.body import Body
from ..lcp.model import HairModel
from .builder import Built
from .document import Document
from .motion import Motion
from .moving_hair import STEP_RATE, MovingHair
from .other_process import OtherProcess
from .simulation import Simulation


@dataclass(frozen=True)
class SampledMotion:
    """A motion as frames at equal distances, for those who cannot ask for any other. start [s]; rate [1/s]."""

    start: float
    rate: float
    frames: tuple[HeadFrame, ...]

    @classmethod
    def of(cls, motion: Motion, start: float, rate: float, count: int) -> SampledMotion:
        """``count`` frames of ``motion``, from ``start`` [s] on."""
        return cls(start, rate, tuple(motion(start + k / rate) for k in range(count)))

    def __call__(self, time: float) -> HeadFrame:
        """The frame next to ``time`` [s]."""
        return self.frames[min(max(round((time - self.start) * self.rate), 0), len(self.frames) - 1)]


class SimulationAhead(Simulation):
    """A Simulation that is one frame ahead: advance() takes what it asked for last time, and asks for the next frame.

    The process starts with the first advance(). Until it is there, which takes a second or two, and should it come to an
    end, the simulation goes on in this process.
    """

    def __init__(self, built: Built, document: Document) -> None:
        self._worker: OtherProcess | None = None
        self._asked = False
        super().__init__(built, document)

    def advance(self, motion: Motion, seconds: float) -> None:
        """Take the frame asked for last, and ask for one ``seconds`` later while the head moves by ``motion``."""
        self._take()
        worker = self._running()
        if not worker.ready:
            super().advance(motion, seconds)
            return
        start, count = self.frame_times(seconds)
        sampled = SampledMotion.of(motion, start, STEP_RATE * self.parts, count)
        self._asked = worker.ask(self.document, self.moment(), sampled, seconds)

    def wait_for_process(self) -> bool:
        """Start the process and wait until it is there; False when it cannot be had."""
        return self._running().wait()

    def reset(self) -> None:
        """Back to the initial state."""
        self._take()
        super().reset()

    def hold_apart(self, width: float = 0.09) -> None:
        """Part the hair of the back and hold it ``width`` [m] apart, until release()."""
        self._take()
        super().hold_apart(width)

    def release(self) -> None:
        """Let go of the hair."""
        self._take()
        super().release()

    def _running(self) -> OtherProcess:
        if self._worker is None:
            self._worker = OtherProcess(_Answers, self.model, self.dynamics.body, self.document)
        return self._worker

    def _take(self) -> None:
        """Go on from the frame that was asked for, as soon as it is there."""
        if not self._asked or self._worker is None:
            return
        self._asked = False
        answer = self._worker.answer()
        if answer is None:
            self.notes.append("the process of the simulation has ended; hair goes on moving, more slowly")
            return
        moment, notes = answer
        self.take_up(moment)
        self.notes += notes


class _Answers:
    """Moves hair in the other process."""

    def __init__(self, model: HairModel, body: Body, document: Document) -> None:
        self._hair = MovingHair(model, body, document)

    def __call__(
        self, tuned: Document, moment: dict[str, Any], motion: SampledMotion, seconds: float
    ) -> tuple[dict[str, Any], list[str]]:
        """What the hair comes to from ``moment`` on, and what the user should be told."""
        hair = self._hair
        hair.notes = []
        hair.retune(tuned)
        hair.take_up(moment)
        hair.advance(motion, seconds)
        return hair.moment(), hair.notes
