"""Lines and points on top of the picture, one draw call each."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats
from ..scene.stage import Overlays
from .context import load_program


class OverlayPass:
    """Draws ``Overlays``: sent when they are another object than before, seen dimly through what covers them."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._program = load_program(context, "overlay/mark.vert", "overlay/mark.frag")
        self._sent: Overlays | None = None
        self._arrays: list[tuple[int, moderngl.VertexArray]] = []

    def draw(self, overlays: Overlays) -> None:
        """All segments, then all points, into the framebuffer in use."""
        if overlays is not self._sent:
            self._send(overlays)
        for mode, array in self._arrays:
            array.render(mode)

    def _send(self, overlays: Overlays) -> None:
        ends = overlays.segments.reshape(-1, 3)
        end_colours = np.repeat(overlays.segment_colours, 2, axis=0)
        self._arrays = [
            (mode, self._array(places, colours))
            for mode, places, colours in (
                (moderngl.LINES, ends, end_colours),
                (moderngl.POINTS, overlays.points, overlays.point_colours),
            )
            if len(places)
        ]
        self._sent = overlays

    def _array(self, places: Floats, colours: Floats) -> moderngl.VertexArray:
        marks = np.concatenate([places, colours], axis=1).astype(np.float32)
        content = [(self._context.buffer(marks.tobytes()), "3f 3f", "position", "mark_colour")]
        return self._context.vertex_array(self._program, content)
