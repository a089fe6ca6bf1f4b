"""Laying a closed curve into a mesh: from knot to knot, face by face, splitting every edge that it crosses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from heapq import heappop, heappush

import numpy as np

from .head import HeadError
from .locate import SurfacePoints
from .mesh import Ints
from .splitting import SplittableMesh

# Nearer to a corner or an edge than this part of the triangle, the curve goes through the corner or edge itself: what
# that moves is invisible, and what it avoids are slivers, on which neither cotangents nor the next trace can rely.
_SNAP_KNOT = 0.08
_SNAP_CROSSING = 0.03
_LEFT_OUT = -1
_CROSSING = "the curves around the scalp cross or touch each other"
_LOST = "a curve around the scalp gets lost in a fold of the skin; lead it around ears and mouth"


def insert_knots(mesh: SplittableMesh, surface_faces: Ints, knots: SurfacePoints, corners: Sequence[int]) -> list[int]:
    """Make the knots of a closed curve vertices of the mesh: one vertex a knot, -1 for knots that are left out.

    Only one knot of every face is taken, and ``corners`` (indices of knots) come first. A knot that is almost on a
    vertex or an edge takes that. Raises HeadError when a corner falls on another one.
    """
    vertices = [_LEFT_OUT] * len(knots.faces)
    taken = {_LEFT_OUT}
    for k in [*corners, *_one_knot_per_face(knots.faces, corners)]:
        vertex = _insert(mesh, surface_faces[knots.faces[k]].tolist(), knots.weights[k].tolist())
        if vertex not in taken:
            vertices[k] = vertex
            taken.add(vertex)
        elif k in corners:
            raise HeadError("two corners of the scalp fall together; move its curves apart")
    return vertices


def _one_knot_per_face(faces: Ints, corners: Sequence[int]) -> list[int]:
    """The middle knot of the first run of knots in each face that holds no corner."""
    run_start = np.flatnonzero(np.diff(faces, prepend=-1) != 0)
    run_end = np.append(run_start[1:], len(faces))
    _, first_run = np.unique(faces[run_start], return_index=True)
    middles = (run_start[first_run] + run_end[first_run] - 1) // 2
    return np.sort(middles[~np.isin(faces[middles], faces[list(corners)])]).tolist()


def _insert(mesh: SplittableMesh, face: Sequence[int], weights: Sequence[float]) -> int:
    smallest = int(np.argmin(weights))
    a, b, c = (face[(smallest + k) % 3] for k in range(3))
    of_a, of_b, of_c = (weights[(smallest + k) % 3] for k in range(3))
    if min(of_a + of_b, of_a + of_c) < _SNAP_KNOT:
        return b if of_b > of_c else c
    if of_a < _SNAP_KNOT and mesh.has_edge(b, c):
        return mesh.split_edge(b, c, of_c / (of_b + of_c))
    if mesh.opposite[a].get(b) == c:
        return mesh.split_face(a, b, c, (of_a, of_b, of_c))
    # The knot of a neighbour has split this triangle already, and stands for this one.
    return _LEFT_OUT


def trace_loop(mesh: SplittableMesh, stops: Sequence[int], corners: Sequence[int]) -> list[int]:
    """Lay the closed curve through the vertices ``stops`` along edges of the mesh: its vertices in order.

    Between two stops the curve is the cut of the surface with the plane through both that stands upright on it. In a
    fold of the skin that plane may lead nowhere: there the curve takes the shortest way along edges. It keeps to
    ``corners``, and may leave out another stop that hangs on it by one edge. Raises HeadError when it meets itself or
    the border of the mesh.
    """
    loop = [stops[0]]
    before = {stops[0]: -1}
    kept = set(corners)
    for target in [*stops[1:], stops[0]]:
        if target in before and target != stops[0]:
            continue
        given_up: set[int] = set()
        steps_left = len(mesh.opposite)
        while loop[-1] != target:
            steps_left -= 1
            may_turn_back = loop[-1] not in kept
            vertex = _step(mesh, loop, target, before, may_turn_back)
            if may_turn_back and vertex == loop[-2]:
                given_up.add(loop[-1])
                del before[loop.pop()]
            elif vertex == target == stops[0]:
                return loop
            elif vertex in given_up or steps_left < 0:
                # The curve has been there and came back, or gets no nearer.
                way = _shortest_way(mesh, loop[-1], target, before)
                if target == stops[0]:
                    return loop + way[:-1]
                before.update(zip(way, [loop[-1], *way]))
                loop += way
            elif vertex not in before:
                before[vertex] = loop[-1]
                loop.append(vertex)
            else:
                raise HeadError(_CROSSING)
    return loop


def _shortest_way(mesh: SplittableMesh, vertex: int, target: int, before: Mapping[int, int]) -> list[int]:
    """The vertices after ``vertex`` on the shortest way along edges to ``target``, which meets nothing in ``before``. Raises
    HeadError when there is none.
    """
    reached = {vertex: vertex}
    edge = [(0.0, vertex, vertex)]
    while edge:
        length, here, came_from = heappop(edge)
        if here != vertex and here in reached:
            continue
        reached[here] = came_from
        if here == target:
            way = [target]
            while reached[way[0]] != vertex:
                way.insert(0, reached[way[0]])
            return way
        around = {*mesh.opposite[here], *mesh.opposite[here].values()}
        for there in around:
            if there not in reached and (there not in before or there == target):
                step = float(np.linalg.norm(mesh.positions[there] - mesh.positions[here]))
                heappush(edge, (length + step, there, here))
    raise HeadError(_LOST)


def _step(
    mesh: SplittableMesh, loop: Sequence[int], target: int, before: Mapping[int, int], may_turn_back: bool
) -> int:
    """The next vertex on the way to ``target``; splits the edge that the way crosses.

    ``before`` tells for every vertex of the loop which one it was reached from. Only the last of these is a possible
    answer, if the way ``may_turn_back``: then the loop has made a detour to a knot that is as good as on it.
    """
    vertex = loop[-1]
    if mesh.has_edge(vertex, target):
        return target
    here = mesh.positions[vertex]
    way = mesh.positions[target] - here
    right = np.cross(way, mesh.normals[vertex] + mesh.normals[target])
    rim = list(mesh.opposite[vertex].items())
    first = np.array([mesh.positions[b] for b, _ in rim]) - here
    second = np.array([mesh.positions[c] for _, c in rim]) - here
    from_right, to_left = first @ right, second @ right
    crossed = (from_right >= 0) & (to_left <= 0) & (from_right > to_left)
    part = np.divide(from_right, from_right - to_left, out=np.zeros(len(rim)), where=crossed)
    meeting = first + part[:, None] * (second - first)
    ahead = np.where(crossed, meeting @ way / np.maximum(np.linalg.norm(meeting, axis=1), 1e-300), -np.inf)
    best = int(np.argmax(ahead))
    if ahead[best] <= 0:
        return _over_crease(mesh, vertex, target, before)
    (b, c), at = rim[best], float(part[best])
    near = b if at < _SNAP_CROSSING else c if at > 1 - _SNAP_CROSSING else -1
    if near >= 0 and (near not in before or near == target or (may_turn_back and near == before[vertex])):
        return near
    if before.get(b) == c or before.get(c) == b:
        raise HeadError(_CROSSING)
    return mesh.split_edge(b, c, min(max(at, _SNAP_CROSSING), 1 - _SNAP_CROSSING))


def _over_crease(mesh: SplittableMesh, vertex: int, target: int, before: Mapping[int, int]) -> int:
    """Where to go when no triangle lies ahead, as on a sharp crease: the free neighbour that is nearest to the target."""
    starts, ends = set(mesh.opposite[vertex]), set(mesh.opposite[vertex].values())
    free = [b for b in starts if b not in before]
    if starts != ends:
        raise HeadError("a curve around the scalp runs over the border of the skin")
    if not free:
        raise HeadError(_LOST)
    distance = np.linalg.norm([mesh.positions[b] - mesh.positions[target] for b in free], axis=1)
    return free[int(np.argmin(distance))]


def split_chords(mesh: SplittableMesh, loop: Sequence[int]) -> None:
    """Split every edge that joins two vertices of the loop without being part of it.

    Such an edge would lie flat on a side of the square, and so would the triangle beside it.
    """
    neighbours = {a: {b, c} for a, b, c in zip(loop, [*loop[1:], loop[0]], [loop[-1], *loop[:-1]])}
    for a in loop:
        for b in [b for b in mesh.opposite[a] if b in neighbours and b not in neighbours[a]]:
            mesh.split_edge(a, b, 0.5)
