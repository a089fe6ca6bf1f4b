"""Cutting a patch out of a triangle mesh along a closed curve, through the triangles and not along their edges.

The curve is given by knots on the surface. Each knot becomes a vertex, and from knot to knot the curve is traced face
by face: where it crosses an edge, the edge is split there, so that the piece just traced is an edge of the mesh. Both
sides share every new vertex exactly, and since a split never leaves its triangle, the surface keeps its shape.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import igl
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .head import HeadError
from .locate import SurfacePoints
from .mesh import Floats, Ints, TriangleMesh

# Nearer to a corner or edge than this part of the triangle, the curve goes through the corner or edge itself: what it
# moves is invisible, and what it avoids are slivers, on which neither cotangents nor the next trace can rely.
_SNAP_KNOT = 0.08
_SNAP_CROSSING = 0.03
_CROSSING = "the curves around the scalp cross or touch each other"
_CORNERS = "two corners of the scalp fall together; move its curves apart"


@dataclass(frozen=True, eq=False)
class Patch:
    """A disc cut out of a surface.

    mesh: the disc, oriented like the surface. normals: the surface's vertex normals carried over to it, shape (n, 3).
    sides: for each piece of the boundary the vertices along it, both ends included.
    """

    mesh: TriangleMesh
    normals: Floats
    sides: tuple[Ints, ...]


def cut_patch(surface: TriangleMesh, sides: Sequence[SurfacePoints]) -> Patch:
    """The part of ``surface`` on the left, seen from outside, of a closed curve made of ``sides``.

    Each side ends where the next one begins. Raises HeadError when the curve crosses or touches itself, runs over a
    hole, or does not bound a disc.
    """
    knots = np.concatenate([side.faces[:-1] for side in sides])
    weights = np.concatenate([side.weights[:-1] for side in sides])
    starts = np.cumsum([0] + [len(side.faces) - 1 for side in sides[:-1]])
    if len(np.unique(knots[starts])) < len(starts):
        raise HeadError(_CORNERS)
    kept = _one_knot_per_face(knots, starts)
    is_corner = np.isin(kept, starts)

    band = _faces_near(surface, SurfacePoints(knots, weights).blend(surface.vertices, surface.faces))
    web = _Web(surface, band)
    stops: list[int] = []
    corners: list[int] = []
    for face, weight, corner in zip(knots[kept].tolist(), weights[kept], is_corner.tolist()):
        vertex = web.insert(surface.faces[face].tolist(), weight)
        if vertex is not None and (not stops or stops[-1] != vertex):
            stops.append(vertex)
        if corner:
            corners.append(vertex if vertex is not None else stops[-1])
    loop = web.trace(stops)
    web.split_chords(loop)
    return _patch_left_of(web, surface, band, loop, corners)


def _one_knot_per_face(faces: Ints, corners: Ints) -> Ints:
    """Indices of the knots to keep: every corner, and elsewhere the middle knot of each face the curve visits."""
    order = np.arange(len(faces))
    run = np.cumsum(np.diff(faces, prepend=faces[0]) != 0)
    first = np.searchsorted(run, run, side="left")
    last = np.searchsorted(run, run, side="right") - 1
    middle = order == (first + last) // 2
    is_corner = np.isin(order, corners)
    chosen = order[is_corner | (middle & ~np.isin(faces, faces[corners]))]
    rank = np.where(np.isin(chosen, corners), -1, chosen)
    by_rank = chosen[np.argsort(rank, kind="stable")]
    _, once = np.unique(faces[by_rank], return_index=True)
    return np.sort(by_rank[once])


def _faces_near(surface: TriangleMesh, curve: Floats) -> Ints:
    """Faces that the curve [m], shape (k, 3), can meet: (m,)."""
    corners = surface.vertices[surface.faces]
    centres = corners.mean(axis=1)
    radii = np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1)
    step = np.linalg.norm(np.diff(curve, axis=0, append=curve[:1]), axis=1).max()
    distance, _ = cKDTree(curve).query(centres)
    return np.flatnonzero(distance <= 2 * (radii + step))


class _Web:
    """The triangles near the curve, as they are split.

    ``opposite[a][b]`` is the third corner of the triangle that has the edge from a to b, counter-clockwise.
    """

    def __init__(self, surface: TriangleMesh, faces: Ints) -> None:
        used = np.unique(surface.faces[faces])
        self.positions: dict[int, Floats] = dict(zip(used.tolist(), surface.vertices[used]))
        self.normals: dict[int, Floats] = dict(zip(used.tolist(), surface.vertex_normals[used]))
        self.next_vertex = len(surface.vertices)
        self.opposite: dict[int, dict[int, int]] = {vertex: {} for vertex in used.tolist()}
        for a, b, c in surface.faces[faces].tolist():
            self._add(a, b, c)

    def faces(self) -> list[tuple[int, int, int]]:
        """All triangles."""
        return [(a, b, c) for a, edges in self.opposite.items() for b, c in edges.items() if a < b and a < c]

    def _add(self, a: int, b: int, c: int) -> None:
        if b in self.opposite[a] or c in self.opposite[b] or a in self.opposite[c]:
            raise HeadError("the surface folds onto itself along the scalp's border; repair the mesh there")
        self.opposite[a][b], self.opposite[b][c], self.opposite[c][a] = c, a, b

    def _remove(self, a: int, b: int, c: int) -> None:
        del self.opposite[a][b], self.opposite[b][c], self.opposite[c][a]

    def _vertex(self, corners: Sequence[int], weights: Sequence[float]) -> int:
        vertex, self.next_vertex = self.next_vertex, self.next_vertex + 1
        self.positions[vertex] = sum(w * self.positions[c] for c, w in zip(corners, weights))  # type: ignore[assignment]
        self.normals[vertex] = sum(w * self.normals[c] for c, w in zip(corners, weights))  # type: ignore[assignment]
        self.opposite[vertex] = {}
        return vertex

    def split_edge(self, a: int, b: int, part: float) -> int:
        """Split the edge from a to b at ``part`` of its length; returns the new vertex."""
        middle = self._vertex((a, b), (1 - part, part))
        for start, end in ((a, b), (b, a)):
            third = self.opposite[start].get(end)
            if third is not None:
                self._remove(start, end, third)
                self._add(start, middle, third)
                self._add(middle, end, third)
        return middle

    def insert(self, face: Sequence[int], weights: Floats) -> int | None:
        """Make a point of an original face a vertex, or take the corner or edge it is almost on.

        None when its edge was split already, which only happens next to another knot.
        """
        small = weights < _SNAP_KNOT
        if small.sum() == 2:
            return face[int(np.argmax(weights))]
        if small.any():
            k = int(np.argmin(weights))
            a, b = face[(k + 1) % 3], face[(k + 2) % 3]
            if b not in self.opposite[a] and a not in self.opposite[b]:
                return None
            return self.split_edge(a, b, float(weights[(k + 2) % 3] / (weights[(k + 1) % 3] + weights[(k + 2) % 3])))
        a, b, c = face
        if self.opposite[a].get(b) != c:
            return None
        middle = self._vertex(face, weights.tolist())
        self._remove(a, b, c)
        for start, end in ((a, b), (b, c), (c, a)):
            self._add(start, end, middle)
        return middle

    def trace(self, stops: Sequence[int]) -> list[int]:
        """Lay the closed curve through the vertices ``stops`` along edges of the mesh: its vertices in order."""
        loop = [stops[0]]
        before: dict[int, int] = {stops[0]: -1}
        for target in [*stops[1:], stops[0]]:
            steps_left = 4 * len(self.opposite)
            while loop[-1] != target:
                vertex = self._step(loop[-1], target, before)
                if len(loop) > 1 and vertex == loop[-2]:
                    # The knot hangs on the curve by one edge: leave it out.
                    del before[loop.pop()]
                elif vertex not in before:
                    before[vertex] = loop[-1]
                    loop.append(vertex)
                elif vertex == target == stops[0]:
                    return loop
                else:
                    raise HeadError(_CROSSING)
                steps_left -= 1
                if steps_left == 0:
                    raise HeadError("a curve around the scalp cannot be followed on the surface")
        return loop

    def split_chords(self, loop: Sequence[int]) -> None:
        """Split every edge that joins two vertices of the loop without being part of it.

        Such an edge would lie flat on a side of the square, and so would the triangle beside it.
        """
        neighbours = {a: {b, c} for a, b, c in zip(loop, [*loop[1:], loop[0]], [loop[-1], *loop[:-1]])}
        for a in loop:
            for b in [b for b in self.opposite[a] if b in neighbours and b not in neighbours[a]]:
                self.split_edge(a, b, 0.5)

    def _step(self, vertex: int, target: int, before: Mapping[int, int]) -> int:
        """The next vertex on the way to ``target``; splits the edge that the way crosses."""
        ring = self.opposite[vertex]
        if target in ring or vertex in self.opposite[target]:
            return target
        here = self.positions[vertex]
        way = self.positions[target] - here
        right = np.cross(way, self.normals[vertex] + self.normals[target])
        ends = np.array(list(ring.items()))
        if len(ends) == 0:
            raise HeadError("a curve around the scalp runs over the border of the surface")
        first = np.array([self.positions[b] for b in ends[:, 0]]) - here
        second = np.array([self.positions[c] for c in ends[:, 1]]) - here
        from_right, to_left = first @ right, second @ right
        crossed = (from_right >= 0) & (to_left <= 0) & (from_right > to_left)
        part = np.divide(from_right, from_right - to_left, out=np.zeros(len(ends)), where=crossed)
        meeting = first + part[:, None] * (second - first)
        forward = meeting @ way / (np.linalg.norm(meeting, axis=1) + 1e-300)
        crossed &= forward > 0
        if not crossed.any():
            raise HeadError("a curve around the scalp runs over the border or a crease of the surface")
        best = int(np.argmax(np.where(crossed, forward, -np.inf)))
        b, c = ends[best].tolist()
        if part[best] < _SNAP_CROSSING:
            return b
        if part[best] > 1 - _SNAP_CROSSING:
            return c
        if before.get(b) == c or before.get(c) == b:
            raise HeadError(_CROSSING)
        return self.split_edge(b, c, float(part[best]))


def _patch_left_of(web: _Web, surface: TriangleMesh, band: Ints, loop: list[int], corners: list[int]) -> Patch:
    outside_band = np.ones(len(surface.faces), dtype=bool)
    outside_band[band] = False
    faces = np.concatenate([surface.faces[outside_band], np.array(web.faces(), dtype=np.int64).reshape(-1, 3)])
    around = np.array(loop)
    inside = _faces_left_of(faces, around, web.next_vertex)
    faces = faces[inside]

    extra = range(len(surface.vertices), web.next_vertex)
    vertices = np.concatenate([surface.vertices, np.array([web.positions[v] for v in extra]).reshape(-1, 3)])
    normals = np.concatenate([surface.vertex_normals, np.array([web.normals[v] for v in extra]).reshape(-1, 3)])
    used, compact = np.unique(faces, return_inverse=True)
    faces = compact.reshape(-1, 3)
    around = np.searchsorted(used, around)
    if not _is_disc(faces, len(used), len(around)):
        raise HeadError("the curves around the scalp do not enclose one piece of skin without holes")
    starts = _sides_of(loop, corners)
    ring = np.concatenate([around, around[:1]])
    sides = tuple(ring[a : b + 1] for a, b in pairwise(starts))
    lengths = np.linalg.norm(normals[used], axis=1, keepdims=True)
    return Patch(TriangleMesh(vertices[used], faces), normals[used] / np.where(lengths > 0, lengths, 1), sides)


def _faces_left_of(faces: Ints, loop: Ints, vertex_count: int) -> Ints:
    """Indices of the faces that one reaches from the left of the loop without crossing it."""
    start = faces.reshape(-1)
    end = np.roll(faces, -1, axis=1).reshape(-1)
    owner = np.repeat(np.arange(len(faces)), 3)
    key = np.minimum(start, end) * vertex_count + np.maximum(start, end)
    loop_end = np.roll(loop, -1)
    wall = np.minimum(loop, loop_end) * vertex_count + np.maximum(loop, loop_end)
    open_edge = ~np.isin(key, wall)
    order = np.argsort(key[open_edge], kind="stable")
    sorted_key, sorted_owner = key[open_edge][order], owner[open_edge][order]
    pair = np.flatnonzero(sorted_key[1:] == sorted_key[:-1])
    links = coo_array(
        (np.ones(len(pair), dtype=bool), (sorted_owner[pair], sorted_owner[pair + 1])), shape=(len(faces), len(faces))
    )
    _, component = connected_components(links, directed=False)
    directed = start * vertex_count + end
    left = owner[np.isin(directed, loop * vertex_count + loop_end)]
    right = owner[np.isin(directed, loop_end * vertex_count + loop)]
    if np.intersect1d(component[left], component[right]).size:
        raise HeadError("the curves around the scalp do not separate it from the rest of the skin")
    return np.flatnonzero(np.isin(component, component[left]))


def _is_disc(faces: Ints, vertex_count: int, border_count: int) -> bool:
    pieces, _ = igl.facet_components(faces)
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, times = np.unique(edges, axis=0, return_counts=True)
    euler = vertex_count - len(unique) + len(faces)
    return pieces == 1 and euler == 1 and times.max() <= 2 and int((times == 1).sum()) == border_count


def _sides_of(loop: list[int], corners: list[int]) -> list[int]:
    """Where along the loop each side starts, and its end."""
    position = {vertex: k for k, vertex in enumerate(loop)}
    starts = [position.get(corner, -1) for corner in corners]
    if min(starts) < 0 or len(set(starts)) < len(corners) or starts != sorted(starts):
        raise HeadError(_CORNERS)
    return [*starts, len(loop)]
