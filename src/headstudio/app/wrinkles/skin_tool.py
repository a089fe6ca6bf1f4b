"""A tool that works on the living face, on the head and in its texture space alike."""

from __future__ import annotations

from imgui_bundle import imgui

from ...head.mesh import Floats
from ...head.scalp_settings import GrayImage
from ..studio import Studio
from ..tools.tool import Canvas, Pointer, Tool
from .face_places import FacePlaces, places_of
from .skin_canvas import HeadCanvas, SkinCanvas, Touch


class SkinTool(Tool):
    """What it does is said once, by the methods that end in "_on"; here the viewport's own are led to them."""

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._scale = 1.0

    def press_on(self, canvas: SkinCanvas, touch: Touch) -> bool:
        """The left button went down on ``canvas``; True when the tool wants what follows."""
        return False

    def drag_on(self, canvas: SkinCanvas, touch: Touch) -> None:
        """The mouse is moved with the button down."""

    def draw_on(self, canvas: SkinCanvas, drawing: imgui.ImDrawList, touch: Touch | None) -> None:
        """Draw what can be touched; ``touch``: the mouse, if it is over this canvas."""

    def painted_image(self, faces: FacePlaces) -> GrayImage | None:
        """The map that the tool paints, for texture space to show; None for a tool that paints none."""
        return None

    def press(self, pointer: Pointer) -> bool:
        """On the head; without a living face every press is for the camera."""
        canvas = self._head_canvas(pointer)
        return canvas is not None and self.press_on(canvas, _touch(pointer))

    def drag(self, pointer: Pointer) -> None:
        """On the head."""
        canvas = self._head_canvas(pointer)
        if canvas is not None:
            self.drag_on(canvas, _touch(pointer))

    def draw(self, canvas: Canvas) -> None:
        """On the head."""
        faces, positions = places_of(self.studio), self._posed()
        if faces is None or positions is None:
            return
        self._scale, corner = canvas.scale, (canvas.x, canvas.y)
        head = HeadCanvas(faces, canvas.view, canvas.frame, positions, corner, canvas.scale)
        mouse = imgui.get_mouse_pos()
        self.draw_on(head, canvas.drawing, Touch(mouse.x, mouse.y) if imgui.is_item_hovered() else None)

    def _head_canvas(self, pointer: Pointer) -> HeadCanvas | None:
        faces, positions = places_of(self.studio), self._posed()
        if faces is None or positions is None:
            return None
        return HeadCanvas(faces, pointer.view, pointer.frame, positions, scale=self._scale)

    def _posed(self) -> Floats | None:
        """Every vertex of the head's own skin as it is now [m], (n, 3); None while no face lives."""
        stage = self.studio.stage
        return stage.skin.posed if stage is not None and stage.skin is not None else None


def _touch(pointer: Pointer) -> Touch:
    return Touch(pointer.x, pointer.y, pointer.ctrl, pointer.shift)
