"""``headstudio wrinkle``: a face with an expression and its wrinkles, as a picture or as a mesh."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..head.head import Head
from ..io.faces import write_stage_mesh
from ..io.meshes import MESH_SUFFIXES
from ..params import ParameterError, assign
from ..scene.document import Document
from ..wrinkle.expressions import FACES
from ..wrinkle.face_settings import SLIDERS
from .documents import animate
from .pictures import Photographer, Size, save_picture
from .reporting import say, warn, working

# Room for the face in the picture, from hairline to chin.
_ROOM = 1.2
# The middle of the picture lies so far from the front of the face to the ears.
_BEHIND = 0.3


def face_settings(preset: str | None, expressions: Sequence[str]) -> dict[str, Any]:
    """Parameters for a face by its name and words such as "smile=0.8". Raises ParameterError."""
    if preset is not None and preset not in FACES:
        raise ParameterError(f"there is no face {preset!r}; choose from {', '.join(FACES)}")
    weights: dict[str, Any] = dict(FACES[preset]) if preset is not None else {}
    for word in expressions:
        name, equals, value = word.partition("=")
        if not equals or name not in SLIDERS:
            raise ParameterError(f"an expression is written NAME=0.8, NAME one of {', '.join(SLIDERS)}; got {word!r}")
        weights[name] = value
    return {f"face.{name}": value for name, value in weights.items()}


def with_face(document: Document, preset: str | None, expressions: Sequence[str], wrinkles: bool) -> Document:
    """The document with a living face. Hair is left out unless the document shows strands. Raises ParameterError."""
    changes: dict[str, Any] = {"look.skin_as": "living", **face_settings(preset, expressions)}
    if document.look.hair_as == "particles":
        changes["look.hair_as"] = "none"
    if not wrinkles:
        changes |= {"wrinkle.shown": False, "fine.on": False}
    return assign(document, changes)


def close_up(document: Document, head: Head) -> Document:
    """The document with its camera on the face, from the side it looks from."""
    marks = head.landmarks
    # The face fills the picture from chin to hairline; from the side, too, it is what stands in the middle.
    front, ears = 0.5 * (marks.hairline + marks.chin), 0.5 * (marks.left_tragus + marks.right_tragus)
    x, y, z = front + _BEHIND * (ears - front) * [1.0, 0.0, 1.0]
    height = float(np.linalg.norm(marks.hairline - marks.chin))
    distance = 0.5 * _ROOM * height / math.tan(0.5 * document.camera.field_of_view)
    return assign(
        document,
        {"camera.target_x": x, "camera.target_y": y, "camera.target_z": z, "camera.distance": distance},
    )


def wrinkle(document: Document, out: Path, size: Size, framed: bool) -> None:
    """Write the face of a document as a picture (.png) or as a mesh; ``framed``: the camera goes close to the face.

    Raises HeadError, ParameterError, OSError.
    """
    suffix = out.suffix.lower()
    if suffix != ".png" and suffix not in MESH_SUFFIXES:
        raise ParameterError(f"a face is written to .png, {', '.join(MESH_SUFFIXES)}; got {out.name!r}")
    stage = animate(document).stage()
    why = stage.skin.face.why_lids_stay(document.face) if stage.skin is not None else None
    if why is not None:
        warn(why)
    if suffix == ".png":
        document = close_up(document, stage.head) if framed else document
        save_picture(Photographer(size).final(stage, document, size), out)
    else:
        with working(f"writing {out.name}"):
            write_stage_mesh(stage, out)
    say(str(out))
