"""The strand texture as shaders read it: one level of fineness for a whole picture."""

from __future__ import annotations

import moderngl
import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter1d

from ..head.mesh import Floats
from ..resources import asset
from .strand_texture import STRIP_WIDTH
from .view import View

LIGHT_LEVEL = 3
"""The light wants no single strands, and every reader must see the same billboard."""

_BLUR = 0.4  # deviation of what a pixel of the picture takes in, in pixels
_PER_OCTAVE = 2
_LEAST_WIDTH = 64  # texels of the coarsest level


class StrandLevels:
    """Opacity and tone of the strip of strands, each level for pixels half an octave larger than the one before, as textures
    of their own.

    All strands are equally thick and about equally far away. To choose between mip levels at every pixel would cost a
    processor more than it takes to read them. Hair runs aslant through the picture, so that a level must not hold what is
    finer than its pixels: strands would be strings of beads. So it is smoothed with the width of a pixel, and has texels
    of less than half of that.
    """

    def __init__(self, context: moderngl.Context) -> None:
        with Image.open(asset("textures/strands.png")) as image:
            pixels = np.asarray(image.convert("RGB"), np.float64)[..., :2]
        self._width = pixels.shape[1]
        self._levels: list[moderngl.Texture] = []
        finer, step = pixels, 1  # whose texels are as wide as so many of the finest
        for k in range(_PER_OCTAVE * int(np.log2(self._width / _LEAST_WIDTH)) + 1):
            pixel = 2.0 ** (k / _PER_OCTAVE)
            self._levels.append(_texture(context, _smoothed(finer, _BLUR * pixel / step), moderngl.LINEAR))
            if pixel >= 4 * step:
                finer, step = halved(finer), 2 * step
        light = pixels
        for _ in range(LIGHT_LEVEL):
            light = halved(light)
        self.light = _texture(context, light[..., :1], moderngl.NEAREST)
        """The opacity alone, at LIGHT_LEVEL, read at the nearest texel: texels of the light map are larger."""

    def seen(self, view: View, distance: float, picture_height: int) -> moderngl.Texture:
        """The level for pixels as wide as those of a picture at this distance [m] from the eye."""
        pixels_per_metre = 0.5 * picture_height * view.focal / max(distance, view.near)
        level = _PER_OCTAVE * np.log2(self._width / STRIP_WIDTH / pixels_per_metre)
        return self._levels[int(np.clip(np.rint(level), 0, len(self._levels) - 1))]


def halved(image: Floats) -> Floats:
    """The mean of every 2 x 2 texels, (height / 2, width / 2, parts)."""
    return (image[::2, ::2] + image[1::2, ::2] + image[::2, 1::2] + image[1::2, 1::2]) / 4


def _smoothed(image: Floats, deviation: float) -> Floats:
    """Opacity and tone, (height, width, 2), smoothed across the strands, which repeat; tone as far as it is seen."""
    opacity, tone = np.moveaxis(image, -1, 0)
    weight = opacity + 1e-3
    smooth = gaussian_filter1d(np.stack([opacity, weight * tone, weight]), deviation, axis=2, mode="wrap")
    return np.stack([smooth[0], smooth[1] / smooth[2]], axis=-1)


def _texture(context: moderngl.Context, image: Floats, smooth: int) -> moderngl.Texture:
    height, width, parts = image.shape
    texture = context.texture((width, height), parts, np.rint(image).astype(np.uint8).tobytes(), alignment=1)
    texture.filter = (smooth, smooth)
    texture.repeat_y = False
    return texture
