"""Paint a map on the scalp."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from ...head.length_maps import sample
from ...head.mesh import Floats
from ...head.scalp import Scalp
from ...head.scalp_settings import GrayImage
from ...scene.stage import Stage
from ...wisp.follicles import tiles_of
from ...wisp.proportions import Proportions
from ..brush import BrushStroke, Sheet
from ..brush_rim import draw_rim, rim_points
from ..map_colours import map_colours
from ..painted_maps import PaintedMap
from ..parameter_widgets import edit_item
from ..studio import Studio
from ..ui import Ui
from .tool import Canvas, Pointer, Tool

_LIFT = 0.002  # of the coloured map off the skin [m]
_OPACITY = 0.6
_SIZE = 256, 256  # texels of a map that is made from nothing


def painter(painted: PaintedMap) -> Callable[[Studio], PaintMap]:
    """What makes the tool that paints this map."""
    return lambda studio: PaintMap(studio, painted)


class PaintMap(Tool):
    """A brush on the scalp. Beside the scalp a press is for the camera."""

    takes_shift = True

    def __init__(self, studio: Studio, painted: PaintedMap) -> None:
        super().__init__(studio)
        self.painted = painted
        self.label, self.icon = painted.label, painted.icon
        self.help = f"{painted.help} Ctrl takes away, Shift smooths."
        self._stroke: BrushStroke | None = None
        self._sheet: tuple[object, Sheet] | None = None
        self._dressed: tuple[object, Stage] | None = None

    def press(self, pointer: Pointer) -> bool:
        """Begin a stroke, if the brush touches the scalp."""
        scalp = self._scalp
        if scalp is None or pointer.hit is None:
            return False
        place = pointer.hit.point[None]
        if np.linalg.norm(scalp.points(scalp.locate(place)) - place) > self.studio.brush.radius:
            return False
        action = "smooth" if pointer.shift else "lower" if pointer.ctrl else "raise"
        before = self.painted.read(self.studio.document).pixels.astype(np.float64)
        self._stroke = BrushStroke(self.studio.brush, self._sheet_for(scalp, before.shape), before, action)
        self.studio.work.begin_gesture(self._name)
        self.drag(pointer)
        return True

    def drag(self, pointer: Pointer) -> None:
        """Paint on to where the mouse is."""
        if self._stroke is None or pointer.hit is None:
            return
        self._stroke.move(pointer.hit.point)
        self._put(GrayImage(self._stroke.result.astype(np.float32)), self._name)

    def release(self) -> None:
        """The stroke is done."""
        self._stroke = None
        self.studio.work.end_gesture()

    def options(self, ui: Ui) -> None:
        """The brush, and what is done to the whole map."""
        self.studio.brush, _ = edit_item(ui, self.studio.brush)
        width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        for label, value in (("Fill", 1.0), ("Clear", 0.0)):
            if ui.button(label, f"Make the whole map {'bright' if value else 'dark'}.", width=width):
                self._put(GrayImage(np.full(_SIZE, value, dtype=np.float32)), f"{label} {self._name.lower()}")
            imgui.same_line()
        imgui.new_line()
        painted = self.painted.is_painted(self.studio.document)
        if ui.button("Forget", "Take the painted map away.", text="Forget what is painted", enabled=painted, width=-1):
            self._put(None, f"Forget {self._name.lower()}")

    def dress(self, stage: Stage) -> Stage:
        """The map in colours on the scalp."""
        scalp = self._scalp
        if scalp is None:
            return stage
        image = self.painted.read(self.studio.document)
        if self._dressed is None or self._dressed[0] != (stage, image, scalp):
            tiles = tiles_of(scalp)
            vertices = tiles.vertices + _LIFT * scalp.normals(tiles.uv)
            values = sample(image, tiles.uv)
            colours = np.column_stack([map_colours(values), np.full(len(values), _OPACITY)])
            overlays = replace(
                stage.overlays,
                triangles=stage.frame.to_world(vertices)[tiles.corners],
                triangle_colours=colours[tiles.corners],
            )
            self._dressed = (stage, image, scalp), replace(stage, overlays=overlays)
        return self._dressed[1]

    def draw(self, canvas: Canvas) -> None:
        """The rim of the brush on the skin, and that of its mirror image."""
        stage = self.studio.stage
        if stage is None or not imgui.is_item_hovered():
            return
        mouse = imgui.get_mouse_pos()
        pointer = Pointer(mouse.x - canvas.x, mouse.y - canvas.y, canvas.view, stage.head, canvas.frame)
        if pointer.hit is None:
            return
        place, normal = pointer.hit.point, stage.head.skin.face_normals[pointer.hit.face]
        self._draw_rim(canvas, place, normal, 1.0)
        if self.studio.brush.mirror:
            middle = Proportions.of(stage.head.landmarks).centre[0]
            flipped = np.array([-1.0, 1.0, 1.0])
            self._draw_rim(canvas, flipped * (place - [middle, 0, 0]) + [middle, 0, 0], flipped * normal, 0.35)

    def _draw_rim(self, canvas: Canvas, place: Floats, normal: Floats, strength: float) -> None:
        shown = canvas.on_screen(rim_points(place, normal, self.studio.brush.radius))
        draw_rim(canvas.drawing, shown, strength, canvas.scale)

    def _put(self, image: GrayImage | None, label: str) -> None:
        self.studio.work.change(self.painted.write(self.studio.document, image), label)

    @property
    def _name(self) -> str:
        return f"{self.painted.label} map"

    @property
    def _scalp(self) -> Scalp | None:
        return self.studio.grown.animation.scalp if self.studio.grown else None

    def _sheet_for(self, scalp: Scalp, shape: tuple[int, ...]) -> Sheet:
        """Where the texels lie, worked out once for each scalp."""
        if self._sheet is None or self._sheet[0] != (scalp, shape):
            v, u = ((np.arange(count) + 0.5) / count for count in shape)
            uv = np.stack(np.meshgrid(u, v), axis=-1)
            places = scalp.points(uv.reshape(-1, 2)).reshape(*shape, 3)
            assert self.studio.grown is not None
            middle = float(Proportions.of(self.studio.grown.animation.head.landmarks).centre[0])
            self._sheet = (scalp, shape), Sheet(places, middle)
        return self._sheet[1]
