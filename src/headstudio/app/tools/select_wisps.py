"""Choose wisps for an operation or a cut: with a lasso, or with a brush."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from ...head.mesh import Floats
from ...head.scalp_settings import GrayImage
from ...scene.animation import Animation
from ...scene.document import Document
from ...scene.stage import Stage
from ...wisp.selection import Selection
from ..painted_maps import PaintedMap
from ..studio import Studio
from ..styling_items import selection_of
from .freehand import Freehand, draw_line, evenly
from .paint_map import PaintMap
from .tool import Canvas, Pointer

_MOST = 48  # corners of a lasso
_MASK = 64  # texels of a painted selection along each side
_MARK = np.array([1.0, 0.3, 0.04, 0.95])  # linear colour of the roots of chosen wisps
_MARK_SIZE, _LIFT = 0.0016, 0.003  # of a mark from its middle to its corners, and off the skin [m]
_NOTHING_CHOSEN = "Choose an operation or a cut in the lists on the right first."


class SelectedRoots:
    """Marks the roots of the wisps that the chosen item is for."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self._dressed: tuple[Any, Stage] | None = None

    def dress(self, stage: Stage) -> Stage:
        """The stage with the marks; the same object as long as nothing changes."""
        item, grown = chosen_item(self.studio), self.studio.grown
        selection = selection_of(item)
        if selection is None or grown is None or grown.animation.hairdo is None:
            return stage
        hairdo = grown.animation.hairdo
        if self._dressed is None or self._dressed[0] != (stage, selection, hairdo):
            uv = grown.animation.scalp.locate(hairdo.outlines.roots)
            uv = uv[selection.of(uv)]
            scales = _scales(grown.animation.scalp.points(uv), grown.animation.scalp.normals(uv))
            corners = stage.frame.to_world(scales.reshape(-1, 3)).reshape(-1, 3, 3)
            marks = replace(
                stage.overlays,
                triangles=np.concatenate([stage.overlays.triangles, corners]),
                triangle_colours=np.concatenate(
                    [stage.overlays.triangle_colours, np.tile(_MARK, (len(corners), 3, 1))]
                ),
            )
            self._dressed = (stage, selection, hairdo), replace(stage, overlays=marks)
        return self._dressed[1]


def _scales(places: Floats, normals: Floats) -> Floats:
    """Small squares that lie on the skin at ``places`` [m], as triangles: (2 k, 3, 3). Both are (k, 3)."""
    across = np.cross(normals, [0.0, 1.0, 0.0]) + 1e-6
    across *= _MARK_SIZE / np.linalg.norm(across, axis=1, keepdims=True)
    along = np.cross(normals, across)
    middle = places + _LIFT * normals
    right, up, left, down = middle + across, middle + along, middle - across, middle - along
    return np.concatenate([np.stack([right, up, left], axis=1), np.stack([right, left, down], axis=1)])


class Lasso(Freehand):
    """A loop around wisps, as they are seen, chooses them."""

    label = "Lasso"
    icon = icons.ICON_FA_DRAW_POLYGON
    help = "Draw a loop around roots of hair: the chosen operation or cut is for these. Shift adds to what is chosen."
    takes_shift = True

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._roots = SelectedRoots(studio)

    def begins(self, pointer: Pointer) -> bool:
        """Anywhere, once there is something to choose wisps for."""
        if selection_of(chosen_item(self.studio)) is not None:
            self._adds = pointer.shift
            return True
        self.studio.messages.say(_NOTHING_CHOSEN, "warning")
        return False

    def finish(self, line: Floats, pointer: Pointer, animation: Animation) -> None:
        """The loop as a polygon on the scalp square."""
        if len(line) < 3:
            return
        uv = animation.scalp.locate(evenly(line, 0.004, _MOST))
        polygon = tuple((float(u), float(v)) for u, v in uv)
        before = selection_of(chosen_item(self.studio))
        kept = before.lasso if before is not None and self._adds else ()
        put_selection(self.studio, Selection(lasso=(*kept, polygon)), "Lasso")

    def dress(self, stage: Stage) -> Stage:
        """The roots of the chosen wisps."""
        return self._roots.dress(stage)

    def draw(self, canvas: Canvas) -> None:
        """The loop so far."""
        if len(self._line) >= 2:
            draw_line(canvas, np.array(self._line), closed=True)


class PaintSelection(PaintMap):
    """A brush that paints which wisps the chosen operation or cut is for."""

    def __init__(self, studio: Studio) -> None:
        def of(document: Document) -> Selection | None:
            return selection_of(studio.chosen.of(document)) if studio.chosen else None

        def read(document: Document) -> GrayImage:
            selection = of(document)
            mask = selection.mask if selection else None
            return mask or GrayImage(np.zeros((_MASK, _MASK), dtype=np.float32))

        def write(document: Document, image: GrayImage | None) -> Document:
            item = studio.chosen.of(document) if studio.chosen else None
            if studio.chosen is None or item is None or selection_of(item) is None:
                return document
            return studio.chosen.put(document, replace(item, selection=Selection(mask=image)))

        super().__init__(
            studio,
            PaintedMap(
                "Select",
                icons.ICON_FA_HIGHLIGHTER,
                "Paint which wisps the chosen operation or cut is for: those that are half bright.",
                read,
                write,
                lambda document: bool((selection := of(document)) and selection.mask),
            ),
        )
        self._roots = SelectedRoots(studio)

    def press(self, pointer: Pointer) -> bool:
        """Begin a stroke, once there is something to choose wisps for."""
        if selection_of(chosen_item(self.studio)) is None:
            if pointer.hit is not None:
                self.studio.messages.say(_NOTHING_CHOSEN, "warning")
            return False
        return super().press(pointer)

    def dress(self, stage: Stage) -> Stage:
        """The painted map and the roots of the chosen wisps."""
        return self._roots.dress(super().dress(stage))


def chosen_item(studio: Studio) -> Any:
    """The item of the styling that the user is at work on, or None."""
    return studio.chosen.of(studio.document) if studio.chosen else None


def put_selection(studio: Studio, selection: Selection, label: str) -> None:
    """Make the chosen item one for ``selection``."""
    item = chosen_item(studio)
    if studio.chosen is not None and item is not None and selection_of(item) is not None:
        studio.work.change(studio.chosen.put(studio.document, replace(item, selection=selection)), label)
