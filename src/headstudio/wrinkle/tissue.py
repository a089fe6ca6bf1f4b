"""Tissue under the skin: where skin is pressed together it is pushed out (Bando's thesis, section 2.5.2)."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ..head.mesh import Floats, Ints, TriangleMesh

# A triangle counts as pressed together or drawn apart by no more than this: below, volume would ask for spikes.
_EXPANSION = (0.25, 4.0)


class TissueLift:
    """Lifts the skin of one mesh, or the part of it that moves.

    faces: the triangles that may change, (m, 3), None for all. What only depends on the mesh is made once.
    """

    def __init__(self, mesh: TriangleMesh, faces: Ints | None = None) -> None:
        self._faces = mesh.faces if faces is None else faces
        count = len(mesh.vertices)
        self.vertices: Ints = np.unique(self._faces)
        local = np.zeros(count, dtype=np.int64)
        local[self.vertices] = np.arange(len(self.vertices))
        corner = local[self._faces]
        self._corners = tuple(np.ascontiguousarray(corner[:, k]) for k in range(3))
        triangles = np.repeat(np.arange(len(corner)), 3)
        shape = (len(self.vertices), len(corner))
        self._around = sparse.csr_array((np.ones(corner.size), (corner.ravel(), triangles)), shape=shape)
        self._degree = np.maximum(self._around.sum(axis=1), 1.0)
        self._rest_area = np.linalg.norm(self._crosses(mesh.vertices[self.vertices]), axis=1)

    def expansion(self, positions: Floats) -> Floats:
        """Area expansion ratio e of the vertices that may change: the mean over their triangles, (k,).

        positions: of all vertices of the mesh [m], (n, 3).
        """
        return self._mean_ratio(self._crosses(positions[self.vertices]))

    def lifted(self, positions: Floats, thickness: Floats) -> Floats:
        """``positions``, (n, 3) [m], displaced along their normals by h / e - h with the thickness h at rest [m], (n,)."""
        crosses = self._crosses(positions[self.vertices])
        rest = thickness[self.vertices]
        height = rest / self._mean_ratio(crosses) - rest
        normals = self._around @ crosses
        length = np.sqrt(np.einsum("ij,ij->i", normals, normals))
        lifted = positions.copy()
        lifted[self.vertices] += (height / np.maximum(length, 1e-30))[:, None] * normals
        return lifted

    def _crosses(self, points: Floats) -> Floats:
        """Twice the area of every triangle along its normal [m^2], (m, 3)."""
        a, b, c = (points[corner] for corner in self._corners)
        b -= a
        c -= a
        crosses = np.empty_like(b)
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            crosses[:, k] = b[:, i] * c[:, j] - b[:, j] * c[:, i]
        return crosses

    def _mean_ratio(self, crosses: Floats) -> Floats:
        area = np.sqrt(np.einsum("ij,ij->i", crosses, crosses))
        ratio = np.divide(area, self._rest_area, out=np.ones_like(area), where=self._rest_area > 0)
        mean: Floats = self._around @ np.clip(ratio, *_EXPANSION) / self._degree
        return mean
