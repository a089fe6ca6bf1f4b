"""The keyframes of a performance over time: set, taken away and moved beside the playhead."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from imgui_bundle import ImVec2Like, imgui
from imgui_bundle import icons_fontawesome_6 as icons

from ...wrinkle.performance import Performance, moved_key, without_key
from .. import theme
from ..parameter_rows import ParameterRows
from ..ui import Rect, Ui

HEIGHT = 36.0
HIGHEST = 96.0
PLOTS = 110.0  # plots below need so much
GRAB = 8.0
LEAST_SPAN = 4.0  # seconds on show at least
ROOM = 1.15
TICKS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0)
TICK_WIDTH = 62.0


class Timeline:
    """A strip with a diamond for each keyframe. A click beside them moves the playhead of the face."""

    def __init__(self, rows: ParameterRows) -> None:
        self.rows = rows
        self._chosen: int | None = None
        self._held: str | None = None

    def draw(self, ui: Ui) -> None:
        """Buttons, and the strip below them."""
        with ui.within("Timeline"):
            self._draw_buttons(ui)
            self._draw_strip(ui)

    @property
    def chosen(self) -> int | None:
        """The number of the keyframe that was clicked last."""
        return self._chosen if self._chosen is not None and self._chosen < len(self._performance) else None

    @property
    def _performance(self) -> Performance:
        return self.rows.studio.document.face.performance

    def _draw_buttons(self, ui: Ui) -> None:
        studio = self.rows.studio
        help_ = "Keep the face as it is now as a keyframe at the playhead."
        if ui.button("Add key", help_, icon=icons.ICON_FA_PLUS):
            face = studio.document.face.with_key(studio.face_time)
            self.rows.change(replace(studio.document, face=face), "Add keyframe")
            times = np.array([key.time for key in face.performance])
            self._chosen = int(np.abs(times - studio.face_time).argmin())
        imgui.same_line()
        help_ = "Take the chosen keyframe away."
        chosen = self.chosen
        if ui.button("Delete key", help_, icon=icons.ICON_FA_TRASH_CAN, enabled=chosen is not None):
            assert chosen is not None
            self._chosen = None
            self._change(without_key(self._performance, chosen), "Delete keyframe")
        imgui.same_line()
        imgui.align_text_to_frame_padding()
        ui.muted(f"Face at {studio.face_time:.2f} s   {_told(self._performance)}")

    def _draw_strip(self, ui: Ui) -> None:
        studio, performance = self.rows.studio, self._performance
        corner = imgui.get_cursor_screen_pos()
        rect = Rect(corner.x, corner.y, max(imgui.get_content_region_avail().x, 1.0), self._strip_height(ui))
        imgui.invisible_button("##keys", (rect.width, rect.height))
        ui.note("Keys")
        ui.hint("Click or drag: go there. Drag a diamond: another time for this keyframe.")
        span = max(LEAST_SPAN, ROOM * max([key.time for key in performance] + [studio.face_time]))
        inset = ui.px(GRAB)
        rate = (rect.width - 2 * inset) / span

        def across(time: float) -> float:
            return rect.x + inset + rate * time

        mouse = imgui.get_io().mouse_pos.x
        if imgui.is_item_activated():
            away = [abs(across(key.time) - mouse) for key in performance]
            nearest = int(np.argmin(away)) if away else None
            on_key = nearest is not None and away[nearest] <= ui.px(GRAB)
            self._chosen, self._held = (nearest, "key") if on_key else (None, "playhead")
        if imgui.is_item_active():
            self._drag(max((mouse - rect.x - inset) / rate, 0.0))
        elif self._held is not None:
            self._held = None
        self._draw_ruler(ui, rect, span, across)
        self._draw_keys(ui, rect, across)

    def _strip_height(self, ui: Ui) -> float:
        """All the room that is too low for plots."""
        left = imgui.get_content_region_avail().y
        return ui.px(HEIGHT) if left > ui.px(HEIGHT + PLOTS) else float(np.clip(left, ui.px(HEIGHT), ui.px(HIGHEST)))

    def _drag(self, time: float) -> None:
        studio, number = self.rows.studio, self.chosen
        studio.playback.playing = False
        if self._held == "key" and number is not None:
            if imgui.is_mouse_dragging(0):
                self._change(moved_key(self._performance, number, time), "Move keyframe")
            time = self._performance[number].time
        studio.seek_face(time)

    def _change(self, performance: Performance, label: str) -> None:
        document = self.rows.studio.document
        self.rows.change(replace(document, face=replace(document.face, performance=performance)), label)

    def _draw_ruler(self, ui: Ui, rect: Rect, span: float, across: Callable[[float], float]) -> None:
        drawing = imgui.get_window_draw_list()
        far = (rect.x + rect.width, rect.y + rect.height)
        drawing.add_rect_filled((rect.x, rect.y), far, theme.packed(theme.GROUND), ui.px(4))
        most = max(rect.width / ui.px(TICK_WIDTH), 1.0)
        step = next((tick for tick in TICKS if span / tick <= most), TICKS[-1])
        for time in np.arange(0.0, span, step):
            x = across(float(time))
            drawing.add_line((x, rect.y + 0.62 * rect.height), (x, far[1]), theme.packed(theme.LINE), ui.px(1))
            text = (x + ui.px(3), far[1] - imgui.get_font_size())
            drawing.add_text(text, theme.packed(theme.FAINT), f"{time:g}")

    def _draw_keys(self, ui: Ui, rect: Rect, across: Callable[[float], float]) -> None:
        drawing = imgui.get_window_draw_list()
        x, middle, size = across(self.rows.studio.face_time), rect.y + 0.36 * rect.height, ui.px(6)
        drawing.add_line((x, rect.y), (x, rect.y + rect.height), theme.packed(theme.INK), ui.px(1.5))
        for number, key in enumerate(self._performance):
            x = across(key.time)
            diamond: list[ImVec2Like] = [(x - size, middle), (x, middle - size), (x + size, middle), (x, middle + size)]
            chosen = number == self.chosen
            drawing.add_convex_poly_filled(diamond, theme.packed(theme.ACCENT if chosen else theme.ACCENT_DEEP))
            if chosen:
                drawing.add_polyline(diamond, theme.packed(theme.INK), ui.px(1), imgui.ImDrawFlags_.closed.value)
            ui.note(f"Key {number + 1}", Rect(x - size, middle - size, 2 * size, 2 * size))


def _told(performance: Performance) -> str:
    if not performance:
        return "No keyframes: the sliders hold."
    return f"{len(performance)} keyframe{'s' if len(performance) > 1 else ''}: a slider sets one where the playhead is."
