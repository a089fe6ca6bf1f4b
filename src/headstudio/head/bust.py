"""From a body to a sculptor's bust: which part of the skin turns with the head, and where the body is cut."""

from __future__ import annotations

import numpy as np

from .head import Landmarks
from .mesh import Floats


def head_weight(vertices: Floats, landmarks: Landmarks) -> Floats:
    """How much of the head's rotation each vertex takes: 1 on the head, 0 on the torso, shape (n,).

    Between them the weight falls smoothly along the neck, from a plane through the nape and under the chin, over half
    the height of the head. The plane leans forward as the lower jaw does, so that the chin stays with the head.
    """
    height = landmarks.crown[1] - landmarks.chin[1]
    lean = landmarks.chin - landmarks.nape
    # The throat meets the jaw half way from the chin to the nape and a little below the chin.
    slope = np.clip(-lean[1] / max(lean[2], 1e-9), 0.0, 0.6)
    normal = np.array([0.0, 1.0, slope]) / np.hypot(1.0, slope)
    top = landmarks.chin - np.array([0.0, 0.03 * height, 0.0])
    depth = (top - vertices) @ normal / (0.5 * height)
    share = np.clip(depth, 0.0, 1.0)
    return 1.0 - share * share * (3.0 - 2.0 * share)
