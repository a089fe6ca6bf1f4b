"""Catmull-Clark subdivision of quads (Catmull and Clark 1978), as a sparse matrix that carries anything along."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .mesh import Floats, Ints, TriangleMesh


@dataclass(frozen=True, eq=False)
class QuadMesh:
    """A mesh of quadrilaterals.

    vertices: positions, shape (n, 3). faces: vertex indices, counter-clockwise seen from outside, shape (m, 4).
    corner_uv: texture coordinates per face corner, shape (m, 4, 2).
    """

    vertices: Floats
    faces: Ints
    corner_uv: Floats

    def selected(self, keep: NDArray[np.bool_] | None = None) -> tuple[QuadMesh, Ints]:
        """The faces where ``keep`` is true, shape (m,), or all, without loose vertices; and the vertices' old indices."""
        kept = np.arange(len(self.faces)) if keep is None else np.nonzero(keep)[0]
        old, faces = np.unique(self.faces[kept], return_inverse=True)
        return QuadMesh(self.vertices[old], faces.reshape(-1, 4), self.corner_uv[kept]), old

    def triangulated(self) -> TriangleMesh:
        """Every quad split along its shorter diagonal."""
        a, b, c, d = (self.vertices[self.faces[:, k]] for k in range(4))
        first_is_shorter = np.linalg.norm(a - c, axis=1) <= np.linalg.norm(b - d, axis=1)
        corners = np.where(first_is_shorter[:, None], [0, 1, 2, 0, 2, 3], [0, 1, 3, 1, 2, 3])
        rows = np.arange(len(self.faces))[:, None]
        return TriangleMesh(
            self.vertices, self.faces[rows, corners].reshape(-1, 3), self.corner_uv[rows, corners].reshape(-1, 3, 2)
        )


def catmull_clark(mesh: QuadMesh) -> tuple[QuadMesh, sparse.csr_array]:
    """One step of Catmull-Clark subdivision, and the matrix that makes the new vertices from the old ones.

    The matrix has shape (new vertices, old vertices); whatever is linear in the vertices (offsets of an expression,
    weights) goes through it too. Borders become cubic B-splines. Texture coordinates are split evenly inside every face.
    """
    count, faces = len(mesh.vertices), mesh.faces
    half_edges = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
    edges, edge_of = np.unique(np.sort(half_edges, axis=1), axis=0, return_inverse=True)
    edge_of = edge_of.reshape(-1)
    faces_at_edge = np.bincount(edge_of, minlength=len(edges))
    inner_edge = faces_at_edge == 2

    face_points = _incidence(faces, count) / 4.0
    midpoints = _incidence(edges, count) / 2.0
    face_of_half_edge = np.repeat(np.arange(len(faces)), 4)
    faces_of_edge = _matrix(edge_of, face_of_half_edge, (len(edges), len(faces)))
    mean_of_faces = _scaled_rows(faces_of_edge, 1.0 / faces_at_edge) @ face_points
    edge_points = _scaled_rows(midpoints, np.where(inner_edge, 0.5, 1.0)) + _scaled_rows(
        mean_of_faces, np.where(inner_edge, 0.5, 0.0)
    )

    vertex_points = _vertex_points(count, faces, edges, inner_edge, face_points, midpoints)
    carry = sparse.csr_array(sparse.vstack([vertex_points, edge_points, face_points]))

    after = count + edge_of.reshape(-1, 4)
    before = np.roll(after, 1, axis=1)
    middle = np.broadcast_to((count + len(edges) + np.arange(len(faces)))[:, None], faces.shape)
    new_faces = np.stack([faces, after, middle, before], axis=2).reshape(-1, 4)
    return QuadMesh(carry @ mesh.vertices, new_faces, _split_uv(mesh.corner_uv)), carry


def _vertex_points(
    count: int,
    faces: Ints,
    edges: Ints,
    inner_edge: NDArray[np.bool_],
    face_points: sparse.csr_array,
    midpoints: sparse.csr_array,
) -> sparse.csr_array:
    """Where the old vertices go: (F + 2 R + (n - 3) P) / n inside, (R + P) / 2 with the border's own R on a border."""
    around_faces = _incidence(faces, count).T
    valence = np.maximum(around_faces.sum(axis=1), 1.0)
    around_edges = _incidence(edges, count).T
    edge_valence = np.maximum(around_edges.sum(axis=1), 1.0)
    inner = (
        _scaled_rows(around_faces @ face_points, 1.0 / valence**2)
        + _scaled_rows(around_edges @ midpoints, 2.0 / (edge_valence * valence))
        + sparse.diags_array((valence - 3.0) / valence)
    )
    border_edges = _incidence(edges[~inner_edge], count).T
    border_valence = np.asarray(border_edges.sum(axis=1))
    on_border = border_valence > 0
    border = _scaled_rows(border_edges @ midpoints[~inner_edge], 0.5 / np.maximum(border_valence, 1.0))
    border = border + 0.5 * sparse.eye_array(count)
    return _scaled_rows(inner, np.where(on_border, 0.0, 1.0)) + _scaled_rows(border, np.where(on_border, 1.0, 0.0))


def _split_uv(uv: Floats) -> Floats:
    """Texture coordinates of the four quads in each quad, shape (m, 4, 2) to (4 m, 4, 2)."""
    after = 0.5 * (uv + np.roll(uv, -1, axis=1))
    middle = np.broadcast_to(uv.mean(axis=1, keepdims=True), uv.shape)
    return np.stack([uv, after, middle, np.roll(after, 1, axis=1)], axis=2).reshape(-1, 4, 2)


def _incidence(rows: Ints, columns: int) -> sparse.csr_array:
    """1 where row i names column j, for rows of k indices each."""
    return _matrix(np.repeat(np.arange(len(rows)), rows.shape[1]), rows.ravel(), (len(rows), columns))


def _matrix(rows: Ints, columns: Ints, shape: tuple[int, int]) -> sparse.csr_array:
    return sparse.csr_array((np.ones(len(rows)), (rows, columns)), shape=shape)


def _scaled_rows(matrix: sparse.csr_array, factors: Floats) -> sparse.csr_array:
    return sparse.csr_array(sparse.diags_array(factors) @ matrix)
