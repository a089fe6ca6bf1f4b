"""Where lips end: parting them where they are closed, and finding their ends where they are open.

Closed lips are cut apart along the line where they meet, from corner to corner of the mouth.

A sculpture or a scan with closed lips has a groove there, and triangles that run across it. The cut follows edges, whose
ends are moved onto the line first, so that lips end in an even line and no triangle is split into slivers.
"""

from __future__ import annotations

from dataclasses import replace

import igl
import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.ndimage import gaussian_filter1d
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import cKDTree

from .head import Landmarks
from .locate import locator
from .mesh import Floats, Ints, TriangleMesh

# An edge so far from the line as edges there are long counts for twice its length.
_ASTRAY = 0.5
# What is so many of them away is not gone along at all.
_FARTHEST = 3.0
# So many rings of vertices beside the cut make room for those that have moved, in so many steps.
_RINGS, _STEPS = 4, 12
# The line is found in columns, and evened out over so many.
_EVENED = 1.5
_FINE = 400


def parted(skin: TriangleMesh, line: Floats) -> tuple[TriangleMesh, Ints] | None:
    """The skin cut open along ``line``, points on it from the right corner to the left [m], (k, 3), and its new border.

    The border is a closed chain of vertices, along the lower lip to the left corner and back along the upper, (b,); those of
    the lower lip are new, but for both corners, and lie where those of the upper do. All other vertices and all triangles
    keep their places in the arrays. None where edges do not lead from corner to corner.
    """
    line = _resampled(np.column_stack([line[:, 0], gaussian_filter1d(line[:, 1:], _EVENED, axis=0, mode="nearest")]))
    path = _along_edges(skin, line)
    if path is None:
        return None
    fitted = skin.moved(_moved_onto(skin, line, path))
    inner = path[1:-1]
    below = _below(skin.faces, path)
    count = len(skin.vertices)
    double = np.arange(count)
    double[inner] = count + np.arange(len(inner))
    faces = np.where(below, double[skin.faces], skin.faces)
    vertices = np.concatenate([fitted.vertices, fitted.vertices[inner]])
    return replace(fitted, vertices=vertices, faces=faces), np.concatenate([path[:1], double[inner], path[:0:-1]])


def open_lips(skin: TriangleMesh, marks: Landmarks) -> Ints | None:
    """The border of a skin that ends behind its lips, (b,), as ``parted`` gives it; None where it ends nowhere there."""
    middle = 0.5 * (marks.mouth_left + marks.mouth_right)
    width = float(np.linalg.norm(marks.mouth_left - marks.mouth_right))
    for loop in igl.boundary_loop_all(skin.faces):
        points = skin.vertices[loop]
        if np.ptp(points[:, 0]) > 0.5 * width and np.linalg.norm(points - middle, axis=1).max() < width:
            ends = np.asarray(loop, dtype=np.int64)[::-1]
            return np.roll(ends, -int(skin.vertices[ends, 0].argmin()))
    return None


def _resampled(line: Floats) -> Floats:
    """The same line in many equal steps."""
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    steps = np.linspace(0.0, way[-1], _FINE)
    return np.stack([np.interp(steps, way, each) for each in line.T], axis=1)


def _along_edges(skin: TriangleMesh, line: Floats) -> Ints | None:
    """Vertices from corner to corner, joined by edges, that keep near the line, (p,)."""
    points, count = skin.vertices, len(skin.vertices)
    ends = np.concatenate([skin.faces[:, [0, 1]], skin.faces[:, [1, 2]], skin.faces[:, [2, 0]]])
    distance, place = cKDTree(line).query(points)
    start, end = (int(np.linalg.norm(points - corner, axis=1).argmin()) for corner in line[[0, -1]])
    length = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    usual = np.median(length[(distance[ends] < 2.0 * length[:, None]).all(axis=1)])
    # Only what goes on along the line: a path to and fro would lie on itself.
    onward = (np.diff(place[ends], axis=1)[:, 0] > 0) & (distance[ends] < _FARTHEST * usual).all(axis=1)
    onward |= (ends[:, 0] == start) | (ends[:, 1] == end)
    cost = length * (1.0 + ((distance[ends] ** 2).mean(axis=1) / (_ASTRAY * usual) ** 2))
    graph = sparse.csr_array((cost[onward], ends[onward].T), shape=(count, count))
    cost_to, before = dijkstra(graph, indices=start, return_predecessors=True)
    if not np.isfinite(cost_to[end]):
        return None
    path = [end]
    while path[-1] != start:
        path.append(int(before[path[-1]]))
    return np.array(path[::-1])


def _moved_onto(skin: TriangleMesh, line: Floats, path: Ints) -> Floats:
    """All vertices [m], (n, 3), with those of the path on the line and their neighbours spread evenly on the surface."""
    points = skin.vertices.copy()
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points[path], axis=0), axis=1))])
    place = way / way[-1] * (len(line) - 1)
    points[path] = np.stack([np.interp(place, np.arange(len(line)), each) for each in line.T], axis=1)
    adjacent = igl.adjacency_matrix(skin.faces).tocsr()
    near = np.isin(np.arange(len(points)), path)
    for _ in range(_RINGS):
        near = near | (adjacent @ near > 0)
    near[path] = False
    free = np.flatnonzero(near)
    degree = np.asarray(adjacent.sum(axis=1)).ravel()[free]
    at = locator(skin)
    for _ in range(_STEPS):
        found, _ = at.nearest(0.5 * (points[free] + (adjacent[free] @ points) / degree[:, None]))
        points[free] = found.blend(skin.vertices, skin.faces)
    return points


def _below(faces: Ints, path: Ints) -> NDArray[np.bool_]:
    """Which corners of triangles, (m, 3), are at an inner vertex of the path and on its right, as seen from outside."""
    count = int(faces.max()) + 1
    owner, at = np.nonzero(np.isin(faces, path[1:-1]))
    corner = np.arange(len(owner))
    vertex, after, before = (faces[owner, (at + k) % 3] for k in range(3))
    forth, back = path[:-1] * count + path[1:], path[1:] * count + path[:-1]
    # Two corners at one vertex are on one side where their triangles share an edge there that is not of the path.
    spokes = np.concatenate([vertex * count + after, vertex * count + before])
    shared = np.flatnonzero(~np.isin(spokes, np.concatenate([forth, back])))
    shared = shared[np.argsort(spokes[shared], kind="stable")]
    same = np.flatnonzero(np.diff(spokes[shared]) == 0)
    of_corner = np.tile(corner, 2)
    pairs = of_corner[shared[same]], of_corner[shared[same + 1]]
    linked = sparse.coo_array((np.ones(len(same), dtype=bool), pairs), shape=(len(corner),) * 2)
    side = connected_components(linked, directed=False)[1]
    # Triangles whose own way around leads along the path lie on its left.
    left = np.isin(vertex * count + after, forth) | np.isin(before * count + vertex, forth)
    below = np.zeros(faces.shape, dtype=bool)
    below[owner, at] = ~np.isin(side, side[left])
    return below
