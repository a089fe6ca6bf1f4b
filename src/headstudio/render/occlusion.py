"""What is hidden by the body that is drawn already, found out before it is drawn.

Pieces of hair behind a head cost as much as those before it, up to where every pixel of them is thrown away. So the
depth of the body is looked at from afar, in tiles: what lies behind the farthest place of all tiles it may touch is in
no pixel.
"""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter

from ..head.mesh import Floats
from ..wisp.strands import Singles
from .view import View

_TILE = 16  # [pixels]
# Ribbons are so much wider than strands [pixels], and depths so much less exact than places [m].
_RIBBON, _SLACK = 2.0, 2e-4


class Occluder:
    """The farthest distance from the eye [m] in every tile of a picture, along the direction of looking."""

    def __init__(self, depth: moderngl.Texture, view: View) -> None:
        """depth: of the body, as it is seen in ``view``, with one sample a pixel."""
        self._view = view
        self._width, self._height = depth.size
        seen = np.frombuffer(depth.read(), np.float32).reshape(self._height, self._width)
        # Tiles at the far borders are filled up with what hides nothing.
        rows, columns = (-(-side // _TILE) for side in seen.shape)
        padded = np.ones((rows * _TILE, columns * _TILE), np.float32)
        padded[: self._height, : self._width] = seen
        farthest = padded.reshape(rows, _TILE, columns, _TILE).max(axis=(1, 3))
        near, far = view.near, view.far
        self._farthest: Singles = 2.0 * near * far / (near + far - (2.0 * farthest - 1.0) * (far - near))
        self._farthest[farthest >= 1.0] = np.inf

    def hides(self, places: Singles, world_from_places: Floats, reach: float) -> NDArray[np.bool_]:
        """Whether all that is within ``reach`` [m] of ``places``, (n, 3), is hidden, (n,); world_from_places: 4 x 4."""
        matrix = (self._view.clip_from_world @ world_from_places).astype(np.float32)
        # The last row of a perspective view is the distance along the direction of looking.
        x, y, distance = (places @ matrix[row, :3] + matrix[row, 3] for row in (0, 1, 3))
        nearest = distance - np.float32(reach)
        ahead = nearest > self._view.near
        divisor = np.where(ahead, distance, np.float32(1.0))
        column = _tile(x / divisor, self._width)
        row = _tile(y / divisor, self._height)
        closest = float(nearest.min(initial=np.inf, where=ahead))
        if not np.isfinite(closest):
            return ahead
        pixels = reach * 0.5 * self._height * self._view.focal / closest + _RIBBON
        around = maximum_filter(self._farthest, 2 * int(np.ceil(pixels / _TILE)) + 1, mode="nearest")
        hidden: NDArray[np.bool_] = ahead & (nearest > around[row, column] + np.float32(_SLACK))
        return hidden


def _tile(clip: Singles, side: int) -> NDArray[np.int32]:
    """The tile of places that are -1 to 1 across a picture of ``side`` pixels; of those beside it, the nearest."""
    pixel = (0.5 * side) * (clip + np.float32(1.0))
    return (np.clip(pixel, 0, side - 1) / _TILE).astype(np.int32)
