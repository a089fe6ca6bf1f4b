"""A mesh with more triangles on the same surface, each vertex at a known place of the coarse mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..head.locate import locator
from ..head.mesh import Floats, Ints, TriangleMesh

# Weights of a point in a triangle add up to 1, but for rounding.
_WITHIN = 1.0 - 1e-9


@dataclass(frozen=True, eq=False)
class RefinedMesh:
    """Triangles that cover a coarse mesh, sharing every edge: no cracks and no T-junctions.

    coarse: n vertices, m triangles; its vertices come first and in order. home: the coarse triangle that each vertex lies
    in, (N,). weights: where in it, (N, 3). faces: (M, 3). parent: the coarse triangle that each of them comes from, (M,).
    vertices: positions on the flat coarse triangles [m], (N, 3).
    """

    coarse: TriangleMesh
    home: Ints
    weights: Floats
    faces: Ints
    parent: Ints
    vertices: Floats

    @classmethod
    def unrefined(cls, coarse: TriangleMesh) -> RefinedMesh:
        """The coarse mesh itself. A vertex without a triangle is put into triangle 0 with no weight; it never moves."""
        count = len(coarse.vertices)
        home, weights = np.zeros(count, dtype=np.int64), np.zeros((count, 3))
        for k in range(3):
            corner = coarse.faces[:, k]
            home[corner] = np.arange(len(coarse.faces))
            weights[corner] = 0.0
            weights[corner, k] = 1.0
        return cls(coarse, home, weights, coarse.faces, np.arange(len(coarse.faces)), coarse.vertices)

    @cached_property
    def added(self) -> Ints:
        """The vertices that are not simply a vertex of the coarse mesh: new ones, and those that were moved."""
        count = len(self.coarse.vertices)
        same = (self.weights[:count] == 1.0) & (self.coarse.faces[self.home[:count]] == np.arange(count)[:, None])
        loose = self.weights[:count].sum(axis=1) == 0
        return np.concatenate([np.flatnonzero(~same.any(axis=1) & ~loose), np.arange(count, len(self.home))])

    def interpolation(self, vertices: Ints) -> sparse.csr_array:
        """The matrix, (k, n), that makes anything linear at ``vertices`` from its values at the coarse vertices."""
        columns = self.coarse.faces[self.home[vertices]].ravel()
        pointers = 3 * np.arange(len(vertices) + 1)
        matrix = sparse.csr_array(
            (self.weights[vertices].ravel(), columns, pointers), shape=(len(vertices), len(self.coarse.vertices))
        )
        matrix.eliminate_zeros()
        return matrix

    def between(self, edges: Ints, edge_of: Ints) -> tuple[Ints, Floats]:
        """The middles of edges, (e, 2): a coarse triangle that holds each, (e,), and where in it, (e, 3).

        edge_of: which edge the sides 0-1, 1-2 and 2-0 of every triangle are, -1 for others, (M, 3).
        """
        home = np.empty(len(edges), dtype=np.int64)
        has = edge_of >= 0
        home[edge_of[has]] = np.broadcast_to(self.parent[:, None], edge_of.shape)[has]
        theirs, wanted = self.coarse.faces[self.home[edges]], self.coarse.faces[home]
        same = theirs[:, :, :, None] == wanted[:, None, None, :]
        weights = 0.5 * np.einsum("eki,ekij->ej", self.weights[edges], same)
        # Where a vertex was moved, triangles do not lie within their parents.
        astray = np.flatnonzero(weights.sum(axis=1) < _WITHIN)
        if len(astray):
            found, _ = locator(self.coarse).nearest(self.vertices[edges[astray]].mean(axis=1))
            home[astray], weights[astray] = found.faces, found.weights
        return home, weights

    def part(self, chosen: NDArray[np.bool_]) -> RefinedMesh:
        """Only some of the triangles, (M,), with all vertices."""
        return replace(self, faces=self.faces[chosen], parent=self.parent[chosen])

    def border(self, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Which vertices have triangles that are ``chosen``, (M,), and others, (N,)."""
        within, outside = (np.zeros(len(self.home), dtype=bool) for _ in range(2))
        within[self.faces[chosen]] = True
        outside[self.faces[~chosen]] = True
        return within & outside

    def beside(self, other: RefinedMesh) -> RefinedMesh:
        """With the triangles of ``other``, whose vertices are the first of this mesh's own."""
        faces, parent = np.concatenate([other.faces, self.faces]), np.concatenate([other.parent, self.parent])
        return replace(self, faces=faces, parent=parent)

    def split(self, edge_of: Ints, home: Ints, weights: Floats) -> RefinedMesh:
        """The mesh with a new vertex on some of its edges, at ``weights`` in the coarse triangles ``home``, (e,).

        edge_of: for the edges 0-1, 1-2 and 2-0 of every triangle which of these it is, or -1, (M, 3).
        """
        vertices = np.concatenate([self.vertices, self._places(home, weights)])
        middle = np.where(edge_of >= 0, len(self.home) + edge_of, -1)
        cut = (edge_of >= 0).any(axis=1)
        faces, source = _split_triangles(self.faces[cut], middle[cut], vertices)
        return RefinedMesh(
            self.coarse,
            np.concatenate([self.home, home]),
            np.concatenate([self.weights, weights]),
            np.concatenate([self.faces[~cut], faces]),
            np.concatenate([self.parent[~cut], self.parent[cut][source]]),
            vertices,
        )

    def moved(self, vertices: Ints, home: Ints, weights: Floats) -> RefinedMesh:
        """The mesh with some vertices, (k,), at other places of the surface."""
        homes, places, positions = self.home.copy(), self.weights.copy(), self.vertices.copy()
        homes[vertices], places[vertices], positions[vertices] = home, weights, self._places(home, weights)
        return RefinedMesh(self.coarse, homes, places, self.faces, self.parent, positions)

    def _places(self, home: Ints, weights: Floats) -> Floats:
        return np.einsum("ki,kid->kd", weights, self.coarse.vertices[self.coarse.faces[home]])


def _split_triangles(faces: Ints, middle: Ints, vertices: Floats) -> tuple[Ints, Ints]:
    """Triangles split at the vertices on their edges 0-1, 1-2, 2-0 (-1: none), and which triangle each piece is of."""
    split = middle >= 0
    count = split.sum(axis=1)
    # Turned so that a lone split edge is 0-1, and the edge that is left whole is 2-0.
    first = split & ((count == 3)[:, None] | ~np.roll(split, 1, axis=1))
    turn = (first.argmax(axis=1)[:, None] + np.arange(3)) % 3
    (a, b, c), (ab, bc, ca) = np.take_along_axis(faces, turn, 1).T, np.take_along_axis(middle, turn, 1).T

    def distance(p: Ints, q: Ints) -> Floats:
        return np.linalg.norm(vertices[p] - vertices[q], axis=1)

    # Two split edges leave a quadrilateral a ab bc c, three a middle triangle; the quadrilateral takes its shorter
    # diagonal.
    shorter = distance(a, bc) <= distance(ab, c)
    cases = [
        (count == 0, [(a, b, c)]),
        (count == 1, [(a, ab, c), (ab, b, c)]),
        ((count == 2) & shorter, [(ab, b, bc), (a, ab, bc), (a, bc, c)]),
        ((count == 2) & ~shorter, [(ab, b, bc), (a, ab, c), (ab, bc, c)]),
        (count == 3, [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]),
    ]
    pieces = [(np.stack(piece, axis=1)[case], np.flatnonzero(case)) for case, parts in cases for piece in parts]
    return np.concatenate([piece for piece, _ in pieces]), np.concatenate([source for _, source in pieces])
