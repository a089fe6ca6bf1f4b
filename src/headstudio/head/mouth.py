"""The mouth: where the lips meet, and what is behind them.

A sculpture or a scan with closed lips has a groove for a mouth and nothing behind it. There the lips are cut apart, and what
would be seen when the jaw opens is put behind them: skin that lines the mouth, two rows of teeth and a tongue, of usual size.
"""

from __future__ import annotations

from dataclasses import replace

import igl
import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .head import Head, Landmarks, Part
from .lips import open_lips, parted
from .locate import locator
from .mesh import Floats, TriangleMesh
from .mouth_lining import lined
from .sight import COLUMNS, SEAM_REACH, lip_seam, seen_from_front
from .teeth import dental_row

# Lips stand out before a groove by at most this part of the height of the head: what is deeper is an open mouth.
_GROOVE = 0.045
# Flesh goes on so far behind closed lips, in heights of the head, where one enters them so far beside where they meet, and
# so deep.
_FLESH, _LIP, _INTO = 0.25, 0.01, 0.002
# In parts of the height of the head. Half the width of a row of teeth and its depth; how far behind the seam it begins.
_HALF_ROW, _ROW, _BEHIND = 0.142, 0.195, 0.040
# From the seam down: edge and end of the gum of the upper and of the lower row; upper teeth bite over the lower.
_UPPER, _LOWER = (0.012, -0.048), (0.009, 0.043)
# Middle of the tongue, down and back from the seam, and its half axes.
_TONGUE_LIES = (0.046, 0.165)
_TONGUE = (0.088, 0.032, 0.115)
# What is hidden from the front by more than this [m], and lies within these parts of the height of the head from the middle
# of the mouth, across, up or down, and back, may line it: what hangs together with skin so near to where the lips meet.
_HIDDEN = 0.0008
_ROOM = 0.20, 0.12, 0.36
_AT_SEAM = 0.02
# Teeth and tongue stay so far behind skin, which will move.
_CLEAR = 0.022


def with_mouth(head: Head) -> Head:
    """The head with teeth and a tongue where its lips are closed and it has none: in the mouth that is behind them, or in one
    that is made there, with the lips cut apart."""
    if any(part.kind in ("teeth", "tongue") for part in head.parts):
        return head
    marks = head.landmarks
    height = float(marks.crown[1] - marks.chin[1])
    seam = lip_seam(head.skin, marks)
    across, level = seam[COLUMNS // 2]
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
    with_parts = replace(head, parts=(*head.parts, *parts))
    ends = open_lips(head.skin, marks)
    if ends is not None:
        return replace(with_parts, skin=lined(head.skin, ends, height))
    if not _sealed(head.skin, seam, height):
        return with_parts
    cut = parted(head.skin, np.column_stack([seam, seen_from_front(head.skin, seam)]))
    return head if cut is None else replace(with_parts, skin=lined(*cut, height))


def _behind(front: Floats, height: float) -> list[Part]:
    """Teeth and tongue behind the middle of a seam at ``front`` [m], (3,), in a head so high [m]."""
    rows = [
        Part("teeth", dental_row(_place_of_row(front, height, down), upper=upper))
        for down, upper in ((_UPPER, True), (_LOWER, False))
    ]
    return [*rows, _tongue(front, height)]


def _sealed(skin: TriangleMesh, seam: Floats, height: float) -> bool:
    """Whether there is flesh behind the lips, and no mouth. seam: where they meet, seen from the front [m], (k, 2)."""
    middle = seam[len(seam) // 4 : -(len(seam) // 4)]
    beside = _LIP * height * np.array([[0.0, -1.0], [0.0, 0.0], [0.0, 1.0]])
    lips = (middle + beside[:, None]).reshape(-1, 2)
    inside = np.column_stack([lips, seen_from_front(skin, lips) - _INTO * height])
    behind = locator(skin).first_hit(inside, np.broadcast_to([0.0, 0.0, -1.0], inside.shape))
    return bool(np.median(behind) > _FLESH * height)


def _room(parts: list[Part], skin: TriangleMesh) -> float:
    """How far it is from parts of the mouth to the skin before them [m]; 0 where one is not behind skin."""
    starts = np.concatenate([part.mesh.vertices for part in parts])
    distance = locator(skin).first_hit(starts, np.broadcast_to([0.0, 0.0, 1.0], starts.shape))
    return float(np.where(np.isfinite(distance), distance, 0.0).min())


def lines_mouth(skin: TriangleMesh, marks: Landmarks) -> NDArray[np.bool_]:
    """Which vertices of a skin are inside the mouth, behind the lips, (n,)."""
    points = skin.vertices
    middle, height = 0.5 * (marks.mouth_left + marks.mouth_right), float(marks.crown[1] - marks.chin[1])
    across, up, ahead = (points - middle).T / height
    hidden = (np.abs(across) < _ROOM[0]) & (np.abs(up) < _ROOM[1]) & (ahead > -_ROOM[2])
    index = np.flatnonzero(hidden)
    hidden[index] = points[index, 2] < seen_from_front(skin, points[index, :2]) - _HIDDEN
    # Nostrils are hidden, too, but lips are between them and the mouth.
    index = np.flatnonzero(hidden)
    among = igl.adjacency_matrix(skin.faces).tocsr()[index][:, index]
    piece = connected_components(among, directed=False)[1]
    at_seam = cKDTree(lip_seam(skin, marks)).query(points[index, :2])[0] < _AT_SEAM * height
    lining = np.zeros(len(points), dtype=bool)
    lining[index] = np.isin(piece, piece[at_seam & (points[index, 2] > middle[2] - _AT_SEAM * height)])
    return lining


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
