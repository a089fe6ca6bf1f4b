"""What the skin shader cannot know by itself, painted on the vertices once: lips, brows, flush, scalp.

Heads come with no texture, so the places that are not skin-coloured are found from the landmarks.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.head import Head, Landmarks, Part
from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.mouth import lines_mouth
from ..head.sight import lip_seam
from ..head.smooth import smoothstep
from ..lcp.model import HairModel

# From the edge of a tooth to where its gum begins in front [m], and how much of that is left at the ends of a row.
_CROWN = (0.0085, 0.0105)
_MOLAR = 0.55
# Skin nearer than this to a root [m] is covered, and bare beyond the second.
_SCALP_REACH = (0.006, 0.016)


def clustered(vertices: Floats, cell: float) -> tuple[Ints, Ints]:
    """One vertex for every cube of side ``cell`` [m] that holds any.

    Returns the representatives, (k,), and the representative's place in them for every vertex, (n,).
    """
    cells = np.floor((vertices - vertices.min(axis=0)) / cell).astype(np.int64)
    extent = cells.max(axis=0) + 1
    key = (cells[:, 0] * extent[1] + cells[:, 1]) * extent[2] + cells[:, 2]
    _, representatives, cluster = np.unique(key, return_index=True, return_inverse=True)
    return representatives, cluster


def coarse_faces(mesh: TriangleMesh, cell: float) -> Ints:
    """Faces over the same vertices, with details below ``cell`` [m] left out, (k, 3): good enough to cast a shadow."""
    representatives, cluster = clustered(mesh.vertices, cell)
    corners = cluster[mesh.faces]
    whole = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
    return representatives[corners[whole]]


def paint(head: Head) -> Floats:
    """Lips, brows and flush of every vertex of the skin, 0 to 1, (n, 3)."""
    points, marks = head.skin.vertices, head.landmarks
    has_brows = any(part.kind == "brows" for part in head.parts)
    brows = np.zeros(len(points)) if has_brows else _brows(points, marks)
    return np.stack([_lips(head), brows, _flush(points, marks)], axis=1)


def standing_out(head: Head, part: Part) -> Floats:
    """How far every vertex of a part stands out of the skin, 0 at the root of a lash to 1 at its tip, (n,)."""
    distance, _ = cKDTree(head.skin.vertices).query(part.mesh.vertices)
    return distance / max(distance.max(), 1e-9)


def dental_arch(teeth: TriangleMesh) -> Floats:
    """How far around the arch every vertex of a row of teeth lies, from 0 at its right end to 1 at its left, (n,)."""
    low, high = teeth.bounds
    # The arch is close to a half ellipse that opens backward.
    across = (teeth.vertices[:, 0] - 0.5 * (low[0] + high[0])) / (0.5 * (high[0] - low[0]))
    ahead = (teeth.vertices[:, 2] - low[2]) / (high[2] - low[2])
    return np.clip(0.5 + np.arctan2(across, ahead) / np.pi, 0.0, 1.0)


def gums(teeth: TriangleMesh, upper: bool) -> Floats:
    """Where a row of teeth is gum and no longer tooth, 0 to 1, (n,)."""
    height, forward = teeth.vertices[:, 1], teeth.vertices[:, 2]
    beyond = height - height.min() if upper else height.max() - height
    ahead = (forward - forward.min()) / np.ptp(forward)
    return smoothstep(beyond / (_MOLAR + (1.0 - _MOLAR) * ahead), *_CROWN)


def scalp_cover(head: Head, hair: HairModel | None) -> Floats:
    """How densely hair roots stand on the skin, 0 to 1, (n,): the ground that hair grows from is never bare skin."""
    if hair is None or hair.count == 0:
        return np.zeros(len(head.skin.vertices))
    distance, _ = cKDTree(hair.root_points).query(head.skin.vertices)
    near, far = _SCALP_REACH
    return 1.0 - smoothstep(distance, near, far)


def _face_axes(marks: Landmarks) -> tuple[Floats, Floats]:
    """Unit directions to the person's left and up, along the face."""
    left = marks.left_eye - marks.right_eye
    left = left / np.linalg.norm(left)
    up = marks.nasion - marks.chin
    up = up - (up @ left) * left
    return left, up / np.linalg.norm(up)


def _lips(head: Head) -> Floats:
    """Red of the lips: between two arcs from corner to corner of the mouth, beside where they meet; and of all behind them."""
    points, marks = head.skin.vertices, head.landmarks
    left, up = _face_axes(marks)
    out = np.cross(left, up)
    middle = (marks.mouth_left + marks.mouth_right) / 2
    half = float(np.linalg.norm(marks.mouth_left - marks.mouth_right)) / 2
    across, height, depth = ((points - middle) @ axis / half for axis in (left, up, out))
    seam = lip_seam(head.skin, marks)
    seam_across, seam_height = ((seam - middle[:2]) @ axis[:2] / half for axis in (left, up))
    arch = np.sqrt(np.clip(1 - across**2, 0, 1))
    height = height - np.interp(across, seam_across, seam_height)
    bow = 1 - 0.20 * np.exp(-((across / 0.16) ** 2))
    # The red reaches a little around the corners, where an open mouth shows what lay between the lips.
    corner = 0.07 * (1 - smoothstep(np.abs(across), 1.0, 1.12))
    upper, lower = np.maximum(0.34 * arch * bow, corner), np.maximum(0.44 * arch, corner)
    inside = np.where(height > 0, height / np.maximum(upper, 1e-6), -height / np.maximum(lower, 1e-6))
    front = smoothstep(depth, -1.7, -0.7)
    lips = (1 - smoothstep(inside, 0.75, 1.15)) * front * (np.abs(across) < 1.12)
    return np.where(lines_mouth(head.skin, marks), 1.0, lips)


def _brows(points: Floats, marks: Landmarks) -> Floats:
    """Two arcs above the eyes, thick beside the nose and thin at the temple."""
    left, up = _face_axes(marks)
    out = np.cross(left, up)
    span = np.linalg.norm(marks.left_eye - marks.right_eye)
    cover = np.zeros(len(points))
    for eye, side in ((marks.left_eye, 1.0), (marks.right_eye, -1.0)):
        along = side * ((points - eye) @ left) / span
        t = np.clip((along + 0.30) / 0.72, 0, 1)
        arc = span * (0.30 + 0.11 * np.sin(np.pi * np.clip(t, 0, 1) ** 1.3) - 0.05 * t)
        # No thinner than the triangles that carry it: a thinner tail comes in tufts.
        thickness = span * (0.058 * (1 - t) ** 0.7 + 0.026)
        off = np.abs((points - eye) @ up - arc) / thickness
        ends = smoothstep(along, -0.34, -0.24) * (1 - smoothstep(along, 0.24, 0.41))
        front = smoothstep((points - eye) @ out, -0.04, -0.02)
        cover = np.maximum(cover, (1 - smoothstep(off, 0.3, 1.0)) * ends * front)
    return cover


def _flush(points: Floats, marks: Landmarks) -> Floats:
    """Where blood shows through: nose, cheeks, chin and ears."""
    left, up = _face_axes(marks)
    out = np.cross(left, up)
    span = np.linalg.norm(marks.left_eye - marks.right_eye)
    cheek = np.array([0.62, -0.72, -0.05])
    spots = [(marks.nose_tip, 0.32, 0.8), (marks.chin, 0.30, 0.35)]
    middle = (marks.left_eye + marks.right_eye) / 2
    for side in (1.0, -1.0):
        place = middle + span * (side * cheek[0] * left + cheek[1] * up + cheek[2] * out)
        spots.append((place, 0.45, 0.7))
    spots += [(marks.left_tragus - 0.02 * out, 0.42, 0.9), (marks.right_tragus - 0.02 * out, 0.42, 0.9)]
    flush = [
        strength * np.exp(-((np.linalg.norm(points - place, axis=1) / (size * span)) ** 2))
        for place, size, strength in spots
    ]
    return np.clip(np.sum(flush, axis=0), 0.0, 1.0)
