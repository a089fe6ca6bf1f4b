"""The textures a frame is drawn into; made for a size, kept until the size changes."""

from __future__ import annotations

from dataclasses import dataclass

import moderngl

from .context import RenderError

Size = tuple[int, int]


@dataclass(frozen=True, eq=False)
class PictureTargets:
    """Linear colour (half floats, premultiplied alpha) with depth, and what is shown (8 bits, sRGB).

    The body is drawn with ``samples`` samples a pixel into ``body`` and resolved into ``scene``, which the hair, being
    soft by itself, is drawn into. ``depth_copy`` is the depth of the body as a texture the hair may read while the
    depth buffer is in use.
    """

    size: Size
    body: moderngl.Framebuffer
    scene: moderngl.Framebuffer
    colour: moderngl.Texture
    depth_copy: moderngl.Framebuffer
    depth: moderngl.Texture
    shown: moderngl.Framebuffer
    picture: moderngl.Texture


@dataclass(frozen=True, eq=False)
class LightTargets:
    """Seen from the light: the depth of the objects, and the part of the light that the hair lets through."""

    size: int
    shadow: moderngl.Framebuffer
    depth: moderngl.Texture
    light: moderngl.Framebuffer
    map: moderngl.Texture


def picture_targets(context: moderngl.Context, size: Size, samples: int) -> PictureTargets:
    """Targets of ``size`` pixels (width, height). Raises RenderError for a size this machine cannot draw."""
    largest = context.info["GL_MAX_TEXTURE_SIZE"]
    if not all(1 <= side <= largest for side in size):
        raise RenderError(f"a picture has 1 to {largest} pixels a side here, got {size[0]} x {size[1]}")
    samples = min(samples, context.max_samples)
    body = context.framebuffer(
        [context.renderbuffer(size, 4, samples=samples, dtype="f2")], context.depth_renderbuffer(size, samples=samples)
    )
    colour = _texture(context, size, 4, "f2", moderngl.NEAREST)
    scene = context.framebuffer([colour], context.depth_renderbuffer(size))
    depth = context.depth_texture(size)
    depth.compare_func = ""
    depth.filter = (moderngl.NEAREST, moderngl.NEAREST)
    depth_copy = context.framebuffer([], depth)
    picture = _texture(context, size, 4, "f1", moderngl.LINEAR)
    return PictureTargets(size, body, scene, colour, depth_copy, depth, context.framebuffer([picture]), picture)


def light_targets(context: moderngl.Context, size: int) -> LightTargets:
    """Shadow and light map of ``size`` x ``size`` texels."""
    depth = context.depth_texture((size, size))
    depth.compare_func = "<="
    depth.filter = (moderngl.LINEAR, moderngl.LINEAR)
    depth.repeat_x = depth.repeat_y = False
    light = _texture(context, (size, size), 1, "f2", moderngl.LINEAR)
    return LightTargets(size, context.framebuffer([], depth), depth, context.framebuffer([light]), light)


def _texture(context: moderngl.Context, size: Size, parts: int, kind: str, smooth: int) -> moderngl.Texture:
    texture = context.texture(size, parts, dtype=kind)
    texture.filter = (smooth, smooth)
    texture.repeat_x = texture.repeat_y = False
    return texture
