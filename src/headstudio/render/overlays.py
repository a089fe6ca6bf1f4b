"""Triangles, lines and points on top of the picture, one draw call each."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from ..scene.stage import Overlays
from .context import load_program

_SURFACE = moderngl.BLEND | moderngl.CULL_FACE | moderngl.DEPTH_TEST


class OverlayPass:
    """Draws ``Overlays``: sent when they are another object than before, seen dimly through what covers them."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._program = load_program(context, "overlay/mark.vert", "overlay/mark.frag")
        self._sent: Overlays | None = None
        self._arrays: list[tuple[int, moderngl.VertexArray]] = []

    def draw(self, overlays: Overlays) -> None:
        """All triangles, then all segments, then all points, into the framebuffer in use."""
        if overlays is not self._sent:
            self._send(overlays)
        self._context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        for mode, array in self._arrays:
            # A surface lies on the skin and is hidden by ears; marks are to be seen through everything.
            flags = _SURFACE if mode == moderngl.TRIANGLES else moderngl.NOTHING
            self._context.enable(flags)
            array.render(mode)
            self._context.disable(flags)

    def _send(self, overlays: Overlays) -> None:
        corners, corner_colours = overlays.triangles.reshape(-1, 3), overlays.triangle_colours.reshape(-1, 4)
        ends = overlays.segments.reshape(-1, 3)
        end_colours = _opaque(np.repeat(overlays.segment_colours, 2, axis=0))
        self._arrays = [
            (mode, self._array(places, colours))
            for mode, places, colours in (
                (moderngl.TRIANGLES, corners, corner_colours),
                (moderngl.LINES, ends, end_colours),
                (moderngl.POINTS, overlays.points, _opaque(overlays.point_colours)),
            )
            if len(places)
        ]
        self._sent = overlays

    def _array(self, places: Floats, colours: Floats) -> moderngl.VertexArray:
        marks = np.concatenate([places, colours], axis=1).astype(np.float32)
        content = [(self._context.buffer(marks.tobytes()), "3f 4f", "position", "mark_colour")]
        return self._context.vertex_array(self._program, content)


def _opaque(colours: Floats) -> Floats:
    return np.column_stack([colours, np.ones(len(colours))])
