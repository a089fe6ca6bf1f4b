"""What lies behind the tools in texture space: the face as a relief with its fine wrinkles, triangles, painted maps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...head.length_maps import sample
from ...head.mesh import Floats
from ...head.scalp_settings import GrayImage
from ...wrinkle.fine_wrinkles import FineWrinkles
from ...wrinkle.height_field import normal_map
from ...wrinkle.texels import TexelMap, texel_map
from .. import theme
from ..map_colours import map_colours
from .face_places import FacePlaces

SIZE = 1024
_LIGHT = np.array([0.3, 0.45, 0.84])
_SKIN = np.array([0.86, 0.78, 0.70])
_MAP_OPACITY = 0.55
_EXAGGERATED = 3.0  # fine wrinkles are seen from far away here


class TexturePicture:
    """Pictures of one head's texture space, sRGB, (SIZE, SIZE, 3), first row at v = 1."""

    def __init__(self, faces: FacePlaces) -> None:
        self._texels: TexelMap = texel_map(faces.layout.texture_map, SIZE)
        normals = faces.layout.texture_map.mesh.vertex_normals
        self._normals = np.stack([self._texels.spread(normals[:, k]) for k in range(3)], axis=2)
        triangle = self._texels.triangle
        edge = np.zeros(triangle.shape, dtype=bool)
        edge[:, 1:] |= triangle[:, 1:] != triangle[:, :-1]
        edge[1:] |= triangle[1:] != triangle[:-1]
        self._edges = edge & self._texels.mapped

    def draw(self, fine: FineWrinkles | None, painted: GrayImage | None, *, triangles: bool) -> NDArray[np.uint8]:
        """The relief, with ``painted`` in colours over it, and with the outlines of ``triangles``."""
        # Light from all around, more of it from above: no part of the face lies in the dark.
        lit = (0.5 + 0.5 * self._normals @ (_LIGHT / np.linalg.norm(_LIGHT))) ** 1.5
        if fine is not None:
            lit = lit + self._fine(fine)
        picture = (0.1 + 0.75 * np.clip(lit, 0.0, 1.1))[..., None] * _SKIN
        if painted is not None:
            centre = (np.arange(SIZE) + 0.5) / SIZE
            values = sample(painted, np.stack(np.meshgrid(centre, centre), axis=-1).reshape(-1, 2))
            colours = map_colours(values).reshape(SIZE, SIZE, 3) ** (1 / 2.2)
            picture = (1 - _MAP_OPACITY) * picture + _MAP_OPACITY * colours
        if triangles:
            picture[self._edges] = 0.6 * picture[self._edges]
        picture[~self._texels.mapped] = theme.GROUND
        return (255 * np.clip(picture[::-1], 0.0, 1.0)).astype(np.uint8)

    def _fine(self, fine: FineWrinkles) -> Floats:
        """How much lighter or darker fine wrinkles at rest make every texel, (SIZE, SIZE)."""
        texels = fine.texels
        height = (fine.initial_amplitude * fine.heights.sum(axis=0) + fine.pores).astype(np.float32)
        slope = normal_map(height, texels.metres, texels.map.wrapped)[..., :2] @ _LIGHT[:2]
        at = ((np.arange(SIZE) + 0.5) / SIZE * texels.size).astype(np.int64)
        return _EXAGGERATED * slope[np.ix_(at, at)].astype(np.float64)
