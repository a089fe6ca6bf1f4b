"""The mouth: where the lips meet, and what is behind them.

A sculpture or a scan with closed lips has a groove for a mouth and nothing behind it. What would be seen when the jaw opens
is put there: two rows of teeth and a tongue, of usual size.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh
from scipy.ndimage import median_filter

from .head import Head, Landmarks, Part
from .locate import locator
from .mesh import Floats, TriangleMesh
from .teeth import dental_row

SEAM_REACH = 0.45
"""The seam between the lips is looked for within this part of the half width of the mouth, above and below the corners."""

_COLUMNS = 25
_LEVELS = 61
# Lips stand out before a groove by at most this part of the height of the head: what is deeper is an open mouth.
_GROOVE = 0.045
# In parts of the height of the head. Half the width of a row of teeth and its depth; how far behind the seam it begins.
_HALF_ROW, _ROW, _BEHIND = 0.142, 0.195, 0.040
# From the seam down: edge and end of the gum of the upper and of the lower row; upper teeth bite over the lower.
_UPPER, _LOWER = (0.012, -0.048), (0.009, 0.043)
# Middle of the tongue, down and back from the seam, and its half axes.
_TONGUE_LIES = (0.046, 0.165)
_TONGUE = (0.088, 0.032, 0.115)
# All of these stay so far behind skin, which will move.
_CLEAR = 0.022


def with_mouth(head: Head) -> Head:
    """The head with teeth and a tongue behind its lips, where these are closed and it has none."""
    if any(part.kind in ("teeth", "tongue") for part in head.parts):
        return head
    marks = head.landmarks
    height = float(marks.crown[1] - marks.chin[1])
    seam = lip_seam(head.skin, marks)
    across, level = seam[_COLUMNS // 2]
    lips = np.array(
        [[across, level + share * SEAM_REACH * (seam[-1, 0] - across)] for share in (-1.0, -0.5, 0.0, 0.5, 1.0)]
    )
    depth = seen_from_front(head.skin, lips)
    if depth.max() - depth[2] > _GROOVE * height:
        return head
    front = np.array([across, level, depth[2]])
    parts = _behind(front, height)
    short = _CLEAR * height - _room(parts, head.skin)
    if short > 0:
        parts = _behind(front - [0.0, 0.0, short], height)
        if _room(parts, head.skin) < 0.5 * _CLEAR * height:
            return head  # there is skin inside: lips that meet before a mouth
    return replace(head, parts=(*head.parts, *parts))


def _behind(front: Floats, height: float) -> list[Part]:
    """Teeth and tongue behind the middle of a seam at ``front`` [m], (3,), in a head so high [m]."""
    rows = [
        Part("teeth", dental_row(_place_of_row(front, height, down), upper=upper))
        for down, upper in ((_UPPER, True), (_LOWER, False))
    ]
    return [*rows, _tongue(front, height)]


def _room(parts: list[Part], skin: TriangleMesh) -> float:
    """How far it is from parts of the mouth to the skin before them [m]; 0 where one is not behind skin."""
    starts = np.concatenate([part.mesh.vertices for part in parts])
    distance = locator(skin).first_hit(starts, np.broadcast_to([0.0, 0.0, 1.0], starts.shape))
    return float(np.where(np.isfinite(distance), distance, 0.0).min())


def lip_seam(skin: TriangleMesh, marks: Landmarks) -> Floats:
    """Where the lips meet as seen from the front: points (x, y) from the right corner to the left [m], (25, 2)."""
    x = np.linspace(marks.mouth_right[0], marks.mouth_left[0], _COLUMNS)
    share = np.linspace(0.0, 1.0, _COLUMNS)
    corner = (1 - share) * marks.mouth_right[1] + share * marks.mouth_left[1]
    reach = SEAM_REACH * 0.5 * float(np.linalg.norm(marks.mouth_left - marks.mouth_right))
    offset = np.linspace(-reach, reach, _LEVELS)
    across = np.stack(np.broadcast_arrays(x[:, None], corner[:, None] + offset), axis=2)
    depth = seen_from_front(skin, across.reshape(-1, 2)).reshape(_COLUMNS, _LEVELS)
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


def _place_of_row(front: Floats, height: float, down: tuple[float, float]) -> TriangleMesh:
    """The place of a row of teeth, as coarse as ``dental_row`` needs it. front: the middle of the seam [m], (3,)."""
    x, y, z = front
    levels = y - height * np.array(down)
    first = z - height * _BEHIND
    ends = [(x + side * height * _HALF_ROW, level, first - height * _ROW) for side in (-1, 1) for level in levels]
    middle = [(x, level, first) for level in levels]
    return TriangleMesh(np.array([*ends, *middle]), np.array([[0, 1, 4], [1, 5, 4], [2, 4, 3], [3, 4, 5]]))


def _tongue(front: Floats, height: float) -> Part:
    ball = trimesh.creation.icosphere(subdivisions=3)
    down, back = _TONGUE_LIES
    vertices = front - height * np.array([0.0, down, back]) + height * np.array(_TONGUE) * ball.vertices
    return Part("tongue", TriangleMesh(vertices, np.asarray(ball.faces)))
