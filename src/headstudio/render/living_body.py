"""A head whose skin lives, on the graphics card: posed, wrinkled and covered with fine wrinkles.

What stays the same is sent once; positions, normals and amplitudes when the pose is another object than before.
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..lcp.model import HairModel
from ..scene.settings import Look
from ..scene.skin_settings import MODELS, SkinSettings
from ..wrinkle.living_skin import LivingSkin, SkinSurface
from . import lafortune
from .body import BodyPrograms
from .body_parts import BodyParts, hidden_of_head
from .buffers import bytes_of, floats_of, indices_of
from .context import load_program, set_uniforms
from .fine_relief import FineRelief
from .openings import Openings
from .scattering import STEEPEST, scattering_table
from .scene_block import linear
from .screen import ScreenPasses
from .skin_colour import HAEMOGLOBIN, skin_colour
from .skin_paint import scalp_cover
from .skin_shape import BLOOD_MEAN, MOST_HIDDEN, hidden_in_creases, pose_of, shape_of, smooth_pose_of
from .skin_values import scale_colours, shown_values
from .targets import PictureTargets
from .view import View


class LivingPrograms:
    """The shaders that draw living skin, and the tables they look into."""

    def __init__(self, context: moderngl.Context, body: BodyPrograms) -> None:
        self.depth = body.depth
        self.part = body.part
        self.surface = load_program(context, "skin/surface.vert", "skin/surface.frag")
        self.screens = ScreenPasses(context, "light", room="skin")
        table = scattering_table()
        self.scattered = context.texture(table.shape[1::-1], 3, table.astype(np.float16), dtype="f2")
        self.scattered.repeat_x = self.scattered.repeat_y = False
        self.scale = context.texture((256, 1), 3, dtype="f1")
        self.scale.repeat_x = False
        self._scale_of = ""

    def set_scale(self, shows: str) -> None:
        """Put the colours of a scale into its texture."""
        if shows != self._scale_of:
            self.scale.write(bytes_of(scale_colours(shows)))
            self._scale_of = shows


class LivingBody:
    """A living skin and the parts of its head; made once per ``SkinSurface``."""

    def __init__(self, context: moderngl.Context, programs: LivingPrograms, surface: SkinSurface) -> None:
        self.surface = surface
        self.head = surface.head
        self._context = context
        self._programs = programs
        self._roots_of: HairModel | None = None
        self._openings = Openings(self.head.skin)
        hidden, hidden_parts = hidden_of_head(context, self.head)
        self._parts = BodyParts(
            context, programs.part, self.head, [np.minimum(part, MOST_HIDDEN) for part in hidden_parts]
        )
        self._shape = shape = shape_of(surface, hidden)
        self._relief = FineRelief(context, shape.fine)
        count = len(shape.rest)
        body = np.column_stack([shape.turning, shape.curvature, shape.mapped])
        self._constants = context.buffer(floats_of(np.column_stack([shape.rest, shape.uv, body])))
        self._paint = context.buffer(bytes_of(shape.painted))
        self._cover = context.buffer(bytes_of(np.zeros(count)))
        self._faces = context.buffer(indices_of(shape.faces))
        self._wrinkled = _PosedSkin(self, count)
        self._smooth: _PosedSkin | None = None
        self._shadow = context.vertex_array(
            programs.depth,
            [
                (self._wrinkled.vertices, "3f 12x", "position"),
                (context.buffer(floats_of(shape.turning)), "1f", "head_weight"),
            ],
            context.buffer(indices_of(shape.shadow_faces)),
        )

    def set_roots(self, hair: HairModel | None) -> None:
        """Cover the skin that ``hair`` grows from; sent again only for another model."""
        if hair is not self._roots_of:
            self._cover.write(bytes_of(self.surface.spread(scalp_cover(self.head, hair))))
            self._roots_of = hair

    def pose(self, skin: LivingSkin, look: Look) -> None:
        """Take the pose of ``skin``, of this body's surface; sent again only for another object or other figures shown."""
        self._parts.move(skin.parts)
        self._wrinkled.take(skin, look.skin_shows, wrinkled=True)
        if look.split > 0:
            if self._smooth is None:
                self._smooth = _PosedSkin(self, len(self._shape.rest))
            self._smooth.take(skin, look.skin_shows, wrinkled=False)

    def draw_depth(self) -> None:
        """The body into the shadow map."""
        self._shadow.render()

    def surface_target(self, targets: PictureTargets) -> moderngl.Framebuffer:
        """Where ``draw_surface`` draws."""
        return targets.skin.surface

    def draw_surface(self, view: View, look: Look, skin: SkinSettings, targets: PictureTargets) -> None:
        """What the skin is like, into the framebuffer in use; texture 2 is the strands."""
        set_uniforms(self._programs.surface, strands=2, creases=skin.creases)
        # Half of the triangles face away, and their inside is only seen through an opening.
        if not self._openings.shown_to(view.eye):
            self._context.enable(moderngl.CULL_FACE)
        target = self.surface_target(targets)
        width, height = target.size
        border = round(look.split * width)
        if border < width:
            target.scissor = (border, 0, width - border, height)
            self._wrinkled.draw(fine=True)
        if border > 0 and self._smooth is not None:
            target.scissor = (0, 0, border, height)
            self._smooth.draw(fine=False)
        target.scissor = (0, 0, width, height)
        self._context.disable(moderngl.CULL_FACE)

    def light_surface(self, view: View, look: Look, skin: SkinSettings, targets: PictureTargets) -> None:
        """The light that the skin sends to the eye, wherever the depth of the framebuffer in use shows that it is.

        Texture 0 is the shadow map, 1 the light map.
        """
        relief, programs = self._relief, self._programs
        textures = (
            targets.normal,
            targets.paint,
            targets.distance,
            targets.skin.place,
            targets.skin.state,
            relief.slopes,
            relief.pores,
            relief.heights,
            programs.scattered,
            programs.scale,
        )
        for unit, texture in enumerate(textures, start=3):
            texture.use(unit)
        shows_value = look.skin_shows != "skin"
        if shows_value:
            programs.set_scale(look.skin_shows)
        colour = skin_colour(skin, look)
        width, height = targets.normal.size
        self._context.depth_func = ">"
        programs.screens.draw(
            "light", shadow_map=0, light_map=1, normals=3, paint=4, distances=5, places_in_map=6, states=7, slopes=8,
            pores=9, heights=10, scattered=11, scale=12, size=(float(width), float(height)),
            forward=tuple(view.forward), upward=tuple(view.up / view.focal),
            sideward=tuple(view.right * width / height / view.focal),
            skin_colour=tuple(colour), hair_colour=tuple(linear(look.hair_colour)), haemoglobin=tuple(HAEMOGLOBIN),
            flushed=skin.flush, blood_mean=BLOOD_MEAN, blood_flow=skin.blood_flow, creases=skin.creases, gloss=skin.gloss,
            roughness=skin.roughness, scattering=skin.scattering, steepest=STEEPEST, model=MODELS.index(skin.model),
            tint=tuple(colour / lafortune.MEASURED_ALBEDO), measured_diffuse=tuple(lafortune.DIFFUSE),
            shows_value=shows_value, texels=float(relief.size), metres=relief.metres,
            mean_heights=relief.mean_heights, relief=skin.relief,
            **lafortune_uniforms(),
        )  # fmt: skip
        self._context.depth_func = "<"

    def draw_parts(self, look: Look) -> None:
        """Eyes, teeth and lashes into the framebuffer in use; texture 0 is the shadow map, 1 the light map."""
        self._parts.draw(look)


class _PosedSkin:
    """The arrays of one pose, with wrinkles or without."""

    def __init__(self, body: LivingBody, count: int) -> None:
        context = body._context
        self._body = body
        self._taken: tuple[LivingSkin, str] | None = None
        self.vertices = context.buffer(reserve=24 * count, dynamic=True)
        self._states = context.buffer(reserve=16 * count, dynamic=True)
        self._array = context.vertex_array(
            body._programs.surface,
            [
                (self.vertices, "3f 3f", "position", "normal"),
                (self._states, "4f", "state"),
                (body._constants, "3f 2f 3f", "rest", "uv", "body"),
                (body._paint, "4f1", "paint"),
                (body._cover, "1f1", "cover"),
            ],
            body._faces,
        )

    def take(self, skin: LivingSkin, shows: str, wrinkled: bool) -> None:
        """Send a pose, and the figures that are shown on it, if they are not here already."""
        if self._taken is not None and self._taken[0] is skin and self._taken[1] == shows:
            return
        pose = pose_of(skin) if wrinkled else smooth_pose_of(skin)
        value = shown_values(shows, skin) if shows != "skin" else 0.5 + 0.5 * np.log2(np.maximum(pose.expansion, 1e-3))
        self.vertices.write(floats_of(np.concatenate([pose.positions, pose.normals], axis=1)))
        states = np.column_stack([pose.amplitudes, hidden_in_creases(pose.height), value])
        self._states.write(floats_of(states))
        self._taken = (skin, shows)

    def draw(self, fine: bool) -> None:
        """Into the framebuffer in use."""
        set_uniforms(self._body._programs.surface, wrinkled=float(fine))
        self._array.render()


def lafortune_uniforms() -> dict[str, object]:
    """The figures of common/lafortune.glsl."""
    tables = {"lobe_across": lafortune.ACROSS, "lobe_along": lafortune.ALONG, "lobe_exponents": lafortune.EXPONENTS}
    return {name: [tuple(row) for row in table.tolist()] for name, table in tables.items()}
