"""Even triangles of a wanted size on a smooth surface.

Botsch and Kobbelt 2004, "A remeshing approach to multiresolution modeling": split long edges, collapse short ones, flip
to Delaunay, relax along the surface, and lay the vertices back onto it. Each step works on many edges at once, on sets
of edges that do not touch each other.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csr_array

from ..mesh import Floats, Ints
from .fields import Field

# What is compared is rounded: its last digits are the processor's.
_DIGITS = 6
_LONG, _SHORT = 4.0 / 3.0, 4.0 / 5.0
Bools = np.ndarray


class Surface(NamedTuple):
    """What the triangles shall follow.

    onto: lays points, shape (n, 3), onto the surface and gives its unit normals there. size: wanted edge length at
    points. planes: which of the bounding planes each point lies in, shape (n, k); a point never leaves its planes, so
    the border of the surface must lie in them.
    """

    onto: Callable[[Floats], tuple[Floats, Floats]]
    size: Field
    planes: Callable[[Floats], Bools]


class _Edges(NamedTuple):
    """ends: vertices of every edge, smaller first, (e, 2). of_face: edge opposite each corner, (m, 3). corners: the
    one or two corners (3 * face + k) opposite each edge, the second -1 on the border, (e, 2)."""

    ends: Ints
    of_face: Ints
    corners: Ints

    @property
    def border(self) -> Bools:
        return self.corners[:, 1] < 0


def remesh(vertices: Floats, faces: Ints, surface: Surface, rounds: int) -> tuple[Floats, Ints]:
    """The surface with even triangles; vertices of shape (n, 3), faces of shape (m, 3), border edges kept in planes."""
    for _ in range(rounds):
        for _ in range(3):
            vertices, faces = _split(vertices, faces, surface)
        for _ in range(3):
            vertices, faces = _collapse(vertices, faces, surface)
        vertices, normals = surface.onto(vertices)
        for _ in range(4):
            faces = _flip(vertices, faces, surface)
        vertices, _ = surface.onto(_relaxed(vertices, faces, normals, surface))
    for _ in range(4):
        faces = _flip(vertices, faces, surface)
    return vertices, faces


def _edges(faces: Ints) -> _Edges:
    sides = np.sort(faces[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2), axis=1)
    count = faces.max() + 1
    keys, index, uses = np.unique(sides[:, 0] * count + sides[:, 1], return_inverse=True, return_counts=True)
    order = np.argsort(index, kind="stable")
    first = np.cumsum(uses) - uses
    second = np.where(uses > 1, order[np.minimum(first + 1, len(order) - 1)], -1)
    ends = np.stack([keys // count, keys % count], axis=1)
    return _Edges(ends, index.reshape(-1, 3), np.stack([order[first], second], axis=1))


def _first_in_faces(urgency: Floats, edges: _Edges) -> Bools:
    """Edges more urgent than all others of their faces; urgency <= 0 is never chosen."""
    urgency = np.where(urgency > 0, urgency + 1e-9 * np.arange(len(urgency)), 0.0)
    best = urgency[edges.of_face].max(axis=1)
    one, two = edges.corners[:, 0] // 3, edges.corners[:, 1] // 3
    return (urgency > 0) & (urgency == best[one]) & (edges.border | (urgency == best[two]))


def _chords(planes: Bools, ends: Ints, border: Bools) -> Bools:
    """Inner edges with both ends in one plane: their triangles could fold flat into it."""
    return (planes[ends[:, 0]] & planes[ends[:, 1]]).any(axis=1) & ~border


def _relative_length(vertices: Floats, ends: Ints, surface: Surface) -> Floats:
    a, b = vertices[ends[:, 0]], vertices[ends[:, 1]]
    return np.round(np.linalg.norm(a - b, axis=1) / surface.size((a + b) / 2.0), _DIGITS)


def _split(vertices: Floats, faces: Ints, surface: Surface) -> tuple[Floats, Ints]:
    edges = _edges(faces)
    length = _relative_length(vertices, edges.ends, surface)
    long = (length > _LONG) & ~_chords(surface.planes(vertices), edges.ends, edges.border)
    chosen = np.flatnonzero(_first_in_faces(np.where(long, length, 0.0), edges))
    corners, middle = edges.corners[chosen], len(vertices) + np.arange(len(chosen))
    inner = corners[:, 1] >= 0
    side = np.concatenate([corners[:, 0], corners[inner, 1]])
    middle = np.concatenate([middle, middle[inner]])
    face, k = side // 3, side % 3
    apex, a, b = (faces[face, (k + turn) % 3] for turn in range(3))
    faces = faces.copy()
    faces[face] = np.stack([apex, a, middle], axis=1)
    faces = np.concatenate([faces, np.stack([apex, middle, b], axis=1)])
    return np.concatenate([vertices, vertices[edges.ends[chosen]].mean(axis=1)]), faces


def _collapse(vertices: Floats, faces: Ints, surface: Surface) -> tuple[Floats, Ints]:
    edges = _edges(faces)
    length = _relative_length(vertices, edges.ends, surface)
    short = np.flatnonzero(length < _SHORT)
    planes = surface.planes(vertices)
    gone, kept = edges.ends[short].T
    swap = planes[gone].sum(axis=1) > planes[kept].sum(axis=1)
    gone, kept = np.where(swap, kept, gone), np.where(swap, gone, kept)
    may = (planes[gone] <= planes[kept]).all(axis=1) & (edges.border[short] | ~planes[gone].any(axis=1))
    may &= _keeps_a_surface(edges, gone, kept, edges.border[short], np.asarray(planes.any(axis=1)))
    short, gone, kept = short[may], gone[may], kept[may]
    alone = _far_apart(length[short], gone, kept, edges.ends, len(vertices))
    gone, kept = gone[alone], kept[alone]

    moved = vertices.copy()
    alike = (planes[gone] == planes[kept]).all(axis=1)
    moved[kept[alike]] = (vertices[gone[alike]] + vertices[kept[alike]]) / 2.0
    target, owner = np.arange(len(vertices)), np.full(len(vertices), -1)
    target[gone] = kept
    owner[gone] = owner[kept] = np.arange(len(gone))
    spoilt = np.unique(owner[faces[_folded(vertices, moved, faces, target[faces])]])
    spoilt = spoilt[spoilt >= 0]
    moved[kept[spoilt]] = vertices[kept[spoilt]]
    target[gone[spoilt]] = gone[spoilt]

    faces = target[faces]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    used, index = np.unique(faces, return_inverse=True)
    return moved[used], index.reshape(-1, 3)


def _keeps_a_surface(edges: _Edges, gone: Ints, kept: Ints, border: Bools, in_plane: Bools) -> Bools:
    """Which pairs may merge: two neighbours in common, on the border one, and no new edge across the border."""
    both = np.concatenate([edges.ends, edges.ends[:, ::-1]])
    size = (len(in_plane),) * 2
    joined = csr_array(coo_array((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=size))
    shared = joined[gone].multiply(joined[kept])
    rim = in_plane.astype(float)
    stray = joined[gone] @ rim - shared @ rim > in_plane[kept]
    return (shared.sum(axis=1) == np.where(border, 1, 2)) & ~(stray & in_plane[kept] & ~border)


def _far_apart(urgency: Floats, a: Ints, b: Ints, ends: Ints, count: int) -> Bools:
    """Edges with the least urgency within two edges around, so that no face has a corner in two of them."""
    rank = np.empty(len(urgency))
    rank[np.argsort(urgency, kind="stable")] = np.arange(len(urgency))
    least = np.full(count, np.inf)
    np.minimum.at(least, a, rank)
    np.minimum.at(least, b, rank)
    around = least.copy()
    np.minimum.at(around, ends[:, 0], least[ends[:, 1]])
    np.minimum.at(around, ends[:, 1], least[ends[:, 0]])
    return (rank <= around[a]) & (rank <= around[b])


def _folded(before: Floats, after: Floats, old: Ints, new: Ints) -> Bools:
    """Faces that stay but turn by more than 60 degrees."""
    was, now = _normals(before, old), _normals(after, new)
    size = np.linalg.norm(was, axis=1) * np.linalg.norm(now, axis=1)
    stays = (new != np.roll(new, 1, axis=1)).all(axis=1)
    return stays & (np.einsum("ij,ij->i", was, now) < 0.5 * size)


def _normals(vertices: Floats, faces: Ints) -> Floats:
    a, b, c = (vertices[faces[..., k]] for k in range(3))
    return np.cross(b - a, c - a)


def _flip(vertices: Floats, faces: Ints, surface: Surface) -> Ints:
    """Flip edges whose opposite angles sum to more than half a turn, and chords of the border."""
    edges = _edges(faces)
    corners = vertices[faces]
    to_next, to_last = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    area = np.linalg.norm(np.cross(to_next[:, 0], to_last[:, 0]), axis=1)
    cotangent = np.einsum("ijk,ijk->ij", to_next, to_last) / np.maximum(area, 1e-12)[:, None]
    cotangent = cotangent.ravel()
    excess = -np.round(cotangent[edges.corners[:, 0]] + cotangent[edges.corners[:, 1]], _DIGITS)
    planes = surface.planes(vertices)
    excess[_chords(planes, edges.ends, edges.border)] = np.inf
    chosen = np.flatnonzero(_first_in_faces(np.where(edges.border | (excess < 1e-3), 0.0, excess), edges))
    (one, i), (two, j) = (divmod(edges.corners[chosen, side], 3) for side in (0, 1))
    c, a, b = (faces[one, (i + turn) % 3] for turn in range(3))
    d = faces[two, j]
    count = len(vertices)
    key = np.minimum(c, d) * count + np.maximum(c, d)
    fresh = ~(planes[c] & planes[d]).any(axis=1)
    fresh &= ~np.isin(key, edges.ends[:, 0] * count + edges.ends[:, 1])
    fresh &= np.bincount(np.unique(key, return_index=True)[1], minlength=len(key)).astype(bool)
    new_one, new_two = np.stack([c, a, d], axis=1), np.stack([c, d, b], axis=1)
    old = _normals(vertices, faces[one]) + _normals(vertices, faces[two])
    for new in (new_one, new_two):
        normal = _normals(vertices, new)
        size = np.linalg.norm(old, axis=1) * np.linalg.norm(normal, axis=1)
        fresh &= np.einsum("ij,ij->i", old, normal) > 0.7 * size
    faces = faces.copy()
    faces[one[fresh]], faces[two[fresh]] = new_one[fresh], new_two[fresh]
    return faces


def _relaxed(vertices: Floats, faces: Ints, normals: Floats, surface: Surface) -> Floats:
    """Every vertex at the middle of its faces, in the tangent plane; on the border, at the middle of its neighbours."""
    centres = vertices[faces].mean(axis=1)
    weight = np.linalg.norm(_normals(vertices, faces), axis=1) / surface.size(centres) ** 2
    spread = csr_array((np.ones(faces.size), (faces.ravel(), np.repeat(np.arange(len(faces)), 3))))
    middle = (spread @ (weight[:, None] * centres)) / (spread @ weight)[:, None]
    edges = _edges(faces)
    rim = edges.ends[edges.border]
    both = np.concatenate([rim, rim[:, ::-1]])
    along = csr_array((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=(len(vertices),) * 2)
    planes = surface.planes(vertices)
    on_rim = planes.any(axis=1)
    middle[on_rim] = (along @ vertices)[on_rim] / 2.0
    middle[planes.sum(axis=1) > 1] = vertices[planes.sum(axis=1) > 1]
    step = middle - vertices
    step -= np.einsum("ij,ij->i", step, normals)[:, None] * normals
    return vertices + 0.8 * step
