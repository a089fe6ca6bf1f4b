"""What is seen of a skin from the front, and where on it the lips meet."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter

from .head import Landmarks
from .locate import locator
from .mesh import Floats, TriangleMesh

SEAM_REACH = 0.45
"""The seam between the lips is looked for within this part of the half width of the mouth, above and below the corners."""

COLUMNS = 25
_LEVELS = 61


def lip_seam(skin: TriangleMesh, marks: Landmarks) -> Floats:
    """Where the lips meet as seen from the front: points (x, y) from the right corner to the left [m], (25, 2)."""
    x = np.linspace(marks.mouth_right[0], marks.mouth_left[0], COLUMNS)
    share = np.linspace(0.0, 1.0, COLUMNS)
    corner = (1 - share) * marks.mouth_right[1] + share * marks.mouth_left[1]
    reach = SEAM_REACH * 0.5 * float(np.linalg.norm(marks.mouth_left - marks.mouth_right))
    offset = np.linspace(-reach, reach, _LEVELS)
    across = np.stack(np.broadcast_arrays(x[:, None], corner[:, None] + offset), axis=2)
    depth = seen_from_front(skin, across.reshape(-1, 2)).reshape(COLUMNS, _LEVELS)
    # The lips meet in the deepest hollow between two bulges.
    below = np.maximum.accumulate(depth, axis=1)
    above = np.maximum.accumulate(depth[:, ::-1], axis=1)[:, ::-1]
    hollow = np.minimum(below, above) - depth
    found = np.where(hollow.max(axis=1) > 0, offset[hollow.argmax(axis=1)], 0.0)
    found[[0, -1]] = 0.0
    return np.stack([x, corner + median_filter(found, 5, mode="nearest")], axis=1)


def seen_from_front(skin: TriangleMesh, across: Floats) -> Floats:
    """How far forward the skin reaches at each (x, y), (k, 2) [m], (k,); its hindmost point where it has a hole."""
    back, front = skin.bounds[:, 2] + [0.0, 0.1]
    starts = np.column_stack([across, np.full(len(across), front)])
    met = locator(skin).first_hit(starts, np.broadcast_to([0.0, 0.0, -1.0], starts.shape))
    return np.maximum(front - met, back)
