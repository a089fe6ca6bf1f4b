"""Smaller triangles where a curve will be cut, on the same surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .mesh import Floats, Ints, TriangleMesh


@dataclass(frozen=True, eq=False)
class ShadedMesh:
    """A mesh with the unit normals, (n, 3), of the smooth surface that it stands for."""

    mesh: TriangleMesh
    normals: Floats


def refine_near(surface: ShadedMesh, curve: Floats, longest: float) -> ShadedMesh:
    """The same surface with no edge longer than ``longest`` [m] that comes within that distance of ``curve``.

    curve: points [m], (k, 3), closer together than ``longest``. Edges are halved, round by round, and a triangle
    follows its edges, so that the mesh stays joined; normals are blended along the edges.
    """
    tree = cKDTree(curve)
    vertices, faces, normals = surface.mesh.vertices, surface.mesh.faces, surface.normals
    while True:
        ends = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2), axis=2)
        start, end = vertices[ends[..., 0]], vertices[ends[..., 1]]
        length = np.linalg.norm(end - start, axis=2)
        split = length > longest
        # The whole edge lies within half its length of its middle.
        split[split] = tree.query((start + end)[split] / 2)[0] <= longest + length[split] / 2
        if not split.any():
            return surface if faces is surface.mesh.faces else ShadedMesh(TriangleMesh(vertices, faces), normals)
        edges, index = np.unique(ends[split] @ [len(vertices), 1], return_inverse=True)
        edges = np.stack(np.divmod(edges, len(vertices)), axis=1)
        middle = np.full(faces.shape, -1)
        middle[split] = len(vertices) + index
        vertices = np.concatenate([vertices, vertices[edges].mean(axis=1)])
        blended = normals[edges].sum(axis=1)
        normals = np.concatenate([normals, blended / np.linalg.norm(blended, axis=1, keepdims=True)])
        faces = _split_faces(faces, middle)


def _split_faces(faces: Ints, middle: Ints) -> Ints:
    """Triangles split at the vertices ``middle`` of their edges 0-1, 1-2 and 2-0, where there is one (not -1)."""
    count = (middle >= 0).sum(axis=1)
    # Turn every triangle so that a lone split edge, or the first of two in a row, is its edge 0-1.
    is_first = (middle >= 0) & ((np.roll(middle, 1, axis=1) < 0) | (count == 3)[:, None])
    turn = (np.argmax(is_first, axis=1)[:, None] + np.arange(3)) % 3
    (a, b, c), (ab, bc, ca) = np.take_along_axis(faces, turn, 1).T, np.take_along_axis(middle, turn, 1).T
    pieces = {
        0: [(a, b, c)],
        1: [(a, ab, c), (ab, b, c)],
        2: [(ab, b, bc), (a, ab, bc), (a, bc, c)],
        3: [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)],
    }
    return np.concatenate([np.stack(piece, axis=1)[count == k] for k in pieces for piece in pieces[k]])
