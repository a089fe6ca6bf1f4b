"""The same surface with fewer triangles, for an eye to which the rest would be smaller than a pixel.

Vertices are gathered in clusters, as large as a pixel where the surface bends, where something is painted on it and where
its own triangles are small (furrows), and larger where it is flat and plain. What is left is one vertex of every cluster,
and the triangles between three clusters. Clusters spread along edges only: so lips that touch stay two, and there is no
crack.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import igl
import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components, dijkstra

from ..head.mesh import Floats, Ints, TriangleMesh

# Clusters are at least and at most so many pixels wide.
_LEAST, _MOST = 1.3, 7.0
# Between clusters a triangle may leave the surface by this part of a pixel,
_ASTRAY = 0.25
# what is painted may change by this much,
_PAINT_STEP = 0.3
# Seeds of clusters that are nearer to each other than this part of a cluster are one too many.
_APART = 0.6
# and so many edges may go into one.
_EDGES = 4.0
# Shorter edges [m] say nothing about how the surface bends.
_SHORT = 1e-7
# Sizes of clusters, and of pixels for which there is a level of detail, come in steps of the root of two.
_STEPS = 2
_FINEST = 0.25e-3
# A level is as good for pixels that are a little smaller: this part of a step.
_EARLY = 0.25
_CELL_BITS = 16
# Cells along an edge of the Z-curve, as a power of two.
_Z_BITS = 10
# What would be smaller than this [m] is left out of a body that casts shadows.
_SHADOW_PIXEL = 0.004


@dataclass(frozen=True, eq=False)
class Surface:
    """What is drawn: faces, (m, 3); points [m] and unit normals, (n, 3); what is painted on it, 0 to 1, (n, d); vertices on
    lines that are seen, such as the floors of furrows, (k,): where a line runs, the others give way to them."""

    faces: Ints
    points: Floats
    normals: Floats
    painted: Floats
    lines: Ints = field(default_factory=lambda: np.zeros(0, np.int64))


def level_of(pixel: float) -> int:
    """The level of detail for pixels of this size [m]; below 0 nothing may be left out."""
    return int(np.floor(_STEPS * np.log2(max(pixel, 1e-9) / _FINEST) + _EARLY))


def faces_of_level(surface: Surface, level: int) -> Ints:
    """Faces over the same vertices that show all there is to see at this level, (k, 3)."""
    return surface.faces if level < 0 else coarser(surface, _FINEST * 2 ** (level / _STEPS))


def casting_shadows(mesh: TriangleMesh) -> Ints:
    """Faces over the same vertices whose shadow is that of the mesh, (k, 3)."""
    plain = np.zeros((len(mesh.vertices), 0))
    return coarser(Surface(mesh.faces, mesh.vertices, mesh.vertex_normals, plain), _SHADOW_PIXEL)


def coarser(surface: Surface, pixel: float) -> Ints:
    """Faces over the same vertices that look the same in pixels of this size [m], (k, 3)."""
    start, end = surface.faces.ravel(), np.roll(surface.faces, -1, axis=1).ravel()
    along = surface.points[end] - surface.points[start]
    length = np.sqrt(np.einsum("ij,ij->i", along, along)) + _SHORT
    edge = _mean(length, start, len(surface.points))
    size = _sizes(surface, start, end, length, edge, pixel)
    # All of a border stays: an edge of the surface shows every corner that is cut off it. So does all of where it touches
    # itself: lips that are closed would gape where one loses another vertex than the other.
    border = np.union1d(igl.boundary_facets(surface.faces)[0], _touching(surface.points))
    off_line = np.ones(len(size), dtype=bool)
    off_line[surface.lines] = False
    seeds = np.union1d(_seeds(surface.points, start, end, size, off_line), border)
    # Every vertex goes to the seed that is nearest along edges, as measured in clusters.
    count = len(size)
    step = 2 * length / (size[start] + size[end])
    # What is on a line goes to a seed on it: so what is left of a line is joined from end to end.
    open_ = off_line[end] | ~off_line[start]
    steps = sparse.csr_array((step[open_], (start[open_], end[open_])), shape=(count, count))
    away, _, nearest = dijkstra(steps, indices=seeds, min_only=True, return_predecessors=True)
    # A cube that the surface only grazes has a seed beside that of its neighbour. Of the two, what lies on a line stays, and
    # then what lies where triangles are smallest.
    close = (away[start] + step + away[end] < _APART) & (nearest[start] != nearest[end])
    rank = np.empty(count, np.int64)
    rank[np.lexsort((edge, off_line))] = np.arange(count)
    rank[border] = -1
    seeds = _apart(seeds, nearest[start[close]], nearest[end[close]], rank)
    _, _, nearest = dijkstra(steps, indices=seeds, min_only=True, return_predecessors=True)
    corners = np.where(nearest < 0, np.arange(count), nearest)[surface.faces]
    return _once(corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)], count)


def _sizes(surface: Surface, start: Ints, end: Ints, length: Floats, edge: Floats, pixel: float) -> Floats:
    """How wide the cluster of every vertex may be [m], (n,), in steps. length: of edges, edge: their mean at each vertex."""
    turn = surface.normals[end] - surface.normals[start]
    change = np.abs(surface.painted[end] - surface.painted[start]).max(axis=1, initial=0.0)
    bend = _most(np.sqrt(np.einsum("ij,ij->i", turn, turn)) / length, start, end, len(surface.points))
    paint = _most(change / length, start, end, len(surface.points))
    with np.errstate(divide="ignore"):
        # A chord s of a circle of curvature k leaves it by k s^2 / 8.
        wanted = np.minimum(np.sqrt(8 * _ASTRAY * pixel / bend), _PAINT_STEP / paint)
    wanted = np.clip(np.minimum(wanted, _EDGES * edge), _LEAST * pixel, _MOST * pixel)
    steps: Floats = _LEAST * pixel * 2.0 ** (np.floor(_STEPS * np.log2(wanted / (_LEAST * pixel)) + 1e-9) / _STEPS)
    return steps


def _touching(points: Floats) -> Ints:
    """Vertices that lie exactly where another one does, (k,)."""
    _, place, held = np.unique(points, axis=0, return_inverse=True, return_counts=True)
    return np.flatnonzero(held[place.ravel()] > 1)


def _most(values: Floats, start: Ints, end: Ints, count: int) -> Floats:
    """The largest of the values at the edges from ``start`` to ``end`` that meet at each vertex, (count,)."""
    most = np.zeros(count)
    np.maximum.at(most, start, values)
    np.maximum.at(most, end, values)
    return most


def _mean(values: Floats, start: Ints, count: int) -> Floats:
    """The mean of the values at the edges that leave each vertex, (count,); 0 where none does."""
    mean: Floats = np.bincount(start, values, minlength=count) / np.maximum(np.bincount(start, minlength=count), 1)
    return mean


def _apart(seeds: Ints, first: Ints, second: Ints, rank: Ints) -> Ints:
    """Of the seeds as many as can stay with no two that are ``first`` and ``second`` of a pair, but those of rank -1, which
    all do. rank: of every vertex, (n,); of two the lower stays. Each round those stay that are the lowest around (Luby)."""
    ends = np.concatenate([first, second]), np.concatenate([second, first])
    stays = rank == -1
    fresh, open_ = stays, np.isin(np.arange(len(rank)), seeds)
    while True:
        open_[fresh] = False
        open_[ends[1][fresh[ends[0]]]] = False
        if not open_.any():
            break
        here, other = (each[open_[ends[0]] & open_[ends[1]]] for each in ends)
        lowest = np.full(len(rank), len(rank))
        np.minimum.at(lowest, here, rank[other])
        fresh = open_ & (rank < lowest)
        stays = stays | fresh
    return np.flatnonzero(stays)


def _seeds(points: Floats, start: Ints, end: Ints, size: Floats, off_line: NDArray[np.bool_]) -> Ints:
    """One vertex for the vertices that share a cube of their size and are joined by edges within it, (k,): the one next to
    their middle, of those on a line if there are any."""
    cells = np.floor((points - points.min(axis=0)) / size[:, None]).astype(np.int64)
    key = np.unique(size, return_inverse=True)[1]
    for axis in cells.T:
        key = (key << _CELL_BITS) + axis
    same = key[start] == key[end]
    joined = sparse.coo_array((np.ones(same.sum(), bool), (start[same], end[same])), shape=(len(points),) * 2)
    count, cluster = connected_components(joined, directed=False)
    held = np.bincount(cluster)
    middle = np.stack([np.bincount(cluster, axis) / held for axis in points.T], axis=1)
    off = np.einsum("ij,ij->i", points - middle[cluster], points - middle[cluster])
    order = np.lexsort((off, off_line, cluster))
    return order[np.searchsorted(cluster[order], np.arange(count))]


def _once(faces: Ints, count: int) -> Ints:
    """Each triangle once, (k, 3), in their order, and none of two that lie back to back."""
    first = faces.argmin(axis=1)
    turned = np.take_along_axis(faces, (first[:, None] + np.arange(3)) % 3, axis=1)
    low, high = np.sort(turned[:, 1:], axis=1).T
    _, kept, which = np.unique((turned[:, 0] * count + low) * count + high, return_index=True, return_inverse=True)
    outward = np.bincount(which, np.where(turned[:, 1] == low, 1, -1), minlength=len(kept))
    single = turned[kept]
    facing = np.where((outward > 0) == (single[:, 1] < single[:, 2]), 1, -1)
    single = np.where(facing[:, None] > 0, single, single[:, [0, 2, 1]])
    shown = np.flatnonzero(outward)
    return single[shown[np.argsort(kept[shown])]]


def neighbours_together(faces: Ints, points: Floats) -> Ints:
    """The same triangles, (m, 3), in an order that keeps those together that lie together (a Z-curve through space).

    A vertex is worked out again for every few hundred triangles that use it; so this makes drawing faster by a quarter.
    """
    middles = points[faces].mean(axis=1)
    low = middles.min(axis=0)
    cells = ((middles - low) / max(float((middles - low).max()), 1e-12) * (2**_Z_BITS - 1)).astype(np.int64)
    bits = np.arange(_Z_BITS)
    curve = sum(((cells[:, k, None] >> bits & 1) << (3 * bits + k)).sum(axis=1) for k in range(3))
    return faces[np.argsort(curve, kind="stable")]
