"""Pieces of a skin that wrinkles are laid out on: a face, a whole head, whatever an artist selects."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..head.head import Head
from ..head.locate import Locator
from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.parts import joined
from ..head.repair import edge_neighbours, face_components

Mask = NDArray[np.bool_]

# The face reaches this far below the chin and above the hairline, in heights of the head: neck lines, high foreheads.
_NECK = 0.38
_SCALP = 0.06
# It ends this far in front of the ears [heights of the head].
_BEFORE_EARS = 0.05
# On the neck it ends this far behind them.
_NECK_SIDES = 0.06
# A whole head is opened at the crown, where no wrinkle is: a hole of this radius [heights of the head].
_CROWN = 0.1
# Rays that tell what is open to the air: directions, the least cosine to the normal, how far above the skin they start [m].
_DIRECTIONS = 60
_GRAZING = 0.25
_RAY_START = 1e-5


@dataclass(frozen=True, eq=False)
class BodyPart:
    """A connected piece of a skin.

    mesh: the piece, without loose vertices, n vertices, m triangles. vertices: where its vertices are in the skin, (n,);
    a skin vertex may occur twice where texture coordinates are cut. faces: where its triangles are in the skin, (m,).
    """

    mesh: TriangleMesh
    vertices: Ints
    faces: Ints


def body_part(skin: TriangleMesh, selected: Mask) -> BodyPart:
    """The largest connected piece of the ``selected`` faces of a skin, (m,).

    Triangles are dropped where only a vertex holds the piece together, and where one hangs on the piece by a single
    edge: a map fixes all its corners, and zigzags of the border would turn it over. Raises ValueError when nothing is
    selected.
    """
    if not selected.any():
        raise ValueError("no triangle of the skin lies in this part of the body")
    kept = _largest(skin, selected)
    while True:
        lost = _pinched_faces(skin.faces, kept) | _hanging_faces(skin.faces, kept)
        if not lost.any() or not (kept & ~lost).any():
            break
        kept = _largest(skin, kept & ~lost)
    return extract(skin, np.flatnonzero(kept))


def open_to_air(head: Head) -> Mask:
    """The faces of a head's skin that light reaches, (m,): not the inside of mouth, nostrils and eye sockets.

    A face counts when a straight way out of the head, past eyes and teeth too, leads from each of its corners.
    """
    skin = head.skin
    everything = joined(
        [TriangleMesh(mesh.vertices, mesh.faces) for mesh in (skin, *(part.mesh for part in head.parts))]
    )
    rays = Locator(everything.vertices, everything.faces)
    normals = skin.vertex_normals
    starts = skin.vertices + _RAY_START * normals
    hidden = np.arange(len(skin.vertices))
    for direction in _fibonacci_sphere(_DIRECTIONS):
        facing = hidden[normals[hidden] @ direction > _GRAZING]
        way = rays.first_hit(starts[facing], np.broadcast_to(direction, (len(facing), 3)).copy())
        hidden = np.setdiff1d(hidden, facing[np.isinf(way)])
    dark = np.zeros(len(skin.vertices), dtype=bool)
    dark[hidden] = True
    return np.asarray(~dark[skin.faces].any(axis=1), dtype=bool)


def _fibonacci_sphere(count: int) -> Floats:
    """Directions spread evenly over the sphere, (count, 3)."""
    height = 1 - (2 * np.arange(count) + 1) / count
    angle = np.arange(count) * np.pi * (3 - np.sqrt(5))
    across = np.sqrt(1 - height**2)
    return np.stack([across * np.sin(angle), height, across * np.cos(angle)], axis=1)


def extract(skin: TriangleMesh, faces: Ints) -> BodyPart:
    """The faces with these indices, (m,), and only the vertices they use."""
    vertices, compact = np.unique(skin.faces[faces], return_inverse=True)
    uv = None if skin.corner_uv is None else skin.corner_uv[faces]
    return BodyPart(TriangleMesh(skin.vertices[vertices], compact.reshape(-1, 3), uv), vertices, faces)


def face_part(head: Head) -> BodyPart:
    """The part of a head that carries expressive wrinkles: forehead to the front of the neck, ear to ear. A disc."""
    marks = head.landmarks
    height = marks.crown[1] - marks.chin[1]
    ears = 0.5 * (marks.left_tragus + marks.right_tragus)
    centres = head.skin.vertices[head.skin.faces].mean(axis=1)
    level = (centres[:, 1] > marks.chin[1] - _NECK * height) & (centres[:, 1] < marks.hairline[1] + _SCALP * height)
    # Below the ears the part reaches farther back, around the neck.
    mouth = 0.5 * (marks.mouth_left + marks.mouth_right)
    below = np.clip((mouth[1] - centres[:, 1]) / (mouth[1] - marks.chin[1]), 0.0, 1.0)
    back = ears[2] + (_BEFORE_EARS - (_BEFORE_EARS + _NECK_SIDES) * below) * height
    broad = np.abs(centres[:, 0]) < max(marks.left_tragus[0], -marks.right_tragus[0])
    return body_part(head.skin, open_to_air(head) & level & broad & (centres[:, 2] > back))


def head_part(head: Head) -> BodyPart:
    """All the skin of a head but a small disc at the crown: with its open neck, a tube that maps to a cylinder."""
    marks = head.landmarks
    height = marks.crown[1] - marks.chin[1]
    centres = head.skin.vertices[head.skin.faces].mean(axis=1)
    at_crown = np.linalg.norm(centres - marks.crown, axis=1) < _CROWN * height
    return body_part(head.skin, open_to_air(head) & ~at_crown)


def split_at_seams(skin: TriangleMesh) -> BodyPart:
    """A skin cut open where its own texture coordinates are: every vertex has one (u, v).

    Raises ValueError for a skin without texture coordinates.
    """
    if skin.corner_uv is None:
        raise ValueError("this mesh has no texture coordinates of its own")
    corners = np.column_stack([skin.faces.ravel(), np.round(skin.corner_uv.reshape(-1, 2), 7)])
    _, first, compact = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    vertices = skin.faces.ravel()[first]
    mesh = TriangleMesh(skin.vertices[vertices], compact.reshape(-1, 3), skin.corner_uv)
    return BodyPart(mesh, vertices, np.arange(len(skin.faces)))


def _largest(skin: TriangleMesh, selected: Mask) -> Mask:
    """The piece of the selected faces that has the largest area, (m,)."""
    chosen = np.flatnonzero(selected)
    piece = face_components(skin.faces[chosen])
    best = np.bincount(piece, skin.face_areas[chosen]).argmax()
    kept = np.zeros(len(skin.faces), dtype=bool)
    kept[chosen[piece == best]] = True
    return kept


def _hanging_faces(faces: Ints, kept: Mask) -> Mask:
    """Kept faces with two sides on the border, (m,)."""
    chosen = np.flatnonzero(kept)
    inner = np.bincount(edge_neighbours(faces[chosen]).ravel(), minlength=len(chosen))
    hanging = np.zeros(len(faces), dtype=bool)
    hanging[chosen[inner < 2]] = True
    return hanging


def _pinched_faces(faces: Ints, kept: Mask) -> Mask:
    """Kept faces at a vertex with more than one fan of kept faces around it, (m,)."""
    half_edges = faces[kept][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    count = int(faces.max()) + 1
    keys = half_edges @ [count, 1]
    border = half_edges[~np.isin(keys, half_edges[:, ::-1] @ [count, 1])]
    pinched = np.bincount(border[:, 0], minlength=count) > 1
    return kept & pinched[faces].any(axis=1)
