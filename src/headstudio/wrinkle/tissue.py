"""Tissue under the skin: where skin is pressed together it is pushed out (Bando's thesis, section 2.5.2)."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints, TriangleMesh
from .vectors import AreaVectors, scaled, unit

SPREAD = 0.010
"""How far tissue that is pressed together gives way to the sides [m]: about as far as it is thick."""

# A triangle counts as pressed together or drawn apart by no more than this: below, volume would ask for spikes.
_EXPANSION = (0.25, 4.0)
# Nodes that a vertex takes the mean of. Two sides of a thin fold are as good as twice this many spreads apart.
_NODES = 14
_FACING = 2.0


class TissueLift:
    """Lifts the skin of one mesh, or the part of it that moves; what only depends on the mesh is made once.

    faces: the triangles that may change, (m, 3), None for all. spread: length over which the tissue evens out how much
    it is pressed [m]; 0 lifts every vertex by itself as the thesis says, and shows the borders of each muscle's field.
    """

    def __init__(self, mesh: TriangleMesh, faces: Ints | None = None, spread: float = SPREAD) -> None:
        self._faces = mesh.faces if faces is None else faces
        self.vertices: Ints = np.unique(self._faces)
        local = np.zeros(len(mesh.vertices), dtype=np.int64)
        local[self.vertices] = np.arange(len(self.vertices))
        corner = local[self._faces]
        self._areas = AreaVectors(corner)
        triangles = np.repeat(np.arange(len(corner)), 3)
        shape = (len(self.vertices), len(corner))
        self._around = sparse.csr_array((np.ones(corner.size, np.float32), (corner.ravel(), triangles)), shape=shape)
        self._degree = np.maximum(self._around.sum(axis=1), 1.0)
        points, normals = mesh.vertices[self.vertices], mesh.vertex_normals[self.vertices]
        self._rest_area = _lengths(self._areas.at(points))
        self._evening = _evening(points, normals, self._around @ self._rest_area, spread) if spread > 0 else None

    def expansion(self, positions: Floats) -> Floats:
        """Area expansion ratio e of the vertices that may change: the mean over their triangles, (k,).

        positions: of all vertices of the mesh [m], (n, 3).
        """
        return self._mean_ratio(self._areas.at(positions[self.vertices]))

    def lifted(self, positions: Floats, thickness: Floats) -> Floats:
        """``positions``, (n, 3) [m], displaced along their normals by h / e - h with the thickness h at rest [m], (n,)."""
        areas = self._areas.at(positions[self.vertices])
        gain = 1.0 / self._mean_ratio(areas) - 1.0
        if self._evening is not None:
            to_nodes, to_vertices = self._evening
            gain = to_vertices @ (to_nodes @ gain)
        normals = unit(self._around @ np.ascontiguousarray(areas.T))
        lifted = positions.copy()
        lifted[self.vertices] += scaled(normals, thickness[self.vertices] * gain)
        return lifted

    def _mean_ratio(self, areas: Floats) -> Floats:
        area = _lengths(areas)
        ratio = np.divide(area, self._rest_area, out=np.ones_like(area), where=self._rest_area > 0)
        mean: Floats = self._around @ np.clip(ratio, *_EXPANSION) / self._degree
        return mean


def _lengths(vectors: Floats) -> Floats:
    """Of vectors by coordinate, (3, m): (m,)."""
    return np.sqrt(vectors[0] ** 2 + vectors[1] ** 2 + vectors[2] ** 2)


def _evening(
    points: Floats, normals: Floats, areas: Floats, spread: float
) -> tuple[sparse.csr_array, sparse.csr_array]:
    """Two matrices that take the local mean of values at vertices: to nodes some ``spread`` apart, and back.

    Both take means, so that what is even stays as it is. Nodes know which way they face: the lining of a cheek is near
    to the cheek, and is none of it.
    """
    places = np.concatenate([points, _FACING * spread * normals], axis=1)
    # Rounded and not cut off, so that both halves of a face have the same nodes.
    cells = np.rint(places / spread).astype(np.int64)
    _, node = np.unique(cells, axis=0, return_inverse=True)
    node = node.ravel()
    count, mass = int(node.max()) + 1, np.maximum(areas, 1e-15)
    total = np.bincount(node, mass)
    to_nodes = sparse.csr_array((mass / total[node], (node, np.arange(len(node)))), shape=(count, len(node)))
    distance, near = cKDTree(to_nodes @ places).query(places, k=min(_NODES, count))
    near, distance = near.reshape(len(node), -1), distance.reshape(len(node), -1)
    # The farthest node counts for nothing: none comes or goes from vertex to vertex.
    reach = np.maximum(distance.max(axis=1, keepdims=True), 1e-6 * spread) * (1 + 1e-9)
    weight = (1.0 - (distance / reach) ** 2) ** 2 * total[near]
    weight /= weight.sum(axis=1, keepdims=True)
    rows = np.repeat(np.arange(len(node)), weight.shape[1])
    return to_nodes, sparse.csr_array((weight.ravel(), (rows, near.ravel())), shape=(len(node), count))
