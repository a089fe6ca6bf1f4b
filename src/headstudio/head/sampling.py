"""Random points on a surface, even by area (thesis, section 3.5)."""

from __future__ import annotations

import numpy as np

from .mesh import Floats, TriangleMesh


def sample_surface(mesh: TriangleMesh, spacing: float, seed: int = 0) -> tuple[Floats, Floats]:
    """Positions [m] and interpolated normals of random points, one per ``spacing`` squared [m^2], (k, 3) each."""
    rng = np.random.default_rng(seed)
    areas = mesh.face_areas
    count = max(1000, int(areas.sum() / spacing**2))
    face = rng.choice(len(areas), size=count, p=areas / areas.sum())
    a, b = rng.random((2, count))
    fold = a + b > 1.0
    a, b = np.where(fold, 1.0 - a, a), np.where(fold, 1.0 - b, b)
    weights = np.stack([1.0 - a - b, a, b], axis=1)
    corners = mesh.faces[face]
    positions = np.einsum("ij,ijk->ik", weights, mesh.vertices[corners])
    return positions, np.einsum("ij,ijk->ik", weights, mesh.vertex_normals[corners])
