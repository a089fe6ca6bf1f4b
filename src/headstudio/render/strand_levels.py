"""The strand texture as shaders read it: one level of fineness for a whole picture."""

from __future__ import annotations

import moderngl
import numpy as np
from PIL import Image

from ..head.mesh import Floats
from ..resources import asset
from .strand_texture import STRIP_WIDTH
from .view import View

LIGHT_LEVEL = 3
"""The light wants no single strands, and every reader must see the same billboard."""

# Levels finer than one texel a pixel: the strands of neighbouring ribbons smooth each other.
_CRISPNESS = 0.8
_LEAST_HEIGHT = 8


class StrandLevels:
    """Opacity and tone of the strip of strands, each level half as fine as the one before, as textures of their own.

    All strands are equally thick and about equally far away. To choose between mip levels at every pixel would cost a
    processor more than it takes to read them.
    """

    def __init__(self, context: moderngl.Context) -> None:
        with Image.open(asset("textures/strands.png")) as image:
            pixels = np.asarray(image.convert("RGB"), np.float64)[..., :2]
        self._width = pixels.shape[1]
        levels = [pixels]
        while len(levels[-1]) > _LEAST_HEIGHT:
            levels.append(_halved(levels[-1]))
        self._levels = [_texture(context, level, moderngl.LINEAR) for level in levels]
        self.light = _texture(context, levels[LIGHT_LEVEL][..., :1], moderngl.NEAREST)
        """The opacity alone, at LIGHT_LEVEL, read at the nearest texel: texels of the light map are larger."""

    def seen(self, view: View, distance: float, picture_height: int) -> moderngl.Texture:
        """The level at which a texel is about as wide as a pixel at this distance [m] from the eye."""
        pixels_per_metre = 0.5 * picture_height * view.focal / max(distance, view.near)
        level = np.log2(self._width / STRIP_WIDTH / pixels_per_metre) - _CRISPNESS
        return self._levels[int(np.clip(np.rint(level), 0, len(self._levels) - 1))]


def _halved(image: Floats) -> Floats:
    """The mean of every 2 x 2 texels, (height / 2, width / 2, parts)."""
    return (image[::2, ::2] + image[1::2, ::2] + image[::2, 1::2] + image[1::2, 1::2]) / 4


def _texture(context: moderngl.Context, image: Floats, smooth: int) -> moderngl.Texture:
    height, width, parts = image.shape
    texture = context.texture((width, height), parts, np.rint(image).astype(np.uint8).tobytes(), alignment=1)
    texture.filter = (smooth, smooth)
    texture.repeat_y = False
    return texture
