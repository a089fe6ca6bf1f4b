"""Bulges on both sides of a fold stop where they meet.

Each point beside a furrow has a mate: the point on the other side, as far from the floor. When a joint bends, both come
near each other. The plane half way between them is the farther side's limit, too, so neither bulge crosses it.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ..head.mesh import Floats
from .furrow_bed import FurrowBed
from .smooth_surface import PosedSurface, SmoothSurface

# Bulges are kept apart up to this many widths from the floor.
_WIDTHS = 4.0
# A mate farther outside the map than this, in texture space, does not exist.
_OFF_MAP = 1e-3


class Folds:
    """Points on the bulges of furrows, and their mates on the other side."""

    def __init__(self, bed: FurrowBed, surface: SmoothSurface, unit_height: Floats) -> None:
        width = np.array([laid.furrow.width for laid in bed.furrows])[bed.furrow]
        wanted = np.flatnonzero((unit_height > 0) & (bed.beside.distance < _WIDTHS * width))
        # A vertex between several furrows folds at the nearest.
        order = wanted[np.lexsort((bed.beside.distance[wanted], bed.vertex[wanted]))]
        first = order[np.unique(bed.vertex[order], return_index=True)[1]]
        mirrored = np.zeros((len(first), 2))
        for k, laid in enumerate(bed.furrows):
            own = np.flatnonzero(bed.furrow[first] == k)
            entries = first[own]
            uv = bed.layout.uv(bed.refined, bed.vertex[entries])
            mirrored[own] = laid.mirrored(bed.beside.t[entries], uv)
        found, off = bed.layout.locate(mirrored)
        exists = off < _OFF_MAP
        part = bed.layout.part
        corners = part.vertices[part.mesh.faces[found.faces[exists]]]
        self.rows = surface.row_of[bed.vertex[first[exists]]]
        count = int(exists.sum())
        self._mates = sparse.csr_array(
            (found.weights[exists].ravel(), corners.ravel(), 3 * np.arange(count + 1)),
            shape=(count, len(bed.layout.skin.vertices)),
        )

    def clamped(self, height: Floats, posed: Floats, surface: PosedSurface) -> Floats:
        """Heights [m], (k,), of the surface's vertices, none beyond half way to its mate: h <= |e|^2 / (2 n . e)."""
        to_mate = self._mates @ posed - surface.positions[self.rows]
        facing = np.einsum("ij,ij->i", to_mate, surface.normals[self.rows])
        gap = 0.5 * np.einsum("ij,ij->i", to_mate, to_mate)
        hit = np.flatnonzero(height[self.rows] * facing > gap)
        if not len(hit):
            return height
        clamped = height.copy()
        clamped[self.rows[hit]] = gap[hit] / facing[hit]
        return clamped
