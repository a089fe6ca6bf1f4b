"""The head, shoulders, eyes, teeth and lashes on the graphics card."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.head import Head, Part
from ..head.mesh import Floats, TriangleMesh
from ..lcp.model import HairModel
from ..scene.settings import Look
from .context import load_program, set_uniforms
from .scene_block import linear
from .skin_paint import coarse_faces, paint, scalp_cover

# Details below this [m] are left out of the body that casts shadows.
_SHADOW_DETAIL = 0.004
_UNSEEN_SHADOW_KINDS = ("eye", "teeth", "tongue")


class BodyPrograms:
    """The shaders that draw a body."""

    def __init__(self, context: moderngl.Context) -> None:
        self.depth = load_program(context, "body/depth.vert", "body/depth.frag")
        self.skin = load_program(context, "body/skin.vert", "body/skin.frag")
        self.part = load_program(context, "body/part.vert", "body/part.frag")


class Body:
    """Everything of one head that is drawn as triangles; made once per head."""

    def __init__(self, context: moderngl.Context, programs: BodyPrograms, head: Head) -> None:
        self.head = head
        self._programs = programs
        self._cover_of: HairModel | None = None
        skin = head.skin
        surface = np.concatenate([skin.vertices, skin.vertex_normals, head.head_weight[:, None]], axis=1)
        vertices = context.buffer(_floats(surface))
        self._cover = context.buffer(_bytes(scalp_cover(head, None)))
        self._skin = context.vertex_array(
            programs.skin,
            [
                (vertices, "3f 3f 1f", "position", "normal", "head_weight"),
                (context.buffer(_bytes(paint(head))), "4f1", "paint"),
                (self._cover, "1f1", "cover"),
            ],
            context.buffer(_indices(skin.faces)),
        )
        self._shadow = context.vertex_array(
            programs.depth,
            [(vertices, "3f 12x 1f", "position", "head_weight")],
            context.buffer(_indices(coarse_faces(skin, _SHADOW_DETAIL))),
        )
        self._parts = [(part, _part_array(context, programs.part, part)) for part in head.parts]

    def set_roots(self, hair: HairModel | None) -> None:
        """Darken the skin that ``hair`` grows from; sent again only for another model."""
        if hair is not self._cover_of:
            self._cover.write(_bytes(scalp_cover(self.head, hair)))
            self._cover_of = hair

    def draw_depth(self) -> None:
        """The body into the shadow map."""
        self._shadow.render()

    def draw(self, look: Look) -> None:
        """The body into the picture; the light and shadow maps are bound already."""
        hair = tuple(linear(look.hair_colour))
        set_uniforms(self._programs.skin, skin_colour=tuple(linear(look.skin_colour)), hair_colour=hair)
        self._skin.render()
        program = self._programs.part
        set_uniforms(
            program,
            iris_colour=tuple(linear(look.iris_colour)),
            skin_colour=tuple(linear(look.skin_colour)),
            hair_colour=hair,
        )
        for part, array in self._parts:
            eye = part.kind == "eye" and part.axis is not None and part.centre is not None
            set_uniforms(program, kind=_KINDS["eye" if eye else part.kind if part.kind != "eye" else "other"])
            if eye:
                set_uniforms(program, ball=(*map(float, part.centre), part.radius), pupil=tuple(map(float, part.axis)))  # type: ignore[arg-type]
            array.render()


_KINDS = {"eye": 0, "teeth": 1, "tongue": 2, "lashes": 3, "brows": 3, "other": 4}


def _part_array(context: moderngl.Context, program: moderngl.Program, part: Part) -> moderngl.VertexArray:
    mesh: TriangleMesh = part.mesh
    surface = np.concatenate([mesh.vertices, mesh.vertex_normals], axis=1)
    return context.vertex_array(
        program,
        [(context.buffer(_floats(surface)), "3f 3f", "position", "normal")],
        context.buffer(_indices(mesh.faces)),
    )


def _floats(values: Floats) -> bytes:
    return np.ascontiguousarray(values, dtype=np.float32).tobytes()


def _bytes(values: Floats) -> bytes:
    return np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8).tobytes()


def _indices(faces: object) -> bytes:
    return np.ascontiguousarray(faces, dtype=np.uint32).tobytes()
