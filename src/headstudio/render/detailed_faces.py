"""The triangles of a body on the graphics card, in as many levels of detail as were asked for."""

from __future__ import annotations

import moderngl
import numpy as np

from ..head.mesh import Floats, Ints
from .buffers import indices_of
from .detail import Surface, faces_of_level, level_of
from .view import View

# So many vertices tell how near a body is.
_PROBES = 500


class DetailedFaces:
    """An index buffer in which the levels of detail of one surface lie one behind the other, the whole surface first."""

    def __init__(self, context: moderngl.Context, surface: Surface, places: Ints | None = None) -> None:
        """places: where in the buffers each vertex of the surface is, (n,), if not in its own place."""
        self._surface = surface
        self._places = places
        self._levels = {-1: self._placed(surface.faces)}
        self.buffer = context.buffer(indices_of(self._levels[-1]))
        self._probes = surface.points[:: max(len(surface.points) // _PROBES, 1)]

    def render(self, array: moderngl.VertexArray, level: int) -> None:
        """Draw a vertex array that has this index buffer."""
        names = list(self._levels)
        first = sum(self._levels[name].size for name in names[: names.index(level)])
        array.render(vertices=self._levels[level].size, first=first)

    def level_for(self, view: View, shift: Floats, height: int) -> int:
        """The level of detail for the next picture, ``height`` pixels high, of the surface moved by ``shift`` [m], (3,)."""
        near = max(float(view.depth(self._probes + shift).min()), view.near)
        level = max(level_of(2 * near / (view.focal * height)), -1)
        if level not in self._levels:
            self._levels[level] = self._placed(faces_of_level(self._surface, level))
            self._send()
        return level

    def _placed(self, faces: Ints) -> Ints:
        return faces if self._places is None else self._places[faces]

    def _send(self) -> None:
        data = indices_of(np.concatenate(list(self._levels.values())))
        self.buffer.orphan(len(data))
        self.buffer.write(data)
