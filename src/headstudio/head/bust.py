"""From a body to a sculptor's bust: where the body is cut, and which part of the skin turns with the head."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from .clip import clip_by_surface
from .head import Landmarks
from .mesh import TriangleMesh
from .neck import Neck

# The cut is a trough along the line of sight, in heights of the head: so far below the chin in the middle, and rising
# to the sides with the square of the distance, so that it takes off the arms in the same sweep.
_CUT_BELOW_CHIN = 1.0
_CUT_RISE = 0.42

_NECK_LENGTH = 0.5


def cut_bust(mesh: TriangleMesh, landmarks: Landmarks) -> tuple[TriangleMesh, sparse.csr_array]:
    """Head, neck and shoulders of a body [m], with one smooth border through the upper chest and the shoulders.

    Returns the bust and the matrix that makes its vertices from those of ``mesh``, as ``clip`` does.
    """
    height = head_height(landmarks)
    bottom = landmarks.chin[1] - _CUT_BELOW_CHIN * height
    x, y = mesh.vertices[:, 0] / height, (mesh.vertices[:, 1] - bottom) / height
    slope = 2.0 * _CUT_RISE * x
    steepness = np.sqrt(1.0 + slope**2)
    gradient = np.stack([-slope, np.ones_like(x), np.zeros_like(x)], axis=1) / steepness[:, None]
    return clip_by_surface(mesh, (y - _CUT_RISE * x**2) / steepness * height, gradient)


def head_height(landmarks: Landmarks) -> float:
    """From the chin up to the crown [m]."""
    return float(landmarks.crown[1] - landmarks.chin[1])


def neck_of(landmarks: Landmarks) -> Neck:
    """Half as long as the head is high. It begins under the chin and rises to the back as the jaw does, so that the chin
    stays with the head."""
    height = head_height(landmarks)
    jaw = landmarks.chin - landmarks.nape
    slope = np.clip(-jaw[1] / max(jaw[2], 1e-9), 0.0, 0.6)
    upward = np.array([0.0, 1.0, slope]) / np.hypot(1.0, slope)
    start = landmarks.chin - np.array([0.0, 0.03 * height, 0.0])
    return Neck(upward, float(start @ upward), _NECK_LENGTH * height)
