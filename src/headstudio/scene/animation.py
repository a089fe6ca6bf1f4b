"""One head with everything that is on it, over time: loose particles that swing or strands that keep their style, and a
face that may live."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ..head.frame import HeadFrame
from .ahead import SimulationAhead
from .builder import Builder
from .document import Document
from .face_ahead import FaceAhead
from .measures import head_figures
from .motion import Motion
from .moving_face import MovingFace
from .simulation import Simulation
from .stage import Stage


class Animation:
    """What a document shows, from rest on.

    document: as it is shown now. head, scalp: what everything sits on. simulation: the particles in motion, or None.
    hairdo: the strands in their style, or None. skin: of a face that lives, or None.
    """

    def __init__(
        self,
        builder: Builder,
        document: Document,
        strands: int | None = None,
        *,
        settled: bool = True,
        live: bool = False,
    ) -> None:
        """Build what the document asks for; ``strands``: of a hairstyle at most so many. settled: False is quicker where
        furrows change, and leaves ``settled`` to be made up for. live: somebody looks on, so that loose hair and the
        face are worked out one frame ahead, in other processes. Raises HeadError, ParameterError."""
        self.document = document
        self.head = builder.head(document.head)
        self.scalp = builder.scalp(document)
        hair_as = document.look.hair_as
        simulate = SimulationAhead if live else Simulation
        self.simulation = simulate(builder.build(document), document) if hair_as == "particles" else None
        self.hairdo = builder.hairdo(document, strands) if hair_as == "strands" else None
        self.skin = builder.skin(document, settled=settled) if document.look.skin_as == "living" else None
        self._face = (FaceAhead if live else MovingFace)(self.skin) if self.skin is not None else None
        self._time = 0.0
        self._frame = HeadFrame()
        self._ahead = 0.0

    @property
    def time(self) -> float:
        """How long it has been going on [s]."""
        return self.simulation.time if self.simulation else self._time

    @property
    def settled(self) -> bool:
        """Whether nothing is left on the skin of furrows that are no more."""
        return self.skin is None or self.skin.surface.bed.settled

    @property
    def timings(self) -> dict[str, float]:
        """Milliseconds that each stage of the last advance() took."""
        return self.simulation.timings if self.simulation else {}

    def advance(self, motion: Motion, seconds: float) -> None:
        """Let ``seconds`` pass while the head moves by ``motion``."""
        if self.simulation is not None:
            self.simulation.advance(motion, seconds)
        else:
            self._time += seconds
            self._frame = motion(self._time)
        if self._face is not None:
            self._face.advance(self.document.face, self.face_time, seconds)

    def reset(self) -> None:
        """Back to rest, at time 0."""
        self._time, self._frame, self._ahead = 0.0, HeadFrame(), 0.0
        if self.simulation is not None:
            self.simulation.reset()

    def go_on_from(self, earlier: Animation) -> bool:
        """Take over time and motion of another one with the same head and the same loose hair; False for any other."""
        mine, theirs = self.simulation, earlier.simulation
        if self.head is not earlier.head or (mine is None) != (theirs is None):
            return False
        if mine is not None and theirs is not None:
            if mine.built.hair is not theirs.built.hair:
                return False
            self.simulation = theirs
        self._time, self._frame, self._ahead = earlier._time, earlier._frame, earlier._ahead
        if self.skin is not None and self.skin is earlier.skin:
            self._face = earlier._face
        return True

    @property
    def face_time(self) -> float:
        """Where the performance of the face is [s]."""
        return max(self.time + self._ahead, 0.0)

    def seek_face(self, time: float) -> None:
        """Put the performance of the face at ``time`` [s]; hair and head stay where they are."""
        self._ahead = time - self.time

    def retune(self, document: Document) -> None:
        """Take over the parameters that need no other build."""
        self.document = document
        if self.simulation is not None:
            self.simulation.retune(document)

    def take_notes(self) -> list[str]:
        """What the user should be told since the last time, in lines."""
        if self.simulation is None:
            return []
        notes, self.simulation.notes[:] = list(self.simulation.notes), []
        return notes

    def measure(self) -> dict[str, float]:
        """The figures of the present state."""
        return self.simulation.measure() if self.simulation else head_figures(self._frame)

    def stage(self) -> Stage:
        """What there is to see now."""
        stage = self.simulation.stage() if self.simulation else Stage(self.head, self._frame)
        if self._face is not None:
            stage = replace(stage, skin=self._face.at(self.document.face, self.face_time))
        if self.hairdo is None:
            return stage
        return replace(stage, strands=self.hairdo.strands, adornments=self.hairdo.adornments)

    @property
    def exact(self) -> bool:
        """Whether the last stage shows the face of this very moment, and not of one that was foreseen for about now."""
        return self._face is None or self._face.shows(self.document.face, self.face_time)


def needs(document: Document) -> tuple[Any, ...]:
    """All that a build depends on: documents with the same needs are shown by the same Animation."""
    look = document.look
    hair: tuple[Any, ...] = ()
    if look.hair_as == "strands":
        hair = (document.wisp, document.groom, document.beard, document.colour, document.styling, look.strands_shown)
    elif look.hair_as == "particles":
        hair = (document.hair,)
    skin = (replace(document.wrinkle, proposals=()), document.fine) if look.skin_as == "living" else ()
    return (document.head, document.scalp, look.hair_as, *hair, look.skin_as, *skin)


def groundwork(document: Document) -> tuple[Any, ...]:
    """The part of the needs that takes seconds to build: loose hair, and where the skin is refined and carved. The rest, such
    as strands and the depth of furrows, is there soon enough to follow a drag of the mouse."""
    look, wrinkle = document.look, document.wrinkle
    hair = (document.head, document.scalp, document.hair) if look.hair_as == "particles" else ()
    skin = (wrinkle.lines(), wrinkle.fineness, document.fine) if look.skin_as == "living" else ()
    return (look.hair_as, *hair, look.skin_as, *skin)
