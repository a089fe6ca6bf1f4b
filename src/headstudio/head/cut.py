"""Cutting a patch out of a triangle mesh along a closed curve, through the triangles and not along their edges.

The curve becomes a chain of edges (see trace.py). Both sides of the cut share every new vertex exactly, and since a
split never leaves its triangle, the surface keeps its shape.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import igl
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .head import HeadError
from .locate import SurfacePoints
from .mesh import Floats, Ints, TriangleMesh
from .refine import ShadedMesh
from .splitting import SplittableMesh
from .trace import insert_knots, split_chords, trace_loop


@dataclass(frozen=True, eq=False)
class Patch:
    """A disc cut out of a surface.

    disc: oriented like the surface. sides: for each piece of its boundary the vertices along it, both ends included,
    counter-clockwise.
    """

    disc: ShadedMesh
    sides: tuple[Ints, ...]


def cut_patch(surface: ShadedMesh, sides: Sequence[SurfacePoints]) -> Patch:
    """The part of ``surface`` on the left, seen from outside, of a closed curve made of ``sides``.

    Each side ends where the next one begins. Raises HeadError when the curve crosses or touches itself, meets a hole,
    or does not bound a disc.
    """
    knots = SurfacePoints(
        np.concatenate([side.faces[:-1] for side in sides]), np.concatenate([side.weights[:-1] for side in sides])
    )
    corners = np.cumsum([0, *(len(side.faces) - 1 for side in sides[:-1])]).tolist()
    near = _faces_near(surface.mesh, knots.blend(surface.mesh.vertices, surface.mesh.faces))
    mesh = SplittableMesh(surface, near)
    vertices = insert_knots(mesh, surface.mesh.faces, knots, corners)
    corner_vertices = [vertices[k] for k in corners]
    loop = trace_loop(mesh, [vertex for vertex in vertices if vertex >= 0], corner_vertices)
    split_chords(mesh, loop)
    return _patch_on_the_left(surface, near, mesh, loop, corner_vertices)


def _faces_near(surface: TriangleMesh, curve: Floats) -> Ints:
    """Faces that the curve through these points [m], shape (k, 3), can meet: (m,)."""
    corners = surface.vertices[surface.faces]
    centres = corners.mean(axis=1)
    radii = np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1)
    step = np.linalg.norm(np.diff(curve, axis=0, append=curve[:1]), axis=1).max()
    distance, _ = cKDTree(curve).query(centres)
    return np.flatnonzero(distance <= 2 * (radii + step))


def _patch_on_the_left(
    surface: ShadedMesh, replaced: Ints, mesh: SplittableMesh, loop: list[int], corners: list[int]
) -> Patch:
    """The disc inside ``loop``, from the surface with the triangles ``replaced`` by those of ``mesh``."""
    added = range(len(surface.mesh.vertices), mesh.next_vertex)
    vertices = np.concatenate([surface.mesh.vertices, *(mesh.positions[v][None] for v in added)])
    normals = np.concatenate([surface.normals, *(mesh.normals[v][None] for v in added)])
    faces = np.concatenate([np.delete(surface.mesh.faces, replaced, axis=0), mesh.faces()])

    faces = faces[_faces_left_of(faces, np.array(loop), mesh.next_vertex)]
    used, compact = np.unique(faces, return_inverse=True)
    patch = TriangleMesh(vertices[used], compact.reshape(-1, 3))
    border = np.searchsorted(used, [*loop, loop[0]])
    if not _is_disc(patch, len(loop)):
        raise HeadError("the curves around the scalp do not enclose one piece of skin without holes")
    ends = [*(loop.index(corner) for corner in corners), len(loop)]
    if ends != sorted(ends):
        raise HeadError("the curves around the scalp do not follow one after the other")
    unit = normals[used] / np.maximum(np.linalg.norm(normals[used], axis=1, keepdims=True), np.finfo(float).tiny)
    return Patch(ShadedMesh(patch, unit), tuple(border[start : end + 1] for start, end in pairwise(ends)))


def _faces_left_of(faces: Ints, loop: Ints, vertex_count: int) -> Ints:
    """Indices of the faces that one reaches from the left of the loop without crossing it."""
    ahead = np.roll(loop, -1)
    to, fro = loop * vertex_count + ahead, ahead * vertex_count + loop
    edges = (faces * vertex_count + np.roll(faces, -1, axis=1)).reshape(-1)
    owner = np.repeat(np.arange(len(faces)), 3)
    left, right = owner[np.isin(edges, to)], owner[np.isin(edges, fro)]

    open_edges = _undirected(faces, vertex_count)
    passable = np.flatnonzero(~np.isin(open_edges, np.minimum(to, fro)))
    order = passable[np.argsort(open_edges[passable], kind="stable")]
    shared = np.flatnonzero(np.diff(open_edges[order]) == 0)
    pairs = owner[order[shared]], owner[order[shared + 1]]
    links = coo_array((np.ones(len(shared), dtype=bool), pairs), shape=(len(faces), len(faces)))
    _, piece = connected_components(links, directed=False)
    if np.intersect1d(piece[left], piece[right]).size:
        raise HeadError("the curves around the scalp do not separate it from the rest of the skin")
    return np.flatnonzero(np.isin(piece, piece[left]))


def _is_disc(mesh: TriangleMesh, border_count: int) -> bool:
    pieces, _ = igl.facet_components(mesh.faces)
    edges, times = np.unique(_undirected(mesh.faces, len(mesh.vertices)), return_counts=True)
    euler = len(mesh.vertices) - len(edges) + len(mesh.faces)
    return bool(pieces == 1 and euler == 1 and times.max() <= 2 and (times == 1).sum() == border_count)


def _undirected(faces: Ints, vertex_count: int) -> Ints:
    """One number for every side of every triangle, the same for both triangles at an edge, (3 m,)."""
    other = np.roll(faces, -1, axis=1)
    return (np.minimum(faces, other) * vertex_count + np.maximum(faces, other)).reshape(-1)
