"""Living skin on the graphics card, whatever body it is of: posed, wrinkled and covered with fine wrinkles.

What stays the same is sent once; positions, normals and amplitudes when there is another pose.
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints, TriangleMesh
from ..scene.settings import Look
from ..scene.skin_settings import SkinSettings
from . import lafortune
from .body import BodyPrograms, prepare_covering
from .buffers import bytes_of, floats_of, indices_of
from .context import load_program, set_uniforms
from .detailed_faces import DetailedFaces
from .fine_relief import FineRelief
from .hair_ground import Growth, ground_colour
from .openings import Openings
from .picture_area import Area, Outline, around
from .scattering import STEEPEST, scattering_table, scattering_taps
from .screen import ScreenPasses
from .skin_colour import HAEMOGLOBIN, skin_colour
from .skin_shape import BLOOD_MEAN, SkinPose, SkinShape, order_of_use
from .skin_values import scale_colours
from .targets import PictureTargets, Size
from .view import View


class SkinPrograms:
    """The shaders that draw living skin, and the tables they look into."""

    def __init__(self, context: moderngl.Context, body: BodyPrograms) -> None:
        self.depth = body.depth
        self.covering = body.covering
        self.part = body.part
        self.surface = load_program(context, "skin/surface.vert", "skin/surface.frag")
        self.scatter = ScreenPasses(context, "scatter", room="skin")
        self._context = context
        self._lights: dict[tuple[tuple[str, int], ...], ScreenPasses] = {}
        table = scattering_table()
        self.scattered = context.texture(table.shape[1::-1], 3, table.astype(np.float16), dtype="f2")
        self.scattered.repeat_x = self.scattered.repeat_y = False
        self.scale = context.texture((256, 1), 3, dtype="f1")
        self.scale.repeat_x = False
        self._scale_of = ""

    def light(self, **choices: int) -> ScreenPasses:
        """The pass that lights skin, made for these choices when they are first asked for; see skin/light.frag."""
        key = tuple(choices.items())
        if key not in self._lights:
            self._lights[key] = ScreenPasses(self._context, "light", room="skin", **choices)
        return self._lights[key]

    def set_scale(self, shows: str) -> None:
        """Put the colours of a scale into its texture."""
        if shows != self._scale_of:
            self.scale.write(bytes_of(scale_colours(shows)))
            self._scale_of = shows


class SkinBody:
    """A skin that is posed anew whenever it moves; made once per shape. growth: the hair that it carries."""

    def __init__(
        self,
        context: moderngl.Context,
        programs: SkinPrograms,
        shape: SkinShape,
        whole: TriangleMesh,
        known: SkinBody | None = None,
    ) -> None:
        """whole: the skin at rest, as a surface that is open only where it ends. known: a body with perhaps the same whole,
        or the same fine wrinkles, whose textures are large."""
        self.context = context
        self.programs = programs
        self.growth: Growth = None
        self._whole = whole
        self._openings: Openings = known._openings if known and known._whole is whole else Openings(whole)
        self._fine = shape.fine
        same_fine = known is not None and known._fine is shape.fine
        self._relief: FineRelief = known._relief if known and same_fine else FineRelief(context, shape.fine)
        surface = shape.surface
        self._order = order = order_of_use(surface.faces, len(surface.points))
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        body = np.column_stack([surface.points, shape.uv, shape.turning, shape.curvature, shape.mapped])[order]
        self._constants = [
            (context.buffer(floats_of(body)), "3f 2f 3f", "rest", "uv", "body"),
            (context.buffer(bytes_of(shape.painted[order])), "4f1", "paint"),
        ]
        self._cover = context.buffer(bytes_of(np.zeros(len(order))))
        self._faces = DetailedFaces(context, surface, place)
        self._level = -1
        # Nothing is bumpy beyond the map of the fine wrinkles: two thirds of a bust.
        self._outline = Outline(surface.points, shape.turning, shape.mapped > 0)
        self._bumpy: Area = (0, 0, 0, 0)
        self._posed = self._array()
        self._smooth: _PosedSkin | None = None
        posed = [
            (self._posed.vertices, "3f 28x", "position"),
            (context.buffer(floats_of(shape.turning[order])), "1f", "head_weight"),
        ]
        self._shadow = context.vertex_array(
            programs.depth, posed, context.buffer(indices_of(place[shape.shadow_faces]))
        )
        self._covering = context.vertex_array(programs.covering, posed, self._faces.buffer)

    def cover(self, cover: Floats) -> None:
        """How densely hair stands on every vertex, 0 to 1, (N,), from now on."""
        self._cover.write(bytes_of(cover[self._order]))

    def take(self, pose: SkinPose) -> None:
        """Show this pose from now on."""
        self._posed.write(pose)
        self._outline.pose(pose.positions)

    def take_smooth(self, pose: SkinPose) -> None:
        """Show this pose left of ``look.split``."""
        if self._smooth is None:
            self._smooth = self._array()
        self._smooth.write(pose)

    def look_from(self, view: View, frame: HeadFrame, size: Size) -> None:
        """Be as detailed as the next picture needs, of so many pixels (width, height), of the body at ``frame``."""
        self._level = self._faces.level_for(view, frame.translation, size[1])
        self._bumpy = self._outline.area(view, frame, size)

    def draw_depth(self, light: View) -> None:
        """The body into the shadow map of ``light``."""
        self._cull(light)
        self._shadow.render()
        self.context.disable(moderngl.CULL_FACE)

    def surface_targets(self, targets: PictureTargets) -> tuple[moderngl.Framebuffer, moderngl.Framebuffer]:
        """Where ``draw_surface`` draws, and what of it is to be cleared before."""
        return targets.skin.surface, targets.skin.bare

    def draw_surface(self, view: View, look: Look, skin: SkinSettings, targets: PictureTargets) -> None:
        """What the skin is like, into the framebuffer in use; texture 2 is the strands."""
        set_uniforms(self.programs.surface, strands=2, creases=skin.creases)
        self._cull(view)
        target = targets.skin.surface
        width, height = target.size
        border = round(look.split * width)
        if border < width:
            target.scissor = (border, 0, width - border, height)
            self._draw_pose(self._posed, fine=True)
        if border > 0:
            target.scissor = (0, 0, border, height)
            self._draw_pose(self._smooth or self._posed, fine=False)
        target.scissor = (0, 0, width, height)
        self.context.disable(moderngl.CULL_FACE)

    def _cull(self, view: View) -> None:
        """Half of the triangles face away, and their inside is only seen through an opening."""
        if not self._openings.shown_to(view.eye):
            self.context.enable(moderngl.CULL_FACE)

    def light_surface(self, view: View, look: Look, skin: SkinSettings, targets: PictureTargets) -> None:
        """The light that the skin sends to the eye, wherever the depth of the framebuffer in use shows that it is.

        Texture 0 is the shadow map, 1 the light map.
        """
        relief, programs = self._relief, self.programs
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
        apart = skin.scattering_by == "screen" and not shows_value
        self.context.depth_func = ">"
        lit = targets.scattering.lit if apart else targets.scene
        with self.context.scope(lit, moderngl.DEPTH_TEST):
            self._draw_light(
                lit,
                {"LAFORTUNE": int(skin.model == "lafortune"), "SHOWS_VALUE": int(shows_value), "KEPT_APART": int(apart)},
                shadow_map=0, light_map=1, normals=3, paint=4, distances=5, places_in_map=6, states=7, slopes=8,
                pores=9, heights=10, scattered=11, scale=12, size=(float(width), float(height)),
                forward=tuple(view.forward), upward=tuple(view.up / view.focal),
                sideward=tuple(view.right * width / height / view.focal),
                skin_colour=tuple(colour), hair_colour=tuple(ground_colour(self.growth, look)), haemoglobin=tuple(HAEMOGLOBIN),
                flushed=skin.flush, blood_mean=BLOOD_MEAN, blood_flow=skin.blood_flow, creases=skin.creases, gloss=skin.gloss,
                roughness=skin.roughness, scattering=skin.scattering, steepest=STEEPEST,
                tint=tuple(colour / lafortune.MEASURED_ALBEDO), measured_diffuse=tuple(lafortune.DIFFUSE),
                texels=float(relief.size), metres=relief.metres,
                mean_heights=relief.mean_heights, relief=skin.relief,
                **lafortune_uniforms(),
            )  # fmt: skip
        if apart:
            self._scatter(view, skin, targets)
        self.context.depth_func = "<"

    def _draw_light(self, target: moderngl.Framebuffer, choices: dict[str, int], **uniforms: object) -> None:
        """Light the skin that is in ``target``, in use; that with bumps and that without by shaders of their own."""
        for bumpy, areas in ((1, [self._bumpy]), (0, around(self._bumpy, target.size))):
            for k, area in enumerate(areas):
                target.scissor = area
                self.programs.light(BUMPY=bumpy, **choices).draw("light", **({} if k else uniforms))
        target.scissor = (0, 0, *target.size)

    def _scatter(self, view: View, skin: SkinSettings, targets: PictureTargets) -> None:
        """Spread the light that has entered the skin, along rows and then along columns, and add it to the picture."""
        scattering = targets.scattering
        width, height = targets.normal.size
        distances, shares = scattering_taps()
        known = {
            "entered": 3,
            "distances": 4,
            "tap_distances": distances.tolist(),
            "tap_shares": [tuple(share) for share in shares.tolist()],
            "scattering": skin.scattering,
            "size": (float(width), float(height)),
        }
        metre = 0.5 * view.focal * height
        scattering.entered.use(3)
        targets.distance.use(4)
        with self.context.scope(scattering.row, moderngl.DEPTH_TEST):
            self.programs.scatter.draw("scatter", along=(metre, 0.0), **known)
        scattering.spread.use(3)
        with self.context.scope(targets.scene, moderngl.DEPTH_TEST | moderngl.BLEND):
            # Colours add up, coverage stays.
            self.context.blend_func = moderngl.ONE, moderngl.ONE, moderngl.ZERO, moderngl.ONE  # type: ignore[assignment]
            self.programs.scatter.draw("scatter", along=(0.0, metre), **known)

    def cover_samples(self, targets: PictureTargets) -> None:
        """Draw the lit skin of ``targets`` into the framebuffer in use, which has several samples a pixel."""
        prepare_covering(self.programs.covering, targets)
        self._faces.render(self._covering, self._level)

    def draw_parts(self, look: Look) -> None:
        """What belongs to the body and is no skin, into the framebuffer in use: nothing, unless a body has parts."""

    def _draw_pose(self, posed: _PosedSkin, fine: bool) -> None:
        """Into the framebuffer in use."""
        set_uniforms(self.programs.surface, wrinkled=float(fine))
        self._faces.render(posed.array, self._level)

    def _array(self) -> _PosedSkin:
        constants: list[tuple[object, ...]] = [*self._constants, (self._cover, "1f1", "cover")]
        return _PosedSkin(self.context, self.programs.surface, self._order, constants, self._faces.buffer)


class _PosedSkin:
    """The arrays of one pose."""

    def __init__(
        self,
        context: moderngl.Context,
        program: moderngl.Program,
        order: Ints,
        constants: list[tuple[object, ...]],
        faces: moderngl.Buffer,
    ) -> None:
        """order: the vertices as they are drawn, (N,)."""
        self._order = order
        # What comes in double precision and column by column, as it goes to the graphics card.
        self._rows = np.empty((len(order), 10), dtype=np.float32)
        self._ordered = np.empty_like(self._rows)
        self.vertices = context.buffer(reserve=self._rows.nbytes, dynamic=True)
        changing = (self.vertices, "3f 3f 4f", "position", "normal", "state")
        self.array = context.vertex_array(program, [changing, *constants], faces)

    def write(self, pose: SkinPose) -> None:
        """Send a pose."""
        rows = self._rows
        columns = (*pose.positions.T, *pose.normals.T, *pose.amplitudes.T, pose.hidden, pose.value)
        for k, column in enumerate(columns):
            rows[:, k] = column
        self.vertices.write(rows.take(self._order, axis=0, out=self._ordered, mode="clip"))


def lafortune_uniforms() -> dict[str, object]:
    """The figures of common/lafortune.glsl."""
    tables = {"lobe_across": lafortune.ACROSS, "lobe_along": lafortune.ALONG, "lobe_exponents": lafortune.EXPONENTS}
    return {name: [tuple(row) for row in table.tolist()] for name, table in tables.items()}
