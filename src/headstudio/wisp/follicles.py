"""Where hair grows: master roots spread evenly, a Voronoi region around each, member roots by density inside the regions.

Choe, Ko 2005, section 2.3. Everything is done on tiles, triangles of the scalp that are much smaller than a wisp.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree
from trimesh.remesh import subdivide

from ..head.length_maps import sample
from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from ..head.scalp_settings import GrayImage
from .hairline import thinning
from .parting import Parting

_LARGEST_TILE = 0.004  # edge [m]
_LLOYD_STEPS = 4
# So much more hair around the whorl, and along a parting, and within how far [m].
_AT_WHORL, _AT_PARTING = (0.9, 0.016), (2.0, 0.008)
# Additive recurrence of Roberts (2018): its points fill a cube evenly, however many of them one takes.
_PLASTIC = 1.2207440846057596
_STRIDE = np.array([1 / _PLASTIC, 1 / _PLASTIC**2, 1 / _PLASTIC**3])


@dataclass(frozen=True, eq=False)
class Tiles:
    """The scalp in small triangles: vertices [m], (n, 3), their (u, v), (n, 2), corners, (m, 3), and areas [m^2], (m,)."""

    vertices: Floats
    uv: Floats
    corners: Ints
    areas: Floats


@lru_cache(maxsize=4)
def tiles_of(scalp: Scalp) -> Tiles:
    """The tiles of a scalp; those of the last few scalps are kept."""
    joined, corners = np.column_stack([scalp.patch.vertices, scalp.uv]), scalp.patch.faces
    while True:
        edges = joined[corners][:, :, :3] - np.roll(joined[corners][:, :, :3], 1, axis=1)
        large = np.flatnonzero(np.linalg.norm(edges, axis=2).max(axis=1) > _LARGEST_TILE)
        if len(large) == 0:
            break
        joined, corners = subdivide(joined, corners, face_index=large)
    a, b, c = (joined[corners[:, k], :3] for k in range(3))
    areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return Tiles(np.ascontiguousarray(joined[:, :3]), np.ascontiguousarray(joined[:, 3:]), corners, areas)


@dataclass(frozen=True, eq=False)
class Regions:
    """W wisps on the scalp.

    roots: of the master strands [m], (W, 3), uv: the same on the square, (W, 2). share: part of all strands that grows
    in each region, (W,). reach: no strand of a region has its root farther than this from the master's [m], (W,).
    weight: how much hair each tile carries, (m,). nearest: of each tile the wisps that may own a part of it, (m, 4).
    places, corner_places: masters, (W, 4), and vertices of the tiles, (n, 4), in the coordinates in which the regions are
    Voronoi's: position and detour around the parting [m]. parting: the parting, if any.
    """

    tiles: Tiles
    roots: Floats
    uv: Floats
    share: Floats
    reach: Floats
    weight: Floats
    nearest: Ints
    places: Floats
    corner_places: Floats
    parting: Parting | None = None

    @property
    def count(self) -> int:
        """How many wisps there are, W; 0 where no hair grows."""
        return len(self.roots)


@lru_cache(maxsize=4)
def spread_wisps(
    scalp: Scalp, density: GrayImage, count: int, parting: Parting | None, seed: int, hairline: float = 0.0
) -> Regions:
    """Spread ``count`` master roots evenly over the skin where hair grows, by Lloyd's relaxation in the skin's own metric.

    Fewer, if hair grows on fewer tiles. Each region is what lies nearer to its root than to any other, on the same bank
    of the parting. hairline: how far from the border of the scalp hair is still sparser [m]. The last few results are kept:
    most of what an artist changes does not move a root.
    """
    tiles = tiles_of(scalp)
    middles = tiles.vertices[tiles.corners].mean(axis=1)
    weight = tiles.areas * sample(density, tiles.uv[tiles.corners].mean(axis=1)) * thinning(scalp, middles, hairline)
    weight = weight * fulness(scalp, parting, middles)
    corner_places = _places(tiles.vertices, parting)
    centres = corner_places[tiles.corners].mean(axis=1)
    # Even over the skin, whatever the density: the paper's density map says how many strands a wisp has.
    area = np.where(weight > 0, tiles.areas, 0.0)
    count = min(count, int(np.count_nonzero(area)))
    rng = np.random.default_rng([seed, 0])
    places = centres[_pick(area, count, rng)] if count else np.zeros((0, 4))
    for _ in range(_LLOYD_STEPS if count else 0):
        places = _centroids(centres, area, _owners(places, centres), places)
    uv = scalp.locate(places[:, :3])
    roots = scalp.points(uv)
    places = _places(roots, parting)
    if count == 0:
        none = np.zeros(0)
        nearest = np.zeros((len(area), 4), dtype=np.int64)
        return Regions(tiles, roots, uv, none, none, weight, nearest, places, corner_places)
    owner = _owners(places, centres)
    nearest = np.column_stack([owner, _owners(places, corner_places)[tiles.corners]])
    share = np.bincount(owner, weight, minlength=count) / weight.sum()
    reach = _reach(tiles, weight, nearest, roots)
    return Regions(tiles, roots, uv, share, reach, weight, nearest, places, corner_places, parting)


def fulness(scalp: Scalp, parting: Parting | None, places: Floats) -> Floats:
    """How many times as densely as elsewhere hair grows at places of the skin [m], (n, 3), for its flow: (n,).

    Hair that leaves a line or a place to all sides lies there in one layer, and every root that is missing shows.
    """
    at_whorl = np.linalg.norm(places - scalp.points(scalp.whorl[None]), axis=1)
    more = _around(at_whorl, *_AT_WHORL)
    if parting is not None:
        more = np.maximum(more, _around(parting.distance(places), *_AT_PARTING))
    return 1.0 + more


def _around(distance: Floats, most: float, within: float) -> Floats:
    return most * np.exp(-((distance / within) ** 2))


def scatter_strands(regions: Regions, total: int, seed: int) -> tuple[Floats, Ints]:
    """Roots of ``total`` member strands [m], (total, 3), and their wisps, (total,): by density, each in its region.

    The first k of them are spread over the whole scalp as all of them are: hair with fewer strands is the same hair.
    """
    if regions.count == 0 or total == 0:
        return np.zeros((0, 3)), np.zeros(0, dtype=np.int64)
    tiles = regions.tiles
    rng = np.random.default_rng([seed, 1])
    even = (rng.random(3) + np.arange(1, total + 1)[:, None] * _STRIDE) % 1.0
    tile = _at_share(regions.weight, even[:, 0])
    root = np.sqrt(even[:, 1])
    weights = np.stack([1 - root, root * (1 - even[:, 2]), root * even[:, 2]], axis=1)
    corners = tiles.corners[tile]
    place = np.einsum("ij,ijk->ik", weights, regions.corner_places[corners])
    candidates = regions.nearest[tile]
    distance = np.stack([_squared(place - regions.places[candidates[:, k]]) for k in range(4)])
    wisp = candidates[np.arange(total), distance.argmin(axis=0)]
    roots = np.ascontiguousarray(place[:, :3])
    if regions.parting is not None:
        drawn = regions.parting.drawn(roots)
        # A wisp is as wide at its root as its region is, and no comb takes a strand out of it.
        inside = _squared(drawn - regions.roots[wisp]) <= regions.reach[wisp] ** 2
        roots = np.where(inside[:, None], drawn, roots)
    return roots, wisp


def _places(points: Floats, parting: Parting | None) -> Floats:
    detour = np.zeros(len(points)) if parting is None else parting.detour(points)
    return np.column_stack([points, detour])


def _owners(places: Floats, points: Floats) -> Ints:
    return cKDTree(places).query(points, workers=-1)[1]


def _centroids(centres: Floats, area: Floats, owner: Ints, places: Floats) -> Floats:
    """The middle of every region, (W, 4); a region without area keeps its place."""
    total = np.bincount(owner, area, minlength=len(places))
    sums = np.stack([np.bincount(owner, area * column, minlength=len(places)) for column in centres.T], axis=1)
    empty = total <= 0
    return np.where(empty[:, None], places, sums / np.where(empty, 1.0, total)[:, None])


def _reach(tiles: Tiles, weight: Floats, nearest: Ints, roots: Floats) -> Floats:
    """The largest distance from a master root to a corner of a tile that its region may own a part of [m], (W,).

    Distance is convex: nothing inside a triangle is farther away than its corners.
    """
    grown = weight > 0
    reach = np.zeros(len(roots))
    for k in range(4):
        owner = nearest[grown, k]
        gap = tiles.vertices[tiles.corners[grown]] - roots[owner][:, None]
        np.maximum.at(reach, owner, np.linalg.norm(gap, axis=2).max(axis=1))
    return reach


def _pick(area: Floats, count: int, rng: np.random.Generator) -> Ints:
    """Indices of ``count`` different tiles, spread evenly by area."""
    even = np.unique(_at_share(area, (rng.random() + np.arange(count)) / count % 1.0))
    spare = np.setdiff1d(np.flatnonzero(area), even)
    return np.concatenate([even, rng.permutation(spare)[: count - len(even)]])


def _at_share(weight: Floats, share: Floats) -> Ints:
    """Which index a share of the whole weight falls on, with indices in proportion to their weight. Any shape."""
    total = np.cumsum(weight)
    index = np.searchsorted(total, share * total[-1], side="right")
    return np.minimum(index, np.flatnonzero(weight)[-1])


def _squared(vectors: Floats) -> Floats:
    return np.einsum("ij,ij->i", vectors, vectors)
