"""Clipping a triangle mesh by a plane, a smooth surface or any function of its vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .mesh import Floats, Ints, TriangleMesh

# A vertex this close to the surface, as a fraction of its shortest edge, is moved onto it: no sliver is left behind.
_SNAP = 0.12

Mask = NDArray[np.bool_]


def clip(mesh: TriangleMesh, distance: Floats) -> tuple[TriangleMesh, sparse.csr_array]:
    """The part of ``mesh`` where ``distance`` is at least 0, cut through the triangles.

    distance: signed value per vertex, shape (n,), linear in between. Returns the part, without loose vertices, and the
    matrix of shape (new vertices, old vertices) that makes its vertices from the old ones, for anything else that
    lives on them. The part may be empty.
    """
    side = np.sign(distance).astype(np.int64)
    half_edges = mesh.faces[:, [[0, 1], [1, 2], [2, 0]]]
    crossed = side[half_edges[..., 0]] * side[half_edges[..., 1]] < 0
    pairs, pair_of = np.unique(np.sort(half_edges[crossed], axis=1), axis=0, return_inverse=True)
    on_crossing = np.full(crossed.shape, -1)
    on_crossing[crossed] = len(distance) + pair_of.reshape(-1)

    # Around each triangle: corner, crossing, corner, crossing, corner, crossing; what is kept is the new polygon.
    outline = np.stack([mesh.faces, on_crossing], axis=2).reshape(-1, 6)
    kept = np.stack([side[mesh.faces] >= 0, crossed], axis=2).reshape(-1, 6)
    kept[(side[mesh.faces] <= 0).all(axis=1)] = False
    source, places = _fans(kept)
    faces = outline[source[:, None], places]
    uv = None
    if mesh.corner_uv is not None:
        uv = _outline_uv(mesh.corner_uv, half_edges, distance, crossed)[source[:, None], places]

    used, faces = np.unique(faces, return_inverse=True)
    every = sparse.csr_array(sparse.vstack([sparse.eye_array(len(distance)), _between(pairs, distance)]))
    carry = every[used]
    return TriangleMesh(carry @ mesh.vertices, faces.reshape(-1, 3), uv), carry


def clip_by_plane(mesh: TriangleMesh, point: Floats, normal: Floats) -> tuple[TriangleMesh, sparse.csr_array]:
    """The part of ``mesh`` on the side of a plane that ``normal`` (unit) points to. Returns what ``clip`` returns."""
    distance = (mesh.vertices - point) @ normal
    return clip_by_surface(mesh, distance, np.broadcast_to(normal, mesh.vertices.shape))


def clip_by_surface(mesh: TriangleMesh, distance: Floats, gradient: Floats) -> tuple[TriangleMesh, sparse.csr_array]:
    """The part of ``mesh`` on one side of a smooth surface, with an even border on it.

    distance: signed distance of every vertex from the surface, shape (n,), near the surface at least. gradient: its
    unit gradient, shape (n, 3). Vertices that all but touch the surface are moved onto it first, so that no sliver is
    left. Returns what ``clip`` returns.
    """
    edges = mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    lengths = np.linalg.norm(mesh.vertices[edges[:, 0]] - mesh.vertices[edges[:, 1]], axis=1)
    shortest = np.zeros(len(distance))
    shortest[edges] = np.inf
    np.minimum.at(shortest, edges, lengths[:, None])
    touching = np.abs(distance) < _SNAP * shortest
    snapped = mesh.vertices - np.where(touching, distance, 0.0)[:, None] * gradient
    return clip(mesh.moved(snapped), np.where(touching, 0.0, distance))


def _between(pairs: Ints, distance: Floats) -> sparse.csr_array:
    """The matrix that makes the vertex on each crossed edge, where ``distance`` is 0."""
    start, end = distance[pairs[:, 0]], distance[pairs[:, 1]]
    share = start / (start - end)
    rows = np.tile(np.arange(len(pairs)), 2)
    weights = np.concatenate([1.0 - share, share])
    return sparse.csr_array((weights, (rows, pairs.T.ravel())), shape=(len(pairs), len(distance)))


def _fans(kept: Mask) -> tuple[Ints, Ints]:
    """Triangles of the convex polygons that masked rows of six places make.

    Returns the row of each triangle, shape (k,), and its places in that row, shape (k, 3).
    """
    count = kept.sum(axis=1)
    order = np.argsort(~kept, axis=1, kind="stable")
    rows = [np.nonzero(count > last)[0] for last in (2, 3)]  # a clipped triangle has three or four corners
    places = [order[row][:, [0, last - 1, last]] for row, last in zip(rows, (2, 3))]
    return np.concatenate(rows), np.concatenate(places)


def _outline_uv(uv: Floats, half_edges: Ints, distance: Floats, crossed: Mask) -> Floats:
    """Texture coordinates of the six places around each triangle, shape (m, 6, 2)."""
    start, end = distance[half_edges[..., 0]], distance[half_edges[..., 1]]
    share = np.divide(start, start - end, out=np.zeros_like(start), where=crossed)[..., None]
    crossing = uv * (1.0 - share) + np.roll(uv, -1, axis=1) * share
    return np.stack([uv, crossing], axis=2).reshape(-1, 6, 2)
