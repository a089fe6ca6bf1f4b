"""Tools that draw a line by hand, on the head or around it."""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2Like

from ...head.mesh import Floats
from ...scene.animation import Animation
from ...wisp.proportions import Proportions
from .. import navigation, theme
from ..studio import Studio
from .tool import Canvas, Pointer, Tool

_STEP = 3.0  # between two points of a line, in window units


class Freehand(Tool):
    """A line follows the mouse while the button is down; what becomes of it is up to the tool.

    lift: how far above the skin the line is drawn [m].
    """

    lift = 0.0

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._line: list[Floats] = []
        self._last: Pointer | None = None

    def press(self, pointer: Pointer) -> bool:
        """Begin a line, where the tool can draw."""
        if self._animation is None or not self.begins(pointer):
            return False
        self._line, self._last = [], None
        self.drag(pointer)
        return bool(self._line)

    def drag(self, pointer: Pointer) -> None:
        """Draw on to where the mouse is."""
        if self._last is not None and np.hypot(pointer.x - self._last.x, pointer.y - self._last.y) < _STEP:
            return
        place = self._place(pointer)
        if place is not None:
            self._line.append(place)
            self._last = pointer

    def release(self) -> None:
        """The line is drawn."""
        line, last = np.array(self._line), self._last
        self._line = []
        if last is not None and len(line) >= 2 and self._animation is not None:
            with self.studio.reporting():
                self.finish(line, last, self._animation)

    def begins(self, pointer: Pointer) -> bool:
        """Whether a line may begin there: on the skin, unless a tool says otherwise."""
        return pointer.hit is not None

    def finish(self, line: Floats, pointer: Pointer, animation: Animation) -> None:
        """Take the line, (n, 3) [m] in the head frame, n at least 2, that ends at ``pointer``. Errors become messages."""
        raise NotImplementedError

    def draw(self, canvas: Canvas) -> None:
        """The line so far."""
        if len(self._line) >= 2:
            draw_line(canvas, np.array(self._line))

    @property
    def _animation(self) -> Animation | None:
        return self.studio.grown.animation if self.studio.grown else None

    @property
    def proportions(self) -> Proportions:
        """Those of the head on show."""
        assert self._animation is not None
        return Proportions.of(self._animation.head.landmarks)

    def _place(self, pointer: Pointer) -> Floats | None:
        """Above the skin below the mouse; beside the head as deep as the line was, or as the head is."""
        if pointer.hit is not None and pointer.head is not None:
            return pointer.hit.point + self.lift * pointer.head.skin.face_normals[pointer.hit.face]
        depth = self._line[-1] if self._line else self.proportions.centre
        return in_view_plane(pointer, depth)


def in_view_plane(pointer: Pointer, through: Floats) -> Floats:
    """The point below the mouse on the plane through a point that faces the viewer, head frame [m], (3,) each."""
    ray = pointer.ray.to_head(pointer.frame)
    back = pointer.frame.rotation.inv().apply(navigation.axes(pointer.view.camera)[2])
    return ray.at(float((through - ray.origin) @ back / (ray.direction @ back)))


def evenly(line: Floats, spacing: float, most: int) -> Floats:
    """Points along a polyline, (n, d), about ``spacing`` apart, both ends among them: 2 to ``most``, none twice."""
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    count = int(np.clip(run[-1] / spacing, 1, most - 1)) + 1
    at = np.linspace(0.0, run[-1], count)
    return np.stack([np.interp(at, run, column) for column in line.T], axis=1)


def draw_line(canvas: Canvas, line: Floats, strength: float = 1.0, *, closed: bool = False) -> None:
    """A line in the head frame [m], (n, 3), over the picture."""
    shown: list[ImVec2Like] = canvas.on_screen(np.concatenate([line, line[:1]]) if closed else line)
    for colour, width in (
        (theme.packed(theme.GROUND, 0.7 * strength), 4.5),
        (theme.packed(theme.ACCENT, strength), 2.0),
    ):
        canvas.drawing.add_polyline(shown, colour, width * canvas.scale, 0)
