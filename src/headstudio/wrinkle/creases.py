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
from .at_once import at_once
from .balance import balance
from .blending import Blending
from .cross_profile import section_height, section_slope
from .furrow import Furrow
from .furrow_bed import FurrowBed
from .metric import perpendicular, vertex_metrics
from .self_contact import Folds
from .shape import amplitude
from .shrinkage import Measure, ShrinkageGauge, shrinkage_gauge
from .smooth_surface import SmoothSurface
from .vectors import scaled, unit


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


@dataclass(frozen=True, eq=False)
class _Grown:
    """Furrows in one pose. shrinkage, amplitude: of every entry of the bed, (i,). height: of the fine vertices [m], and its
    derivatives by_u and by_v, (k,) each."""

    shrinkage: Floats
    amplitude: Floats
    height: Floats
    by_u: Floats
    by_v: Floats


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
        self.faces: Ints = bed.refined.faces
        self._count = len(bed.refined.home)
        self._initial = np.array([furrow.initial for furrow in furrows])[bed.furrow]
        self._surface = SmoothSurface(bed.refined, bed.layout, bed.vertex)
        self._row = self._surface.row_of[bed.vertex]

        beside = bed.beside
        profile, slope = _sections(bed, strength * np.array([furrow.depth for furrow in furrows]))
        height = beside.fade * profile
        gradient = (beside.fade * slope)[:, None] * beside.toward + profile[:, None] * beside.along
        raised, raised_more = balance(bed, self._surface, height)
        height = (1.0 + raised) * height
        # From amplitudes of the entries to heights of the vertices and their derivatives by u and v; and from squared
        # amplitudes to what the bulges rise besides.
        summed = (height, *((1.0 + raised) * gradient[:, k] for k in (0, 1)))
        self._sums = sparse.csr_array(sparse.vstack([self._summing(values) for values in summed]))
        self._sums_of_squares = self._summing(raised_more * height)
        adds = np.array([furrow.adds for furrow in furrows], dtype=bool)[bed.furrow]
        self._blending = Blending(self._row, height, adds)
        self._folds = Folds(bed, self._surface, height) if self_contact else None
        self._gauge, self._spread = _gauge_beside(bed, measure)

    def displaced(self, posed: Floats) -> WrinkledSkin:
        """The wrinkled skin for posed positions of the whole skin [m], (n, 3).

        Shrinkage across each furrow (2.3), between vertices interpolated, gives the amplitude M(s) (2.4); M times S(l)
        (2.1) displaces along the normals.
        """
        surface, grown = at_once(lambda: self._surface.at(posed), lambda: self._grown(posed))
        height, by_u, by_v = grown.height, grown.by_u, grown.by_v
        if self._folds is not None:
            height = self._folds.clamped(height, posed, surface)
        positions = surface.positions + scaled(surface.normals, height)
        normals = unit(surface.normals - scaled(surface.by_u, by_u) - scaled(surface.by_v, by_v))
        return WrinkledSkin(
            self._whole(posed, positions),
            self._whole(surface.coarse_normals, normals),
            self._whole(np.zeros(len(posed)), height),
            grown.shrinkage,
            grown.amplitude,
        )

    def _grown(self, posed: Floats) -> _Grown:
        """What furrows do to the skin for its posed positions [m], (n, 3)."""
        shrinkage = self._spread @ self._gauge.shrinkage(posed)
        grown = amplitude(shrinkage, self._initial)
        share = self._blending.applied(grown)
        height, *slopes = (self._sums @ share).reshape(3, -1)
        height += self._sums_of_squares @ (share * grown)
        # Like other directions, slopes need no more than single precision.
        by_u, by_v = (slope.astype(np.float32) for slope in slopes)
        return _Grown(shrinkage, grown, height, by_u, by_v)

    def mesh(self, skin: WrinkledSkin) -> TriangleMesh:
        """The wrinkled skin as a mesh that is shaded with its own normals."""
        # Computed anew from the triangles, normals would show the border of the refinement.
        return TriangleMesh(skin.positions, self.faces).shaded(skin.normals)

    def _summing(self, values: Floats) -> sparse.csr_array:
        """The matrix, (k, i), that adds up entries times ``values``, (i,), at the vertices of the fine surface."""
        used = np.flatnonzero(values)
        shape = len(self._surface.vertices), len(values)
        return sparse.csr_array(sparse.coo_array((values[used], (self._row[used], used)), shape=shape))

    def _whole(self, coarse: Floats, fine: Floats) -> Floats:
        """Values of the whole refined skin, (N, ...): of the coarse vertices, (n, ...), where not of the fine, (k, ...)."""
        vertices, count = self._surface.vertices, len(coarse)
        # All vertices that the coarse skin does not have are fine ones, and the last of them.
        replaced = len(vertices) - (self._count - count)
        whole = np.concatenate([coarse, fine[replaced:]])
        whole[vertices[:replaced]] = fine[:replaced]
        return whole


def _sections(bed: FurrowBed, depths: Floats) -> tuple[Floats, Floats]:
    """Height of every entry where its furrow is whole [m], and the derivative by distance from it, (i,) each."""
    beside = bed.beside
    profile, slope = np.zeros((2, len(bed.furrow)))
    for k, laid in enumerate(bed.furrows):
        own = np.flatnonzero(bed.furrow == k)
        side = beside.side[own]
        across = side * beside.distance[own]
        shape = depths[k], laid.furrow.width, laid.furrow.section
        profile[own], slope[own] = section_height(across, *shape), side * section_slope(across, *shape)
    return profile, slope


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
