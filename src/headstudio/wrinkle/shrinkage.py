"""How far posed skin shrinks across a wrinkle: Bando's thesis, equation 2.3 and figure 2.5.

From a vertex v1 the direction d_p, square to the wrinkle, runs through a triangle v1 v2 v3 and leaves it at a point q of
the edge v2 v3. L is the way to q at rest, L' the way in the posed mesh, and s = 1 - L' / L. There is a triangle ahead
and one behind, and s is the mean of both.

The thesis follows q with two edges: v1 v2 and v1 v3 are scaled by t2 and t3 where they lie in texture space, their angle
kept. Then L' / L = 1 / (a / t2 + (1 - a) / t3), with q = a v2 + (1 - a) v3. That is exact along the edges and off by up to
a third of the shrinkage between them, as much as the triangles happen to lie. With the length of the third edge, too, the
triangle is rigid, and L' is the length of q - v1 itself (Stewart's theorem): exact for any evenly stretched skin and any
direction. Both are here; "three edges" is what furrows use unless told otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy import sparse

from ..head.mesh import Floats, Ints
from ..head.rows import row_length
from .texture_map import TextureMap

Measure = Literal["three edges", "two edges"]
MEASURES: tuple[Measure, ...] = ("three edges", "two edges")

# A direction may leave a triangle by this much of its width and still count as inside: rounding.
_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class ShrinkageGauge:
    """Measures s at k places of a mesh, each across a direction of its own.

    corners: v1, v2, v3 ahead and behind, indices into the positions to be measured, (2, k, 3). share: a, the weight of v2
    in q, (2, k). edges: lengths of v1 v2 and v1 v3 at rest [m], (2, k, 2). lengths: L [m], (2, k). way: the matrix that
    makes q - v1 from positions, (2 k, n). found: whether there is a triangle at all, (k,).
    """

    corners: Ints
    share: Floats
    edges: Floats
    lengths: Floats
    way: sparse.csr_array
    found: np.ndarray
    measure: Measure

    def shrinkage(self, posed: Floats) -> Floats:
        """s at the k places, (k,), for posed positions [m], (n, 3): 0 at rest, below 0 where skin is stretched."""
        if self.measure == "two edges":
            start = posed[self.corners[..., 0]]
            scale = [
                np.linalg.norm(posed[self.corners[..., k]] - start, axis=2) / self.edges[..., k - 1] for k in (1, 2)
            ]
            tiny = np.finfo(float).tiny
            share = np.clip(self.share, 0.0, 1.0)
            kept = 1.0 / (share / np.maximum(scale[0], tiny) + (1 - share) / np.maximum(scale[1], tiny))
        else:
            way = self.way @ posed
            kept = row_length(way).reshape(self.lengths.shape) / self.lengths
        return np.where(self.found, 1.0 - 0.5 * (kept[0] + kept[1]), 0.0)


def shrinkage_gauge(
    texture_map: TextureMap,
    vertices: Ints,
    across: Floats,
    measure: Measure = "three edges",
    *,
    skin_vertices: Ints | None = None,
    skin_count: int | None = None,
) -> ShrinkageGauge:
    """Prepare to measure shrinkage at ``vertices`` of the map's mesh, (k,), in the directions ``across``, (k, 2).

    across: d_p in texture space, of any length but 0, square to the wrinkles (see metric.perpendicular); its sign does not
    matter. A vertex may occur often, once for each wrinkle. skin_vertices, skin_count: for a map of a part of a skin,
    where its vertices are in the skin, (n,), and how many the skin has; then the whole skin's positions are measured.
    Where d_p meets a triangle on one side only (at a border), that side counts alone; where on neither (in a corner), the
    nearest triangle is extended. A vertex of no triangle has s = 0.
    """
    sides = [_triangle_ahead(texture_map, vertices, sign * across) for sign in (1.0, -1.0)]
    inside = np.stack([side.inside for side in sides])
    # What is missing on one side is taken from the other, so that their mean is the one that is there.
    take = np.where((inside >= -_TOLERANCE) | (inside >= inside[::-1]), [[0], [1]], [[1], [0]])
    column = np.arange(len(vertices))
    corners = np.stack([side.corners for side in sides])[take, column]
    share = np.stack([side.share for side in sides])[take, column]

    rest = texture_map.mesh.vertices
    start, second, third = (rest[corners[..., k]] for k in range(3))
    edges = np.stack([np.linalg.norm(second - start, axis=2), np.linalg.norm(third - start, axis=2)], axis=2)
    lengths = np.linalg.norm(share[..., None] * second + (1 - share[..., None]) * third - start, axis=2)
    found = np.isfinite(inside.max(axis=0))
    if skin_vertices is not None:
        corners = skin_vertices[corners]
    count = len(rest) if skin_count is None else skin_count
    rows = np.repeat(np.arange(share.size), 3)
    values = np.stack([-np.ones_like(share), share, 1 - share], axis=2).ravel()
    way = sparse.coo_array((values, (rows, corners.ravel())), shape=(share.size, count)).tocsr()
    return ShrinkageGauge(
        corners, share, np.where(found[:, None], edges, 1.0), np.where(found, lengths, 1.0), way, found, measure
    )


@dataclass(frozen=True, eq=False)
class _Side:
    """The best triangle at every vertex; ``inside`` is negative where the direction misses it, (k,)."""

    corners: Ints
    share: Floats
    inside: Floats


def _triangle_ahead(texture_map: TextureMap, vertices: Ints, direction: Floats) -> _Side:
    """The triangle at each vertex that its direction runs into."""
    faces, uv = texture_map.mesh.faces, texture_map.corner_uv
    order = np.argsort(faces.ravel(), kind="stable")
    first = np.searchsorted(faces.ravel()[order], np.arange(len(texture_map.mesh.vertices) + 1))
    count = first[vertices + 1] - first[vertices]
    query = np.repeat(np.arange(len(vertices)), count)
    within = np.arange(len(query)) - np.repeat(np.cumsum(count) - count, count)
    corner = order[first[vertices][query] + within]
    face, place = np.divmod(corner, 3)

    start, second, third = (uv[face, (place + k) % 3] for k in range(3))
    to_second, to_third, aim = second - start, third - start, direction[query]
    a, b = _cross(aim, to_third), _cross(to_second, aim)
    total = a + b
    # Ahead: both weights positive. The best triangle is the one whose smaller weight is largest.
    share = np.divide(a, total, out=np.full(len(a), np.nan), where=total > 0)
    inside = np.nan_to_num(np.minimum(share, 1 - share), nan=-np.inf)
    best = np.lexsort((inside, query))
    last = np.cumsum(count) - 1
    chosen = best[np.maximum(last, 0)]
    corners = np.stack([faces[face[chosen], (place[chosen] + k) % 3] for k in range(3)], axis=1)
    return _Side(corners, np.nan_to_num(share[chosen]), np.where(count > 0, inside[chosen], -np.inf))


def _cross(a: Floats, b: Floats) -> Floats:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
