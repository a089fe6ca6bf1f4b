"""A stage becomes a picture: the passes of thesis 3.4, in their order."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.frame import HeadFrame
from ..scene.settings import TONE_MAPS, Camera, Look
from ..scene.skin_settings import SkinSettings
from ..scene.stage import Stage
from ..wrinkle.limb_skin import PosedLimb
from .adornments import AdornmentPrograms, Adornments
from .body import Body, BodyPrograms
from .hair import Hair, HairPrograms
from .limb_body import LimbBody
from .living_body import LivingBody
from .overlays import OverlayPass
from .samples import SampledCanvas, samples_of
from .scene_block import SCENE_DTYPE, linear, scene_block
from .screen import ScreenPasses
from .skin_body import SkinBody, SkinPrograms
from .strand_hair import StrandHair
from .strand_layer import StoppedError, StrandLayer
from .strand_picture import FINENESS, Progress
from .targets import LightTargets, PictureTargets, Size, light_targets, picture_targets
from .timing import StageTimer
from .view import View, camera_view, light_view

_AS_IT_COMES = SkinSettings()


class Renderer:
    """Draws stages into a texture of its own, in any OpenGL 3.3 context.

    It pulls: just before it draws it sends what is another object than in the last frame, and nothing else. After
    every frame the framebuffer, blending and tests are as they were before.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self.timer = StageTimer(context)
        self._body_programs = BodyPrograms(context)
        self._skin_programs = SkinPrograms(context, self._body_programs)
        self._hair_programs = HairPrograms(context)
        self._strands = StrandLayer(context)
        self._adornment_programs = AdornmentPrograms(context)
        self._overlays = OverlayPass(context)
        self._screens = ScreenPasses(context, "reduce", "develop")
        self._light_screens = ScreenPasses(context, "soft_map", room="light")
        self._scene_block = context.buffer(reserve=SCENE_DTYPE.itemsize, dynamic=True)
        self._body: Body | LivingBody | None = None
        self._limb: LimbBody | None = None
        self._hair: Hair | None = None
        self._adornments: Adornments | None = None
        self._maps: LightTargets | None = None
        self._final: Progress | None = None
        self._targets: PictureTargets | None = None
        self._sampled: SampledCanvas | None = None

    @property
    def colour_texture(self) -> int:
        """OpenGL's name of the texture that holds the last picture, bottom row first; 0 before the first."""
        return self._targets.picture.glo if self._targets else 0

    def render(
        self,
        stage: Stage,
        look: Look,
        camera: Camera,
        size: Size = (512, 512),
        target: moderngl.Framebuffer | None = None,
        supersampling: int = 1,
        skin: SkinSettings = _AS_IT_COMES,
    ) -> moderngl.Texture:
        """Draw the stage, and return the texture it is in; ``target``, if given, gets a copy.

        ``size``: width and height in pixels. ``supersampling``: how many times finer to draw before every pixel takes
        the mean; 2 makes a still smooth and costs four times the time. ``skin``: how living skin takes the light. Raises
        RenderError for a size that cannot be drawn.
        """
        with self._putting_back():
            targets = self._targets_for((int(size[0]), int(size[1])), supersampling)
            self._render(stage, look, camera, targets, skin)
            if target is not None:
                self.context.copy_framebuffer(target, targets.shown)
            return targets.picture

    def render_limb(
        self,
        limb: PosedLimb,
        look: Look,
        camera: Camera,
        size: Size = (512, 512),
        supersampling: int = 1,
        skin: SkinSettings = _AS_IT_COMES,
    ) -> moderngl.Texture:
        """Draw a hand, an arm or a foot where the head would be, lit and developed in the same way; see ``render``."""
        with self._putting_back():
            targets = self._targets_for((int(size[0]), int(size[1])), supersampling)
            if self._limb is None or self._limb.skin is not limb.skin:
                self._limb = LimbBody(self.context, self._skin_programs, limb.skin)
            self._limb.pose(limb, look)
            low, high = limb.positions.min(axis=0), limb.positions.max(axis=0)
            light = light_view(look, (low + high) / 2, float(np.linalg.norm(high - low)) / 2)
            view, maps = camera_view(camera, targets.size[0] / targets.size[1]), self._maps_for(look.shadow_size)
            self._limb.look_from(view, HeadFrame(), targets.scene.size)
            self._scene_block.write(scene_block(view, light, HeadFrame(), look).tobytes())
            self._scene_block.bind_to_uniform_block(0)
            self._cast_shadows(self._limb, None, light, look, maps)
            maps.softened.clear(1.0, 1.0, 1.0, 1.0)
            maps.depth.use(0)
            maps.soft.use(1)
            # A limb has no brows, whose strokes are all that its skin would take from this.
            self._hair_programs.strands.seen(view, camera.distance, targets.scene.height).use(2)
            canvas = self._draw_body(self._limb, view, look, targets, skin)
            self._develop_picture(look, targets, canvas)
            return targets.picture

    @contextmanager
    def _putting_back(self) -> Iterator[None]:
        """Leave framebuffer and blending as they were."""
        before = self.context.fbo
        try:
            yield
        finally:
            self.context.blend_func = moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA
            if before is not None:
                before.use()
            self.context.gc()

    def render_final(
        self,
        stage: Stage,
        look: Look,
        camera: Camera,
        size: Size,
        progress: Progress | None = None,
        skin: SkinSettings = _AS_IT_COMES,
    ) -> moderngl.Texture | None:
        """Draw the stage with all of its strands, each exactly as wide as it is, and FINENESS squared samples a pixel.

        ``progress`` is told how many of how many steps are done, and stops the picture with False: then None.
        """
        self._final = progress or (lambda done, of: True)
        try:
            return self.render(stage, look, camera, size, supersampling=FINENESS, skin=skin)
        except StoppedError:
            return None
        finally:
            self._final = None

    def read_pixels(self) -> NDArray[np.uint8]:
        """The last picture, top row first, shape (height, width, 3). Waits for the graphics card: for captures only."""
        if self._targets is None:
            raise ValueError("read_pixels comes after render")
        width, height = self._targets.size
        pixels = np.frombuffer(self._targets.shown.read(components=3, alignment=1), np.uint8)
        return pixels.reshape(height, width, 3)[::-1].copy()

    def _render(self, stage: Stage, look: Look, camera: Camera, targets: PictureTargets, skin: SkinSettings) -> None:
        timer = self.timer
        timer.start()
        with timer.stage("upload"):
            body, hair = self._pull(stage, look)
            view = camera_view(camera, targets.size[0] / targets.size[1])
            body.look_from(view, stage.frame, targets.scene.size)
            strands = self._strands.pull(stage, look, view, targets.scene.height, final=self._final is not None)
            worn = self._pull_adornments(stage, look)
            maps = self._maps_for(look.shadow_size)
            light = self._light(stage, look, hair, strands)
            self._scene_block.write(scene_block(view, light, stage.frame, look).tobytes())
            self._scene_block.bind_to_uniform_block(0)
        with timer.stage("shadow"):
            self._cast_shadows(body if look.show_head else None, worn, light, look, maps)
        with timer.stage("light"):
            self._shed_light(hair, light, look, maps)
            if strands is not None:
                self._strands.shed_light(strands, stage, light, look, maps)
            self._soften_light(maps)
        maps.depth.use(0)
        maps.soft.use(1)
        self._hair_programs.strands.seen(view, float(view.depth(stage.frame.translation)), targets.scene.height).use(2)
        with timer.stage("body"):
            canvas = self._draw_body(body if look.show_head else None, view, look, targets, skin)
            if worn is not None:
                self._draw_adornments(worn, canvas)
        if hair is not None:
            with timer.stage("hair"):
                self._draw_hair(hair, view, look, targets, canvas)
        if strands is not None:
            with timer.stage("strands"):
                self._strands.draw(strands, stage, view, look, canvas, maps, self._final)
        with timer.stage("overlays"), self.context.scope(canvas, moderngl.PROGRAM_POINT_SIZE):
            self._overlays.draw(stage.overlays)
        with timer.stage("develop"):
            self._develop_picture(look, targets, canvas)

    def _pull(self, stage: Stage, look: Look) -> tuple[Body | LivingBody, Hair | None]:
        body = self._pull_body(stage, look)
        hair = stage.hair if look.show_hair else None
        body.set_roots((hair.model if hair else stage.strands) if look.show_hair else None)
        if hair is None or hair.model.count == 0:
            return body, None
        if self._hair is None or not self._hair.suits(stage.head, hair.model, look.ribbons):
            self._hair = Hair(self.context, self._hair_programs, stage.head, hair.model, look.ribbons)
        self._hair.place(hair, stage.frame, look)
        return body, self._hair

    def _pull_body(self, stage: Stage, look: Look) -> Body | LivingBody:
        known = self._body
        if stage.skin is None:
            if not isinstance(known, Body) or known.head is not stage.head:
                known = Body(self.context, self._body_programs, stage.head)
        else:
            if not isinstance(known, LivingBody) or known.surface is not stage.skin.surface:
                before = known if isinstance(known, LivingBody) else None
                known = LivingBody(self.context, self._skin_programs, stage.skin.surface, stage.skin.face, before)
            known.pose(stage.skin, look)
        self._body = known
        return known

    def _pull_adornments(self, stage: Stage, look: Look) -> Adornments | None:
        if not stage.adornments or not look.show_hair:
            return None
        if self._adornments is None or self._adornments.worn is not stage.adornments:
            self._adornments = Adornments(self.context, self._adornment_programs, stage.adornments)
        return self._adornments

    def _light(self, stage: Stage, look: Look, hair: Hair | None, strands: StrandHair | None) -> View:
        low, high = stage.head.skin.bounds
        centre = (low + high) / 2 + stage.frame.translation
        radius = float(np.linalg.norm(high - low)) / 2
        if hair is not None and hair.curves is not None:
            radius = max(radius, float(np.linalg.norm(hair.curves.position - centre, axis=1).max()))
        if strands is not None:
            radius = max(radius, strands.reach + float(np.linalg.norm(centre - stage.frame.translation)))
        # In steps, so that the texels of the maps do not creep over the head as the hair moves.
        return light_view(look, centre, np.ceil(radius / 0.02) * 0.02)

    def _cast_shadows(
        self, body: Body | SkinBody | None, worn: Adornments | None, light: View, look: Look, maps: LightTargets
    ) -> None:
        with self.context.scope(maps.shadow, moderngl.DEPTH_TEST):
            maps.shadow.clear(depth=1.0)
            if body is not None and look.shadows:
                body.draw_depth(light)
            if worn is not None and look.shadows:
                worn.draw_depth()

    def _shed_light(self, hair: Hair | None, light: View, look: Look, maps: LightTargets) -> None:
        maps.light.clear(1.0, 1.0, 1.0, 1.0)
        if hair is not None:
            hair.shed_light(light, look, maps)

    def _soften_light(self, maps: LightTargets) -> None:
        with self.context.scope(maps.softened, moderngl.NOTHING):
            maps.map.build_mipmaps(0, int(np.log2(maps.size / maps.soft.width)))
            maps.map.use(0)
            self._light_screens.draw("soft_map", light_map=0, size=float(maps.soft.width))

    def _draw_body(
        self, body: Body | SkinBody | None, view: View, look: Look, targets: PictureTargets, skin: SkinSettings
    ) -> moderngl.Framebuffer:
        """Returns the canvas that the rest of the picture is drawn on: the scene, or one of several samples a pixel."""
        surface, bare = (targets.surface, targets.bare) if body is None else body.surface_targets(targets)
        bare.clear(view.far, depth=1.0)
        if body is not None:
            with self.context.scope(surface, moderngl.DEPTH_TEST):
                body.draw_surface(view, look, skin, targets)
        targets.scene.depth_mask = False
        targets.scene.clear(0.0, 0.0, 0.0, 0.0)
        if body is not None:
            with self.context.scope(targets.scene, moderngl.DEPTH_TEST):
                body.light_surface(view, look, skin, targets)
        canvas = self._canvas(look, targets)
        if canvas is not targets.scene:
            with self.context.scope(canvas, moderngl.DEPTH_TEST):
                canvas.depth_mask = True
                canvas.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)
                if body is not None:
                    body.cover_samples(targets)
        if body is not None:
            with self.context.scope(canvas, moderngl.DEPTH_TEST | moderngl.BLEND):
                self.context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
                canvas.depth_mask = True
                body.draw_parts(look)
        return canvas

    def _canvas(self, look: Look, targets: PictureTargets) -> moderngl.Framebuffer:
        samples = samples_of(self.context, look)
        if samples == 1 or targets.supersampling > 1:
            return targets.scene
        if self._sampled is None or (self._sampled.size, self._sampled.samples) != (targets.size, samples):
            self._sampled = SampledCanvas(self.context, targets.size, samples)
        return self._sampled.framebuffer

    def _draw_adornments(self, worn: Adornments, canvas: moderngl.Framebuffer) -> None:
        with self.context.scope(canvas, moderngl.DEPTH_TEST):
            canvas.depth_mask = True
            worn.draw()

    def _draw_hair(
        self, hair: Hair, view: View, look: Look, targets: PictureTargets, canvas: moderngl.Framebuffer
    ) -> None:
        with self.context.scope(canvas, moderngl.BLEND | moderngl.DEPTH_TEST):
            canvas.depth_mask = False
            self.context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
            hair.draw(view, look, targets.distance)

    def _develop_picture(self, look: Look, targets: PictureTargets, canvas: moderngl.Framebuffer) -> None:
        width, height = targets.size
        if canvas is not targets.scene:
            # The mean of the samples of every pixel.
            self.context.copy_framebuffer(targets.reduced_target, canvas)
        if targets.supersampling > 1:
            with self.context.scope(targets.reduced_target, moderngl.NOTHING):
                targets.colour.use(0)
                self._screens.draw("reduce", fine=0, supersampling=targets.supersampling)
        with self.context.scope(targets.shown, moderngl.NOTHING):
            targets.reduced.use(0)
            background = tuple(linear(look.background))
            self._screens.draw(
                "develop",
                linear_picture=0,
                background=background,
                size=(float(width), float(height)),
                tone_map=TONE_MAPS.index(look.tone_map),
            )

    def _targets_for(self, size: Size, supersampling: int) -> PictureTargets:
        known = self._targets
        if known is None or known.size != size or known.supersampling != supersampling:
            known = self._targets = picture_targets(self.context, size, supersampling)
        return known

    def _maps_for(self, size: int) -> LightTargets:
        if self._maps is None or self._maps.size != size:
            self._maps = light_targets(self.context, size)
        return self._maps
