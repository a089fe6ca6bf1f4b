"""Frames become a film or a folder of pictures."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

import imageio_ffmpeg
import numpy as np
from numpy.typing import NDArray
from PIL import Image

FILM_SUFFIXES = (".mp4", ".mov", ".mkv")
# Level 1 is more than twice as fast as Pillow's default, and the files are hardly larger.
_PNG_LEVEL = 1


class FilmError(ValueError):
    """A film that cannot be written. The message is one line for the user."""


class Film(Protocol):
    """Something that takes frames, one after the other."""

    def add(self, frame: NDArray[np.uint8]) -> None:
        """Add a frame, (height, width, 3), top row first. Raises FilmError for another size than the film's."""


@contextmanager
def open_film(path: Path, fps: float, size: tuple[int, int]) -> Iterator[Film]:
    """A film of ``size`` pixels (width, height) at ``fps`` frames a second.

    A path ending in .mp4, .mov or .mkv becomes a film (H.264); any other is a folder, and gets frame_0000.png and so on.
    Raises FilmError, in one line, for what cannot be written.
    """
    try:
        if path.suffix.lower() in FILM_SUFFIXES:
            path.parent.mkdir(parents=True, exist_ok=True)
            with _encoder(path, fps, size) as film:
                yield film
        else:
            path.mkdir(parents=True, exist_ok=True)
            yield _Folder(path, size)
    except OSError as error:
        raise FilmError(f"{path} cannot be written: {error.strerror or error}") from None


class _Sized:
    def __init__(self, size: tuple[int, int]) -> None:
        self._shape = (size[1], size[0], 3)

    def _checked(self, frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
        if frame.shape != self._shape or frame.dtype != np.uint8:
            raise FilmError(
                f"a frame of this film is {self._shape[1]} x {self._shape[0]} pixels of 3 bytes, "
                f"got {frame.dtype} of shape {frame.shape}"
            )
        return np.ascontiguousarray(frame)


class _Folder(_Sized):
    def __init__(self, path: Path, size: tuple[int, int]) -> None:
        super().__init__(size)
        self._path = path
        self._count = 0

    def add(self, frame: NDArray[np.uint8]) -> None:
        image = Image.fromarray(self._checked(frame))
        image.save(self._path / f"frame_{self._count:04d}.png", compress_level=_PNG_LEVEL)
        self._count += 1


class _Encoded(_Sized):
    def __init__(self, writer: object, size: tuple[int, int]) -> None:
        super().__init__(size)
        self._writer = writer

    def add(self, frame: NDArray[np.uint8]) -> None:
        checked = self._checked(frame)
        # yuv420p halves the colour's resolution, so both sides are even: a last odd row or column is doubled.
        height, width = checked.shape[:2]
        even = np.pad(checked, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
        self._writer.send(even.tobytes())  # type: ignore[attr-defined]


@contextmanager
def _encoder(path: Path, fps: float, size: tuple[int, int]) -> Iterator[Film]:
    even = (size[0] + size[0] % 2, size[1] + size[1] % 2)
    writer = imageio_ffmpeg.write_frames(
        str(path), even, fps=fps, codec="libx264", quality=8, macro_block_size=2, ffmpeg_log_level="error"
    )
    writer.send(None)
    try:
        yield _Encoded(writer, size)
    finally:
        writer.close()
