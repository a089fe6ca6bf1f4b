"""The head, shoulders, eyes, teeth and lashes on the graphics card."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.head import Head, Part
from ..head.mesh import Floats
from ..lcp.model import HairModel
from ..scene.settings import Look
from .context import load_program, set_uniforms
from .openings import Openings
from .scene_block import linear
from .screen import ScreenPasses
from .skin_paint import coarse_faces, paint, scalp_cover, standing_out
from .sky import hidden_from_sky
from .targets import PictureTargets
from .view import View

# Details below this [m] are left out of the body that casts shadows.
_SHADOW_DETAIL = 0.004
# How part.frag tells the parts apart.
_KINDS = {"eye": 0, "teeth": 1, "tongue": 2, "lashes": 3, "brows": 3, "other": 4}


class BodyPrograms:
    """The shaders that draw a body."""

    def __init__(self, context: moderngl.Context) -> None:
        self.depth = load_program(context, "body/depth.vert", "body/depth.frag")
        self.skin = load_program(context, "body/skin.vert", "body/skin.frag")
        self.part = load_program(context, "body/part.vert", "body/part.frag")
        self.screens = ScreenPasses(context, "light", room="body")


class Body:
    """Everything of one head that is drawn as triangles; made once per head."""

    def __init__(self, context: moderngl.Context, programs: BodyPrograms, head: Head) -> None:
        self.head = head
        self._context = context
        self._programs = programs
        self._roots_of: HairModel | None = None
        self._openings = Openings(head.skin)
        skin, meshes = head.skin, [head.skin, *(part.mesh for part in head.parts)]
        points = np.concatenate([mesh.vertices for mesh in meshes])
        normals = np.concatenate([mesh.vertex_normals for mesh in meshes])
        hidden = hidden_from_sky(context, skin, points, normals)
        hidden_skin, *hidden_parts = np.split(hidden, np.cumsum([len(mesh.vertices) for mesh in meshes])[:-1])
        surface = np.concatenate([skin.vertices, skin.vertex_normals, head.head_weight[:, None]], axis=1)
        vertices = context.buffer(_floats(surface))
        self._cover = context.buffer(_bytes(scalp_cover(head, None)))
        self._skin = context.vertex_array(
            programs.skin,
            [
                (vertices, "3f 3f 1f", "position", "normal", "head_weight"),
                (context.buffer(_bytes(np.column_stack([hidden_skin, paint(head)]))), "4f1", "paint"),
                (self._cover, "1f1", "cover"),
            ],
            context.buffer(_indices(skin.faces)),
        )
        self._shadow = context.vertex_array(
            programs.depth,
            [(vertices, "3f 12x 1f", "position", "head_weight")],
            context.buffer(_indices(coarse_faces(skin, _SHADOW_DETAIL))),
        )
        parts = [(part, self._part_array(part, cut_off)) for part, cut_off in zip(head.parts, hidden_parts)]
        # Lashes are translucent, and so the last.
        self._parts = sorted(parts, key=lambda drawn: _KINDS[drawn[0].kind] == _KINDS["lashes"])

    def set_roots(self, hair: HairModel | None) -> None:
        """Cover the skin that ``hair`` grows from; sent again only for another model."""
        if hair is not self._roots_of:
            self._cover.write(_bytes(scalp_cover(self.head, hair)))
            self._roots_of = hair

    def draw_depth(self) -> None:
        """The body into the shadow map."""
        self._shadow.render()

    def draw_surface(self, view: View) -> None:
        """What the skin is like, into the framebuffer in use; texture 2 is the strands."""
        set_uniforms(self._programs.skin, strands=2)
        # Half of the triangles face away, and their inside is only seen through an opening.
        if not self._openings.shown_to(view.eye):
            self._context.enable(moderngl.CULL_FACE)
        self._skin.render()
        self._context.disable(moderngl.CULL_FACE)

    def light_surface(self, view: View, look: Look, targets: PictureTargets) -> None:
        """The light that the skin sends to the eye, wherever the depth of the framebuffer in use shows that it is.

        Triangles are only a few pixels large, and light worked out for each would be worked out several times over.
        Texture 0 is the shadow map, 1 the light map.
        """
        for unit, texture in enumerate((targets.normal, targets.paint, targets.distance), start=3):
            texture.use(unit)
        width, height = targets.normal.size
        self._context.depth_func = ">"
        self._programs.screens.draw(
            "light",
            shadow_map=0,
            light_map=1,
            normals=3,
            paint=4,
            distances=5,
            size=(float(width), float(height)),
            forward=tuple(view.forward),
            upward=tuple(view.up / view.focal),
            sideward=tuple(view.right * width / height / view.focal),
            skin_colour=tuple(linear(look.skin_colour)),
            hair_colour=tuple(linear(look.hair_colour)),
        )
        self._context.depth_func = "<"

    def draw_parts(self, look: Look) -> None:
        """Eyes, teeth and lashes into the framebuffer in use; texture 0 is the shadow map, 1 the light map."""
        set_uniforms(
            self._programs.part,
            shadow_map=0,
            light_map=1,
            skin_colour=tuple(linear(look.skin_colour)),
            hair_colour=tuple(linear(look.hair_colour)),
            iris_colour=tuple(linear(look.iris_colour)),
        )
        for part, array in self._parts:
            self._draw_part(part, array)

    def _draw_part(self, part: Part, array: moderngl.VertexArray) -> None:
        program, kind = self._programs.part, part.kind
        if part.centre is not None and part.axis is not None:
            set_uniforms(program, ball=(*part.centre.tolist(), part.radius), pupil=tuple(part.axis.tolist()))
        elif kind == "eye":
            kind = "other"
        set_uniforms(program, kind=_KINDS[kind])
        array.render()

    def _part_array(self, part: Part, hidden: Floats) -> moderngl.VertexArray:
        surface = np.concatenate([part.mesh.vertices, part.mesh.vertex_normals], axis=1)
        painted = np.column_stack([hidden, standing_out(self.head, part)])
        return self._context.vertex_array(
            self._programs.part,
            [
                (self._context.buffer(_floats(surface)), "3f 3f", "position", "normal"),
                (self._context.buffer(_bytes(painted)), "2f1", "paint"),
            ],
            self._context.buffer(_indices(part.mesh.faces)),
        )


def _floats(values: Floats) -> bytes:
    return np.ascontiguousarray(values, dtype=np.float32).tobytes()


def _bytes(values: Floats) -> bytes:
    return np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8).tobytes()


def _indices(faces: object) -> bytes:
    return np.ascontiguousarray(faces, dtype=np.uint32).tobytes()
