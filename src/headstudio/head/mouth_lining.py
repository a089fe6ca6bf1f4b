"""The inside of a mouth: skin from lip to lip, around teeth and tongue."""

from __future__ import annotations

import igl
import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from .mesh import Ints, TriangleMesh
from .sight import seen_from_front

# Rings of the lining from the lips to the throat, in parts of the height of the head: how far behind the lips a ring lies
# and how much wider than the mouth it is on either side; how far up and down it reaches from where the lips meet; and how
# far it has left the bow of the lips for a plane.
_RINGS = np.array(
    [
        (0.006, -0.010, 0.0015, 0.0015, 0.0),
        (0.012, -0.018, 0.006, 0.006, 0.0),
        (0.018, -0.018, 0.015, 0.015, 0.0),
        (0.022, -0.010, 0.028, 0.028, 0.0),
        (0.026, 0.000, 0.045, 0.045, 0.0),
        (0.036, 0.014, 0.064, 0.060, 0.1),
        (0.070, 0.032, 0.077, 0.077, 0.3),
        (0.135, 0.040, 0.082, 0.086, 0.7),
        (0.225, 0.032, 0.073, 0.077, 1.0),
        (0.300, 0.010, 0.045, 0.055, 1.0),
    ]
)
_THROAT = 0.33
# Lining comes to lie so far behind what is seen of the skin, on this part of the way to the throat.
_BEHIND, _SOON = 0.04, 0.05
# So many rings of vertices on either side of the edges of the lips are made round.
_ROUND = 2


def lined(skin: TriangleMesh, border: Ints, height: float) -> TriangleMesh:
    """The skin with a lining sewn to the lips. Its vertices and triangles come after those of ``skin``.

    border: the vertices of the parted lips, around the mouth as ``lips.parted`` gives them, (b,). height: of the head [m].
    """
    lips = skin.vertices[border]
    right, left = lips[:, 0].min(), lips[:, 0].max()
    middle, half = 0.5 * (left + right), 0.5 * (left - right)
    cosine = np.clip((lips[:, 0] - middle) / half, -1.0, 1.0)
    # Along the lower lip to the left corner, and back along the upper.
    corner = int(lips[:, 0].argmax())
    sine = np.sqrt(1.0 - cosine**2) * np.where(np.arange(len(lips)) < corner, -1.0, 1.0)
    level, front = lips[:, 1].mean(), lips[:, 2].max()
    back, wider, up, down, plane = _RINGS.T[:, :, None] * height
    plane = plane / height
    across = middle + (half + wider) * cosine
    rise = lips[:, 1] * (1.0 - plane) + level * plane + np.where(sine > 0, up, down) * sine
    depth = lips[:, 2] * (1.0 - plane) + front * plane - back
    rings = np.stack([across, rise, depth], axis=2)
    open_ = seen_from_front(skin, rings[..., :2].reshape(-1, 2)).reshape(depth.shape)
    rings[..., 2] = np.minimum(depth, open_ - _BEHIND * height * np.minimum(back / (_SOON * height), 1.0))
    throat = np.array([[middle, level, front - _THROAT * height]])

    count, around = len(skin.vertices), len(border)
    place = np.concatenate([border[None], count + np.arange(rings[..., 0].size).reshape(-1, around)])
    a, b, c, d = place[:-1], np.roll(place[:-1], -1, axis=1), np.roll(place[1:], -1, axis=1), place[1:]
    # Quads are split the same way on either side.
    turned = np.broadcast_to(cosine + np.roll(cosine, -1) < 0, a.shape)
    first = np.where(turned[..., None], np.stack([a, b, d], axis=-1), np.stack([a, b, c], axis=-1))
    second = np.where(turned[..., None], np.stack([b, c, d], axis=-1), np.stack([a, c, d], axis=-1))
    pole = np.full(around, count + rings[..., 0].size)
    end = np.stack([place[-1], np.roll(place[-1], -1), pole], axis=-1)
    faces = np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3), end])
    uv = None
    if skin.corner_uv is not None:
        # No place on the chart is left: the lining lies folded on the edge of the lips.
        of_lip = np.zeros((count + len(border) * len(_RINGS) + 1, 2))
        of_lip[skin.faces] = skin.corner_uv
        of_lip[place] = of_lip[border]
        of_lip[-1] = of_lip[border[0]]
        uv = np.concatenate([skin.corner_uv, of_lip[faces]])
    vertices = np.concatenate([skin.vertices, rings.reshape(-1, 3), throat])
    return _rounded(TriangleMesh(vertices, np.concatenate([skin.faces, faces]), uv), border)


def _rounded(skin: TriangleMesh, border: Ints) -> TriangleMesh:
    """The skin with lips that round into their lining: both bend as little as they can around a border that stays."""
    count = len(skin.vertices)
    adjacent = igl.adjacency_matrix(skin.faces).tocsr()
    is_border = np.isin(np.arange(count), border)
    near = is_border
    for _ in range(_ROUND):
        near = near | (adjacent @ near > 0)
    free = np.flatnonzero(near & ~is_border)
    degree = np.asarray(adjacent.sum(axis=1)).ravel()
    bend = sparse.csr_array(adjacent.multiply(1.0 / degree[:, None])) - sparse.eye_array(count)
    bend = sparse.csr_array(bend)[np.flatnonzero(near | (adjacent @ near > 0))]
    of_free = bend[:, free]
    rest = skin.vertices.copy()
    rest[free] = 0.0
    rest[free] = splu((of_free.T @ of_free).tocsc()).solve(-(of_free.T @ (bend @ rest)))
    return skin.moved(rest)
