"""The buttons in the corner of the viewport: the sides to look from, and framing."""

from __future__ import annotations

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from . import theme
from .editors import SideView
from .ui import Rect, Ui
from .viewport import Viewport

SIDES = {"Front": "front", "Left": "left", "Right": "right", "Back": "back", "Top": "top"}


def draw(ui: Ui, viewport: Viewport, area: Rect, beside: SideView | None = None) -> None:
    """Draw them in the upper right corner of ``area``; in the left one what opens and closes the view ``beside``."""
    opener = _draw_opener(ui, beside, area) if beside is not None else 0.0
    style = imgui.get_style()
    labels = [*SIDES, icons.ICON_FA_USER, icons.ICON_FA_EXPAND]
    padding = 2 * style.frame_padding.x
    gap = ui.px(2)
    width = sum(imgui.calc_text_size(label).x + padding + gap for label in labels)
    if width + opener > area.width:
        return
    imgui.set_cursor_screen_pos((area.x + area.width - width - ui.px(8), area.y + ui.px(8)))
    imgui.push_style_color(imgui.Col_.button.value, theme.rgba(theme.GROUND, 0.35))
    with ui.within("Views"):
        for label, side in SIDES.items():
            if ui.button(label, f"Look at the {side} of the head."):
                viewport.look_from(side)
            imgui.same_line(0, gap)
        if ui.button("Frame head", "See the head alone, up close (H).", icon=icons.ICON_FA_USER, text=""):
            viewport.frame_head()
        imgui.same_line(0, gap)
        if ui.button("Frame", "See all of head and hair (F).", icon=icons.ICON_FA_EXPAND, text=""):
            viewport.frame_all()
    imgui.pop_style_color()


def _draw_opener(ui: Ui, beside: SideView, area: Rect) -> float:
    """Returns how much of the width it takes."""
    imgui.set_cursor_screen_pos((area.x + ui.px(8), area.y + ui.px(8)))
    imgui.push_style_color(imgui.Col_.button.value, theme.rgba(theme.GROUND, 0.35))
    with ui.within("Views"):
        if ui.button(beside.label, beside.help, icon=icons.ICON_FA_TABLE_COLUMNS, on=beside.shown):
            beside.shown = not beside.shown
    imgui.pop_style_color()
    return float(imgui.get_item_rect_max().x) - area.x + ui.px(8)
