"""The view beside the head: its texture space, with the tool that is in the hand."""

from __future__ import annotations

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ...head.mesh import Floats
from ...head.scalp_settings import GrayImage
from ...render.small_picture import SmallPicture
from .. import theme
from ..ui import Rect, Ui
from ..viewport import Viewport
from .face_places import FacePlaces, places_of
from .skin_canvas import Touch, as_points
from .skin_tool import SkinTool
from .texture_canvas import TextureCanvas
from .texture_picture import TexturePicture

LEFT, RIGHT, MIDDLE = 0, 1, 2
CLOSEST, FARTHEST = 30.0, 0.5  # edge of the unit square, in parts of the view
NOTCH = 1.15
MARGIN = 1.06
# Outermost furrows of a face on the chart [m].
FEATURES = np.array([[-0.085, -0.03], [0.085, -0.03], [0.0, 0.06], [0.0, -0.105]])


class TextureView:
    """Draws texture space and gives the mouse to the tool, or pans and zooms. shown: whether it is open."""

    label = "Texture space"
    help = "The face laid out flat, beside the head: every tool for wrinkles works there too (M)."

    def __init__(self, viewport: Viewport) -> None:
        self.shown = False
        self._viewport = viewport
        self._studio = viewport.studio
        self._picture = SmallPicture(viewport.renderer.context)
        self._drawn: tuple[object, imgui.ImTextureRef] | None = None
        self._source: tuple[FacePlaces, TexturePicture] | None = None
        self._triangles = False
        self._centre: Floats = np.array([0.5, 0.5])
        self._zoom = 1.0
        self._held: str | None = None

    def draw(self, ui: Ui, area: Rect) -> None:
        """All of it, in the current ImGui window."""
        drawing = imgui.get_window_draw_list()
        far = (area.x + area.width, area.y + area.height)
        drawing.add_rect_filled((area.x, area.y), far, theme.packed(theme.GROUND))
        faces = places_of(self._studio)
        if faces is None:
            imgui.set_cursor_screen_pos((area.x + ui.px(12), area.y + ui.px(12)))
            ui.muted("The face is being built.")
            return
        if self._source is None or self._source[0] is not faces:
            self._source = faces, TexturePicture(faces)
            self._frame(faces, area)
        imgui.set_cursor_screen_pos((area.x, area.y))
        imgui.set_next_item_allow_overlap()
        flags = imgui.ButtonFlags_
        buttons = flags.mouse_button_left.value | flags.mouse_button_right.value | flags.mouse_button_middle.value
        imgui.invisible_button("##texture", (area.width, area.height), buttons)
        ui.note("Texture")
        hovered, active = imgui.is_item_hovered(), imgui.is_item_active()
        canvas = self._take_mouse(faces, area, ui.scale, hovered=hovered, active=active)
        drawing.push_clip_rect((area.x, area.y), far, True)
        low, high = as_points(canvas.to_window(np.array([[0.0, 1.0], [1.0, 0.0]])))
        drawing.add_image(self._texture(faces), low, high)
        drawing.add_rect(low, high, theme.packed(theme.LINE))
        tool = self._viewport.tool
        if isinstance(tool, SkinTool):
            mouse = imgui.get_mouse_pos()
            tool.draw_on(canvas, drawing, Touch(mouse.x, mouse.y) if hovered else None)
        drawing.pop_clip_rect()
        self._draw_buttons(ui, area, faces)

    def canvas(self, faces: FacePlaces, area: Rect, scale: float = 1.0) -> TextureCanvas:
        """Texture space as it lies in ``area`` now."""
        return TextureCanvas(faces, area, self._centre, self._zoom * min(area.width, area.height), scale)

    def _draw_buttons(self, ui: Ui, area: Rect, faces: FacePlaces) -> None:
        imgui.set_cursor_screen_pos((area.x + ui.px(8), area.y + ui.px(8)))
        imgui.push_style_color(imgui.Col_.button.value, theme.rgba(theme.GROUND, 0.55))
        with ui.within(self.label):
            if ui.button("Triangles", "Show the triangles of the skin.", on=self._triangles):
                self._triangles = not self._triangles
            imgui.same_line(0, ui.px(2))
            if ui.button(
                "Frame", "See eyes, nose and mouth as large as there is room.", icon=icons.ICON_FA_EXPAND, text=""
            ):
                self._frame(faces, area)
        imgui.pop_style_color()

    def _frame(self, faces: FacePlaces, area: Rect) -> None:
        """See the features of the face, which are a part of what is mapped."""
        places, reached = faces.of_chart(FEATURES)
        uv = faces.uv(places)[reached]
        low, high = uv.min(axis=0), uv.max(axis=0)
        self._centre = 0.5 * (low + high)
        across, up = np.maximum(high - low, 1e-6) * MARGIN
        self._zoom = min(area.width / across, area.height / up) / min(area.width, area.height)

    def _take_mouse(self, faces: FacePlaces, area: Rect, scale: float, *, hovered: bool, active: bool) -> TextureCanvas:
        """Pan, zoom or lead the tool; returns the canvas as it is after that."""
        io = imgui.get_io()
        side = min(area.width, area.height)
        canvas = self.canvas(faces, area, scale)
        x, y = io.mouse_pos.x, io.mouse_pos.y
        if hovered and io.mouse_wheel:
            fixed = canvas.to_uv(x, y)
            closer = float(np.clip(self._zoom * NOTCH**io.mouse_wheel, FARTHEST, CLOSEST)) / self._zoom
            # What is under the mouse stays there.
            self._centre, self._zoom = fixed + (self._centre - fixed) / closer, closer * self._zoom
        if self._held is None and hovered:
            self._begin(canvas, io)
        elif self._held is not None and not active:
            self._end()
        tool = self._viewport.tool
        if self._held == "tool" and isinstance(tool, SkinTool):
            tool.drag_on(canvas, Touch(x, y, io.key_ctrl, io.key_shift))
        elif self._held == "pan":
            self._centre = self._centre - np.array([io.mouse_delta.x, -io.mouse_delta.y]) / (self._zoom * side)
        return self.canvas(faces, area, scale)

    def _begin(self, canvas: TextureCanvas, io: imgui.IO) -> None:
        tool = self._viewport.tool
        if imgui.is_mouse_clicked(LEFT):
            touch = Touch(io.mouse_pos.x, io.mouse_pos.y, io.key_ctrl, io.key_shift)
            own_keys = io.key_alt or (io.key_shift and not tool.takes_shift)
            if isinstance(tool, SkinTool) and not own_keys and tool.press_on(canvas, touch):
                self._held = "tool"
                return
        if any(imgui.is_mouse_clicked(button) for button in (LEFT, RIGHT, MIDDLE)):
            self._held = "pan"

    def _end(self) -> None:
        if self._held == "tool":
            self._viewport.tool.release()
        self._held = None

    def _texture(self, faces: FacePlaces) -> imgui.ImTextureRef:
        """The picture behind, drawn again when what it shows has changed."""
        grown = self._studio.grown
        skin = grown.animation.skin if grown is not None else None
        fine = skin.surface.fine if skin is not None else None
        tool = self._viewport.tool
        painted: GrayImage | None = tool.painted_image(faces) if isinstance(tool, SkinTool) else None
        wanted = (faces, fine, painted, self._triangles)
        if self._drawn is None or self._drawn[0] != wanted:
            assert self._source is not None
            pixels = self._source[1].draw(fine, painted, triangles=self._triangles)
            self._drawn = wanted, imgui.ImTextureRef(self._picture.show(pixels))
        return self._drawn[1]
