"""A head from a mesh file: read, repaired, stood upright, cut to a bust, and its points named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from .bust import cut_bust, neck_of
from .eyes import pupil
from .head import Head, HeadError, Landmarks, Part
from .landmarks import find_landmarks, skull_base
from .mesh import Floats, TriangleMesh
from .mouth import with_mouth
from .orient import Stance, find_stance
from .parts import joined, pieces_of, sort_pieces
from .profile import midline
from .read import read_mesh
from .repair import Repairs, border_loops, repair
from .units import guess_unit

# A piece with less than this part of the largest one's surface cannot be the head.
_CANDIDATE_AREA = 0.15
_CANDIDATES = 3
_FEWEST_FACES = 150


def head_from_file(path: str | Path, eyes: str | Path | None = None) -> Head:
    """The head in an OBJ, PLY, STL, OFF or GLB file; ``Head.notes`` says what was found and what was done.

    eyes: another file in the same place, unit and axes, with eyes, teeth or lashes that the first has not. Raises
    HeadError, one line for the user, when a file is not usable.
    """
    soup = read_mesh(path)
    mesh, repairs = repair(soup if eyes is None else soup.with_(read_mesh(eyes)))
    return head_from_mesh(mesh, repairs, Path(path))


def head_from_mesh(mesh: TriangleMesh, repairs: Repairs, path: Path) -> Head:
    """The head in a repaired mesh, in any unit and any axes. ``path`` names it. Raises HeadError when there is none."""
    pieces = pieces_of(mesh)
    skin, loose, stance = _find_head(pieces, path.name)
    unit = guess_unit(stance.height)
    skin, *loose = (piece.moved(stance.upright(piece.vertices, unit.metres)) for piece in (skin, *loose))
    height = stance.height * unit.metres
    found = sort_pieces(loose, float(midline(skin).level[-1]), height)

    landmarks = find_landmarks(skin, height, _pupils(found.parts))
    origin = skull_base(landmarks)
    landmarks = Landmarks(**{name: point - origin for name, point in vars(landmarks).items()})
    body = joined([skin, *found.skin])
    bust, _ = cut_bust(body.moved(body.vertices - origin), landmarks)
    parts = tuple(_moved(part, -origin) for part in found.parts)
    head = Head(
        name=path.stem,
        skin=bust,
        neck=neck_of(landmarks),
        landmarks=landmarks,
        parts=parts,
        notes=(
            f"{repairs.vertices_in_file:,} vertices and {repairs.faces_in_file:,} triangles in the file",
            *repairs.lines(),
            _axes_note(stance),
            unit.note,
            _pieces_note(len(pieces), parts),
            *found.notes,
            *_bust_notes(body, bust),
        ),
        from_file=_placement(stance, unit.metres, origin),
    )
    return with_mouth(head)


def _find_head(pieces: list[TriangleMesh], name: str) -> tuple[TriangleMesh, list[TriangleMesh], Stance]:
    """The piece that is the skin of the head, the other pieces, and how the head stands.

    A file may hold clothes and a body beside the head: the large pieces are tried one by one, and, for a skin that is
    in pieces itself, all together.
    """
    count = sum(len(piece.faces) for piece in pieces)
    if count < _FEWEST_FACES:
        raise HeadError(f"{name} has only {count:,} usable triangles: a head takes at least {_FEWEST_FACES}")
    area = pieces[0].face_areas.sum()
    large = [piece for piece in pieces[:_CANDIDATES] if piece.face_areas.sum() >= _CANDIDATE_AREA * area]
    stances = [(_stance(piece), k) for k, piece in enumerate(large)]
    known = [(stance, k) for stance, k in stances if stance is not None]
    if known:
        stance, k = min(known, key=lambda pair: pair[0].misfit)
        return pieces[k], pieces[:k] + pieces[k + 1 :], stance
    together = joined(pieces)
    whole = _stance(together) if len(pieces) > 1 else None
    if whole is None:
        raise HeadError(f"{name} does not look like a human head from any side: give a surface with face and skull")
    return together, [], whole


def _stance(piece: TriangleMesh) -> Stance | None:
    return find_stance(piece) if len(piece.faces) >= _FEWEST_FACES else None


def _pupils(parts: list[Part]) -> tuple[Floats, Floats] | None:
    """The pupils, left and right, when the file has both eyes."""
    eyes = [part for part in parts if part.kind == "eye"]
    if len(eyes) != 2:
        return None
    return pupil(eyes[0]), pupil(eyes[1])


def _moved(part: Part, shift: Floats) -> Part:
    centre = None if part.centre is None else part.centre + shift
    return replace(part, mesh=part.mesh.moved(part.mesh.vertices + shift), centre=centre)


def _placement(stance: Stance, metres: float, origin: Floats) -> Floats:
    """What was done to every point of the file, as a matrix."""
    matrix = np.eye(4)
    matrix[:3, 3] = stance.upright(np.zeros((1, 3)), metres)[0] - origin
    matrix[:3, :3] = metres * stance.rotation
    return matrix


def _axes_note(stance: Stance) -> str:
    if stance.axes is None:
        return "axes guessed: the head stands askew in the file and was set upright"
    return "axes guessed: {} is up, the face looks along {}".format(*stance.axes)


def _pieces_note(count: int, parts: tuple[Part, ...]) -> str:
    kinds = [part.kind for part in parts]
    found = ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds))
    pieces = f"{count:,} connected pieces" if count > 1 else "one connected piece"
    return f"{pieces}: {found} split off the skin" if found else pieces


def _bust_notes(body: TriangleMesh, bust: TriangleMesh) -> list[str]:
    """What was cut away, and what is left open."""
    notes = []
    removed = 1.0 - bust.face_areas.sum() / body.face_areas.sum()
    if removed > 1e-6:
        notes.append(f"body cut below the shoulders: {removed:.0%} of its surface removed")
    holes = len(border_loops(bust.faces))
    if holes:
        notes.append(f"{holes} open borders, the cut through neck or chest among them")
    return notes
