"""The hair on the graphics card: the light that reaches each particle, and the ribbons that are seen."""

from __future__ import annotations

import moderngl
import numpy as np
from PIL import Image

from ..head.frame import HeadFrame
from ..resources import asset
from ..scene.settings import Look
from ..scene.stage import HairOnStage
from .context import load_program, set_uniforms
from .light_billboards import BILLBOARD_DTYPE, light_billboards
from .ribbons import RIBBON_DTYPE, HairFrames, RibbonBuilder
from .scene_block import linear
from .targets import LightTargets
from .view import View

ROW = 256
"""Particles per row of the textures that hold something for every particle."""

SEGMENTS = 3
BATCHES = 16
"""How many times the light map is read while it is drawn. Within a batch the light is worked out exactly, so this is a
matter of speed alone: more batches cost more passes, fewer cost more arithmetic."""

_TEXELS_PER_BILLBOARD = BILLBOARD_DTYPE.itemsize // 16


class HairPrograms:
    """The shaders that draw hair, and its texture."""

    def __init__(self, context: moderngl.Context) -> None:
        self.reach = load_program(context, "hair/particle.vert", "hair/particle.frag")
        self.splat = load_program(context, "hair/splat.vert", "hair/splat.frag")
        self.ribbon = load_program(context, "hair/ribbon.vert", "hair/ribbon.frag")
        with Image.open(asset("textures/strands.png")) as image:
            pixels = image.convert("RGB")
        self.strands = context.texture(pixels.size, 3, pixels.tobytes(), alignment=1)
        self.strands.build_mipmaps()
        self.strands.filter = (moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
        self.strands.repeat_y = False


class Hair:
    """The hair of one model; made once per model and number of ribbons."""

    def __init__(self, context: moderngl.Context, programs: HairPrograms, builder: RibbonBuilder) -> None:
        self.builder = builder
        self.frames: HairFrames | None = None
        self._context = context
        self._programs = programs
        self._placed: tuple[HairOnStage, HeadFrame] | None = None
        n = builder.model.count
        rows = -(-n // ROW)
        self._billboards = context.texture((ROW * _TEXELS_PER_BILLBOARD, rows), 4, dtype="f4")
        self.light = context.texture((ROW, rows), 2, dtype="f4")
        for texture in (self._billboards, self.light):
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._light_target = context.framebuffer([self.light])
        self._points = context.vertex_array(programs.reach, [])
        corners = np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]], np.float32)
        self._splats = context.vertex_array(programs.splat, [(context.buffer(corners.tobytes()), "2f", "corner")])
        self._instances = context.buffer(reserve=max(1, n * builder.per_particle) * RIBBON_DTYPE.itemsize)
        self._ribbons = context.vertex_array(
            programs.ribbon,
            [
                (context.buffer(_strip().tobytes()), "2f", "corner"),
                (self._instances, "3f 3f 3f 3f 3f 4f /i", *RIBBON_DTYPE.names),  # type: ignore[misc]
            ],
        )

    def place(self, hair: HairOnStage, frame: HeadFrame) -> None:
        """Take the particles of this instant."""
        if self._placed is None or self._placed[0] is not hair or self._placed[1] is not frame:
            self.frames = self.builder.frames(hair, frame)
            self._placed = (hair, frame)

    def shed_light(self, light: View, look: Look, maps: LightTargets) -> None:
        """Fill ``self.light`` and the light map: thesis 3.4, lines 6 to 12.

        The thesis reads the light map back for every particle in turn. Here the particles go in batches: the particles
        of a batch read the map as all batches before have left it, work out among themselves how much each takes from
        the others, and are then drawn into it.
        """
        assert self.frames is not None
        model, context = self.builder.model, self._context
        billboards = light_billboards(self.frames, model, self.builder.windows, light, look, maps.size)
        padded = np.zeros(self.light.width * self.light.height, BILLBOARD_DTYPE)
        padded[: model.count] = billboards
        self._billboards.write(padded.tobytes())
        self._programs.strands.use(2)
        self._billboards.use(3)
        self.light.use(4)
        maps.map.use(1)
        batch = max(1, -(-model.count // BATCHES))
        for program in (self._programs.reach, self._programs.splat):
            set_uniforms(program, strands=2, billboards=3, particle_light=4, light_map=1, shadow_map=0)
        set_uniforms(self._programs.reach, rows=self.light.height)
        set_uniforms(self._programs.splat, map_size=float(maps.size))
        for first in range(0, model.count, batch):
            count = min(batch, model.count - first)
            with context.scope(self._light_target, moderngl.NOTHING):
                set_uniforms(self._programs.reach, first=first)
                self._points.render(moderngl.POINTS, vertices=count, first=first)
            with context.scope(maps.light, moderngl.BLEND):
                context.blend_func = moderngl.DST_COLOR, moderngl.ZERO
                set_uniforms(self._programs.splat, first=first)
                self._splats.render(moderngl.TRIANGLE_STRIP, instances=count)

    def light_all(self) -> None:
        """Without shadows every particle gets all the light."""
        self._light_target.clear(1.0, 1.0, 0.0, 0.0)

    def draw(self, view: View, look: Look, depth: moderngl.Texture) -> None:
        """The ribbons, farthest first (thesis 3.4, lines 17 to 21), into the framebuffer in use."""
        assert self.frames is not None
        ribbons = self.builder.ribbons(self.frames, look)
        order = np.argsort(-view.depth(ribbons["centre"]), kind="stable")
        self._instances.orphan()
        self._instances.write(ribbons[order].tobytes())
        self._programs.strands.use(2)
        depth.use(3)
        self.light.use(4)
        set_uniforms(
            self._programs.ribbon,
            strands=2,
            body_depth=3,
            particle_light=4,
            hair_colour=tuple(linear(look.hair_colour)),
            opacity=look.hair_opacity,
            transmission=look.forward_scatter,
            gloss=look.gloss,
        )
        self._ribbons.render(moderngl.TRIANGLE_STRIP, instances=len(ribbons))


def _strip() -> np.ndarray:
    """Corners of a ribbon as a triangle strip: side -1 or 1, place along it -1 (root) to 1 (tip)."""
    along = np.linspace(-1, 1, SEGMENTS + 1)
    return np.stack(np.meshgrid([-1, 1], along), axis=-1).reshape(-1, 2).astype(np.float32)
