"""How fine the triangles of the mannequin are, and where."""

from __future__ import annotations

import numpy as np

from ..mesh import Floats

# Boxes as centre, half extent and edge length inside [mm], on the left half.
_BOXES = (
    ((31.6, 37.6, 85), (15.5, 5, 9), 0.95),  # slit between the lids
    ((31.6, 38, 82), (22, 13, 14), 2.1),  # eye
    ((12, -29, 100), (15, 2.5, 12), 1.05),  # between the lips
    ((12, -29, 100), (15, 10, 12), 1.9),  # lips
    ((6, -4, 107), (7, 5, 8), 1.4),  # nostril
    ((0, 5, 105), (16, 28, 20), 2.1),  # nose
    ((79, 22, -10), (14, 34, 22), 1.75),  # ear
    ((0, 0, 70), (60, 70, 40), 3.4),  # face
    ((0, 40, -10), (80, 100, 110), 4.4),  # head and neck
    ((60, -140, 5), (80, 30, 25), 4.2),  # collar bone
)
_COARSEST, _GROWTH = 7.0, 0.24


def edge_length(points: Floats) -> Floats:
    """Wanted length of edges [mm] at points of shape (n, 3): it grows by a fifth of the way from a finer box."""
    length = np.full(len(points), _COARSEST)
    x, y, z = np.ascontiguousarray(points.T)
    for centre, half, finest in _BOXES:
        away = [np.maximum(np.abs(q - c) - h, 0.0) for q, c, h in zip((x, y, z), centre, half)]
        np.minimum(length, finest + _GROWTH * np.sqrt(away[0] ** 2 + away[1] ** 2 + away[2] ** 2), out=length)
    return length
