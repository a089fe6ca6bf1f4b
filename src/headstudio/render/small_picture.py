"""Small pictures for panels."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray


class SmallPicture:
    """A texture that is filled again when what it shows has changed."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._texture: moderngl.Texture | None = None

    def show(self, pixels: NDArray[np.uint8]) -> int:
        """Take over ``pixels``, sRGB, (rows, columns, 3), first row on top; returns OpenGL's number of the texture."""
        size = pixels.shape[1], pixels.shape[0]
        if self._texture is None or self._texture.size != size:
            self._texture = self._context.texture(size, 3, alignment=1)
        self._texture.write(np.ascontiguousarray(pixels).tobytes(), alignment=1)
        return self._texture.glo
