"""Asking shaders what light arrives at many places at once: a texel of a texture for every place."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from .screen import ScreenPasses

_ROW = 512


def receive(
    context: moderngl.Context, screens: ScreenPasses, name: str, places: Floats, outputs: int, **uniforms: object
) -> Floats:
    """What the fragment shader ``name`` says at ``places`` [m], (n, 3), in so many outputs: (n, outputs, 4).

    The shader reads the place from ``receivers``, which is texture 0.
    """
    rows = max(-(-len(places) // _ROW), 1)
    padded = np.zeros((rows * _ROW, 3), np.float32)
    padded[: len(places)] = places
    asking = context.texture((_ROW, rows), 3, padded, dtype="f4")
    answers = [context.texture((_ROW, rows), 4, dtype="f4") for _ in range(outputs)]
    target = context.framebuffer(answers)
    with context.scope(target, moderngl.NOTHING):
        asking.use(0)
        screens.draw(name, receivers=0, **uniforms)
    read = np.stack([np.frombuffer(answer.read(), np.float32).reshape(-1, 4) for answer in answers], axis=1)
    return read[: len(places)].astype(np.float64)
