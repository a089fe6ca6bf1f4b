"""Move the places of operations, strokes, cuts and accessories by handles in the view."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from ...head.mesh import Floats
from ...scene.stage import Stage
from ...wisp.proportions import Proportions
from .. import navigation, theme
from ..studio import Studio
from ..styling_items import LISTS, Chosen, Handle, handles_of, moved
from .freehand import draw_line, in_view_plane
from .select_wisps import SelectedRoots
from .tool import Canvas, Pointer, Tool

_GRAB = 11.0
_FARTHEST = 15.0  # a place, in proportions of the head
_FAINT = 0.4


class Adjust(Tool):
    """Handles at every place of everything in the lists; around those of the chosen item how far it acts."""

    label = "Adjust"
    icon = icons.ICON_FA_UP_DOWN_LEFT_RIGHT
    help = "Drag the handles of operations, strokes, cuts and accessories; with Ctrl along the skin."

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._held: tuple[Chosen, Handle] | None = None
        self._roots = SelectedRoots(studio)

    def press(self, pointer: Pointer) -> bool:
        """Take the handle under the mouse; of two at one place that of the chosen item."""
        proportions = self._proportions
        if proportions is None:
            return False
        best: tuple[float, Chosen, Handle] | None = None
        for chosen, _, handle in self._handles():
            place = proportions.place(np.array(handle.place))[None]
            x, y = pointer.view.project(pointer.frame.to_world(place))[0]
            gap = float(np.hypot(x - pointer.x, y - pointer.y)) - 2.0 * (chosen == self.studio.chosen)
            if gap < _GRAB and (best is None or gap < best[0]):
                best = gap, chosen, handle
        if best is None:
            return False
        _, self.studio.chosen, handle = best
        self._held = self.studio.chosen, handle
        self.studio.work.begin_gesture("Move a handle")
        return True

    def drag(self, pointer: Pointer) -> None:
        """The handle follows the mouse, as deep as it was, or on the skin with Ctrl."""
        proportions = self._proportions
        if self._held is None or proportions is None:
            return
        chosen, handle = self._held
        item = chosen.of(self.studio.document)
        if item is None:
            return
        if pointer.ctrl and pointer.hit is not None:
            place = pointer.hit.point
        else:
            place = in_view_plane(pointer, proportions.place(np.array(handle.place)))
        x, y, z = (float(part) for part in np.clip(proportions.measure(place), -_FARTHEST, _FARTHEST))
        with self.studio.reporting():
            document = chosen.put(self.studio.document, moved(item, handle.trail, (x, y, z)))
            self.studio.work.change(document, "Move a handle")

    def release(self) -> None:
        """The handle stays where it is."""
        self._held = None
        self.studio.work.end_gesture()

    def dress(self, stage: Stage) -> Stage:
        """The roots of the wisps that the chosen item is for."""
        return self._roots.dress(stage)

    def draw(self, canvas: Canvas) -> None:
        """Paths, handles, and how far they act."""
        proportions = self._proportions
        if proportions is None:
            return
        paths: dict[tuple[Any, ...], list[Floats]] = {}
        for chosen, _, handle in self._handles():
            place = proportions.place(np.array(handle.place))
            on = chosen == self.studio.chosen
            if len(handle.trail) > 1 and isinstance(handle.trail[-1], int):
                paths.setdefault((on, chosen, handle.trail[:-1]), []).append(place)
            self._draw_handle(canvas, place, handle.size, on=on)
        for (on, *_), line in paths.items():
            if len(line) > 1:
                draw_line(canvas, np.array(line), 1.0 if on else _FAINT)

    def _draw_handle(self, canvas: Canvas, place: Floats, size: float, *, on: bool) -> None:
        ((x, y),) = np.array(canvas.on_screen(place[None]))
        strength = 1.0 if on else _FAINT
        drawing = canvas.drawing
        if on and size > 0:
            right = canvas.frame.rotation.inv().apply(navigation.axes(canvas.view.camera)[0])
            ((rim, _),) = np.array(canvas.on_screen((place + size * right)[None]))
            drawing.add_circle_filled((x, y), abs(rim - x), theme.packed(theme.ACCENT, 0.18), 48)
            drawing.add_circle((x, y), abs(rim - x), theme.packed(theme.ACCENT, 0.8), 48, 1.2 * canvas.scale)
        drawing.add_circle_filled((x, y), 7.0 * canvas.scale, theme.packed(theme.GROUND, strength))
        drawing.add_circle_filled((x, y), 5.5 * canvas.scale, theme.packed(theme.INK, strength))
        if on:
            drawing.add_circle_filled((x, y), 4.0 * canvas.scale, theme.packed(theme.ACCENT))

    def _handles(self) -> Iterator[tuple[Chosen, Any, Handle]]:
        """Every handle of everything, with the item that it belongs to."""
        for field in LISTS:
            for k, item in enumerate(getattr(self.studio.document.styling, field)):
                for handle in handles_of(item):
                    yield Chosen(field, k), item, handle

    @property
    def _proportions(self) -> Proportions | None:
        return Proportions.of(self.studio.grown.animation.head.landmarks) if self.studio.grown else None
