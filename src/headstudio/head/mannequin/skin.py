"""The skin of the mannequin: one half from the field, evened, charted and mirrored. Millimetres."""

from __future__ import annotations

import igl
import numpy as np

from ..mesh import Floats, Ints
from .bust import CUT
from .grain import edge_length
from .polygonise import polygonise
from .remesh import Surface, remesh
from .sculpture import sculpture

# Processors differ in the last digits of a sum or a power, and what is split, merged or turned may hang on them. Millimetres
# and directions are rounded so far, so that the mannequin is the same on all.
_DIGITS = 6
_MIRROR = np.array([-1.0, 1.0, 1.0])
_CROWN = 146.0  # above this height the middle line is the upper side of the chart [mm]


def sculpted_half() -> tuple[Floats, Ints]:
    """Vertices [mm], shape (n, 3), and faces, shape (m, 3), of the left half, open in the middle plane and the cut."""
    vertices, faces = polygonise(sculpture, (0.0, CUT, -160.0), (220.0, 165.0, 150.0), 4.5)
    vertices, _ = _onto_skin(vertices)
    vertices, faces = remesh(vertices, faces, Surface(_onto_skin, edge_length, _planes), rounds=5)
    return _onto_skin(_onto_skin(vertices)[0])[0], faces


def _planes(points: Floats) -> np.ndarray:
    return np.stack([points[:, 0] < 1e-9, points[:, 1] < CUT + 1e-9], axis=1)


def _onto_skin(points: Floats) -> tuple[Floats, Floats]:
    """One Newton step to the skin, and the unit normals; points of the middle plane and of the cut stay in them."""
    planes = _planes(points)
    step = 0.02
    value = sculpture(points)
    slope = np.stack([sculpture(points + step * axis) - value for axis in np.eye(3)], axis=1) / step
    slope[:, :2][planes] = 0.0
    square = np.maximum(np.einsum("ij,ij->i", slope, slope), 0.05)
    points = points - np.clip((value / square)[:, None] * slope, -1.0, 1.0)
    points[:, 0] = np.where(planes[:, 0], 0.0, np.maximum(points[:, 0], 1e-3))
    normals = slope / np.linalg.norm(slope, axis=1, keepdims=True)
    return np.round(points, _DIGITS), np.round(normals, _DIGITS)


def charted(vertices: Floats, faces: Ints) -> Floats:
    """Texture coordinates of the half, shape (n, 2): u from 1/2 in front to 1 at the back, v from the cut to the crown.

    A cylinder's chart, but harmonic, so that chin, nose and ears do not lie over the skin behind them.
    """
    middle = vertices[:, 0] < 1e-9
    crown = middle & (vertices[:, 1] > _CROWN)
    depth, top = vertices[:, 2], vertices[crown, 2]
    front = middle & np.where(crown, depth == top.max(), depth > top.mean())
    back = middle & np.where(crown, depth == top.min(), depth < top.mean())
    u = _harmonic(vertices, faces, front, 0.5, back, 1.0)
    return np.stack([u, _harmonic(vertices, faces, vertices[:, 1] < CUT + 1e-9, 0.0, crown, 1.0)], axis=1)


def _harmonic(
    vertices: Floats, faces: Ints, one: np.ndarray, at_one: float, other: np.ndarray, at_other: float
) -> Floats:
    fixed = np.concatenate([np.flatnonzero(one), np.flatnonzero(other)])
    values = np.repeat([at_one, at_other], [one.sum(), other.sum()])
    return igl.harmonic(vertices, faces, fixed, values[:, None], 1).ravel()


def mirrored(vertices: Floats, faces: Ints, chart: Floats) -> tuple[Floats, Ints, Floats]:
    """The half and its mirror image joined along the middle plane: vertices, faces and chart per corner, (m, 3, 2)."""
    middle = vertices[:, 0] < 1e-9
    twin = np.arange(len(vertices))
    twin[~middle] = len(vertices) + np.arange(np.count_nonzero(~middle))
    other = faces[:, ::-1]
    corners = np.concatenate([chart[faces], np.array([1.0, 0.0]) + np.array([-1.0, 1.0]) * chart[other]])
    return np.concatenate([vertices, vertices[~middle] * _MIRROR]), np.concatenate([faces, twin[other]]), corners
