"""The hair on the graphics card: the ribbons that are seen."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.frame import HeadFrame
from ..head.head import Head
from ..lcp.model import HairModel
from ..scene.settings import Look
from ..scene.stage import HairOnStage
from .context import load_program, set_uniforms
from .covered import shown_through_hair
from .hair_light import HairLight, LightPrograms
from .particle_texture import RecordTexture
from .ribbons import CURVE_DTYPE, RIBBON_DTYPE, curve_texels, farthest_first, lay_out_ribbons, ribbon_narrowing
from .scene_block import linear
from .strand_levels import StrandLevels
from .strand_texture import STRIP_WIDTH
from .strands import SECTIONS, CurveBuilder, HairCurves, ending, joined, openness
from .targets import LightTargets
from .undergrowth import Undergrowth
from .view import View

_DRAWN_DTYPE = np.dtype([("ribbon", "i4"), ("shown", "f4")])


class HairPrograms:
    """The shaders that draw hair, and its texture."""

    def __init__(self, context: moderngl.Context) -> None:
        self.light = LightPrograms(context)
        self.ribbon = load_program(context, "hair/ribbon.vert", "hair/ribbon.frag")
        self.strands = StrandLevels(context)


class Hair:
    """The hair of one model on one head, as ``per_particle`` ribbons for each particle; made once for them."""

    def __init__(
        self, context: moderngl.Context, programs: HairPrograms, head: Head, model: HairModel, per_particle: int
    ) -> None:
        self._head = head
        self._model = model
        self._per_particle = per_particle
        self.curves: HairCurves | None = None
        self._programs = programs
        self._builder = CurveBuilder(model)
        self._undergrowth = Undergrowth(head, model)
        self._openness = np.concatenate([openness(model), np.full(len(self._undergrowth), 0.6)])
        self._placed: tuple[HairOnStage, HeadFrame, float] | None = None
        self._laid_out = lay_out_ribbons(ending(model), per_particle, self._undergrowth.source)
        windows = self._laid_out["window"][: model.count * per_particle : per_particle]
        self.light = HairLight(context, programs.light, model, windows)
        self._curve_texture = RecordTexture(context, CURVE_DTYPE, len(self._openness))
        self._ribbon_texture = RecordTexture(context, RIBBON_DTYPE, len(self._laid_out))
        self._ribbon_texture.write(self._laid_out)
        self._drawn = context.buffer(reserve=_DRAWN_DTYPE.itemsize * len(self._laid_out))
        self._ribbons = context.vertex_array(
            programs.ribbon,
            [(context.buffer(_strip().tobytes()), "2f", "corner"), (self._drawn, "1i 1f /i", "ribbon", "shown")],
        )

    def suits(self, head: Head, model: HairModel, per_particle: int) -> bool:
        """True if this is the hair of that model on that head."""
        return self._head is head and self._model is model and self._per_particle == per_particle

    def place(self, hair: HairOnStage, frame: HeadFrame, look: Look) -> None:
        """Take the particles of this instant; sent again only when they, the head or the length changed."""
        half_length = self._half_width(look) * look.billboard_stretch
        placed = (hair, frame, half_length)
        if (
            self._placed is None
            or any(a is not b for a, b in zip(placed[:2], self._placed))
            or placed[2] != self._placed[2]
        ):
            self.curves = self._builder.curves(hair, frame, half_length)
            self._all_curves = joined(self.curves, self._undergrowth.curves(frame))
            self._curve_texture.write(curve_texels(self._all_curves, self._openness))
            self._placed = placed

    def shed_light(self, light: View, look: Look, maps: LightTargets) -> None:
        """Let the light through the hair: fills the light map and the light on every particle."""
        assert self.curves is not None
        if look.shadows:
            self.light.shed(self.curves, light, look, maps, self._programs.strands.light)
        else:
            self.light.fill()

    def draw(self, view: View, look: Look, body_distance: moderngl.Texture) -> None:
        """The ribbons, farthest first (thesis 3.4, lines 17 to 21), into the framebuffer in use.

        Texture 2 is the strands. ``body_distance``: how far away the body is at every pixel [m].
        """
        assert self.curves is not None
        half_width = self._half_width(look)
        ribbon_half_width = half_width * ribbon_narrowing(self._per_particle)
        order = farthest_first(self._laid_out, self._all_curves, half_width, view)
        curve = self._laid_out["curve"][order].astype(np.int64)
        shown = shown_through_hair(self._all_curves, view, 2 * half_width)[curve]
        drawn = np.zeros(np.count_nonzero(shown), _DRAWN_DTYPE)
        drawn["ribbon"], drawn["shown"] = order[shown > 0], shown[shown > 0]
        self._drawn.orphan()
        self._drawn.write(drawn.tobytes())
        body_distance.use(3)
        self.light.softened.use(4)
        self._curve_texture.texture.use(5)
        self._ribbon_texture.texture.use(6)
        set_uniforms(
            self._programs.ribbon,
            strands=2,
            body_distance=3,
            light=4,
            curves=5,
            ribbons=6,
            half_width=half_width,
            ribbon_half_width=ribbon_half_width,
            window_width=2 * ribbon_half_width / STRIP_WIDTH,
            hair_colour=tuple(linear(look.hair_colour)),
            opacity=look.hair_opacity,
            transmission=look.forward_scatter,
            gloss=look.gloss,
        )
        self._ribbons.render(moderngl.TRIANGLE_STRIP, instances=len(drawn))

    def _half_width(self, look: Look) -> float:
        return 0.5 * look.billboard_width * self._model.spacing


def _strip() -> NDArray[np.float32]:
    """Corners of a ribbon as a triangle strip: side -1 or 1, and section."""
    return np.stack(np.meshgrid([-1, 1], np.arange(SECTIONS)), axis=-1).reshape(-1, 2).astype(np.float32)
