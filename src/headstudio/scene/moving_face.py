"""A face that lives, over time: its skin and the performance that moves it."""

from __future__ import annotations

from ..wrinkle.face_settings import FaceSettings
from ..wrinkle.living_skin import LivingSkin, Skin


class MovingFace:
    """A skin, and what it is like now."""

    def __init__(self, skin: Skin) -> None:
        self.skin = skin
        self._shown: tuple[FaceSettings, LivingSkin] | None = None

    def advance(self, settings: FaceSettings, time: float, seconds: float) -> None:
        """Time has come to ``time`` [s] in the performance of ``settings``, and will go on by some ``seconds``."""

    def at(self, settings: FaceSettings, time: float) -> LivingSkin:
        """The skin at ``time`` [s] of a performance; the same object while nothing moves."""
        face = settings.at(time)
        if self._shown is None or self._shown[0] != face:
            self._shown = face, self.skin.at(face)
        return self._shown[1]

    def shows(self, settings: FaceSettings, time: float) -> bool:
        """Whether what at() gave last is the skin at ``time`` [s], and not one foreseen for about then."""
        return self._shown is None or self._shown[0] == settings.at(time)
