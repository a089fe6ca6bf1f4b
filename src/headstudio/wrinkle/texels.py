"""A texture map drawn into an image: which triangle each texel belongs to, and where in it the texel lies.

Image coordinates are (x, y) in texels, x along u and y along v; texel (row, column) has its centre at
(column + 0.5, row + 0.5). Row 0 is at v = 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints
from .plane import cross, shorter_way
from .texture_map import TextureMap

Flags = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class TexelMap:
    """Where the texels of a square image lie on a mapped mesh.

    map: the mesh in texture space. size: texels along an edge of the unit square. triangle: index of the triangle that
    holds the centre of each texel, -1 where the mesh is not, (size, size).
    """

    map: TextureMap
    size: int
    triangle: Ints

    @property
    def metres(self) -> float:
        """Edge of a texel on the skin [m]."""
        return self.map.metres / self.size

    @property
    def period(self) -> int:
        """After how many texels x comes round again; 0 when it does not."""
        return self.size if self.map.wrapped else 0

    def without(self, closed: Flags) -> TexelMap:
        """The same with some texels, (size, size), taken as lying off the mesh."""
        return replace(self, triangle=np.where(closed, -1, self.triangle))

    @cached_property
    def mapped(self) -> Flags:
        """Which texels lie on the mesh, (size, size)."""
        return self.triangle >= 0

    def triangle_at(self, points: Floats) -> Ints:
        """The triangle at each of ``points`` [texels], (k, 2), to the nearest texel; -1 off the mesh. Shape (k,)."""
        cells = np.floor(points).astype(np.int64)
        column, row = cells[:, 0], cells[:, 1]
        if self.period:
            column = column % self.period
        inside = (column >= 0) & (column < self.size) & (row >= 0) & (row < self.size)
        found = self.triangle[np.where(inside, row, 0), np.where(inside, column, 0)]
        return np.where(inside, found, -1)

    def weights(self, triangles: Ints, points: Floats) -> Floats:
        """Barycentric coordinates, (k, 3), of ``points`` [texels], (k, 2), in their triangles, (k,).

        None is negative: a point just outside the triangle of its texel counts as on its border.
        """
        corners = self.map.corner_uv[triangles] * self.size
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        offset = shorter_way(points - a, self.period)
        area = cross(b - a, c - a)
        area = np.where(area == 0, np.inf, area)
        second, third = cross(offset, c - a) / area, cross(b - a, offset) / area
        weights = np.stack([1 - second - third, second, third], axis=1).clip(0, None)
        return weights / weights.sum(axis=1, keepdims=True)

    def spread(self, values: Floats) -> Floats:
        """Values given at the vertices, (n,), interpolated at every texel; 0 off the mesh. Shape (size, size)."""
        corners = self.map.corner_uv * self.size
        at_corners = values[self.map.mesh.faces]
        start, first, second = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        rise, other_rise = at_corners[:, 1] - at_corners[:, 0], at_corners[:, 2] - at_corners[:, 0]
        area = cross(first, second)
        area = np.where(area == 0, np.inf, area)
        # Each triangle is a plane over the image: a value at its first corner, and slopes along x and y.
        slope_x = (rise * second[:, 1] - other_rise * first[:, 1]) / area
        slope_y = (other_rise * first[:, 0] - rise * second[:, 0]) / area

        image = np.zeros(self.size * self.size)
        texels = np.flatnonzero(self.mapped)
        triangle = self.triangle.ravel()[texels]
        offset = shorter_way(self.centres(texels) - start[triangle], self.period)
        image[texels] = at_corners[triangle, 0] + slope_x[triangle] * offset[:, 0] + slope_y[triangle] * offset[:, 1]
        return image.reshape(self.size, self.size)

    def centres(self, texels: Ints) -> Floats:
        """Centres of texels [texels], (k, 2), given by number, (k,): row after row."""
        return np.stack([texels % self.size + 0.5, texels // self.size + 0.5], axis=1)


def texel_map(texture_map: TextureMap, size: int) -> TexelMap:
    """Find the triangle of every texel of a square image of ``size`` texels along an edge.

    Every triangle is cut into its rows, each row into its texels, all at once. A texel on a shared edge belongs to
    either triangle.
    """
    corners = texture_map.corner_uv * size
    first = np.ceil(corners[..., 1].min(axis=1) - 0.5).astype(np.int64).clip(0, size)
    last = np.floor(corners[..., 1].max(axis=1) - 0.5).astype(np.int64).clip(-1, size - 1)
    faces, rows = expand(first, np.maximum(last - first + 1, 0))
    left, right = _row_spans(corners[faces], np.asarray(rows + 0.5))
    begin = np.ceil(left - 0.5).astype(np.int64)
    spans, columns = expand(begin, np.maximum(np.floor(right - 0.5).astype(np.int64) - begin + 1, 0))
    if texture_map.wrapped:
        columns %= size
    inside = (columns >= 0) & (columns < size)
    triangle = np.full((size, size), -1, dtype=np.int64)
    triangle[rows[spans][inside], columns[inside]] = faces[spans][inside]
    return TexelMap(texture_map, size, triangle)


def expand(starts: Ints, counts: Ints) -> tuple[Ints, Ints]:
    """All whole numbers of the ranges ``starts[i]`` to ``starts[i] + counts[i]``: (i of each, the number), both (s,)."""
    owner = np.repeat(np.arange(len(starts)), counts)
    before = np.cumsum(counts) - counts
    return owner, np.arange(len(owner)) - before[owner] + starts[owner]


def _row_spans(corners: Floats, level: Floats) -> tuple[Floats, Floats]:
    """From where to where in x each triangle, (k, 3, 2), is cut by the row at y = ``level``, (k,)."""
    start, end = corners, np.roll(corners, -1, axis=1)
    rise = end[..., 1] - start[..., 1]
    part = np.divide(level[:, None] - start[..., 1], rise, out=np.full(rise.shape, np.nan), where=rise != 0)
    x = start[..., 0] + part * (end[..., 0] - start[..., 0])
    met = (part >= 0) & (part <= 1)
    left, right = np.where(met, x, np.inf).min(axis=1), np.where(met, x, -np.inf).max(axis=1)
    # A triangle without height meets no row.
    return np.where(met.any(axis=1), left, 0.0), np.where(met.any(axis=1), right, -1.0)
