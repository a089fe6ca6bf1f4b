"""Recording what the viewport shows: a film, or a folder of numbered pictures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..io.film import FilmWriter

FRAMES_PER_SECOND = 30
FILM_ENDINGS = (".mp4", ".webm", ".mov", ".gif")


class Recorder:
    """Takes one picture a frame while it records. Time goes on by ``frame_seconds`` a picture, however long one takes."""

    def __init__(self) -> None:
        self._target: Path | None = None
        self._film: FilmWriter | None = None
        self._count = 0
        self._size = (0, 0)

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
        """Begin: a film when the name ends like one, else a folder of pictures. Raises OSError."""
        self._target, self._count, self._film = target, 0, None
        if target.suffix.lower() not in FILM_ENDINGS:
            target.mkdir(parents=True, exist_ok=True)

    def add(self, picture: NDArray[np.uint8]) -> None:
        """Append a picture, shape (height, width, 3); all of a film have the size of its first. Raises OSError."""
        if self._target is None:
            return
        if self._count == 0:
            # Most films want an even width and height.
            self._size = (picture.shape[1] // 2 * 2, picture.shape[0] // 2 * 2)
        image = Image.fromarray(picture)
        if image.size != self._size:
            image = image.resize(self._size, Image.Resampling.LANCZOS)
        if self._target.suffix.lower() in FILM_ENDINGS:
            if self._film is None:
                self._film = FilmWriter(self._target, self._size, FRAMES_PER_SECOND)
            self._film.add(np.asarray(image))
        else:
            image.save(self._target / f"frame-{self._count:05d}.png")
        self._count += 1

    def stop(self) -> str:
        """End, and return what was written, for a message."""
        target, film = self._target, self._film
        self._target = self._film = None
        if film is not None:
            film.close()
        return f"Recorded {self._count} frames to {target}"
