"""Deep opacity maps: how much hair light has met on its way, in layers that follow the first hair it meets.

Yuksel, Keyser 2008, "Deep opacity maps". The first hair is known for every texel: what is seen of dense hair are its first
strands, and a first hair for several texels would leave most of them in the shadow of their own layer. Strands thinner
than a texel are drawn a texel wide with less opacity. Counts of strands are added up, and not opacities multiplied, since
light-coloured hair passes light on from strand to strand: ``exp(-count)`` is what comes through between the strands.
"""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from .context import load_program, set_uniforms
from .fibre import Sent, pile
from .strand_points import StrandTextures
from .view import View

LAYER_DEPTHS = np.array([0.0015, 0.004, 0.008, 0.015, 0.027, 0.048, 0.085, 0.15])
"""Behind the first hair [m]; the last layer holds all that is still deeper, too."""


# Of the light, by one strand in the logarithm: which has no value for all. As in common/deep_opacity.glsl.
_MOST_TAKEN = 0.98
# A strand that is drawn as wide as it is is met within so much [m].
_AT_ONCE = 1e-6


def taken(lost: Floats, cover: float) -> Floats:
    """By what the logarithm of light falls with the count, (n,), where a strand takes the parts ``lost`` of it, (n,).

    A count is the sum of what strands ``cover`` of a texel, and every one leaves 1 - cover lost of what there is in the texel.
    With strands much thinner than that it is ``lost`` itself; one that covers all of it leaves 1 - lost, less than exp(-lost).
    """
    return -np.log1p(-np.minimum(cover * lost, _MOST_TAKEN)) / cover


class OpacityPrograms:
    """The shaders that fill deep opacity maps."""

    def __init__(self, context: moderngl.Context) -> None:
        self.depth = load_program(context, "strands/opacity.vert", "body/depth.frag")
        self.layers = load_program(context, "strands/opacity.vert", "strands/opacity.frag")


class LightStrips:
    """Some of the strands as strips for the two programs of deep opacity maps."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: OpacityPrograms,
        textures: StrandTextures,
        indices: NDArray[np.uint32],
        widening: float,
        width: float,
    ) -> None:
        """widening: how many times too thick they are to be taken, to stand for all strands; width: of a strand as it is, in
        the mean [m].
        """
        self.widening = widening
        self.width = widening * width
        self._programs = programs
        self._textures = textures
        self._count = len(indices)
        strips = context.buffer(indices)
        self._depth, self._layers = (
            context.vertex_array(program, [], strips) for program in (programs.depth, programs.layers)
        )

    def draw(self, layers: bool, **uniforms: object) -> None:
        """Draw into the framebuffer in use: into the layers, or the depth of the first strand alone."""
        self._textures.points.use(0)
        self._textures.tangents.use(1)
        program, array = (self._programs.layers, self._layers) if layers else (self._programs.depth, self._depth)
        set_uniforms(program, points=0, tangents=1, widening=self.widening, **uniforms)
        array.render(moderngl.TRIANGLE_STRIP, vertices=self._count)


class DeepOpacityMap:
    """How lights see the hair: one map of ``size`` x ``size`` texels for each, ``tiles`` a side in one texture."""

    def __init__(self, context: moderngl.Context, programs: OpacityPrograms, size: int, tiles: int = 1) -> None:
        self.size = size
        self.tiles = tiles
        self._context = context
        self._programs = programs
        texels = (size * tiles,) * 2
        self.front = context.depth_texture(texels)
        self.front.compare_func = ""
        self._front_target = context.framebuffer([], self.front)
        self.near_counts, self.far_counts = (context.texture(texels, 4, dtype="f2") for _ in range(2))
        for texture in (self.front, self.near_counts, self.far_counts):
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._counts_target = context.framebuffer([self.near_counts, self.far_counts])
        self._depths: dict[str, object] = {}
        self.cover = 1.0
        """The part of a texel that a strand covers, in the mean."""

    def fill(self, strips: LightStrips, pose: Floats, lights: list[View]) -> None:
        """Draw the strands as the lights see them, which look at boxes of the same size.

        pose: world from head, 4 x 4.
        """
        box = lights[0].far
        depths = LAYER_DEPTHS / box
        rates = 1.0 / np.diff(depths, prepend=0.0)
        self.cover = float(np.clip(strips.width * self.size / box, 1e-3, 1.0))
        self._depths = {
            "near_depths": tuple(depths[:4]), "far_depths": tuple(depths[4:]),
            "near_rates": tuple(rates[:4]), "far_rates": tuple(rates[4:]),
            "first_rate": box / max(strips.width * (1 - 1 / strips.widening), _AT_ONCE),
        }  # fmt: skip
        with self._context.scope(self._front_target, moderngl.DEPTH_TEST):
            self._front_target.clear(depth=1.0)
            for tile, light in enumerate(lights):
                self._look_at(self._front_target, tile)
                self._draw(strips, False, light.clip_from_world @ pose, box)
            _whole(self._front_target)
        with self._context.scope(self._counts_target, moderngl.BLEND):
            self._context.blend_func = moderngl.ONE, moderngl.ONE
            self._counts_target.clear()
            self.front.use(2)
            for tile, light in enumerate(lights):
                self._look_at(self._counts_target, tile)
                self._draw(strips, True, light.clip_from_world @ pose, box)
            _whole(self._counts_target)

    def bind(self, first_unit: int) -> dict[str, object]:
        """Bind the textures to three units from ``first_unit`` on; returns the uniforms of common/deep_opacity.glsl."""
        for k, texture in enumerate((self.front, self.near_counts, self.far_counts)):
            texture.use(first_unit + k)
        return {
            "front": first_unit, "near_counts": first_unit + 1, "far_counts": first_unit + 2, **self._depths,
            "cover": self.cover, "opaque": float(taken(np.ones(1), self.cover)[0]),
        }  # fmt: skip

    def let_through(self, sent: Sent) -> dict[str, object]:
        """Uniforms of common/through_hair.glsl."""
        (rate, endless), (less_rate, less_endless) = pile(sent.less), pile(sent.less.less)
        return {
            "rate": tuple(taken(rate, self.cover)), "endless": tuple(endless),
            "less_rate": tuple(taken(less_rate, self.cover)), "less_endless": tuple(less_endless),
        }  # fmt: skip

    def _look_at(self, target: moderngl.Framebuffer, tile: int) -> None:
        corner = (tile % self.tiles * self.size, tile // self.tiles * self.size)
        target.viewport = target.scissor = (*corner, self.size, self.size)

    def _draw(self, strips: LightStrips, layers: bool, matrix: Floats, box: float) -> None:
        strips.draw(
            layers, map_from_head=tuple(matrix.T.ravel()), size=float(self.size),
            texels_per_metre=self.size / box, front=2, **self._depths,
        )  # fmt: skip


def _whole(target: moderngl.Framebuffer) -> None:
    target.viewport = target.scissor = (0, 0, *target.size)
