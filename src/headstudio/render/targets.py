"""The textures a frame is drawn into; made for a size, kept until the size changes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import moderngl

from .context import RenderError

Size = tuple[int, int]

SOFT_SIZE = 128
"""Texels a side of the light map for what is not hair: one is half a centimetre, as fine as what particles know of hair. The
strands that they are drawn with are made up, and their shadows on a face would be stripes."""


@dataclass(frozen=True, eq=False)
class PictureTargets:
    """Linear colour (half floats, premultiplied alpha) with depth, and what is shown (8 bits, sRGB).

    ``scene`` is ``supersampling`` times as large as ``size``, and so is ``surface``, which holds what the skin is like at
    every pixel before any light falls on it: its normal and how densely hair grows on it, its paint, and its distance
    from the eye [m], which the hair reads too while the depth buffer is in use. They share their depth. ``bare`` is what of
    ``surface`` must be clear where there is no body: the distance. ``reduced`` is the
    colour at the size of the picture: the same texture, or the mean of it when there is supersampling.
    """

    size: Size
    supersampling: int
    scene: moderngl.Framebuffer
    colour: moderngl.Texture
    depth: moderngl.Texture
    reduced: moderngl.Texture
    reduced_target: moderngl.Framebuffer
    surface: moderngl.Framebuffer
    bare: moderngl.Framebuffer
    normal: moderngl.Texture
    paint: moderngl.Texture
    distance: moderngl.Texture
    shown: moderngl.Framebuffer
    picture: moderngl.Texture

    @cached_property
    def skin(self) -> SkinTargets:
        """What living skin needs besides; made for the first picture that shows any."""
        context, fine = self.surface.ctx, self.normal.size
        place = _texture(context, fine, 2, "f4", moderngl.NEAREST)
        state = _texture(context, fine, 4, "f1", moderngl.NEAREST)
        surface = context.framebuffer([self.normal, self.paint, self.distance, place, state], self.depth)
        bare = context.framebuffer([self.distance, place], self.depth)
        return SkinTargets(surface, bare, place, state)

    @cached_property
    def scattering(self) -> ScatteringTargets:
        """What light needs that is spread under the skin in the picture; made for the first picture that does."""
        context, fine = self.surface.ctx, self.normal.size
        entered = _texture(context, fine, 4, "f2", moderngl.LINEAR)
        spread = _texture(context, fine, 4, "f2", moderngl.LINEAR)
        lit = context.framebuffer([self.colour, entered], self.depth)
        row = context.framebuffer([spread], self.depth)
        lit.depth_mask = row.depth_mask = False
        return ScatteringTargets(lit, entered, row, spread)


@dataclass(frozen=True, eq=False)
class SkinTargets:
    """What living skin is like at every pixel, in ``surface``: where it lies in the map of its fine wrinkles (the whole
    precision of single floats: a close look is nearer than a texel), and how far these are grown. ``bare``: what must be
    clear where there is no skin, since the place of a pixel is compared with that of its neighbours."""

    surface: moderngl.Framebuffer
    bare: moderngl.Framebuffer
    place: moderngl.Texture
    state: moderngl.Texture


@dataclass(frozen=True, eq=False)
class ScatteringTargets:
    """``lit``: what the skin mirrors goes into the picture, the light that has ``entered`` it is kept apart. ``row``: that
    light, ``spread`` along rows."""

    lit: moderngl.Framebuffer
    entered: moderngl.Texture
    row: moderngl.Framebuffer
    spread: moderngl.Texture


@dataclass(frozen=True, eq=False)
class LightTargets:
    """Seen from the light: the depth of the objects, and the part of the light that the hair lets through. ``soft``: that
    with soft edges, in SOFT_SIZE texels, for what is not hair."""

    size: int
    shadow: moderngl.Framebuffer
    depth: moderngl.Texture
    light: moderngl.Framebuffer
    map: moderngl.Texture
    softened: moderngl.Framebuffer
    soft: moderngl.Texture


def picture_targets(context: moderngl.Context, size: Size, supersampling: int) -> PictureTargets:
    """Targets of ``size`` pixels (width, height). Raises RenderError for a size this machine cannot draw."""
    largest = context.info["GL_MAX_TEXTURE_SIZE"] // supersampling
    if not all(1 <= side <= largest for side in size):
        raise RenderError(f"a picture has 1 to {largest} pixels a side here, got {size[0]} x {size[1]}")
    fine = (size[0] * supersampling, size[1] * supersampling)
    colour = _texture(context, fine, 4, "f2", moderngl.NEAREST)
    depth = context.depth_texture(fine)
    depth.compare_func = ""
    depth.filter = (moderngl.NEAREST, moderngl.NEAREST)
    reduced = colour if supersampling == 1 else _texture(context, size, 4, "f2", moderngl.NEAREST)
    normal = _texture(context, fine, 4, "f2", moderngl.NEAREST)
    paint = _texture(context, fine, 4, "f1", moderngl.NEAREST)
    distance = _texture(context, fine, 1, "f4", moderngl.NEAREST)
    picture = _texture(context, size, 4, "f1", moderngl.LINEAR)
    return PictureTargets(
        size=size,
        supersampling=supersampling,
        scene=context.framebuffer([colour], depth),
        colour=colour,
        depth=depth,
        reduced=reduced,
        reduced_target=context.framebuffer([reduced]),
        surface=context.framebuffer([normal, paint, distance], depth),
        bare=context.framebuffer([distance], depth),
        normal=normal,
        paint=paint,
        distance=distance,
        shown=context.framebuffer([picture]),
        picture=picture,
    )


def light_targets(context: moderngl.Context, size: int) -> LightTargets:
    """Shadow and light map of ``size`` x ``size`` texels."""
    depth = context.depth_texture((size, size))
    depth.compare_func = "<="
    depth.filter = (moderngl.LINEAR, moderngl.LINEAR)
    depth.repeat_x = depth.repeat_y = False
    light = _texture(context, (size, size), 1, "f2", moderngl.LINEAR)
    soft = _texture(context, (min(size, SOFT_SIZE),) * 2, 1, "f2", moderngl.LINEAR)
    return LightTargets(
        size,
        context.framebuffer([], depth),
        depth,
        context.framebuffer([light]),
        light,
        context.framebuffer([soft]),
        soft,
    )


def _texture(context: moderngl.Context, size: Size, parts: int, kind: str, smooth: int) -> moderngl.Texture:
    texture = context.texture(size, parts, dtype=kind)
    texture.filter = (smooth, smooth)
    texture.repeat_x = texture.repeat_y = False
    return texture
