"""Deep opacity maps: how much hair light has met on its way, in layers that follow the first hair it meets.

Yuksel, Keyser 2008, "Deep opacity maps". Strands thinner than a texel are drawn a texel wide with less opacity. Counts
of strands are added up, and not opacities multiplied, since light-coloured hair passes light on from strand to strand:
``exp(-count)`` is what comes through between the strands.
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from .context import load_program, set_uniforms
from .screen import ScreenPasses
from .strand_points import StrandTextures

LAYER_DEPTHS = np.array([0.0015, 0.004, 0.008, 0.015, 0.027, 0.048, 0.085, 0.15])
"""Behind the first hair [m]; the last layer holds all that is still deeper, too."""

_FRONT_REDUCTION = 4


class OpacityPrograms:
    """The shaders that fill deep opacity maps."""

    def __init__(self, context: moderngl.Context) -> None:
        self.depth = load_program(context, "strands/opacity.vert", "body/depth.frag")
        self.layers = load_program(context, "strands/opacity.vert", "strands/opacity.frag")
        self.front = ScreenPasses(context, "front", room="strands")


class DeepOpacityMap:
    """One light's view of the hair, ``size`` x ``size`` texels."""

    def __init__(self, context: moderngl.Context, programs: OpacityPrograms, size: int) -> None:
        self.size = size
        self._context = context
        self._programs = programs
        coarse = (max(size // _FRONT_REDUCTION, 1),) * 2
        self._nearest = context.depth_texture(coarse)
        self._nearest.compare_func = ""
        self._nearest.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._nearest_target = context.framebuffer([], self._nearest)
        self.front = _smooth(context.texture(coarse, 1, dtype="f4"))
        self._front_target = context.framebuffer([self.front])
        self.near_counts, self.far_counts = (_smooth(context.texture((size, size), 4, dtype="f2")) for _ in range(2))
        self._counts_target = context.framebuffer([self.near_counts, self.far_counts])
        self._depths: dict[str, tuple[float, ...]] = {}

    def fill(
        self,
        strands: StrandTextures,
        strips: dict[str, moderngl.VertexArray],
        map_from_head: Floats,
        box: float,
        widening: float,
    ) -> None:
        """Draw the strands as the light sees them.

        strips: vertex arrays for the programs "depth" and "layers". map_from_head: 4 x 4, a parallel projection onto a box
        of ``box`` metres a side. widening: how many times too thick the strands are to be taken, when there are fewer.
        """
        depths = LAYER_DEPTHS / box
        self._depths = {"near_depths": tuple(depths[:4]), "far_depths": tuple(depths[4:])}
        strands.points.use(0)
        strands.tangents.use(1)
        common = {"points": 0, "tangents": 1, "map_from_head": tuple(map_from_head.T.ravel()), "widening": widening}
        coarse = self.front.width
        with self._context.scope(self._nearest_target, moderngl.DEPTH_TEST):
            self._nearest_target.clear(depth=1.0)
            set_uniforms(self._programs.depth, **common, size=float(coarse), texels_per_metre=coarse / box)
            strips["depth"].render(moderngl.TRIANGLE_STRIP)
        with self._context.scope(self._front_target, moderngl.NOTHING):
            self._nearest.use(2)
            self._programs.front.draw("front", nearest=2)
        with self._context.scope(self._counts_target, moderngl.BLEND):
            self._context.blend_func = moderngl.ONE, moderngl.ONE
            self._counts_target.clear()
            self.front.use(2)
            set_uniforms(
                self._programs.layers, **common, **self._depths, size=float(self.size),
                texels_per_metre=self.size / box, front=2,
            )  # fmt: skip
            strips["layers"].render(moderngl.TRIANGLE_STRIP)

    def bind(self, first_unit: int) -> dict[str, object]:
        """Bind the textures to three units from ``first_unit`` on; returns the uniforms of common/deep_opacity.glsl."""
        for k, texture in enumerate((self.front, self.near_counts, self.far_counts)):
            texture.use(first_unit + k)
        return {"front": first_unit, "near_counts": first_unit + 1, "far_counts": first_unit + 2, **self._depths}


def _smooth(texture: moderngl.Texture) -> moderngl.Texture:
    texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
    texture.repeat_x = texture.repeat_y = False
    return texture
