"""Which triangle holds a point: the lookup behind both directions of the scalp's map, and behind its curves."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import igl
import numpy as np

from .mesh import Floats, Ints, TriangleMesh

# igl takes a ray for parallel to a triangle when a determinant, an area in the units of the mesh, is below 1e-6: in
# metres that is every triangle of a fine head. So rays are cast in millimetres.
_RAY_SCALE = 1000.0


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """Points on a mesh: face indices, shape (k,), and barycentric coordinates in these faces, shape (k, 3)."""

    faces: Ints
    weights: Floats

    def blend(self, values: Floats, corners: Ints) -> Floats:
        """Values given at the vertices, (n, d), of a mesh with faces ``corners``, (m, 3), at these points: (k, d)."""
        return np.einsum("ij,ijk->ik", self.weights, values[corners[self.faces]])


class Locator:
    """Finds the nearest point of a triangle mesh, in space or in the plane, with a tree that is built once.

    igl.AABB knows three dimensions only, so a plane mesh gets a third coordinate of zero. 100,000 points against 40,000
    triangles take about 0.1 s; a grid in numpy was no faster, and needs care for points just outside the mesh.
    """

    def __init__(self, vertices: Floats, faces: Ints) -> None:
        """vertices: (n, 3) or (n, 2). faces: (m, 3). See ``locator`` for a mesh that is asked again and again."""
        self.vertices = _in_space(vertices)
        self.faces = np.ascontiguousarray(faces, dtype=np.int64)
        self._tree = igl.AABB()
        self._tree.init(self.vertices, self.faces)

    def nearest(self, points: Floats) -> tuple[SurfacePoints, Floats]:
        """The points of the mesh nearest to ``points``, (k, 3) or (k, 2), and how far they are, (k,)."""
        if len(points) == 0:
            return SurfacePoints(np.zeros(0, dtype=np.int64), np.zeros((0, 3))), np.zeros(0)
        squared, faces, closest = self._tree.squared_distance(self.vertices, self.faces, _in_space(points))
        weights = barycentric(closest, self.vertices[self.faces[faces]])
        return SurfacePoints(faces, weights), np.sqrt(squared)

    def first_hit(self, starts: Floats, directions: Floats) -> Floats:
        """How far each ray, from (k, 3) along (k, 3), runs before it meets the mesh, (k,); infinite if it does not."""
        tree, vertices = self._tree_for_rays
        hit, distance, _ = tree.intersect_ray_first(
            vertices, self.faces, np.ascontiguousarray(starts * _RAY_SCALE), np.ascontiguousarray(directions)
        )
        return np.where(hit >= 0, distance / _RAY_SCALE, np.inf)

    @cached_property
    def _tree_for_rays(self) -> tuple[igl.AABB, Floats]:
        vertices = self.vertices * _RAY_SCALE
        tree = igl.AABB()
        tree.init(vertices, self.faces)
        return tree, vertices


@lru_cache(maxsize=4)
def locator(mesh: TriangleMesh) -> Locator:
    """The locator of a mesh; that of the last few meshes is kept, so that dragging a curve on a head stays quick."""
    return Locator(mesh.vertices, mesh.faces)


def barycentric(points: Floats, triangles: Floats) -> Floats:
    """Barycentric coordinates of points, (k, 3), in the plane of their triangles, (k, 3, 3): (k, 3), none negative.

    A triangle without area has its points on its longest edge.
    """
    a, b, c = (triangles[:, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    doubled = np.einsum("ij,ij->i", normal, normal)
    flat = doubled <= 0
    scale = np.where(flat, 1.0, doubled)
    weights = np.stack(
        [np.einsum("ij,ij->i", np.cross(q - p, points - p), normal) / scale for p, q in ((b, c), (c, a), (a, b))],
        axis=1,
    )
    if flat.any():
        weights[flat] = _along_longest_edge(points[flat], triangles[flat])
    weights = np.clip(weights, 0.0, None)
    return weights / weights.sum(axis=1, keepdims=True)


def _along_longest_edge(points: Floats, triangles: Floats) -> Floats:
    edges = np.roll(triangles, -1, axis=1) - triangles
    length = np.einsum("ijk,ijk->ij", edges, edges)
    row = np.arange(len(points))
    start = length.argmax(axis=1)
    part = np.einsum("ij,ij->i", points - triangles[row, start], edges[row, start])
    part = np.clip(part / np.maximum(length[row, start], np.finfo(float).tiny), 0.0, 1.0)
    weights = np.zeros((len(points), 3))
    weights[row, start] = 1 - part
    weights[row, (start + 1) % 3] = part
    return weights


def _in_space(points: Floats) -> Floats:
    padded = points if points.shape[1] == 3 else np.pad(points, ((0, 0), (0, 1)))
    return np.ascontiguousarray(padded, dtype=np.float64)
