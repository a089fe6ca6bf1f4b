"""Strands of hair on the graphics card: from a light's view of them to ribbons in the picture."""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..wisp.strands import Strands
from .context import load_program, set_uniforms
from .deep_opacity import DeepOpacityMap, OpacityPrograms
from .fibre import Fibre, colour_slope, fibre_tables
from .screen import ScreenPasses
from .strand_points import POINT_ROW, StrandTextures, pack, piece_indices, strip_indices
from .targets import LightTargets
from .view import View

_DEPTH_LEVELS = 65535


@dataclass(frozen=True)
class StrandMaterial:
    """What the strands are made of.

    absorption: per radius, RGB, of strands that have no colour of their own. fibre_model: Marschner's lobes; else those of
    Kajiya and Kay.
    """

    fibre: Fibre
    absorption: tuple[float, float, float]
    fibre_model: bool = True


class StrandPrograms:
    """The shaders of strands."""

    def __init__(self, context: moderngl.Context) -> None:
        self.opacity = OpacityPrograms(context)
        self.ribbon = load_program(context, "strands/ribbon.vert", "strands/ribbon.frag")
        self.screens = ScreenPasses(context, "shade", "light_map", room="strands")


class StrandHair:
    """One set of strands, of which the first ``shown`` are drawn, wider by as much as others are left out."""

    def __init__(self, context: moderngl.Context, programs: StrandPrograms, strands: Strands, shown: int) -> None:
        self.strands = strands
        self._context = context
        self._programs = programs
        packed = pack(strands)
        self.reach = float(np.linalg.norm(strands.points, axis=1).max(initial=0.0))
        """How far strands reach from the origin of the head frame [m]."""
        self.shown = min(shown, packed.count)
        self.widening = packed.count / max(self.shown, 1)
        self._shown_points = int(packed.first[self.shown])
        self._textures = StrandTextures(context, packed)
        strips = context.buffer(strip_indices(packed.first, self.shown))
        self._light_strips = {
            name: context.vertex_array(program, [], strips)
            for name, program in (("depth", programs.opacity.depth), ("layers", programs.opacity.layers))
        }
        self._whole = context.vertex_array(programs.ribbon, [], strips)
        self._pieces, amid = piece_indices(packed.first, self.shown)
        self._amid = packed.points[amid, :3]
        self._sorted = context.buffer(reserve=max(self._pieces.nbytes, 4))
        self._sorted_array = context.vertex_array(programs.ribbon, [], self._sorted)
        self._shades = context.texture((POINT_ROW, self._textures.rows), 4, dtype="f2")
        self._shades.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._shade_target = context.framebuffer([self._shades])
        self._opacity: DeepOpacityMap | None = None
        self._fibre: Fibre | None = None

    def suits(self, strands: Strands, shown: int) -> bool:
        """True if these are those strands in that detail."""
        return self.strands is strands and self.shown == min(shown, strands.count)

    def shed_light(self, light: View, frame: HeadFrame, maps: LightTargets, size: int) -> None:
        """Draw the strands as the light sees them, and what they let through into the light map, for the skin."""
        if self._opacity is None or self._opacity.size != size:
            self._opacity = DeepOpacityMap(self._context, self._programs.opacity, size)
        matrix = light.clip_from_world @ _pose(frame)
        self._opacity.fill(self._textures, self._light_strips, matrix, light.far, self.widening)
        with self._context.scope(maps.light, moderngl.NOTHING):
            self._programs.screens.draw("light_map", **self._opacity.bind(2))

    def shade(self, material: StrandMaterial) -> None:
        """Work out the radiance of every point that is shown; texture 0 is the shadow map, 1 the light map."""
        assert self._opacity is not None
        self._prepare_fibre(material.fibre)
        textures = self._textures
        textures.points.use(2)
        textures.tangents.use(3)
        if textures.colour is not None:
            textures.colour.use(4)
        self._around.use(5)
        self._spread.use(6)
        self._albedo.use(7)
        fibre = material.fibre
        uniforms = {
            "shadow_map": 0, "light_map": 1, "points": 2, "tangents": 3, "hair_colours": 4,
            "around_table": 5, "spread_table": 6, "albedo_table": 7,
            "coloured": textures.colour is not None,
            "hair_absorption": material.absorption,
            "colour_slope": colour_slope(fibre.radial_roughness),
            "variances": tuple(fibre.variances),
            "tilt_cos": tuple(np.cos(fibre.tilts)),
            "tilt_sin": tuple(np.sin(fibre.tilts)),
            "fibre_model": material.fibre_model,
        }  # fmt: skip
        rows = -(-self._shown_points // POINT_ROW)
        with self._context.scope(self._shade_target, moderngl.NOTHING):
            self._shade_target.viewport = (0, 0, POINT_ROW, max(rows, 1))
            self._programs.screens.draw("shade", **uniforms, **self._opacity.bind(8))

    def draw_blended(self, view: View, frame: HeadFrame, height: int) -> None:
        """Strands in order, farthest first, over the framebuffer in use, ``height`` pixels high."""
        eye = frame.rotation.inv().apply(view.eye - frame.translation)
        away = np.linalg.norm(self._amid - eye.astype(np.float32), axis=1)
        low, high = (float(away.min()), float(away.max())) if len(away) else (0.0, 1.0)
        # Whole numbers are sorted several times as fast, and 65,536 levels are some hundredths of a millimetre.
        levels = ((high - away) * (_DEPTH_LEVELS / max(high - low, 1e-6))).astype(np.uint16)
        order = np.argsort(levels, kind="stable")
        self._sorted.write(self._pieces[order])
        self._use(view, height, blended=True)
        self._sorted_array.render(moderngl.TRIANGLE_STRIP)

    def draw_opaque(self, view: View, height: int, shift: tuple[float, float]) -> None:
        """Strands exactly as wide as they are, hidden by what is in front of them; ``shift`` moves the picture, clip units."""
        self._use(view, height, blended=False, shift=shift)
        self._whole.render(moderngl.TRIANGLE_STRIP)

    def _use(self, view: View, height: int, blended: bool, shift: tuple[float, float] = (0.0, 0.0)) -> None:
        self._textures.points.use(2)
        self._textures.tangents.use(3)
        self._shades.use(4)
        set_uniforms(
            self._programs.ribbon, points=2, tangents=3, shades=4, widening=self.widening, blended=blended,
            shift=shift, metres_per_pixel=2.0 / (view.focal * height),
        )  # fmt: skip

    def _prepare_fibre(self, fibre: Fibre) -> None:
        if fibre == self._fibre:
            return
        tables = fibre_tables(fibre)
        self._around, self._spread = (self._volume(values) for values in (tables.around, tables.spread))
        absorptions, sines, parts = tables.albedo.shape
        self._albedo = self._context.texture(
            (sines, absorptions), parts, tables.albedo.astype("f4", order="C"), dtype="f4"
        )
        self._albedo.repeat_x = self._albedo.repeat_y = False
        self._fibre = fibre

    def _volume(self, values: Floats) -> moderngl.Texture3D:
        depth, height, width, parts = values.shape
        volume = self._context.texture3d((width, height, depth), parts, values.astype("f2", order="C"), dtype="f2")
        volume.repeat_x = volume.repeat_y = volume.repeat_z = False
        return volume


def _pose(frame: HeadFrame) -> Floats:
    matrix = np.eye(4)
    matrix[:3, :3] = frame.rotation.as_matrix()
    matrix[:3, 3] = frame.translation
    return matrix
