"""The wrinkles of a skin as images over its texture space: height, normals, occlusion, and how expressions deepen them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, TriangleMesh
from .height_field import normal_map
from .living_skin import LivingSkin, SkinSurface
from .texels import TexelMap, texel_map
from .texture_map import TextureMap

Image = NDArray[np.float32]

# Occlusion looks around in so many directions, at steps of these distances [m].
_DIRECTIONS = 16
_STEPS = np.geomspace(0.0004, 0.008, 8)


@dataclass(frozen=True, eq=False)
class BakedSkin:
    """Images of one instant, row 0 at v = 0. height: over the smooth skin [m]. normals: in tangent space (along u, along v,
    outward), (size, size, 3). occlusion: 1 open, 0 closed. mapped: where the skin is. texel: edge of a texel [m]."""

    height: Image
    normals: Image
    occlusion: Image
    mapped: NDArray[np.bool_]
    texel: float


class Bake:
    """Bakes any instant of one skin; where texels lie on it is found once. A skin's fine wrinkles are used if they have
    this ``size``. Raises ValueError otherwise."""

    def __init__(self, surface: SkinSurface, size: int) -> None:
        if surface.fine is not None and surface.fine.texels.size != size:
            raise ValueError(f"fine wrinkles of {surface.fine.texels.size} texels cannot be baked into {size}")
        self._surface = surface
        self._texels, self._vertices = _refined_texels(surface, size)

    def at(self, living: LivingSkin) -> BakedSkin:
        """The skin as it is in ``living``."""
        height = self._spread(living.skin.height)
        fine = self._surface.fine
        if fine is not None:
            for k in range(2):
                height += self._spread(living.amplitudes[:, k]) * fine.heights[k]
            height += fine.pores
        texel, wrapped = self._texels.metres, self._texels.map.wrapped
        image = height.astype(np.float32)
        return BakedSkin(
            image, normal_map(image, texel, wrapped), occlusion(image, texel, wrapped), self._texels.mapped, texel
        )

    def weight(self, living: LivingSkin) -> Image:
        """How far large wrinkles are out, M of eq. 2.4 from 0 to 1, (size, size); where two meet, the larger."""
        bed = self._surface.bed
        out = np.zeros(len(bed.refined.home))
        np.maximum.at(out, bed.vertex, np.clip(living.skin.amplitude, 0.0, 1.0) * bed.beside.fade)
        return self._spread(out).astype(np.float32)

    def _spread(self, values: Floats) -> Floats:
        return self._texels.spread(values[self._vertices])


def occlusion(height: Image, texel: float, wrapped: bool) -> Image:
    """How open each texel is to a hemisphere of even light, 0 to 1: by the horizon in every direction around it.

    height: [m], (rows, columns). texel: edge of a texel [m]. An even slope is as open as a plane: only what stands
    higher than the slope of the place itself hides light.
    """
    reach = [max(round(step / texel), 1) for step in _STEPS]
    margin = max(reach)
    padded = np.pad(height, ((0, 0), (margin, margin)), mode="wrap" if wrapped else "edge")
    padded = np.pad(padded, ((margin, margin), (0, 0)), mode="edge")
    rows, columns = height.shape
    hidden = np.zeros_like(height)
    for angle in np.arange(_DIRECTIONS) * (2 * np.pi / _DIRECTIONS):
        horizon = np.zeros_like(height)
        for step in dict.fromkeys(reach):
            across, down = round(step * np.cos(angle)), round(step * np.sin(angle))
            there = padded[margin + down : margin + down + rows, margin + across : margin + across + columns]
            back = padded[margin - down : margin - down + rows, margin - across : margin - across + columns]
            rise = 0.5 * (there + back) - height
            distance = texel * float(np.hypot(across, down))
            np.maximum(horizon, rise / distance, out=horizon)
        # Of the light that a hemisphere sends to a level place, a horizon at the angle a hides sin^2 a.
        hidden += horizon * horizon / (1.0 + horizon * horizon)
    return (1.0 - hidden / _DIRECTIONS).astype(np.float32)


def _refined_texels(surface: SkinSurface, size: int) -> tuple[TexelMap, NDArray[np.int64]]:
    """Where texels lie on the mapped triangles of the refined skin, and which of its vertices these have."""
    bed = surface.bed
    layout, refined = bed.layout, bed.refined
    coarse = layout.texture_map
    faces = np.flatnonzero(layout.mapped[refined.parent])
    vertices, local = np.unique(refined.faces[faces], return_inverse=True)
    local = local.reshape(-1, 3)
    uv = layout.uv(refined, vertices)
    # On the border of the map a vertex may be at home in a triangle beyond it.
    uv = np.where(np.isnan(uv), surface.uv[vertices], uv)
    corner_uv = uv[local]
    if coarse.wrapped:
        # Triangles across the seam stay whole: their corners are brought to the side of the rightmost.
        corner_uv[..., 0] -= np.rint(corner_uv[..., 0] - corner_uv[..., 0].max(axis=1, keepdims=True))
    mesh = TriangleMesh(refined.vertices[vertices], local)
    return texel_map(TextureMap(mesh, uv, corner_uv, coarse.metres, coarse.wrapped), size), vertices
