"""Telling eyes, teeth and lashes from skin among the loose pieces of a file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .eyes import fit_sphere
from .head import Part
from .mesh import Ints, TriangleMesh
from .repair import face_components, without_loose_vertices

# All lengths in heights of the head, crown to chin (some 21 cm), all areas in squares of it.
_CRUMB = 2e-5
# Drawn figures have larger eyes than people.
_EYE_RADII = (0.035, 0.14)
_EYE_ROUNDNESS = 0.06
_EYE_SPREAD = (0.06, 0.28)
_EYE_LEVELS = (0.38, 0.65)
_MOUTH_LEVELS = (0.68, 1.0)
_MOUTH_HALF_WIDTH = 0.2
_LASH_REACH = 1.8


def pieces_of(mesh: TriangleMesh) -> list[TriangleMesh]:
    """The connected pieces of a mesh, the largest surface first."""
    piece = face_components(mesh.faces)
    faces_by_piece = np.split(np.argsort(piece, kind="stable"), np.cumsum(np.bincount(piece))[:-1])
    return [submesh(mesh, faces_by_piece[k]) for k in np.argsort(-np.bincount(piece, mesh.face_areas))]


def submesh(mesh: TriangleMesh, faces: Ints) -> TriangleMesh:
    """Some faces of a mesh, with only the vertices they use."""
    uv = None if mesh.corner_uv is None else mesh.corner_uv[faces]
    return without_loose_vertices(TriangleMesh(mesh.vertices, mesh.faces[faces], uv))


def joined(meshes: list[TriangleMesh]) -> TriangleMesh:
    """Several meshes as one; they stay apart from each other."""
    starts = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    uvs = [mesh.corner_uv for mesh in meshes if mesh.corner_uv is not None]
    return TriangleMesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts)]),
        np.concatenate(uvs) if len(uvs) == len(meshes) else None,
    )


@dataclass(frozen=True, eq=False)
class SortedPieces:
    """Loose pieces by what they are: those that belong to the skin, the parts, and what was dropped, a line each."""

    skin: list[TriangleMesh]
    parts: list[Part]
    notes: list[str]


def sort_pieces(pieces: list[TriangleMesh], top: float, height: float) -> SortedPieces:
    """Sort the loose pieces beside the head's skin [m], upright, mirrored at x = 0.

    Each eyeball is a part by itself; of teeth, lashes and the like all pieces make one part together.

    top: level of the crown [m]; height: of the head [m].
    """
    eyes, rest, shells = _eyes(pieces, top, height)
    skin: list[TriangleMesh] = []
    loose: dict[str, list[TriangleMesh]] = {}
    crumbs = 0
    for piece in rest:
        kind = _kind(piece, eyes, top, height)
        if kind in (None, "other") and piece.face_areas.sum() < _CRUMB * height**2:
            crumbs += 1
        elif kind is None:
            skin.append(piece)
        else:
            loose.setdefault(kind, []).append(piece)
    parts = [Part(kind, joined(alike)) for kind, alike in loose.items()]
    notes = []
    if crumbs:
        notes.append(f"{crumbs:,} tiny loose pieces dropped")
    if shells:
        notes.append(f"{shells} inner shells of the eyes dropped")
    return SortedPieces(skin, eyes + parts, notes)


def _eyes(pieces: list[TriangleMesh], top: float, height: float) -> tuple[list[Part], list[TriangleMesh], int]:
    """The eyeball of each side, left first, what is no eye, and how many balls inside others were left out."""
    balls: dict[bool, list[Part]] = {True: [], False: []}
    rest = []
    for piece in pieces:
        centre, radius = fit_sphere(piece.vertices)
        roundness = np.abs(np.linalg.norm(piece.vertices - centre, axis=1) - radius).mean() / radius
        level = (top - centre[1]) / height
        is_eye = (
            roundness < _EYE_ROUNDNESS
            and _EYE_RADII[0] < radius / height < _EYE_RADII[1]
            and _EYE_SPREAD[0] < abs(centre[0]) / height < _EYE_SPREAD[1]
            and _EYE_LEVELS[0] < level < _EYE_LEVELS[1]
        )
        if is_eye:
            balls[bool(centre[0] > 0)].append(Part("eye", piece, centre, np.array([0.0, 0.0, 1.0]), radius))
        else:
            rest.append(piece)
    eyes = [max(side, key=lambda eye: eye.mesh.face_areas.sum()) for side in balls.values() if side]
    return eyes, rest, sum(map(len, balls.values())) - len(eyes)


def _kind(piece: TriangleMesh, eyes: list[Part], top: float, height: float) -> str | None:
    """What a piece is: the kind of a part, or None when it belongs to the skin."""
    low, high = piece.bounds
    middle = 0.5 * (low + high)
    size = high - low
    for eye in eyes:
        away = middle - eye.centre
        if np.linalg.norm(away[:2]) < _LASH_REACH * eye.radius and size.max() < 4.0 * eye.radius:
            return "lashes" if away[1] < eye.radius else "brows"
    levels = (top - high[1]) / height, (top - low[1]) / height
    in_mouth = (
        _MOUTH_LEVELS[0] < levels[0]
        and levels[1] < _MOUTH_LEVELS[1]
        and abs(middle[0]) < 0.05 * height
        and size[0] < 2.0 * _MOUTH_HALF_WIDTH * height
    )
    if in_mouth:
        return "tongue" if size[2] > size[0] else "teeth"
    below_the_head = levels[0] > 0.8
    return None if below_the_head else "other"
