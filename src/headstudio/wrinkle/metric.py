"""Lengths on the skin, measured in texture space: the first fundamental form of a texture map."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats, TriangleMesh
from .texture_map import TextureMap


def face_metrics(mesh: TriangleMesh, corners: Floats) -> Floats:
    """G of every triangle [m^2], (m, 2, 2): a step a in texture space is sqrt(a . G a) long on the skin.

    corners: the triangles in texture space, (m, 3, 2), none without area.
    """
    space = mesh.vertices[mesh.faces]
    skin_edges = np.stack([space[:, 1] - space[:, 0], space[:, 2] - space[:, 0]], axis=1)
    plane_edges = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=1)
    jacobian = np.linalg.solve(plane_edges, skin_edges)
    return np.einsum("nij,nkj->nik", jacobian, jacobian)


def vertex_metrics(texture_map: TextureMap) -> Floats:
    """G at every vertex, the mean of its triangles by area on the skin, (n, 2, 2)."""
    mesh = texture_map.mesh
    weighted = face_metrics(mesh, texture_map.corner_uv) * mesh.face_areas[:, None, None]
    corners = mesh.faces.ravel()
    count = len(mesh.vertices)
    total = np.bincount(corners, np.repeat(mesh.face_areas, 3), minlength=count)
    sums = [np.bincount(corners, np.repeat(weighted[:, i, j], 3), minlength=count) for i in (0, 1) for j in (0, 1)]
    return (np.stack(sums, axis=1) / np.maximum(total, np.finfo(float).tiny)[:, None]).reshape(-1, 2, 2)


def perpendicular(directions: Floats, metrics: Floats) -> Floats:
    """Directions in texture space that stand square to the given ones on the skin, (k, 2), turned to the left.

    directions: (k, 2). metrics: G there, (k, 2, 2). The result is as long on the skin as the direction given.
    """
    covector = np.einsum("kij,kj->ki", metrics, directions)
    return np.stack([-covector[:, 1], covector[:, 0]], axis=1) / np.sqrt(np.linalg.det(metrics))[:, None]
