"""A triangle mesh whose edges and triangles can be split one by one, without changing its shape."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .head import HeadError
from .mesh import Floats, Ints
from .refine import ShadedMesh


class SplittableMesh:
    """Some triangles of a surface, as they are split.

    ``opposite[a][b]`` is the third corner of the triangle that has the edge from a to b, counter-clockwise; vertices
    keep their number in the surface, new ones follow. ``positions`` [m] and ``normals`` are by vertex, each (3,); the
    normals of new vertices are blended and not unit.
    """

    def __init__(self, surface: ShadedMesh, faces: Ints) -> None:
        """Raises HeadError when two of the triangles lie on the same side of an edge."""
        triangles = surface.mesh.faces[faces]
        used = np.unique(triangles)
        self.positions: dict[int, Floats] = dict(zip(used.tolist(), surface.mesh.vertices[used]))
        self.normals: dict[int, Floats] = dict(zip(used.tolist(), surface.normals[used]))
        self.opposite: dict[int, dict[int, int]] = {vertex: {} for vertex in used.tolist()}
        self.next_vertex = len(surface.mesh.vertices)
        for a, b, c in triangles.tolist():
            if b in self.opposite[a] or c in self.opposite[b] or a in self.opposite[c]:
                raise HeadError("three sheets of skin meet in an edge along the scalp's border; repair the mesh there")
            self._add(a, b, c)

    def faces(self) -> Ints:
        """All triangles, shape (m, 3)."""
        found = [(a, b, c) for a, edges in self.opposite.items() for b, c in edges.items() if a < b and a < c]
        return np.array(found, dtype=np.int64).reshape(-1, 3)

    def has_edge(self, a: int, b: int) -> bool:
        """Whether a and b are joined."""
        return b in self.opposite[a] or a in self.opposite[b]

    def split_edge(self, a: int, b: int, part: float) -> int:
        """Split the edge from a to b at ``part`` of its length; the new vertex."""
        middle = self._vertex((a, b), (1 - part, part))
        for start, end in ((a, b), (b, a)):
            third = self.opposite[start].get(end)
            if third is not None:
                self._remove(start, end, third)
                self._add(start, middle, third)
                self._add(middle, end, third)
        return middle

    def split_face(self, a: int, b: int, c: int, weights: Sequence[float]) -> int:
        """Split a triangle at the point with these barycentric weights; the new vertex."""
        middle = self._vertex((a, b, c), weights)
        self._remove(a, b, c)
        for start, end in ((a, b), (b, c), (c, a)):
            self._add(start, end, middle)
        return middle

    def _add(self, a: int, b: int, c: int) -> None:
        self.opposite[a][b], self.opposite[b][c], self.opposite[c][a] = c, a, b

    def _remove(self, a: int, b: int, c: int) -> None:
        del self.opposite[a][b], self.opposite[b][c], self.opposite[c][a]

    def _vertex(self, corners: Sequence[int], weights: Sequence[float]) -> int:
        vertex, self.next_vertex = self.next_vertex, self.next_vertex + 1
        blend = np.asarray(weights)
        self.positions[vertex] = blend @ np.array([self.positions[c] for c in corners])
        self.normals[vertex] = blend @ np.array([self.normals[c] for c in corners])
        self.opposite[vertex] = {}
        return vertex
