"""The light that reaches every particle: thesis 3.4, lines 6 to 12."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from ..lcp.model import HairModel
from ..scene.settings import Look
from .context import load_program, set_uniforms
from .light_billboards import BILLBOARD_DTYPE, light_billboards
from .particle_texture import ROW, RecordTexture, neighbour_records
from .strands import HairCurves
from .targets import LightTargets
from .view import View

BATCH = 160
"""How many particles go between two readings of the light map. Within a batch the light is worked out exactly, so this is
a matter of speed alone: small batches cost more passes, large ones more arithmetic."""


class LightPrograms:
    """The shaders of the light pass."""

    def __init__(self, context: moderngl.Context) -> None:
        self.reach = load_program(context, "light/reach.vert", "light/particle.frag")
        self.receive = load_program(context, "light/receive.vert", "light/particle.frag")
        self.splat = load_program(context, "light/splat.vert", "light/splat.frag")
        self.soften = load_program(context, "light/soften.vert", "light/particle.frag")


class HairLight:
    """The light on the particles of one model, in textures of ROW particles a row.

    received: red the light that reaches the particle, green the part of it that comes past the objects, (n texels).
    softened: the light towards the root, at the particle and towards the tip, each averaged over linked particles: one
    particle stands for a centimetre of hair, and hair in half shadow would be mottled.
    """

    def __init__(self, context: moderngl.Context, programs: LightPrograms, model: HairModel, windows: Floats) -> None:
        self._context = context
        self._programs = programs
        self._model = model
        self._windows = windows
        self._billboards = RecordTexture(context, BILLBOARD_DTYPE, model.count)
        dtype, neighbours = neighbour_records(model.links, model.count)
        self._neighbours = RecordTexture(context, dtype, model.count)
        self._neighbours.write(neighbours)
        self._slots = dtype.itemsize // 16
        size = (ROW, -(-model.count // ROW))
        self._reach, self.received, self.softened = (context.texture(size, 4, dtype="f4") for _ in range(3))
        for texture in (self._reach, self.received, self.softened):
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._reach_target = context.framebuffer([self._reach])
        self._received_target = context.framebuffer([self.received])
        self._softened_target = context.framebuffer([self.softened])
        corners = np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]], np.float32)
        self._past_objects = context.vertex_array(programs.reach, [])
        self._receive = context.vertex_array(programs.receive, [])
        self._splat = context.vertex_array(programs.splat, [(context.buffer(corners.tobytes()), "2f", "corner")])
        self._soften = context.vertex_array(programs.soften, [])

    def shed(self, curves: HairCurves, light: View, look: Look, maps: LightTargets, strands: moderngl.Texture) -> None:
        """Fill the light map and the light on every particle; ``maps.depth`` holds the objects already.

        The thesis reads the light map back for every particle in turn. Here the particles go in batches: the particles
        of a batch read the map as all batches before have left it, work out among themselves how much each takes from
        the others, and are then drawn into it.
        """
        count = self._model.count
        self._billboards.write(light_billboards(curves, self._model, self._windows, light, look, maps.size))
        maps.depth.use(0)
        maps.map.use(1)
        strands.use(2)
        self._billboards.texture.use(3)
        self._reach.use(4)
        rows, size = self.received.height, float(maps.size)
        with self._context.scope(self._reach_target, moderngl.PROGRAM_POINT_SIZE):
            set_uniforms(self._programs.reach, shadow_map=0, billboards=3, rows=rows, map_size=size)
            self._past_objects.render(moderngl.POINTS, vertices=count)
        set_uniforms(self._programs.receive, light_map=1, strands=2, billboards=3, reach=4, rows=rows)
        set_uniforms(self._programs.splat, strands=2, billboards=3, reach=4, map_size=size)
        for first in range(0, count, BATCH):
            in_batch = min(BATCH, count - first)
            with self._context.scope(self._received_target, moderngl.PROGRAM_POINT_SIZE):
                set_uniforms(self._programs.receive, first=first)
                self._receive.render(moderngl.POINTS, vertices=in_batch, first=first)
            with self._context.scope(maps.light, moderngl.BLEND):
                self._context.blend_func = moderngl.DST_COLOR, moderngl.ZERO
                set_uniforms(self._programs.splat, first=first)
                self._splat.render(moderngl.TRIANGLE_STRIP, instances=in_batch)
        self._neighbours.texture.use(3)
        self.received.use(4)
        with self._context.scope(self._softened_target, moderngl.PROGRAM_POINT_SIZE):
            set_uniforms(self._programs.soften, neighbours=3, received=4, rows=rows, slots=self._slots)
            self._soften.render(moderngl.POINTS, vertices=count)

    def fill(self) -> None:
        """Without shadows every particle gets all the light."""
        self._received_target.clear(1.0, 1.0, 1.0, 1.0)
        self._softened_target.clear(1.0, 1.0, 1.0, 1.0)
