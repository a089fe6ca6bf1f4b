"""Finding the plane that mirrors a body onto itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .mesh import Floats, TriangleMesh

_DIRECTIONS = 150
_REFINEMENTS = 12
# Part of the points that need not find a partner: a hole in a scan, a lock of hair, a raised arm.
_WITHOUT_PARTNER = 0.2


@dataclass(frozen=True, eq=False)
class MirrorPlane:
    """A plane of symmetry: unit normal, shape (3,), the points p on it with normal . p = offset, and the error.

    error: trimmed mean distance from a mirrored point to the nearest point, in the unit of the points.
    """

    normal: Floats
    offset: float
    error: float

    def mirrored(self, points: Floats) -> Floats:
        """Points, shape (n, 3), on the other side."""
        return points - 2.0 * (points @ self.normal - self.offset)[:, None] * self.normal


def sample_surface(mesh: TriangleMesh, count: int, seed: int = 0) -> Floats:
    """Points spread over the surface in proportion to area, shape (count, 3)."""
    random = np.random.default_rng(seed)
    face = random.choice(len(mesh.faces), count, p=mesh.face_areas / mesh.face_areas.sum())
    first, second = np.sqrt(random.random(count)), random.random(count)
    weights = np.stack([1.0 - first, first * (1.0 - second), first * second], axis=1)
    return np.einsum("ij,ijk->ik", weights, mesh.vertices[mesh.faces[face]])


def mirror_planes(points: Floats, count: int) -> list[MirrorPlane]:
    """The ``count`` best planes of symmetry of points on a surface, shape (n, 3), best first.

    Directions all around, the axes of the file and the principal axes are tried through the middle of the points; the
    best are refined by matching every point with the one nearest to its mirror image.
    """
    tree = cKDTree(points)
    middle = points.mean(axis=0)
    principal = np.linalg.eigh(np.cov((points - middle).T))[1].T
    directions = np.concatenate([np.eye(3), principal, _half_sphere(_DIRECTIONS)])
    few = points[:: max(1, len(points) // 400)]
    rough = [_with_error(tree, few, normal, float(normal @ middle)) for normal in directions]
    rough.sort(key=lambda plane: plane.error)

    found: list[MirrorPlane] = []
    for plane in rough[: 6 * count]:
        fine = _refined(tree, points, plane)
        if all(abs(fine.normal @ other.normal) < np.cos(np.radians(15)) for other in found):
            found.append(fine)
    return sorted(found, key=lambda plane: plane.error)[:count]


def _half_sphere(count: int) -> Floats:
    """Directions spread evenly over a half sphere on a Fibonacci spiral, shape (count, 3)."""
    index = np.arange(count) + 0.5
    height = index / count
    turn = index * np.pi * (3.0 - np.sqrt(5.0))
    radius = np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), height], axis=1)


def _with_error(tree: cKDTree, points: Floats, normal: Floats, offset: float) -> MirrorPlane:
    plane = MirrorPlane(normal, offset, 0.0)
    distance, _ = tree.query(plane.mirrored(points))
    return MirrorPlane(normal, offset, float(np.sort(distance)[: int(len(distance) * (1.0 - _WITHOUT_PARTNER))].mean()))


def _refined(tree: cKDTree, points: Floats, plane: MirrorPlane) -> MirrorPlane:
    """Iterated closest points for a reflection: partners are matched, then the plane is fitted to them."""
    few = points[:: max(1, len(points) // 1200)]
    normal, offset = plane.normal, plane.offset
    for _ in range(_REFINEMENTS):
        distance, partner = tree.query(MirrorPlane(normal, offset, 0.0).mirrored(few))
        near = distance <= np.quantile(distance, 1.0 - _WITHOUT_PARTNER)
        here, there = few[near], tree.data[partner[near]]
        # The best reflection turns (there - its mean) into (here - its mean): its normal is the eigenvector with the
        # smallest eigenvalue of the symmetric cross covariance.
        a, b = here - here.mean(axis=0), there - there.mean(axis=0)
        cross = a.T @ b
        normal = np.linalg.eigh(cross + cross.T)[1][:, 0]
        offset = float(0.5 * normal @ (here.mean(axis=0) + there.mean(axis=0)))
    return _with_error(tree, points[:: max(1, len(points) // 2000)], normal, offset)
