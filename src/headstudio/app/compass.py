"""A compass for the wind: the head from above, and an arrow that the mouse turns."""

from __future__ import annotations

import math

from imgui_bundle import imgui

from . import theme
from .ui import Ui

RADIUS = 44.0


def draw(ui: Ui, heading: float, strength: float, *, on: bool) -> float | None:
    """Draw the compass; returns the new heading [rad] while it is dragged, else None.

    The nose points down, as when the head is seen from the front: the person's left is on the right. ``strength``: 0
    to 1, the length of the arrow.
    """
    radius = ui.px(RADIUS)
    corner = imgui.get_cursor_screen_pos()
    x, y = corner.x + radius, corner.y + radius
    imgui.invisible_button("##compass", (2 * radius, 2 * radius))
    ui.note("Compass")
    ui.hint("Where the wind blows to: drag. Hold Ctrl for steps of 15 degrees.")
    turned = None
    if imgui.is_item_active():
        mouse = imgui.get_mouse_pos()
        if math.hypot(mouse.x - x, mouse.y - y) > ui.px(4):
            turned = math.atan2(mouse.x - x, mouse.y - y)
            if imgui.get_io().key_ctrl:
                turned = math.radians(15 * round(math.degrees(turned) / 15))
            heading = turned
    _draw_head(ui, x, y, radius)
    colour = theme.packed(theme.ACCENT if on else theme.FAINT)
    _draw_arrow(ui, x, y, radius * (0.35 + 0.6 * strength), heading, colour)
    return turned


def _draw_head(ui: Ui, x: float, y: float, radius: float) -> None:
    canvas = imgui.get_window_draw_list()
    ring = theme.packed(theme.HOVER if imgui.is_item_hovered() else theme.RAISED)
    canvas.add_circle_filled((x, y), radius, theme.packed(theme.GROUND), 64)
    canvas.add_circle((x, y), radius, ring, 64, ui.px(2))
    for k in range(12):
        angle = k * math.pi / 6
        inner, outer = radius * (0.82 if k % 3 == 0 else 0.89), radius * 0.94
        canvas.add_line(
            (x + inner * math.sin(angle), y + inner * math.cos(angle)),
            (x + outer * math.sin(angle), y + outer * math.cos(angle)),
            theme.packed(theme.FAINT),
            ui.px(1),
        )
    skull = theme.packed(theme.HOVER)
    canvas.add_ellipse_filled((x, y), (radius * 0.2, radius * 0.25), skull)
    canvas.add_triangle_filled(
        (x - radius * 0.07, y + radius * 0.22), (x, y + radius * 0.33), (x + radius * 0.07, y + radius * 0.22), skull
    )


def _draw_arrow(ui: Ui, x: float, y: float, length: float, heading: float, colour: int) -> None:
    canvas = imgui.get_window_draw_list()
    along, across = (math.sin(heading), math.cos(heading)), (math.cos(heading), -math.sin(heading))
    tip = (x + length * along[0], y + length * along[1])
    tail = (x - length * along[0], y - length * along[1])
    size = ui.px(9)
    neck = (tip[0] - size * along[0], tip[1] - size * along[1])
    canvas.add_line(tail, neck, colour, ui.px(2.5))
    canvas.add_triangle_filled(
        tip,
        (neck[0] + 0.6 * size * across[0], neck[1] + 0.6 * size * across[1]),
        (neck[0] - 0.6 * size * across[0], neck[1] - 0.6 * size * across[1]),
        colour,
    )
