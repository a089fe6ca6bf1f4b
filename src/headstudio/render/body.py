"""The head, shoulders, eyes, teeth and lashes on the graphics card."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.frame import HeadFrame
from ..head.head import Head
from ..scene.settings import Look
from ..scene.skin_settings import SkinSettings
from .body_parts import BodyParts
from .buffers import bytes_of, floats_of, indices_of
from .context import load_program, set_uniforms
from .detail import Surface, casting_shadows, neighbours_together
from .detailed_faces import DetailedFaces
from .hair_ground import Growth, ground_colour, ground_cover, same_ground
from .head_shade import shade_of_head
from .openings import Openings
from .scene_block import linear
from .screen import ScreenPasses
from .skin_paint import paint
from .targets import PictureTargets, Size
from .view import View


class BodyPrograms:
    """The shaders that draw a body."""

    def __init__(self, context: moderngl.Context) -> None:
        self.depth = load_program(context, "body/depth.vert", "body/depth.frag")
        self.skin = load_program(context, "body/skin.vert", "body/skin.frag")
        self.covering = load_program(context, "body/covering.vert", "body/covering.frag")
        self.part = load_program(context, "body/part.vert", "body/part.frag")
        self.screens = ScreenPasses(context, "light", room="body")


class Body:
    """Everything of one head that is drawn as triangles; made once per head."""

    def __init__(self, context: moderngl.Context, programs: BodyPrograms, head: Head) -> None:
        self.head = head
        self._context = context
        self._programs = programs
        self._growth: Growth = None
        self._openings = Openings(head.skin)
        skin = head.skin
        shade = shade_of_head(context, head)
        corners = np.concatenate([skin.vertices, skin.vertex_normals, head.head_weight[:, None]], axis=1)
        vertices = context.buffer(floats_of(corners))
        painted = np.column_stack([shade.skin, paint(head)])
        surface = Surface(
            neighbours_together(skin.faces, skin.vertices), skin.vertices, skin.vertex_normals, painted[:, :3]
        )
        self._faces = DetailedFaces(context, surface)
        self._level = -1
        self._cover = context.buffer(bytes_of(ground_cover(head, None)))
        self._skin = context.vertex_array(
            programs.skin,
            [
                (vertices, "3f 3f 1f", "position", "normal", "head_weight"),
                (context.buffer(bytes_of(painted)), "4f1", "paint"),
                (self._cover, "1f1", "cover"),
            ],
            self._faces.buffer,
        )
        self._covering = context.vertex_array(
            programs.covering,
            [(vertices, "3f 12x 1f", "position", "head_weight")],
            self._faces.buffer,
        )
        self._shadow = context.vertex_array(
            programs.depth,
            [(vertices, "3f 12x 1f", "position", "head_weight")],
            context.buffer(indices_of(casting_shadows(skin))),
        )
        self._parts = BodyParts(context, programs.part, head, shade.parts)

    def set_roots(self, growth: Growth) -> None:
        """Cover the skin that ``growth`` grows from; sent again only for other roots."""
        if not same_ground(growth, self._growth):
            self._cover.write(bytes_of(ground_cover(self.head, growth)))
        self._growth = growth

    def look_from(self, view: View, frame: HeadFrame, size: Size) -> None:
        """Be as detailed as the next picture needs, of so many pixels (width, height), of the head at ``frame``."""
        self._level = self._faces.level_for(view, frame.translation, size[1])
        self._parts.look_from(view, frame.translation, size[1])

    def draw_depth(self, light: View) -> None:
        """The body into the shadow map of ``light``."""
        self._cull(light)
        self._shadow.render()
        self._context.disable(moderngl.CULL_FACE)

    def surface_targets(self, targets: PictureTargets) -> tuple[moderngl.Framebuffer, moderngl.Framebuffer]:
        """Where ``draw_surface`` draws, and what of it is to be cleared before."""
        return targets.surface, targets.bare

    def draw_surface(self, view: View, look: Look, skin: SkinSettings, targets: PictureTargets) -> None:
        """What the skin is like, into the framebuffer in use; texture 2 is the strands."""
        set_uniforms(self._programs.skin, strands=2)
        self._cull(view)
        self._faces.render(self._skin, self._level)
        self._context.disable(moderngl.CULL_FACE)

    def _cull(self, view: View) -> None:
        """Half of the triangles face away, and their inside is only seen through an opening."""
        if not self._openings.shown_to(view.eye):
            self._context.enable(moderngl.CULL_FACE)

    def light_surface(self, view: View, look: Look, skin: SkinSettings, targets: PictureTargets) -> None:
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
            hair_colour=tuple(ground_colour(self._growth, look)),
        )
        self._context.depth_func = "<"

    def cover_samples(self, targets: PictureTargets) -> None:
        """Draw the lit skin of ``targets`` into the framebuffer in use, which has several samples a pixel."""
        prepare_covering(self._programs.covering, targets)
        self._faces.render(self._covering, self._level)

    def draw_parts(self, look: Look) -> None:
        """Eyes, teeth and lashes into the framebuffer in use; texture 0 is the shadow map, 1 the light map."""
        self._parts.draw(look)


def prepare_covering(program: moderngl.Program, targets: PictureTargets) -> None:
    """What skin is drawn with that has the light that ``targets`` show on it."""
    targets.colour.use(3)
    targets.distance.use(4)
    set_uniforms(program, lit=3, distances=4)
