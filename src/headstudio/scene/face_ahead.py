"""The skin of a face in a process of its own, one frame ahead of the picture.

Where a performance will be when the next frame is due is known but for some milliseconds. So while a frame is drawn the
skin is moved to there elsewhere, and a frame takes as long as the slower of the two.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..head.mesh import Floats
from ..wrinkle.at_once import work_alone
from ..wrinkle.face_settings import FaceSettings
from ..wrinkle.living_skin import LivingSkin, Skin
from ..wrinkle.skin_motion import MovedSkin, SkinMotion
from .moving_face import MovingFace
from .other_process import OtherProcess

# A process is worth its start for skin that has been moving for so long [s]: while furrows are drawn there is another skin
# with every move of the hand.
_LASTING = 0.5
# Bytes that the arrays of a moved skin take for each of its vertices, twice over.
_ROOM = 256


@dataclass(frozen=True, eq=False)
class _Foreseen:
    """What was asked for: the skin of ``face``, where ``performance`` is about ``time`` [s], give or take ``slack`` [s]."""

    performance: FaceSettings
    time: float
    slack: float
    face: FaceSettings


class FaceAhead(MovingFace):
    """A MovingFace that is one frame ahead: advance() takes what it asked for last time, and asks for the next frame.

    Until the process is there, and should it come to an end, skin moves in this process.
    """

    def __init__(self, skin: Skin) -> None:
        super().__init__(skin)
        self._worker: OtherProcess | None = None
        self._asked: _Foreseen | None = None
        self._due: tuple[_Foreseen, MovedSkin] | None = None
        self._tissue: Floats | None = None
        self._moved_for = 0.0

    def advance(self, settings: FaceSettings, time: float, seconds: float) -> None:
        """Take the skin asked for last, and ask for that of ``seconds`` later."""
        self._take()
        face = settings.at(time + seconds)
        if face == settings.at(time):
            return
        self._moved_for += seconds
        if self._worker is None and self._moved_for > _LASTING:
            self._start()
        if self._worker is not None and self._worker.ready:
            self._ask(_Foreseen(settings, time + seconds, seconds, face))

    def at(self, settings: FaceSettings, time: float) -> LivingSkin:
        """The skin about ``time`` [s] of a performance, when it was foreseen, and else exactly then."""
        due, self._due = self._due, None
        if due is not None:
            foreseen, moved = due
            if foreseen.performance is settings and abs(foreseen.time - time) <= foreseen.slack:
                self._shown = foreseen.face, self.skin.alive(moved, foreseen.face)
                return self._shown[1]
        return super().at(settings, time)

    def wait_for_process(self) -> bool:
        """Start the process and wait until it is there; False when it cannot be had."""
        return self._start().wait()

    def _start(self) -> OtherProcess:
        if self._worker is None:
            count = self.skin.motion.interpolation.shape[0]
            self._worker = OtherProcess(_Answers, self.skin.motion, room=_ROOM * count)
        return self._worker

    def _ask(self, foreseen: _Foreseen) -> None:
        tissue = self.skin.tissue(foreseen.face)
        # Images and keyframes are no part of a face at one instant.
        face = replace(foreseen.face, painted_tissue=None, performance=())
        news = None if tissue is self._tissue else tissue
        if self._worker is not None and self._worker.ask(face, news):
            self._asked, self._tissue = foreseen, tissue

    def _take(self) -> None:
        self._due = None
        if self._asked is None or self._worker is None:
            return
        asked, self._asked = self._asked, None
        moved = self._worker.answer()
        if moved is not None:
            self._due = asked, moved


class _Answers:
    """Moves skin in the other process."""

    def __init__(self, motion: SkinMotion) -> None:
        # The picture is drawn on every core meanwhile: a second thread here would hold that up.
        work_alone()
        self._motion = motion
        self._tissue: Floats = np.zeros(0)

    def __call__(self, face: FaceSettings, tissue: Floats | None) -> MovedSkin:
        """The skin of ``face``. tissue: under it [m], (n,); None where it is as before."""
        if tissue is not None:
            self._tissue = tissue
        return self._motion.at(face, self._tissue)
