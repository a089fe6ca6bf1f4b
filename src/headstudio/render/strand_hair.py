"""Strands of hair on the graphics card: from a light's view of them to ribbons in the picture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import moderngl
import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..wisp.strands import Singles
from .context import load_program, set_uniforms
from .deep_opacity import DeepOpacityMap, LightStrips, OpacityPrograms
from .fibre import Fibre, Sent, colour_absorption, colour_slope, fibre_tables, filling, sent_on
from .fibre_textures import FibreTextures
from .light_volume import LightVolume, grid_around, lit_from_beside
from .occlusion import Occluder
from .receivers import receive
from .screen import ScreenPasses
from .sky_light import Sky, SkyLight
from .strand_detail import StrandDetail, StrandSurvey, thinned
from .strand_points import POINT_ROW, PackedStrands, StrandTextures, pack, piece_indices, piece_spheres, strip_indices
from .targets import LightTargets
from .view import View, parallel_view

_DEPTH_LEVELS = 65535

# Pixels beside a strand whose middles are nearer to it than this are covered in part. Those of them that have several
# samples must be drawn to the last: their cover is shared by all.
_ROOM, _TO_SAMPLE = 0.5, 0.75

# Pieces no longer than this part of them may be found to be hidden.
_MOST_PIECES = 0.95

# Strands do not stand in one another: half a chord of each, pi / 4 radii, is between two, and across a strand a way from
# anywhere is pi / 2 times as long as the straight one, in the mean. So far is another strand, in widths.
_CLEAR = np.pi**2 / 8

# No fewer strands are drawn, however small they are seen.
_FEWEST = 2_000


@dataclass(frozen=True)
class StrandMaterial:
    """What the strands are made of.

    absorption: per radius, RGB, of strands that have no colour of their own. fibre_model: Marschner's lobes; else those of
    Kajiya and Kay. followed: how far light is followed from strand to strand (fibre.followed); 1 to its end.
    """

    fibre: Fibre
    absorption: tuple[float, float, float]
    fibre_model: bool = True
    followed: float = 1.0


class StrandPrograms:
    """The shaders of strands."""

    def __init__(self, context: moderngl.Context) -> None:
        self.opacity = OpacityPrograms(context)
        self.ribbon = load_program(context, "strands/ribbon.vert", "strands/ribbon.frag")
        self.screens = ScreenPasses(context, "shade", "light_map", "sunlit", room="strands")
        self.fibre = FibreTextures(context)


class StrandHair:
    """One set of strands, of which at most ``shown`` are drawn, wider by as much as others are left out."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: StrandPrograms,
        survey: StrandSurvey,
        shown: int,
        detail: StrandDetail,
        sparse: bool = False,
    ) -> None:
        """sparse: without every second of the points."""
        self.survey = survey
        self.detail = detail
        self.sparse = sparse
        step = 2 if sparse else 1
        strands = thinned(survey.strands, step)
        self._stands_for = strands.stands_for * strands.count * survey.shortening(step)
        self._context = context
        self._programs = programs
        packed = pack(strands)
        self._first = packed.first
        self.shown = self._drawn = min(shown, packed.count)
        self._textures = StrandTextures(context, packed)
        self._sphere = survey.sphere
        self.reach = float(np.linalg.norm(self._sphere.centre)) + self._sphere.radius
        """Strands reach no farther from the origin of the head frame than this [m]."""
        self._lit_by = min(detail.sun_strands, self.shown)
        self._for_sun = self._light_strips(packed, self._lit_by, step, detail.stride)
        # The sky sees hair from afar: what is straight needs few points.
        stride = max(detail.stride, survey.straight_for // step)
        self._for_sky = self._light_strips(packed, min(detail.sky_strands, self._lit_by), step, stride)
        self._pieces, self._piece_ends = piece_indices(packed.first, self.shown, detail.piece)
        self._amid, self._reaches = piece_spheres(packed, self._pieces)
        self._reach = float(np.quantile(self._reaches, _MOST_PIECES)) if len(self._reaches) else 0.0
        self._thickest = float(packed.points[:, 3].max(initial=0.0))
        self._sorted = context.buffer(reserve=max(self._pieces.nbytes, 4))
        self._sorted_array = context.vertex_array(programs.ribbon, [], self._sorted)
        self._shades = context.texture((POINT_ROW, self._textures.rows), 4, dtype="f2")
        self._shades.filter = (moderngl.NEAREST, moderngl.NEAREST)
        self._shade_target = context.framebuffer([self._shades])
        self.opacity: DeepOpacityMap | None = None
        self._mean_colour: Floats | None = None
        self._paint(strands.colour)
        self._grid = grid_around(strands.points, detail.spacing)
        self._hair_view: View
        self._lit_from: tuple[bytes, bytes, int] | None = None
        self._soft: LightVolume | None = None
        self._filling = 1.0

    def suits(self, survey: StrandSurvey, shown: int, detail: StrandDetail, sparse: bool) -> bool:
        """True if these are strands of that shape in that detail; their colours may be others."""
        same = self.survey.same_shape(survey.strands) and self.detail == detail and self.sparse == sparse
        return same and self.shown == min(shown, survey.strands.count)

    def recolour(self, survey: StrandSurvey) -> None:
        """Show other colours on the same strands."""
        self.survey = survey
        self._paint(thinned(survey.strands, 2 if self.sparse else 1).colour)

    def _paint(self, colour: Singles | None) -> None:
        self._textures.paint(colour)
        self._mean_colour = None if colour is None else np.array([part.mean(dtype=float) for part in colour.T])

    def widening(self, of: int) -> float:
        """How many times too thick the first ``of`` strands are drawn, to cover as much as all that they stand for."""
        return self._stands_for / max(of, 1)

    def _light_strips(self, packed: PackedStrands, strands: int, step: int, stride: int) -> LightStrips:
        """The first ``strands`` with every ``stride``-th point, of those that are every ``step``-th of all."""
        indices = strip_indices(packed.first, strands, stride)
        # They lose more of their length than what is drawn.
        shortening = self.survey.shortening(step * stride) / self.survey.shortening(step)
        return LightStrips(
            self._context, self._programs.opacity, self._textures, indices, self.widening(strands) * shortening,
            self.survey.width,
        )  # fmt: skip

    def look_from(self, view: View, frame: HeadFrame, height: int) -> None:
        """Choose how many strands are shaded and drawn in a picture ``height`` pixels high: so many that none is wider than
        the detail says.
        """
        self._drawn = self.shown
        if self.detail.strand_pixels:
            widest = self.detail.strand_pixels * self.survey.pixel(view, frame, height)
            self._drawn = min(self.shown, max(int(self.widening(1) * self.survey.width / widest), _FEWEST))

    def shed_light(self, light: View, frame: HeadFrame, maps: LightTargets, size: int) -> None:
        """Draw the strands as the light sees them, and what they let through into the light map, for the skin.

        ``light``: its view of all there is; that of the hair alone, which has finer texels, follows from it.
        """
        size = int(size * self.detail.fineness)
        if self.opacity is None or self.opacity.size != size:
            self.opacity = DeepOpacityMap(self._context, self._programs.opacity, size)
        pose = _pose(frame)
        centre = pose[:3, :3] @ self._sphere.centre + pose[:3, 3]
        view = parallel_view(-light.forward, centre, self._sphere.radius)
        lit_from = (view.clip_from_world.tobytes(), pose.tobytes(), size)
        if self._lit_from != lit_from:
            self.opacity.fill(self._for_sun, pose, [view])
            self._hair_view, self._lit_from = view, lit_from
        from_light = view.clip_from_world @ np.linalg.inv(light.clip_from_world)
        with self._context.scope(maps.light, moderngl.NOTHING):
            maps.depth.compare_func = ""
            maps.depth.use(5)
            self._programs.screens.draw(
                "light_map", body=5, size=float(maps.size), hair_box_from_light=tuple(from_light.T.ravel()),
                **self.opacity.bind(2),
            )  # fmt: skip
            maps.depth.compare_func = "<="

    def light_uniforms(self, first_unit: int) -> dict[str, object]:
        """Bind what is known of the light in the hair to three units from ``first_unit`` on; returns the uniforms."""
        assert self.opacity is not None
        box = tuple(self._hair_view.clip_from_world.T.ravel())
        return {"hair_box": box, "box_size": self._hair_view.far, **self.opacity.bind(first_unit)}

    def let_through(self, sent: Sent) -> dict[str, object]:
        """Uniforms of common/through_hair.glsl for the light's map; ``sent`` as ``sent_on`` says."""
        assert self.opacity is not None
        return self.opacity.let_through(sent)

    def see_from_sky(self, sky_light: SkyLight) -> None:
        """Show the hair to the sky: as many of the strands, spread evenly over all, as it can look through."""
        sky_light.see_hair(self._for_sky, self._sphere)

    def take_soft_light(self, sky_light: SkyLight, sky: Sky, sent: Sent) -> None:
        """Work out the soft light all through the hair; ``sent`` as in SkyLight.gather."""
        light = lit_from_beside(self._grid, sky_light.gather(self._grid.places, sky, sent, _CLEAR * self.survey.width))
        self._soft = LightVolume(self._context, self._grid, light)
        self._filling = filling(sent)

    def sent_on(self, material: StrandMaterial) -> Sent:
        """What strands do with the light they meet, in the mean over the hair."""
        absorption = np.array(material.absorption)
        if self._mean_colour is not None:
            absorption = colour_absorption(self._mean_colour, material.fibre.radial_roughness)
        return sent_on(fibre_tables(material.fibre), absorption, material.followed)

    def sunlit(self, places: Floats, maps: LightTargets, sent: Sent) -> Floats:
        """The part of the parallel light that reaches ``places`` [m] in the head frame, (n, 3), between the strands and by
        way of them: RGB, (n, 3). sent: as ``sent_on`` says.
        """
        assert self.opacity is not None
        maps.depth.use(1)
        maps.map.use(2)
        uniforms = {
            "shadow_map": 1, "light_map": 2, **self.opacity.let_through(sent), **self.light_uniforms(3),
        }  # fmt: skip
        return receive(self._context, self._programs.screens, "sunlit", places, 1, **uniforms)[:, 0, :3]

    def shade(self, material: StrandMaterial) -> None:
        """Work out the radiance of every point that is drawn; texture 0 is the shadow map, 1 the light map."""
        assert self.opacity is not None
        assert self._soft is not None
        textures = self._textures
        textures.points.use(2)
        textures.tangents.use(3)
        if textures.colour is not None:
            textures.colour.use(4)
        fibre = material.fibre
        uniforms = {
            "shadow_map": 0, "light_map": 1, "points": 2, "tangents": 3, "hair_colours": 4,
            "light_widening": self._for_sun.widening,
            "light_points": int(self._first[self._lit_by]),
            "coloured": textures.colour is not None,
            "hair_absorption": material.absorption,
            "colour_slope": colour_slope(fibre.radial_roughness),
            "fibre_model": material.fibre_model,
            "followed": material.followed,
            "filling": self._filling,
            **self._programs.fibre.bind(fibre, 5),
        }  # fmt: skip
        rows = -(-int(self._first[self._drawn]) // POINT_ROW)
        with self._context.scope(self._shade_target, moderngl.NOTHING):
            self._shade_target.viewport = (0, 0, POINT_ROW, max(rows, 1))
            self._programs.screens.draw("shade", **uniforms, **self.light_uniforms(9), **self._soft.bind(12))

    def draw(
        self,
        view: View,
        frame: HeadFrame,
        height: int,
        steps: int = 1,
        samples: int = 1,
        occluder: Occluder | None = None,
    ) -> Iterator[int]:
        """Strands in order, farthest first, over the framebuffer in use, ``height`` pixels high, so many samples a pixel.

        They are drawn in so many steps: yields 1, 2, 3 ... after each. What ``occluder`` hides is left out.
        """
        eye = frame.rotation.inv().apply(view.eye - frame.translation)
        drawn = slice(int(self._piece_ends[self._drawn]))
        amid, pieces = self._amid[drawn], self._pieces[drawn]
        away = np.linalg.norm(amid - eye.astype(np.float32), axis=1)
        low, high = (float(away.min()), float(away.max())) if len(away) else (0.0, 1.0)
        if occluder is not None:
            reach = self._reach + self.widening(self._drawn) * self._thickest
            # The few pieces that are longer than nearly all others are drawn anyway.
            seen = (self._reaches[drawn] > self._reach) | ~occluder.hides(amid, _pose(frame), reach)
            away, pieces = away[seen], pieces[seen]
        # Whole numbers are sorted several times as fast, and 65,536 levels are some hundredths of a millimetre.
        levels = ((high - away) * (_DEPTH_LEVELS / max(high - low, 1e-6))).astype(np.uint16)
        order = np.argsort(levels, kind="stable")
        self._sorted.write(pieces[order])
        bounds = np.linspace(0, len(order), steps + 1).astype(int) * pieces.shape[1]
        for step, (start, end) in enumerate(pairwise(bounds.tolist())):
            self._use(view, height, samples)
            if end > start:
                self._sorted_array.render(moderngl.TRIANGLE_STRIP, vertices=end - start, first=start)
            yield step + 1

    def _use(self, view: View, height: int, samples: int) -> None:
        self._textures.points.use(2)
        self._textures.tangents.use(3)
        self._shades.use(4)
        set_uniforms(
            self._programs.ribbon, points=2, tangents=3, shades=4, widening=self.widening(self._drawn),
            metres_per_pixel=2.0 / (view.focal * height), room=_ROOM if samples < 2 else _ROOM + _TO_SAMPLE,
        )  # fmt: skip


def _pose(frame: HeadFrame) -> Floats:
    matrix = np.eye(4)
    matrix[:3, :3] = frame.rotation.as_matrix()
    matrix[:3, 3] = frame.translation
    return matrix
