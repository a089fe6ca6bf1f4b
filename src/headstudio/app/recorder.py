"""Recording what the viewport shows: a film, or a folder of numbered pictures."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..io.film import Film, open_film

FRAMES_PER_SECOND = 30


class Recorder:
    """Takes one picture a frame while it records. Time then goes on evenly, however long a picture takes."""

    def __init__(self) -> None:
        self._target: Path | None = None
        self._film: Film | None = None
        self._closing = ExitStack()
        self._size = (0, 0)
        self._count = 0

    @property
    def recording(self) -> bool:
        """Whether a recording is under way."""
        return self._target is not None

    @property
    def seconds(self) -> float:
        """How much was recorded [s]."""
        return self._count / FRAMES_PER_SECOND

    @property
    def frame_seconds(self) -> float | None:
        """How far a frame goes on [s] while recording, else None: with the clock."""
        return 1 / FRAMES_PER_SECOND if self.recording else None

    def start(self, target: Path) -> None:
        """Begin with the next picture; the name's ending tells a film from a folder."""
        self._target, self._count = target, 0

    def add(self, picture: NDArray[np.uint8]) -> None:
        """Append a picture, shape (height, width, 3). Raises FilmError.

        The first one gives the size; later ones are brought to it, should the window have changed.
        """
        if self._target is None:
            return
        height, width, _ = picture.shape
        if self._film is None:
            self._size = (width, height)
            self._film = self._closing.enter_context(open_film(self._target, FRAMES_PER_SECOND, self._size))
        if (width, height) != self._size:
            picture = np.asarray(Image.fromarray(picture).resize(self._size, Image.Resampling.LANCZOS))
        self._film.add(picture)
        self._count += 1

    def stop(self) -> str:
        """End, and return what was written, for a message."""
        target, self._target, self._film = self._target, None, None
        self._closing.close()
        return f"Recorded {self._count} frames to {target}"
