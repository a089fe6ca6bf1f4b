"""Harmonic map of a disc to the unit square: Bando et al. 2006, section 3.2."""

from __future__ import annotations

import igl
import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.linalg import splu

from .cut import Patch
from .mesh import Floats, Ints, TriangleMesh

# The sides of the square in the order of the patch's sides: where each starts, and where it goes.
_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def map_to_square(patch: Patch) -> tuple[Floats, str]:
    """Coordinates in the unit square for every vertex of a disc with four sides, shape (n, 2), and how they were found.

    Each side lies on a side of the square by its arc length. The map is harmonic (cotangent weights); where that turns
    a triangle over, which obtuse triangles can do, weights are mean value coordinates (Floater 2003): they are
    positive, and a positive convex combination map to a convex outline is one to one.
    """
    mesh = patch.disc.mesh
    border = np.concatenate([side[:-1] for side in patch.sides])
    placed = np.concatenate([_along(mesh.vertices[side], k)[:-1] for k, side in enumerate(patch.sides)])
    uv = igl.harmonic(mesh.vertices, mesh.faces, border, placed, 1)
    if _keeps_orientation(uv, mesh.faces):
        return uv, "harmonic"
    uv = _convex_combination(mean_value_weights(mesh), border, placed)
    if _keeps_orientation(uv, mesh.faces):
        return uv, "mean value"
    edges = igl.adjacency_matrix(mesh.faces)
    return _convex_combination(csr_array(edges.astype(np.float64)), border, placed), "Tutte"


def mean_value_weights(mesh: TriangleMesh) -> csr_array:
    """Mean value weights of every vertex for its neighbours, (n, n), all positive: Floater 2003.

    w_ij = (tan(a / 2) + tan(b / 2)) / |x_j - x_i| with the angles a, b at vertex i on both sides of the edge to j.
    """
    half_tangents = np.tan(igl.internal_angles(mesh.vertices, mesh.faces) / 2)
    rows, columns, values = [], [], []
    for k in range(3):
        at = mesh.faces[:, k]
        for other in (1, 2):
            to = mesh.faces[:, (k + other) % 3]
            rows.append(at)
            columns.append(to)
            values.append(half_tangents[:, k] / np.linalg.norm(mesh.vertices[to] - mesh.vertices[at], axis=1))
    size = len(mesh.vertices)
    return coo_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(size, size)
    ).tocsr()


def _along(curve: Floats, side: int) -> Floats:
    """Points on one side of the square, spaced as the curve's points are along the curve, shape (k, 2)."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    part = (length / length[-1])[:, None]
    return (1 - part) * _CORNERS[side] + part * _CORNERS[(side + 1) % 4]


def _keeps_orientation(uv: Floats, faces: Ints) -> bool:
    return bool(signed_areas(uv, faces).min() > 0)


def signed_areas(uv: Floats, faces: Ints) -> Floats:
    """Area of every triangle in the square, negative where it is turned over, shape (m,)."""
    first, second = uv[faces[:, 1]] - uv[faces[:, 0]], uv[faces[:, 2]] - uv[faces[:, 0]]
    return 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def _convex_combination(weights: csr_array, border: Ints, placed: Floats) -> Floats:
    """Positions where every vertex off the border is the weighted mean of its neighbours, shape (n, 2)."""
    size = weights.shape[0]
    inner = np.setdiff1d(np.arange(size), border)
    uv = np.empty((size, 2))
    uv[border] = placed
    rows = weights[inner]
    total = rows.sum(axis=1)
    system = -rows[:, inner].tocsc()
    system.setdiag(total)
    uv[inner] = splu(system.tocsc()).solve(rows[:, border] @ placed)
    return uv
