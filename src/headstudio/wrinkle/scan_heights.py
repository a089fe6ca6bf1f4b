"""A scan as heights over the skin it was taken of, texel by texel in texture space."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy import ndimage

from ..head.locate import Locator
from ..head.mesh import Floats, Ints, TriangleMesh
from .metric import vertex_metrics
from .refined_mesh import RefinedMesh
from .skin_layout import SkinLayout
from .smooth_surface import SmoothSurface
from .texels import Flags, texel_map

# Edge of a texel on the skin [m], which this part of the skin keeps to, and the most of them along an edge of the map.
TEXEL, _KEEPING = 8e-4, 0.75
_MOST_TEXELS = 1600
# A scan is looked for this far above and below the skin [m]; it must face as the skin does.
_REACH = 0.015
_FACING = 0.3
# What is covered is not in pieces smaller than this [m^2].
_ISLAND = 2e-5
# Rays start this far on the other side of the skin [m], so that a scan that touches it is met.
_RAY_START = 1e-4


@dataclass(frozen=True, eq=False)
class SkinTexels:
    """The texels of a mapped skin.

    size: texels along an edge of the unit square. texels: number of each, row after row, (k,). uv: their centres, (k, 2).
    metrics: G there [m^2], (k, 2, 2). positions: on the smooth skin [m], (k, 3). normals: unit, (k, 3). area: of skin
    that each stands for [m^2], (k,).
    """

    layout: SkinLayout
    size: int
    texels: Ints
    uv: Floats
    metrics: Floats
    positions: Floats
    normals: Floats
    area: Floats

    @classmethod
    def under(cls, scan: Locator, layout: SkinLayout) -> SkinTexels:
        """The texels that a scan may cover. A map is drawn out on a chin or a cheek: they are so small that the skin
        there is seen as closely as a forehead."""
        whole = cls.of(layout)
        near = scan.nearest(whole.positions)[1] < _REACH
        if not near.any():
            return whole._chosen(near)
        fine = cls.of(layout, float(np.quantile(np.sqrt(whole.area[near]), _KEEPING) / TEXEL))
        # The fine texels in a coarse one that is near, or beside such.
        image = ndimage.binary_dilation(np.nan_to_num(whole.image(np.where(near, 1.0, 0.0))) > 0)
        cells = (fine.uv * whole.size).astype(np.int64)
        return fine._chosen(image[cells[:, 1], cells[:, 0]])

    @classmethod
    def of(cls, layout: SkinLayout, finer: float = 1.0) -> SkinTexels:
        """All texels of a layout, so many times as fine as its map asks for on the whole."""
        texture_map = layout.texture_map
        size = int(min(np.ceil(finer * texture_map.metres / TEXEL), _MOST_TEXELS))
        drawn = texel_map(texture_map, size)
        texels = np.flatnonzero(drawn.mapped)
        triangle = drawn.triangle.ravel()[texels]
        centres = drawn.centres(texels)
        weights = drawn.weights(triangle, centres)
        metrics = np.einsum("ki,kiab->kab", weights, vertex_metrics(texture_map)[texture_map.mesh.faces[triangle]])
        positions, normals = _smooth_places(layout, layout.part.faces[triangle], weights)
        area = np.sqrt(np.linalg.det(metrics)) / size**2
        return cls(layout, size, texels, centres / size, metrics, positions, normals, area)

    def _chosen(self, chosen: Flags) -> SkinTexels:
        """Those that are ``chosen``, (k,)."""
        values = (self.uv, self.metrics, self.positions, self.normals, self.area)
        return SkinTexels(self.layout, self.size, self.texels[chosen], *(value[chosen] for value in values))

    @cached_property
    def metres(self) -> float:
        """Edge of a texel on the skin [m]: half of them are larger."""
        return float(np.sqrt(np.median(self.area)))

    def image(self, values: Floats) -> Floats:
        """Values of the texels, (k,), as an image, (size, size); nan off the skin."""
        image = np.full(self.size * self.size, np.nan)
        image[self.texels] = values
        return image.reshape(self.size, self.size)

    def of_image(self, image: Floats) -> Floats:
        """The values of an image, (size, size), at the texels, (k,)."""
        values: Floats = image.ravel()[self.texels]
        return values

    def heights(self, scan: Locator, normals: Floats) -> Floats:
        """Heights of a scan over the skin along its normals [m], (k,); nan where the scan does not cover it.

        normals: of the scan's triangles, unit, (m, 3).
        """
        above, below = (
            scan.first_hit(self.positions - side * _RAY_START * self.normals, side * self.normals) - _RAY_START
            for side in (1.0, -1.0)
        )
        height = np.where(above <= below, above, -below)
        covered = np.flatnonzero(np.abs(height) < _REACH)
        found, _ = scan.nearest(self.positions[covered] + height[covered, None] * self.normals[covered])
        facing = np.einsum("kd,kd->k", normals[found.faces], self.normals[covered]) > _FACING
        kept = covered[facing]
        heights = np.full(len(height), np.nan)
        heights[kept] = height[kept]
        # Through a nostril or between lips a ray may meet the far side of something else.
        islands, count = ndimage.label(np.isfinite(self.image(heights)))
        island = islands.ravel()[self.texels]
        small = np.bincount(island, self.area, count + 1) < _ISLAND
        heights[small[island]] = np.nan
        return heights


@dataclass(frozen=True, eq=False)
class ScanHeights:
    """A scan over a skin. texels: of the skin, k of them. height: of the scan above it [m], (k,); nan where it is not."""

    texels: SkinTexels
    height: Floats

    @classmethod
    def measured(cls, layout: SkinLayout, scan: TriangleMesh) -> ScanHeights:
        """The heights of ``scan``, given in the skin's frame [m], over the skin of ``layout``."""
        locator = Locator(scan.vertices, scan.faces)
        texels = SkinTexels.under(locator, layout)
        return cls(texels, texels.heights(locator, scan.face_normals))

    @cached_property
    def covered(self) -> Flags:
        """Which texels the scan covers, (k,)."""
        return np.isfinite(self.height)

    def without(self, height: Floats) -> ScanHeights:
        """The same with ``height`` [m], (k,), taken off."""
        return replace(self, height=self.height - height)

    @cached_property
    def filled(self) -> Floats:
        """Heights [m], (size, size), continued beyond what is covered by the nearest that is."""
        image = self.texels.image(self.height)
        nearest = ndimage.distance_transform_edt(np.isnan(image), return_distances=False, return_indices=True)
        filled: Floats = image[tuple(nearest)]
        return filled

    @cached_property
    def noise(self) -> float:
        """Standard deviation of what changes from texel to texel [m], robustly."""
        image = self.texels.image(self.height)
        bend = image[1:-1, 1:-1] - 0.25 * (image[2:, 1:-1] + image[:-2, 1:-1] + image[1:-1, 2:] + image[1:-1, :-2])
        bend = np.abs(bend[np.isfinite(bend)])
        # The median of |x| is 0.6745 of the deviation; the five weights have a norm of sqrt(1.25).
        return float(np.median(bend) / 0.6745 / np.sqrt(1.25)) if len(bend) else 0.0

    def low_pass(self, sigma: float, weight: Floats) -> Floats:
        """Heights smoothed over the skin by a Gaussian of ``sigma`` [m], (k,).

        weight: how much each texel counts, (k,); those that the scan does not cover never do.
        """
        counts = self.texels.image(np.where(self.covered, weight, 0.0))
        values = self.texels.image(np.where(self.covered, self.height, 0.0))
        counts, values = np.nan_to_num(counts), np.nan_to_num(values)
        radius = sigma / self.texels.metres
        total = ndimage.gaussian_filter(counts * values, radius, mode="constant")
        share = ndimage.gaussian_filter(counts, radius, mode="constant")
        smooth = np.divide(total, share, out=np.zeros_like(total), where=share > 1e-9)
        return self.texels.of_image(smooth)


def _smooth_places(layout: SkinLayout, triangles: Ints, weights: Floats) -> tuple[Floats, Floats]:
    """Points of the smooth skin [m], (k, 3), in triangles of the skin, (k,), and unit normals, (k, 3)."""
    plain = RefinedMesh.unrefined(layout.skin)
    count = len(plain.home)
    corners = layout.skin.vertices[layout.skin.faces[triangles]]
    dotted = RefinedMesh(
        layout.skin,
        np.concatenate([plain.home, triangles]),
        np.concatenate([plain.weights, weights]),
        plain.faces,
        plain.parent,
        np.concatenate([plain.vertices, np.einsum("ki,kid->kd", weights, corners)]),
    )
    new = np.arange(count, count + len(triangles))
    surface = SmoothSurface(dotted, layout, new)
    rest, rows = surface.at(layout.skin.vertices), surface.row_of[new]
    return rest.positions[rows], rest.normals[rows]
