"""The border between skin without its wrinkles and skin with them: a line over the viewport, to be dragged."""

from __future__ import annotations

from imgui_bundle import imgui

from . import theme
from .parameter_rows import ParameterRows
from .ui import Rect, Ui

WIDTH, KNOB, LOW = 14.0, 7.0, 84.0  # of what takes the mouse, of the knob, and how far the knob is above the lower edge


def draw(ui: Ui, rows: ParameterRows, area: Rect) -> None:
    """Draw it over ``area``, the picture; nothing while all of it has its wrinkles."""
    split = rows.studio.document.look.split
    if split <= 0:
        return
    x, low = area.x + split * area.width, area.y + area.height
    knob = (x, low - ui.px(LOW))
    imgui.set_cursor_screen_pos((x - ui.px(WIDTH / 2), knob[1] - ui.px(WIDTH)))
    imgui.invisible_button("##split", (ui.px(WIDTH), ui.px(2 * WIDTH)))
    ui.note("Split line")
    held = imgui.is_item_active()
    if held or imgui.is_item_hovered():
        imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew.value)
    if held and imgui.get_io().mouse_delta.x:
        rows.set("look.split", min(max((imgui.get_io().mouse_pos.x - area.x) / area.width, 0.0), 1.0))
    drawing, colour = imgui.get_window_draw_list(), theme.ACCENT if held else theme.INK
    for shade, width in ((theme.packed(theme.GROUND, 0.6), 3.0), (theme.packed(colour, 0.8), 1.2)):
        drawing.add_line((x, area.y), (x, low), shade, ui.px(width))
    drawing.add_circle_filled(knob, ui.px(KNOB), theme.packed(theme.GROUND))
    drawing.add_circle_filled(knob, ui.px(KNOB - 2), theme.packed(colour))
    height, gap = low - ui.px(LOW) - imgui.get_text_line_height() / 2, ui.px(WIDTH)
    without = "without wrinkles"
    drawing.add_text((x - gap - imgui.calc_text_size(without).x, height), theme.packed(theme.INK), without)
    drawing.add_text((x + gap, height), theme.packed(theme.INK), "with")
