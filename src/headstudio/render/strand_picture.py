"""A picture in final quality of strands on plain meshes under a sun and an even sky: every strand, many samples a pixel.

No strand is blended: each of many pictures, moved by parts of a pixel, shows every strand as wide as it is and hidden by
what is in front of it. Their mean is what a camera sees, in any order and of any number of strands, and a strand thinner
than a pixel covers as much of the mean as it covers of the pixel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.frame import HeadFrame
from ..head.mesh import Floats, TriangleMesh
from ..wisp.strands import Strands
from .plain_body import PlainBody, PlainBodyPrograms
from .scene_block import SCENE_DTYPE
from .screen import ScreenPasses
from .sky_light import FINE, Sky, SkyLight, SkyPrograms, irradiance
from .strand_hair import StrandHair, StrandMaterial, StrandPrograms
from .targets import light_targets, picture_targets
from .view import View, bounding_sphere, parallel_view

SHADOW_SIZE = 1024
STEPS = 8
FINENESS = 4
"""Samples a pixel along each side, in every pass."""

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
    passes: int = 1,
    progress: Progress | None = None,
) -> NDArray[np.float32] | None:
    """The scene as linear light, top row first, (size, size, 3); None if ``progress`` stopped it."""
    programs = StrandPrograms(context)
    hair = StrandHair(context, programs, scene.strands, scene.strands.count)
    body = PlainBody(context, PlainBodyPrograms(context), scene.meshes)
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
    lost = hair.lost(scene.material)
    sky_light = SkyLight(context, SkyPrograms(context), programs.opacity, body.vertices, body.faces, FINE)
    hair.see_from_sky(sky_light)
    soft = np.pi * np.broadcast_to(scene.sky, body.vertices.shape) * 0.5
    above = body.vertices + 0.002 * body.normals
    facing = np.maximum(body.normals @ scene.sun_direction, 0.0)[:, None]
    sunlit = facing * hair.sunlit(above, maps, lost) * scene.sun
    for _ in range(BOUNCES):
        sky_light.see_body(scene.diffuse / np.pi * (soft + sunlit))
        soft = irradiance(sky_light.gather(above, sky, lost), body.normals)
    body.set_soft_light(soft)
    hair.take_soft_light(sky_light, sky, lost)
    maps.depth.use(0)
    maps.map.use(1)
    hair.shade(scene.material)

    screens = ScreenPasses(context, "reduce")
    targets = picture_targets(context, (size, size), FINENESS)
    total = np.zeros((size, size, 4), np.float32)
    red, green, blue = (float(part) for part in scene.sky)
    for k in range(passes):
        block.write(_scene_block(view, light, scene, _within_sample(k) * 2 / (size * FINENESS)).tobytes())
        with context.scope(targets.scene, moderngl.DEPTH_TEST):
            targets.scene.depth_mask = True
            targets.scene.clear(red, green, blue, 1.0, depth=1.0)
            maps.depth.use(0)
            maps.map.use(1)
            body.draw(scene.diffuse, lost=tuple(lost), shadow_map=0, light_map=1, **hair.light_uniforms(8))
            for step in hair.draw_opaque(view, size * FINENESS, STEPS):
                context.finish()
                if progress is not None and not progress(k * STEPS + step, passes * STEPS):
                    return None
        with context.scope(targets.reduced_target, moderngl.NOTHING):
            targets.colour.use(0)
            screens.draw("reduce", fine=0, supersampling=FINENESS)
        total += np.frombuffer(targets.reduced_target.read(components=4, dtype="f2"), np.float16).reshape(total.shape)
    return np.ascontiguousarray(total[::-1, :, :3] / np.float32(passes))


def shown(picture: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Linear light as it is shown, in sRGB (IEC 61966-2-1): the same shape."""
    light = np.clip(picture, 0.0, 1.0)
    bent = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-6) ** (1 / 2.4) - 0.055)
    return np.rint(255 * bent).astype(np.uint8)


def _scene_block(view: View, light: View, scene: StrandScene, shift: Floats | None = None) -> NDArray[np.void]:
    block = np.zeros(1, SCENE_DTYPE)
    moved = np.eye(4)
    if shift is not None:
        moved[:2, 3] = shift
    block["clip_from_world"] = (moved @ view.clip_from_world).T
    block["light_from_world"] = light.clip_from_world.T
    block["eye"][0, :3] = view.eye
    block["to_light"][0, :3] = -light.forward
    block["radiance"][0, :3] = scene.sun / np.pi
    block["sky"][0, :3] = block["ground"][0, :3] = scene.sky
    block["shadow"][0] = 1.0, light.far, view.near, view.far
    return block


def _within_sample(k: int) -> Floats:
    """By how much pass k moves the picture [samples], (2,): a sequence that fills a square evenly (Roberts 2018, R2)."""
    return (k * np.array([0.7548776662466927, 0.5698402909980532]) + 0.5) % 1.0 - 0.5
