"""Skin with large wrinkles, pose after pose: Bando's thesis, sections 2.5.1 and 2.5.3.

Everything that stays the same while the face moves is made once. A pose then costs some sparse products and arithmetic
on the vertices near furrows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..head.mesh import Floats, Ints, TriangleMesh
from .balance import balance
from .blending import Blending
from .furrow import Furrow
from .furrow_bed import FurrowBed
from .metric import perpendicular, vertex_metrics
from .self_contact import Folds
from .shape import amplitude, bounded_shape, bounded_slope
from .shrinkage import Measure, ShrinkageGauge, shrinkage_gauge
from .smooth_surface import SmoothSurface, unit


@dataclass(frozen=True, eq=False)
class WrinkledSkin:
    """A posed, wrinkled skin.

    positions: [m], (N, 3); the coarse skin's vertices come first and in order. normals: unit, (N, 3). height: displacement
    along the normal [m], (N,). shrinkage, amplitude: s and M(s) of every entry of the bed, (i,).
    """

    positions: Floats
    normals: Floats
    height: Floats
    shrinkage: Floats
    amplitude: Floats


class Creases:
    """Furrows on a skin, ready for any pose of it.

    faces: triangles of the wrinkled skin, (M, 3), the same for every pose.
    """

    def __init__(
        self,
        bed: FurrowBed,
        furrows: Sequence[Furrow] | None = None,
        *,
        strength: float = 1.0,
        measure: Measure = "three edges",
        self_contact: bool = True,
    ) -> None:
        """furrows: depth and r of those of the bed, in its order; without it the bed's own. strength: multiplies every
        depth. measure: how shrinkage is measured, see shrinkage.py. self_contact: keep both sides of a fold apart.

        Raises ValueError for another number of furrows than the bed has.
        """
        if furrows is None:
            furrows = [laid.furrow for laid in bed.furrows]
        if len(furrows) != len(bed.furrows):
            raise ValueError(f"the skin is prepared for {len(bed.furrows)} furrows, not {len(furrows)}")
        self.bed = bed
        self.faces: Ints = bed.refined.faces
        depth = strength * np.array([furrow.depth for furrow in furrows])[bed.furrow]
        width = np.array([laid.furrow.width for laid in bed.furrows])[bed.furrow]
        self._initial = np.array([furrow.initial for furrow in furrows])[bed.furrow]
        self._surface = SmoothSurface(bed.refined, bed.layout, bed.vertex)
        self._row = self._surface.row_of[bed.vertex]

        beside = bed.beside
        profile = bounded_shape(beside.distance, depth, width)
        height = beside.fade * profile
        slope = beside.fade * bounded_slope(beside.distance, depth, width)
        gradient = slope[:, None] * beside.toward + profile[:, None] * beside.along
        raised, self._raised_more = balance(bed, self._surface, height)
        self._height = (1.0 + raised) * height
        self._by_u, self._by_v = ((1.0 + raised) * gradient[:, k] for k in (0, 1))
        self._blending = Blending(self._row, self._height)
        self._folds = Folds(bed, self._surface, self._height) if self_contact else None
        self._gauge, self._spread = _gauge_beside(bed, measure)

    def displaced(self, posed: Floats) -> WrinkledSkin:
        """The wrinkled skin for posed positions of the whole skin [m], (n, 3).

        Shrinkage across each furrow (2.3), between vertices interpolated, gives the amplitude M(s) (2.4); M times S(l)
        (2.1) displaces along the normals.
        """
        shrinkage = self._spread @ self._gauge.shrinkage(posed)
        grown = amplitude(shrinkage, self._initial)
        share = self._blending.applied(grown)
        surface = self._surface.at(posed)

        height = self._at_vertices(share * (1.0 + grown * self._raised_more) * self._height)
        # Like other directions, slopes need no more than single precision.
        by_u, by_v = (
            self._at_vertices(share * slope).astype(np.float32)[:, None] for slope in (self._by_u, self._by_v)
        )
        if self._folds is not None:
            height = self._folds.clamped(height, posed, surface)
        positions, normals, heights = self._whole(posed, surface.coarse_normals)
        fine = self._surface.vertices
        positions[fine] = surface.positions + height[:, None] * surface.normals
        normals[fine] = unit(surface.normals - by_u * surface.by_u - by_v * surface.by_v)
        heights[fine] = height
        return WrinkledSkin(positions, normals, heights, shrinkage, grown)

    def mesh(self, skin: WrinkledSkin) -> TriangleMesh:
        """The wrinkled skin as a mesh that is shaded with its own normals."""
        mesh = TriangleMesh(skin.positions, self.faces)
        # Computed anew from the triangles they would show the border of the refinement.
        mesh.__dict__["vertex_normals"] = skin.normals
        return mesh

    def _at_vertices(self, values: Floats) -> Floats:
        """Values of the entries, (i,), added up at the vertices of the fine surface, (k,)."""
        return np.bincount(self._row, values, minlength=len(self._surface.vertices)).astype(np.float64)

    def _whole(self, posed: Floats, normals: Floats) -> tuple[Floats, Floats, Floats]:
        """Positions, normals and heights of the whole refined skin, those of the coarse vertices filled in."""
        count = len(self.bed.refined.home)
        places, directions = np.empty((count, 3)), np.empty((count, 3))
        places[: len(posed)], directions[: len(posed)] = posed, normals
        return places, directions, np.zeros(count)


def _gauge_beside(bed: FurrowBed, measure: Measure) -> tuple[ShrinkageGauge, sparse.csr_array]:
    """A gauge at every coarse vertex across every furrow near it, and the matrix that spreads s to the bed's entries."""
    layout, refined = bed.layout, bed.refined
    corners = layout.skin.faces[refined.home[bed.vertex]]
    weights = refined.weights[bed.vertex]
    count = len(layout.skin.vertices)
    keys, column = np.unique(corners + count * bed.furrow[:, None], return_inverse=True)
    furrow, vertex = np.divmod(keys, count)
    spread = sparse.csr_array(
        (weights.ravel(), column.ravel(), 3 * np.arange(len(weights) + 1)), shape=(len(weights), len(keys))
    )
    in_part = np.full(count, -1)
    in_part[layout.part.vertices] = np.arange(len(layout.part.vertices))
    own = in_part[vertex]
    metrics = vertex_metrics(layout.texture_map)[own]
    across = np.empty((len(keys), 2))
    for k, laid in enumerate(bed.furrows):
        mine = furrow == k
        beside = laid.beside(layout.texture_map.uv[own[mine]], metrics[mine])
        across[mine] = perpendicular(laid.chain.tangents(beside.t), metrics[mine])
    gauge = shrinkage_gauge(
        layout.texture_map, own, across, measure, skin_vertices=layout.part.vertices, skin_count=count
    )
    return gauge, spread
