"""A picture in final quality of strands on plain meshes under a sun and an even sky, to be laid beside a path tracer's.

Every strand is drawn, in the order of distance, as wide as it is: thinner than a pixel it covers a part of it. Opaque
strands in many shifted pictures would come to the same in the end, but with ten samples a pixel a strand that is a tenth
of a pixel wide is a row of dots, and a path tracer's noise is no model to follow.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.frame import HeadFrame
from ..head.mesh import Floats, TriangleMesh
from ..head.refine import ShadedMesh, refine_near
from ..wisp.strands import Strands
from .occlusion import Occluder
from .plain_body import PlainBody, PlainBodyPrograms
from .scene_block import SCENE_DTYPE
from .screen import ScreenPasses
from .sky_light import Sky, SkyLight, SkyPrograms
from .soft_light import irradiance
from .strand_detail import FINE, StrandSurvey
from .strand_hair import StrandHair, StrandMaterial, StrandPrograms
from .targets import light_targets, picture_targets
from .view import View, bounding_sphere, parallel_view

SHADOW_SIZE = 1024
# Points of the hair around which the body gets triangles no larger than this [m].
_CONTACTS, _CONTACT_SIZE = 60_000, 0.004
FINENESS = 2
"""How many times finer than its pixels a final picture is drawn, along each side."""

STEPS = 16
"""Steps that a final picture is drawn in, so that somebody can watch it and stop it."""

BOUNCES = 2

Progress = Callable[[int, int], bool]
"""Told how many of how many steps are done; False stops the picture."""


@dataclass(frozen=True, eq=False)
class StrandScene:
    """Strands and meshes in one frame, and what lights them.

    diffuse: linear albedo of the meshes, (3,). sun_direction: towards the sun, unit, (3,). sun: irradiance on a surface
    that faces it, linear RGB, (3,). sky: radiance from everywhere, linear RGB, (3,); it is the background, too.
    """

    strands: Strands
    meshes: Sequence[TriangleMesh]
    material: StrandMaterial
    diffuse: Floats
    sun_direction: Floats
    sun: Floats
    sky: Floats


def strand_picture(
    context: moderngl.Context,
    scene: StrandScene,
    view: View,
    size: int,
    fineness: int = FINENESS,
    progress: Progress | None = None,
) -> NDArray[np.float32] | None:
    """The scene as linear light, top row first, (size, size, 3); None if ``progress`` stopped it."""
    context.gc()  # what the picture before this one was made of
    programs = StrandPrograms(context)
    hair = StrandHair(context, programs, StrandSurvey(scene.strands), scene.strands.count, FINE)
    body = PlainBody(context, PlainBodyPrograms(context), _refined(scene))
    maps = light_targets(context, SHADOW_SIZE)
    everything = np.concatenate([body.vertices, scene.strands.points])
    around = bounding_sphere(everything)
    light = parallel_view(scene.sun_direction, around.centre, around.radius)
    block = context.buffer(reserve=SCENE_DTYPE.itemsize)
    block.bind_to_uniform_block(0)
    block.write(_scene_block(view, light, scene).tobytes())

    with context.scope(maps.shadow, moderngl.DEPTH_TEST):
        maps.shadow.clear(depth=1.0)
        body.draw_depth()
    hair.shed_light(light, HeadFrame(), maps, SHADOW_SIZE)
    sky = Sky(scene.sky, scene.sky, np.array([0.0, 1.0, 0.0]))
    sky_light = SkyLight(context, SkyPrograms(context), programs.opacity, body.vertices, body.faces, FINE)
    hair.see_from_sky(sky_light)
    soft = np.pi * np.broadcast_to(scene.sky, body.vertices.shape) * 0.5
    above = body.vertices + 0.002 * body.normals
    facing = np.maximum(body.normals @ scene.sun_direction, 0.0)[:, None]
    sent = hair.sent_on(scene.material)
    sunlit = facing * hair.sunlit(above, maps, sent) * scene.sun
    for _ in range(BOUNCES):
        sky_light.see_body(scene.diffuse / np.pi * (soft + sunlit))
        soft = irradiance(sky_light.gather(above, sky, sent), body.normals)
    body.set_soft_light(soft)
    hair.take_soft_light(sky_light, sky, sent)
    maps.depth.use(0)
    maps.map.use(1)
    hair.shade(scene.material)

    screens = ScreenPasses(context, "reduce")
    targets = picture_targets(context, (size, size), fineness)
    red, green, blue = (float(part) for part in scene.sky)
    with context.scope(targets.scene, moderngl.DEPTH_TEST):
        targets.scene.depth_mask = True
        targets.scene.clear(red, green, blue, 1.0, depth=1.0)
        maps.depth.use(0)
        maps.map.use(1)
        body.draw(
            scene.diffuse, shadow_map=0, light_map=1, **hair.light_uniforms(8), **hair.let_through(sent),
        )  # fmt: skip
    with context.scope(targets.scene, moderngl.BLEND | moderngl.DEPTH_TEST):
        targets.scene.depth_mask = False
        context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        occluder = Occluder(targets.depth, view)
        for step in hair.draw(view, HeadFrame(), size * fineness, STEPS, occluder=occluder):
            context.finish()
            if progress is not None and not progress(step, STEPS):
                return None
    with context.scope(targets.reduced_target, moderngl.NOTHING):
        targets.colour.use(0)
        screens.draw("reduce", fine=0, supersampling=fineness)
    picture = np.frombuffer(targets.reduced_target.read(components=4, dtype="f2"), np.float16)
    return picture.reshape(size, size, 4)[::-1, :, :3].astype(np.float32)


def _refined(scene: StrandScene) -> list[ShadedMesh]:
    """The meshes with small triangles where hair lies on them: soft light is worked out at their vertices."""
    points = scene.strands.points
    near = points[:: max(len(points) // _CONTACTS, 1)].astype(float)
    surfaces = [ShadedMesh(mesh, mesh.vertex_normals) for mesh in scene.meshes]
    return [refine_near(surface, near, _CONTACT_SIZE) for surface in surfaces]


def shown(picture: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Linear light as it is shown, in sRGB (IEC 61966-2-1): the same shape."""
    light = np.clip(picture, 0.0, 1.0)
    bent = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-6) ** (1 / 2.4) - 0.055)
    return np.rint(255 * bent).astype(np.uint8)


def _scene_block(view: View, light: View, scene: StrandScene) -> NDArray[np.void]:
    block = np.zeros(1, SCENE_DTYPE)
    block["clip_from_world"] = view.clip_from_world.T
    block["light_from_world"] = light.clip_from_world.T
    block["eye"][0, :3] = view.eye
    block["to_light"][0, :3] = -light.forward
    block["radiance"][0, :3] = scene.sun / np.pi
    block["sky"][0, :3] = block["ground"][0, :3] = scene.sky
    block["shadow"][0] = 1.0, light.far, view.near, view.far
    return block
