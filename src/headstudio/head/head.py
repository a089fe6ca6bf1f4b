"""A head as everything else sees it: one skin, its loose parts, and the points that anatomy names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from .mesh import Floats, Ints, TriangleMesh
from .neck import Neck


class HeadError(ValueError):
    """A file or name that gives no usable head. The message is one line for the user."""


@dataclass(frozen=True, eq=False)
class Landmarks:
    """Named points on the skin [m], each of shape (3,), in the head frame. Left and right are the person's own.

    crown: top of the head. hairline: middle of the upper forehead, where hair starts. glabella: between the brows.
    nasion: root of the nose. nose_tip. chin: lowest point of the chin in front. nape: where hair ends on the neck.
    occiput: hindmost point of the skull. left_tragus, right_tragus: in front of the ear hole. left_eye, right_eye:
    centres of the pupils. mouth_left, mouth_right: corners of the mouth.
    """

    crown: Floats
    hairline: Floats
    glabella: Floats
    nasion: Floats
    nose_tip: Floats
    chin: Floats
    nape: Floats
    occiput: Floats
    left_tragus: Floats
    right_tragus: Floats
    left_eye: Floats
    right_eye: Floats
    mouth_left: Floats
    mouth_right: Floats


@dataclass(frozen=True, eq=False)
class Part:
    """Something that is not skin: an eye, the teeth, lashes. It moves with the head, hair does not collide with it.

    kind: "eye", "teeth", "tongue", "lashes", "brows" or "other". For an eye, ``axis`` points out of the pupil, shape
    (3,), ``centre`` is the middle of the ball [m] and ``radius`` its radius [m]; the renderer draws iris and pupil from
    these, so that eyes need no texture.
    """

    kind: str
    mesh: TriangleMesh
    centre: Floats | None = None
    axis: Floats | None = None
    radius: float = 0.0


@dataclass(frozen=True, eq=False)
class Expression:
    """One unit of facial expression: how far some vertices of the skin move at full strength.

    vertices: indices into the skin, shape (k,). offsets: displacements [m], shape (k, 3).
    """

    vertices: Ints
    offsets: Floats


@dataclass(frozen=True, eq=False)
class Head:
    """A bust in the head frame: origin at the base of the skull, +Y up, the face along +Z, metres.

    neck: where the turn of the head fades. notes: what was found and what was done to the source, a line each, for
    ``headstudio inspect``.
    """

    name: str
    skin: TriangleMesh
    neck: Neck
    landmarks: Landmarks
    parts: tuple[Part, ...] = ()
    expressions: Mapping[str, Expression] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    from_file: Floats | None = None

    @cached_property
    def head_weight(self) -> Floats:
        """1 where the skin turns with the head, 0 on the torso, between on the neck: per vertex, (n,)."""
        return self.neck.share(self.skin.vertices)
