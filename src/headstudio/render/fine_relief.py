"""The height fields of fine wrinkles as textures for bump mapping (Bando's thesis, section 2.6.4).

Shaders need slopes, not heights, and slopes shrink with distance as they should: the mean of slopes is the slope of the
mean. What is lost of them is kept as the mean of their squares: a bump that is too small to be seen makes skin rougher.
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from ..wrinkle.fine_wrinkles import FineWrinkles


class FineRelief:
    """Textures over the map of a skin: slopes of both fields, of the pores, and heights.

    Slopes are in metres for the whole width of the map. Without fine wrinkles they are flat.
    """

    def __init__(self, context: moderngl.Context, fine: FineWrinkles | None) -> None:
        if fine is None:
            heights, pores, wrapped, metres = np.zeros((2, 1, 1), np.float32), np.zeros((1, 1), np.float32), False, 1.0
        else:
            heights, pores = fine.heights, fine.pores
            wrapped, metres = fine.texels.map.wrapped, fine.texels.map.metres
        self.size = heights.shape[1]
        covered = fine.texels.mapped if fine is not None else np.ones((1, 1), bool)
        # What a furrow is deeper than is the skin around it, which is the mean where all is too small to be seen.
        self.mean_heights = tuple(float(1e3 * height[covered].mean()) for height in (*heights, pores))
        slopes = [_slopes(height, wrapped) for height in (*heights, pores)]
        steepness = [((slope / metres) ** 2).sum(axis=-1) for slope in slopes]
        self.metres = metres
        self.slopes = _texture(context, np.concatenate(slopes[:2], axis=-1), wrapped)
        self.pores = _texture(context, np.concatenate([slopes[2], np.stack(steepness[:2], axis=-1)], axis=-1), wrapped)
        # Millimetres, since half floats lose digits below a tenth of a thousandth.
        layers = [1e3 * heights[0], 1e3 * heights[1], 1e3 * pores, steepness[2]]
        self.heights = _texture(context, np.stack(layers, axis=-1), wrapped)


def _slopes(height: Floats, wrapped: bool) -> Floats:
    """Slopes along u and v of a height field, (size, size) [m], for the whole width of the map: (size, size, 2) [m]."""
    size = len(height)
    across = np.pad(height, ((0, 0), (1, 1)), mode="wrap" if wrapped else "edge")
    along = np.pad(height, ((1, 1), (0, 0)), mode="edge")
    by_u = 0.5 * size * (across[:, 2:] - across[:, :-2])
    by_v = 0.5 * size * (along[2:] - along[:-2])
    return np.stack([by_u, by_v], axis=-1)


def _texture(context: moderngl.Context, layers: Floats, wrapped: bool) -> moderngl.Texture:
    size = layers.shape[0]
    texture = context.texture((size, size), 4, np.ascontiguousarray(layers, np.float16), dtype="f2")
    texture.repeat_x, texture.repeat_y = wrapped, False
    texture.build_mipmaps()
    texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
    return texture
