"""A map for a limb that brings none: its skin opened like a mitten, back and palm laid out side by side.

The skin is cut where back and palm meet, but for one straight stretch of that line (on a hand, along the little finger).
The back is seen from the front, the palm unfolded about that stretch, and springs even both out as any projection
(Bando's thesis, section 2.4). So the map is one piece, and what is bent around the limb lies side by side on it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import sparse
from scipy.ndimage import gaussian_filter1d
from scipy.sparse.csgraph import connected_components

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.repair import edge_neighbours, face_components, non_manifold_edge_count
from .body_part import Mask, split_at_seams
from .mapping import fitted
from .projection import Layout, TextureMapError, border_cycles
from .relaxation import relax

# A stretch that stays whole is no longer than this, over the straight way between its ends.
_CROOKED = 1.12
# Ends of stretches are looked for among so many vertices of the outline.
_TRIED = 220
# Back and palm are told apart by directions evened out so often over neighbouring triangles.
_EVENED = 2
# The cut is straightened over so many of its vertices.
_STRAIGHTENED = 2.0
# Patches of one side inside the other are given up so often before the surface counts as none that can be opened.
_PASSES = 50


def share_of_largest_piece(limb: TriangleMesh) -> float:
    """How much of a limb's area is on the largest piece of its own texture map, 0 to 1; 0 where it has none."""
    if limb.corner_uv is None:
        return 0.0
    opened = split_at_seams(limb).mesh
    areas = np.bincount(face_components(opened.faces), opened.face_areas)
    return float(areas.max() / areas.sum())


def with_map(limb: TriangleMesh, spread_out: Floats | None = None) -> TriangleMesh:
    """The limb with texture coordinates that are one to one, cut along its sides, on its largest piece.

    spread_out: the vertices in a pose that hides less of it, such as an open hand [m], (n, 3). Smaller pieces get the
    coordinates (0, 0). Raises TextureMapError for a limb with edges of more than two triangles, or with a handle.
    """
    if non_manifold_edge_count(limb.faces):
        raise TextureMapError("this limb has edges where more than two triangles meet; repair it")
    piece = face_components(limb.faces)
    own = np.flatnonzero(piece == np.bincount(piece, limb.face_areas).argmax())
    used, compact = np.unique(limb.faces[own], return_inverse=True)
    faces: Ints = compact.reshape(-1, 3)
    shown = (limb.vertices if spread_out is None else spread_out)[used]
    across, up, out = _axes(TriangleMesh(shown, faces))
    closed = _closed(TriangleMesh(shown, faces))
    back = _two_sides(closed, len(faces), out)
    outline = _outline(closed, back)
    seen = shown @ np.stack([across, up], axis=1)
    hinge = _straightest(outline, seen, len(used))

    # The palm has vertices of its own along the cut, and is turned over about the hinge.
    of_back = back[: len(faces)]
    cut = np.intersect1d(np.setdiff1d(outline, hinge), faces[~of_back])
    second = np.arange(len(used))
    second[cut] = len(used) + np.arange(len(cut))
    start, along = seen[hinge[0]], seen[hinge[-1]] - seen[hinge[0]]
    along = along / np.linalg.norm(along)
    turned = start + 2.0 * np.outer((seen - start) @ along, along) - (seen - start)
    of_palm = np.setdiff1d(faces[~of_back], outline)
    places = np.concatenate([seen, turned[cut]])
    places[of_palm] = turned[of_palm]
    # Where an end is open a vertex may belong to one side alone.
    kept, corner = np.unique(np.where(of_back[:, None], faces, second[faces]), return_inverse=True)
    vertices = limb.vertices[np.concatenate([used, used[cut]])][kept]
    mesh = TriangleMesh(vertices, corner.reshape(-1, 3))
    places = places[kept]
    # The cut runs in zigzag from triangle to triangle.
    around = max(border_cycles(mesh.faces), key=len)
    places[around] = gaussian_filter1d(places[around], _STRAIGHTENED, axis=0, mode="wrap")
    relaxed = relax(mesh, Layout(places, np.zeros_like(mesh.faces)))
    corners = np.zeros((len(limb.faces), 3, 2))
    corners[own] = fitted(mesh, relaxed.layout, relaxed.note).corner_uv
    return replace(limb, corner_uv=corners)


def long_side(limb: TriangleMesh) -> Floats:
    """Unit direction in which a limb is longest, (3,)."""
    return _axes(limb)[1]


def _axes(mesh: TriangleMesh) -> tuple[Floats, Floats, Floats]:
    """Unit directions across the limb, along it and out of its flat side, right-handed, (3,) each."""
    centres = mesh.vertices[mesh.faces].mean(axis=1)
    centres = centres - np.average(centres, axis=0, weights=mesh.face_areas)
    _, axes = np.linalg.eigh((centres * mesh.face_areas[:, None]).T @ centres)
    out, across = axes[:, 0], axes[:, 1]
    # Seen with the hand upright and its back (+Z) in front where that can be told.
    out = out * (1.0 if out[np.abs(out).argmax()] > 0 else -1.0)
    return across, np.cross(out, across), out


def _closed(mesh: TriangleMesh) -> TriangleMesh:
    """The mesh with a fan of triangles over every open end, after its own. Raises TextureMapError for no ball then."""
    vertices, faces = [mesh.vertices], [mesh.faces]
    for k, cycle in enumerate(border_cycles(mesh.faces)):
        vertices.append(mesh.vertices[cycle].mean(axis=0, keepdims=True))
        faces.append(np.stack([np.roll(cycle, -1), cycle, np.full(len(cycle), len(mesh.vertices) + k)], axis=1))
    closed = TriangleMesh(np.concatenate(vertices), np.concatenate(faces))
    edges = 3 * len(closed.faces) // 2
    if len(closed.vertices) - edges + len(closed.faces) != 2:
        raise TextureMapError(
            "this limb has a handle or touches itself; only one that could be blown up to a ball is mapped"
        )
    return closed


def _two_sides(ball: TriangleMesh, own: int, out: Floats) -> Mask:
    """Which triangles of a closed surface are its front as seen from ``out``, (m,): one piece, and so is the rest.

    own: how many triangles are the limb's; those after them close its open ends.
    """
    pairs = edge_neighbours(ball.faces)
    count = len(ball.faces)
    joined = sparse.coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    joined = sparse.csr_array(joined + joined.T)
    facing = ball.face_areas * (ball.face_normals @ out)
    for _ in range(_EVENED):
        facing = facing + joined @ facing
    front = facing > 0
    for _ in range(_PASSES):
        same = pairs[front[pairs[:, 0]] == front[pairs[:, 1]]]
        graph = sparse.coo_array((np.ones(len(same)), (same[:, 0], same[:, 1])), shape=(count, count))
        pieces, label = connected_components(graph, directed=False)
        if pieces > 2:
            # What is not the largest piece of its side goes to the other.
            area = np.bincount(label, ball.face_areas)
            kept = [np.flatnonzero(label == label[side][area[label[side]].argmax()]) for side in _both(front)]
            lost = np.setdiff1d(np.arange(count), np.concatenate(kept))
            front[lost] = ~front[lost]
            continue
        pinched = _pinched(ball.faces, front, own)
        if len(pinched):
            # Around a vertex that is met twice all goes to one side, that of the open end if it lies on one.
            around = np.flatnonzero((ball.faces == pinched[0]).any(axis=1))
            front[around] = front[around[-1]]
            continue
        ears = _ears(pairs, front)
        if not len(ears):
            return front
        front[ears] = ~front[ears]
    raise TextureMapError("back and palm of this limb cannot be told apart; repair or remesh it")


def _both(front: Mask) -> tuple[Ints, Ints]:
    sides = np.flatnonzero(front), np.flatnonzero(~front)
    if not all(len(side) for side in sides):
        raise TextureMapError("this limb has only one side")
    return sides


def _ears(pairs: Ints, front: Mask) -> Ints:
    """Triangles that stand out into the other side and would be fixed with all corners; no two are neighbours, (k,)."""
    differ = pairs[front[pairs[:, 0]] != front[pairs[:, 1]]]
    ear = np.bincount(differ.ravel(), minlength=len(front)) > 1
    ear[pairs[ear[pairs].all(axis=1), 1]] = False
    return np.flatnonzero(ear)


def _pinched(faces: Ints, front: Mask, own: int) -> Ints:
    """Vertices where the border of a side passes more than once, with the open ends, too, open, (k,)."""
    sides = [_border_edges(faces[:own], side[:own])[:, 0] for side in (front, ~front)]
    count = int(faces.max()) + 1
    return np.flatnonzero(np.maximum(*(np.bincount(side, minlength=count) for side in sides)) > 1)


def _border_edges(faces: Ints, front: Mask) -> Ints:
    """Edges of the front, as its triangles run through them, that the rest has on its other side, (k, 2)."""
    half_edges = faces[front][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    count = int(faces.max()) + 1
    inner = np.isin(half_edges @ [count, 1], half_edges[:, ::-1] @ [count, 1])
    return half_edges[~inner]


def _outline(ball: TriangleMesh, front: Mask) -> Ints:
    """The vertices between both sides in order, the front on the left, (k,)."""
    edges = _border_edges(ball.faces, front)
    after = np.full(len(ball.vertices), -1)
    after[edges[:, 0]] = edges[:, 1]
    outline = np.empty(len(edges), dtype=np.int64)
    outline[0] = edges[0, 0]
    for k in range(1, len(edges)):
        outline[k] = after[outline[k - 1]]
    return outline


def _straightest(outline: Ints, seen: Floats, own: int) -> Ints:
    """The longest stretch of the outline, (k,), that is nearly straight and has all the rest on one side of it.

    own: how many vertices are the limb's own; those after them close its open ends, and no stretch runs over them.
    seen: where the limb's own vertices appear [m], (own, 2).
    """
    filled = np.flatnonzero(outline >= own)
    if len(filled):
        outline = np.roll(outline, -filled[0])
    count = len(outline)
    real = outline < own
    points = np.zeros((count, 2))
    points[real] = seen[outline[real]]
    walked = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    gaps = np.concatenate([[0], np.cumsum(~real)])
    tried = np.unique(np.linspace(0, count - 1, min(count, _TRIED)).astype(np.int64))
    tried = tried[real[tried]]
    first, last = (index.ravel() for index in np.meshgrid(tried, tried, indexing="ij"))
    chord = np.linalg.norm(points[last] - points[first], axis=1)
    fits = (last > first + 1) & (gaps[last + 1] == gaps[first]) & (walked[last] - walked[first] < _CROOKED * chord)
    fits &= last - first < count - 2
    first, last, chord = first[fits], last[fits], chord[fits]
    for k in np.argsort(-chord):
        line = points[last[k]] - points[first[k]]
        away = points - points[first[k]]
        rest = np.ones(count, dtype=bool)
        rest[first[k] : last[k] + 1] = False
        # The front lies to the left of its outline.
        side = line[0] * away[:, 1] - line[1] * away[:, 0]
        if (side[rest & real] > 0).all():
            return outline[first[k] : last[k] + 1]
    raise TextureMapError("this limb has no straight side along which it could be unfolded")
