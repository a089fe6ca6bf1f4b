"""A triangle mesh, and nothing that knows what it shows."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import igl
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """A triangle mesh that shares vertices along every edge.

    vertices: positions [m], shape (n, 3). faces: vertex indices, counter-clockwise seen from outside, shape (m, 3).
    corner_uv: texture coordinates per face corner, shape (m, 3, 2), or None; they belong to corners and not to vertices
    so that a texture seam does not open the surface.
    """

    vertices: Floats
    faces: Ints
    corner_uv: Floats | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", np.ascontiguousarray(self.vertices, dtype=np.float64))
        object.__setattr__(self, "faces", np.ascontiguousarray(self.faces, dtype=np.int64))

    @cached_property
    def face_areas(self) -> Floats:
        """Area of every triangle [m^2], shape (m,)."""
        return 0.5 * np.linalg.norm(self._face_crosses, axis=1)

    @cached_property
    def face_normals(self) -> Floats:
        """Unit normal of every triangle, shape (m, 3); zero for a degenerate one."""
        length = np.linalg.norm(self._face_crosses, axis=1, keepdims=True)
        return np.divide(self._face_crosses, length, out=np.zeros_like(self._face_crosses), where=length > 0)

    @cached_property
    def vertex_normals(self) -> Floats:
        """Unit normal of every vertex, weighted by the angle of its corners, shape (n, 3)."""
        return np.nan_to_num(
            igl.per_vertex_normals(self.vertices, self.faces, igl.PER_VERTEX_NORMALS_WEIGHTING_TYPE_ANGLE)
        )

    @cached_property
    def bounds(self) -> Floats:
        """Lowest and highest corner of the bounding box [m], shape (2, 3)."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

    @cached_property
    def _face_crosses(self) -> Floats:
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        return np.cross(b - a, c - a)

    def shaded(self, normals: Floats) -> TriangleMesh:
        """The same mesh with other ``vertex_normals``, unit, shape (n, 3): those of the smooth surface it stands for."""
        mesh = replace(self)
        mesh.__dict__["vertex_normals"] = normals
        return mesh

    def moved(self, vertices: Floats) -> TriangleMesh:
        """The same surface with other vertex positions [m], shape (n, 3)."""
        return replace(self, vertices=vertices)
