"""Strands in the pictures of a stage: what is kept of them from one picture to the next, and the passes they take part in."""

from __future__ import annotations

import weakref
from collections.abc import Callable

import moderngl
import numpy as np

from ..head.head import Head
from ..scene.settings import Look
from ..scene.stage import Stage
from ..wisp.strands import Strands
from .deep_opacity import OpacityPrograms
from .fibre import Fibre, colour_absorption
from .occlusion import Occluder
from .scene_block import linear, sky_and_ground
from .skin_paint import coarse_faces
from .sky_light import Sky, SkyLight, SkyPrograms
from .strand_detail import FINE, QUICK, ROUGH, StrandDetail, StrandSurvey
from .strand_hair import StrandHair, StrandMaterial, StrandPrograms
from .strand_picture import STEPS, Progress
from .targets import LightTargets
from .view import View

# Details of the body below this size [m] do not matter to the soft light between strands.
_BODY_DETAIL = 0.006


class StoppedError(Exception):
    """Somebody stopped a final picture."""


class StrandLayer:
    """The strands of the stage that was drawn last, ``hair``, and the sky that lights them."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._programs = StrandPrograms(context)
        self._sky_programs = SkyPrograms(context)
        self.hair: StrandHair | None = None
        # The sky over the head that was drawn last, in every detail it was looked at: a draft and what follows it take
        # turns.
        self._skies: dict[StrandDetail, _HeadSky] = {}

    def pull(self, stage: Stage, look: Look, view: View, height: int, *, final: bool) -> StrandHair | None:
        """The strands to draw, sent again only where they are others; ``final``: all of them, in the finest detail."""
        if stage.strands is None or stage.strands.count == 0 or not look.show_hair:
            return None
        known = self.hair
        survey = known.survey if known and known.survey.strands is stage.strands else StrandSurvey(stage.strands)
        shown, detail = (stage.strands.count, FINE) if final else (look.strands_shown, _quick(stage.strands, look))
        sparse = survey.bend < detail.bend_pixels * survey.pixel(view, stage.frame, height)
        if known is None or not known.suits(survey, shown, detail, sparse):
            known = StrandHair(self._context, self._programs, survey, shown, detail, sparse)
        elif known.survey is not survey:
            known.recolour(survey)
        self.hair = known
        return known

    def shed_light(self, strands: StrandHair, stage: Stage, light: View, look: Look, maps: LightTargets) -> None:
        """Light and sky see the strands; what passes through them goes into the light map."""
        strands.shed_light(light, stage.frame, maps, look.shadow_size)
        self._let_sky_in(strands, stage, look)

    def draw(
        self, strands: StrandHair, stage: Stage, view: View, look: Look, canvas: moderngl.Framebuffer,
        maps: LightTargets, progress: Progress | None,
    ) -> None:  # fmt: skip
        """Shade the strands and blend them over the canvas: in steps of which ``progress`` is told, if there is one.

        Raises StoppedError where it says no.
        """
        maps.depth.use(0)
        maps.map.use(1)
        strands.look_from(view, stage.frame, canvas.height)
        strands.shade(strand_material(look))
        depth = canvas.depth_attachment
        # Reading depth back would hold up a frame of the window. That of several samples a pixel is in no texture.
        occluder = Occluder(depth, view) if progress and isinstance(depth, moderngl.Texture) else None
        with self._context.scope(canvas, moderngl.BLEND | moderngl.DEPTH_TEST):
            canvas.depth_mask = False
            self._context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
            steps = STEPS if progress else 1
            for done in strands.draw(view, stage.frame, canvas.height, steps, canvas.samples, occluder):
                if progress:
                    self._context.finish()
                    if not progress(done, steps):
                        raise StoppedError

    def _let_sky_in(self, strands: StrandHair, stage: Stage, look: Look) -> None:
        """Work out the soft light in the strands: again only for other strands, another sky or another kind of hair."""
        if any(sky.head is not stage.head for sky in self._skies.values()):
            self._skies.clear()
        if strands.detail not in self._skies:
            self._skies[strands.detail] = _HeadSky(
                self._context, self._sky_programs, self._programs.opacity, stage.head, strands.detail
            )
        self._skies[strands.detail].light(strands, look)


class _HeadSky:
    """The sky over one head, the hair that stands before it, and what the light in that hair was worked out from."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: SkyPrograms,
        opacity: OpacityPrograms,
        head: Head,
        detail: StrandDetail,
    ) -> None:
        self.head = head
        faces = coarse_faces(head.skin, _BODY_DETAIL)
        self._sky = SkyLight(context, programs, opacity, head.skin.vertices, faces, detail)
        self._body_lit: tuple[object, ...] | None = None
        # Hair that is shown no more is not kept for this.
        self._seen: Callable[[], StrandHair | None] = lambda: None
        self._lit: tuple[object, ...] | None = None

    def light(self, strands: StrandHair, look: Look) -> None:
        """Let the sky of ``look`` into the strands."""
        material, skin = strand_material(look), self.head.skin
        if self._seen() is not strands:
            strands.see_from_sky(self._sky)
            self._seen, self._lit = weakref.ref(strands), None
        wanted = (strands.survey, look.ambient, look.skin_colour, material.absorption, look.strand_roughness)
        if self._lit == wanted:
            return
        sky = Sky(*sky_and_ground(look), np.array([0.0, 1.0, 0.0]))
        if self._body_lit != (look.ambient, look.skin_colour):
            self._sky.see_body(0.5 * linear(look.skin_colour) * np.broadcast_to(sky.above, skin.vertices.shape))
            self._body_lit = (look.ambient, look.skin_colour)
        strands.take_soft_light(self._sky, sky, strands.sent_on(material))
        self._lit = wanted


def _quick(strands: Strands, look: Look) -> StrandDetail:
    """How carefully strands are drawn to work with: fewer than were asked for, and than there are, are only a draft."""
    there = strands.count * strands.stands_for
    return ROUGH if strands.count < 0.99 * min(look.strands_shown, there) else QUICK


def strand_material(look: Look) -> StrandMaterial:
    """The strands of a look: hair of its colour where they have none of their own."""
    fibre = Fibre(roughness=look.strand_roughness)
    red, green, blue = colour_absorption(linear(look.hair_colour), fibre.radial_roughness)
    return StrandMaterial(fibre, (float(red), float(green), float(blue)), look.strand_model == "fibre")
