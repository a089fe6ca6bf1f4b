"""What the colours on the skin mean: a bar in the corner of the viewport while they show a figure."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from ..render.skin_values import scale_colours, scale_ends
from . import theme
from .ui import Rect, Ui

WIDTH, HEIGHT = 200.0, 10.0
STEPS = 40


def draw(ui: Ui, shows: str, area: Rect) -> None:
    """Draw it in the lower right corner of ``area``; nothing while skin is shown as it is."""
    if shows == "skin":
        return
    width, height, line = ui.px(WIDTH), ui.px(HEIGHT), imgui.get_text_line_height()
    x, y = area.x + area.width - width - ui.px(22), area.y + area.height - height - line - ui.px(24)
    drawing, pad = imgui.get_window_draw_list(), ui.px(12)
    box = Rect(x - pad, y - pad - line, width + 2 * pad, height + 2 * line + 2 * pad)
    drawing.add_rect_filled(
        (box.x, box.y), (box.x + box.width, box.y + box.height), theme.packed(theme.PANEL, 0.85), ui.px(5)
    )
    ui.note("Scale", box)
    drawing.add_text((x, y - line - ui.px(3)), theme.packed(theme.MUTED), shows.capitalize())
    # The colours are linear light; the window shows them as the picture does.
    colours = np.clip(scale_colours(shows, STEPS), 0.0, 1.0) ** (1 / 2.2)
    for k, (red, green, blue) in enumerate(colours.tolist()):
        left, right = x + k * width / STEPS, x + (k + 1) * width / STEPS
        drawing.add_rect_filled((left, y), (right, y + height), theme.packed((red, green, blue)))
    for text, part in zip(scale_ends(shows), (0.0, 0.5, 1.0)):
        drawing.add_text(
            (x + part * (width - imgui.calc_text_size(text).x), y + height + ui.px(3)), theme.packed(theme.INK), text
        )
