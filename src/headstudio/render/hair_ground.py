"""The ground that hair grows from: between roots the scalp is darker than bare skin, for stubs, follicles and shadow.

Strands are drawn as a sample, and where they part one sees far between them. What is left out there is painted.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.head import Head
from ..head.mesh import Floats, Ints
from ..head.rows import row_dot
from ..lcp.model import HairModel
from ..scene.settings import Look
from ..wisp.strands import Strands
from .scene_block import linear
from .skin_paint import scalp_cover
from .strand_points import DEFAULT_RADIUS

Growth = HairModel | Strands | None
"""What grows on a head: particles, strands, or nothing."""

_SAMPLE = 20_000  # roots that are looked at
_COLOURS = 1_000  # whose mean is the ground's
_NEAREST = 16  # of them tell how densely they stand
_REACH = 0.02  # farther from these the skin is bare [m]
# So much of every hair, from its root on, counts as ground [m]: what lies lowest, and in the shadow of the rest.
_STUB = 0.006


def ground_cover(head: Head, growth: Growth) -> Floats:
    """What part of the skin the roots of ``growth`` hide at every vertex, 0 to 1, (n,)."""
    if not isinstance(growth, Strands):
        return scalp_cover(head, growth)
    step = max(growth.count // _SAMPLE, 1)
    roots = growth.first[:-1:step]
    cover = np.zeros(len(head.skin.vertices))
    if len(roots) < _NEAREST:
        return cover
    distance, _ = cKDTree(_stubs(head, growth, roots)).query(
        head.skin.vertices, k=[_NEAREST], distance_upper_bound=_REACH, workers=-1
    )
    near = np.isfinite(distance[:, 0])
    density = step * growth.stands_for * _NEAREST / (np.pi * np.maximum(distance[near, 0], 1e-4) ** 2)
    width = 2.0 * (DEFAULT_RADIUS if growth.radius is None else float(growth.radius[roots].mean()))
    cover[near] = 1.0 - np.exp(-_STUB * width * density)
    return cover


def _stubs(head: Head, growth: Strands, roots: Ints) -> Floats:
    """Where on the skin the middle of what covers it is [m], (k, 3), of strands whose first points are ``roots``, (k,).

    Hair that lies down covers the skin beside its root: where it leaves a parting to both sides the line stays pale.
    """
    points = growth.points
    place = points[roots].astype(np.float64)
    onward = points[np.minimum(roots + 1, len(points) - 1)] - place
    length = np.maximum(np.linalg.norm(onward, axis=1, keepdims=True), 1e-9)
    normals = head.skin.vertex_normals[cKDTree(head.skin.vertices).query(place, workers=-1)[1]]
    lying = onward - row_dot(onward, normals)[:, None] * normals
    return place + np.minimum(0.5 * _STUB, length) * lying / length


def ground_colour(growth: Growth, look: Look) -> Floats:
    """The colour of the hair there, and of the brows, linear RGB, (3,): dye comes no nearer to the skin than a shade of
    brown, gray or fair hair.
    """
    if not isinstance(growth, Strands) or growth.colour is None or growth.count == 0:
        return linear(look.hair_colour)
    roots = growth.first[: -1 : max(growth.count // _COLOURS, 1)]
    red, green, blue = growth.colour[roots].mean(axis=0, dtype=np.float64)
    red = max(red, 0.21 * red + 0.72 * green + 0.07 * blue)
    green = np.clip(green, 0.35 * red, red)
    return np.array([red, green, np.clip(blue, 0.1 * red, green)])


def same_ground(one: Growth, other: Growth) -> bool:
    """True if both cover the skin alike, whatever their colour."""
    if isinstance(one, Strands) and isinstance(other, Strands):
        return one.points is other.points and one.radius is other.radius and one.stands_for == other.stands_for
    return one is other
