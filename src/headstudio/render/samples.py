"""Several samples a pixel (MSAA): what is drawn covers a part of a pixel at its edges, and hides a part of it.

Light is worked out once for a pixel of the skin. Its triangles are then drawn again into a canvas of many samples, and
with them everything else: eyes, accessories and hair.
"""

from __future__ import annotations

import moderngl

from ..scene.settings import Look
from .targets import Size

_ON_A_CARD = 4


def samples_of(context: moderngl.Context, look: Look) -> int:
    """How many samples a pixel has: as many as the look asks for and the driver offers; by itself 4 where a graphics card
    draws, and 1 where the processor does, which takes every sample for itself.
    """
    if look.samples == "auto":
        wanted = 1 if "llvmpipe" in str(context.info["GL_RENDERER"]).lower() else _ON_A_CARD
    else:
        wanted = int(look.samples)
    while wanted > max(context.max_samples, 1):
        wanted //= 2
    return wanted


class SampledCanvas:
    """A framebuffer with so many samples a pixel, in linear colour (half floats, premultiplied alpha)."""

    def __init__(self, context: moderngl.Context, size: Size, samples: int) -> None:
        self.size = size
        self.samples = samples
        colour = context.renderbuffer(size, 4, samples=samples, dtype="f2")
        self.framebuffer = context.framebuffer([colour], context.depth_renderbuffer(size, samples=samples))
