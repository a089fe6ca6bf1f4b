"""Harmonic map of a disc to the unit square: Bando et al. 2006, section 3.2."""

from __future__ import annotations

import igl
import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.linalg import splu

from .cut import Patch
from .head import HeadError
from .mesh import Floats, Ints, TriangleMesh

# The corners of the square in the order of the patch's sides.
_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
# Angles [rad] and lengths (in mean edge lengths) enter the weights within these bounds: needles and caps would
# otherwise swamp the system with weights 1e9 apart, and the map stays one to one with any positive weights.
_ANGLES = np.radians([0.5, 175.0])
_LENGTHS = 0.02, 50.0
# The shortest piece of a side, as a part of it, for the same reason.
_SHORTEST = 1e-6


def map_to_square(patch: Patch) -> tuple[Floats, str]:
    """Coordinates in the unit square for every vertex of a disc with four sides, (n, 2), and how they were found.

    Each side lies on a side of the square by its arc length. The map is harmonic (cotangent weights). Obtuse triangles
    can make that turn some over; then the weights are mean value coordinates, which are positive, and a map to a convex
    outline with positive weights is one to one (Floater 2003). Raises HeadError when rounding defeats even that.
    """
    mesh = patch.disc.mesh
    border = np.concatenate([side[:-1] for side in patch.sides])
    placed = np.concatenate([_along(mesh.vertices[side], k)[:-1] for k, side in enumerate(patch.sides)])
    uv = igl.harmonic(mesh.vertices, mesh.faces, border, placed, 1)
    if _is_one_to_one(uv, mesh.faces):
        return uv, "harmonic"
    uv = _convex_combination(mean_value_weights(mesh), border, placed)
    if _is_one_to_one(uv, mesh.faces):
        return uv, "mean value"
    raise HeadError("the scalp cannot be flattened: its triangles are too thin; repair or remesh the head")


def mean_value_weights(mesh: TriangleMesh) -> csr_array:
    """Mean value weights of every vertex for its neighbours, (n, n), all positive: Floater 2003.

    w_ij = (tan(a / 2) + tan(b / 2)) / |x_j - x_i| with the angles a, b at vertex i on both sides of the edge to j.
    """
    corners = mesh.vertices[mesh.faces]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    lengths = np.clip(lengths, *(bound * lengths.mean() for bound in _LENGTHS))
    angles = np.nan_to_num(igl.internal_angles(mesh.vertices, mesh.faces))
    half_tangents = np.tan(np.clip(angles, *_ANGLES) / 2)
    # Corner k of a triangle has an edge to the next corner, and one to the last, which is that corner's own next.
    to_next, to_last = half_tangents / lengths, half_tangents / np.roll(lengths, 1, axis=1)
    after, before = np.roll(mesh.faces, -1, axis=1), np.roll(mesh.faces, 1, axis=1)
    rows, columns = np.tile(mesh.faces.ravel(), 2), np.concatenate([after.ravel(), before.ravel()])
    values = np.concatenate([to_next.ravel(), to_last.ravel()])
    return coo_array((values, (rows, columns)), shape=(len(mesh.vertices),) * 2).tocsr()


def signed_areas(uv: Floats, faces: Ints) -> Floats:
    """Area of every triangle in the square, negative where it is turned over, shape (m,)."""
    first, second = uv[faces[:, 1]] - uv[faces[:, 0]], uv[faces[:, 2]] - uv[faces[:, 0]]
    return 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def _is_one_to_one(uv: Floats, faces: Ints) -> bool:
    return bool((signed_areas(uv, faces) > 0).all())


def _along(curve: Floats, side: int) -> Floats:
    """Points on one side of the square, spaced as the curve's points are along the curve, shape (k, 2)."""
    pieces = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(np.maximum(pieces, _SHORTEST * pieces.sum()))])
    part = (length / length[-1])[:, None]
    return (1 - part) * _CORNERS[side] + part * _CORNERS[(side + 1) % 4]


def _convex_combination(weights: csr_array, border: Ints, placed: Floats) -> Floats:
    """Positions where every vertex off the border is the weighted mean of its neighbours, shape (n, 2)."""
    inner = np.setdiff1d(np.arange(weights.shape[0]), border)
    uv = np.empty((weights.shape[0], 2))
    uv[border] = placed
    rows = weights[inner]
    system = -rows[:, inner].tolil()
    system.setdiag(rows.sum(axis=1))
    uv[inner] = splu(system.tocsc()).solve(rows[:, border] @ placed)
    return uv
