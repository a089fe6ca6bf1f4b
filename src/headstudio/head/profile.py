"""The outline of a head in its mid-sagittal plane, and single looks at it from outside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .mesh import Floats, Ints, TriangleMesh

_STEP = 0.0005
"""Distance of neighbouring levels of the outline [m]."""


_SKULL = 0.15
"""How far below the top the skull reaches, which tells front from back [m]."""


@dataclass(frozen=True, eq=False)
class Profile:
    """The outline of the plane x = 0: at every level y [m], rising, how far front and back reach along z [m], (n,)."""

    level: Floats
    front: Floats
    back: Floats

    def front_at(self, y: float) -> Floats:
        """The point of the front at a level, shape (3,)."""
        return np.array([0.0, y, np.interp(y, self.level, self.front)])

    def back_at(self, y: float) -> Floats:
        """The point of the back at a level, shape (3,)."""
        return np.array([0.0, y, np.interp(y, self.level, self.back)])

    def between(self, low: float, high: float) -> Profile:
        """The part from one level to another, at least its nearest level."""
        inside = (self.level >= low) & (self.level <= high)
        inside[np.abs(self.level - 0.5 * (low + high)).argmin()] |= not inside.any()
        return Profile(self.level[inside], self.front[inside], self.back[inside])


def midline(mesh: TriangleMesh) -> Profile:
    """Where the plane x = 0 meets the surface, outermost, head frame or any other upright one [m].

    Only what lies in the front half of the head and faces forward counts for the front, and so for the back: what a
    hole lets see of the inside counts for nothing, and levels that fall into a hole are filled in between. The mesh has
    to meet the plane.
    """
    x = mesh.vertices[mesh.faces][..., 0]
    # Vertices in the plane itself count as being on its left, so that every triangle is crossed on two edges or none.
    left = x >= 0
    crossed = left.any(axis=1) & ~left.all(axis=1)
    corners, x, left = mesh.vertices[mesh.faces[crossed]], x[crossed], left[crossed]
    facing = mesh.face_normals[crossed, 2]
    following = np.roll(corners, -1, axis=1)
    on_edge = left != np.roll(left, -1, axis=1)
    share = np.divide(x, x - np.roll(x, -1, axis=1), out=np.zeros_like(x), where=on_edge)
    points = corners + share[..., None] * (following - corners)
    ends = points[on_edge].reshape(-1, 2, 3)[..., 1:]

    low, high = ends[..., 0].min(), ends[..., 0].max()
    level = np.arange(low, high + _STEP, _STEP)
    depth = ends[..., 1].mean(axis=1)
    skull = depth[ends[..., 0].max(axis=1) > high - _SKULL]
    middle = 0.5 * (skull.min() + skull.max())
    front = _outermost(level, ends[(facing >= 0) & (depth > middle)])
    back = -_outermost(level, ends[(facing <= 0) & (depth < middle)] * [1.0, -1.0])
    return Profile(level, front, back)


def _outermost(level: Floats, segments: Floats) -> Floats:
    """The greatest z of segments (k, 2, 2) of (y, z) at every level; levels without any are filled in between."""
    at, z = _sampled(segments, level[0])
    reach = np.full(len(level), -np.inf)
    np.maximum.at(reach, at, z)
    filled = np.isfinite(reach)
    return np.interp(level, level[filled], reach[filled]) if filled.any() else np.zeros(len(level))


def _sampled(segments: Floats, low: float) -> tuple[Ints, Floats]:
    """Segments (k, 2, 2) of (y, z) as points on the levels: index of the level and z."""
    order = np.argsort(segments[..., 0], axis=1)
    lower, upper = np.take_along_axis(segments, order[..., None], axis=1).swapaxes(0, 1)
    first = np.rint((lower[:, 0] - low) / _STEP).astype(np.int64)
    count = np.rint((upper[:, 0] - low) / _STEP).astype(np.int64) - first + 1
    segment = np.repeat(np.arange(len(segments)), count)
    step = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    at = first[segment] + step
    rise = np.maximum(upper[:, 0] - lower[:, 0], 1e-12)
    share = np.clip((low + at * _STEP - lower[segment, 0]) / rise[segment], 0.0, 1.0)
    return at, lower[segment, 1] + share * (upper[segment, 1] - lower[segment, 1])


def seen_from(mesh: TriangleMesh, axis: int, sign: float, across: Floats) -> Floats:
    """How far the surface reaches along an axis where one looks at it from outside [m], shape (k,).

    axis: 0 for x, 2 for z; sign: 1.0 to look from its positive end. across: the other two coordinates of each line of
    sight [m], in order, shape (k, 2). Only what faces the viewer on his side of the head is seen. Where a line meets
    nothing, because of a hole, the nearest vertex that faces the viewer answers.
    """
    others = [k for k in range(3) if k != axis]
    low, high = across.min(axis=0), across.max(axis=0)
    flat = mesh.vertices[:, others][mesh.faces]
    outward = sign * (mesh.vertices[:, axis] - mesh.vertices[:, axis].mean())
    facing = (sign * mesh.face_normals[:, axis] > 0) & (outward[mesh.faces] > 0).all(axis=1)
    near = facing & ((flat.max(axis=1) >= low) & (flat.min(axis=1) <= high)).all(axis=1)
    corners, depth = flat[near], sign * mesh.vertices[:, axis][mesh.faces[near]]
    a, b, c = corners.swapaxes(0, 1)
    twice_area = _cross(b - a, c - a)
    twice_area = np.where(twice_area == 0, np.inf, twice_area)
    point = across[:, None, :]
    weights = np.stack([_cross(b - point, c - point), _cross(c - point, a - point), _cross(a - point, b - point)])
    weights = weights / twice_area
    reach = np.where((weights >= -1e-9).all(axis=0), np.einsum("ikj,ji->kj", weights, depth), -np.inf)
    reach = reach.max(axis=1, initial=-np.inf)
    missed = ~np.isfinite(reach)
    if missed.any():
        seen = mesh.vertices[mesh.faces[facing].ravel()]
        nearest = cKDTree(seen[:, others]).query(across[missed])[1]
        reach[missed] = sign * seen[nearest, axis]
    return sign * reach


def _cross(a: Floats, b: Floats) -> Floats:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
