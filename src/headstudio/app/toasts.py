"""Messages as they appear over the viewport, and the line at the foot of the window."""

from __future__ import annotations

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from . import theme
from .messages import Message, Messages
from .ui import Rect, Ui

LOOKS = {
    "info": (icons.ICON_FA_CIRCLE_INFO, theme.MUTED),
    "good": (icons.ICON_FA_CIRCLE_CHECK, theme.GOOD),
    "warning": (icons.ICON_FA_TRIANGLE_EXCLAMATION, theme.WARNING),
    "error": (icons.ICON_FA_CIRCLE_XMARK, theme.ERROR),
}
WIDTH = 460.0
MOST = 4


def draw(ui: Ui, messages: Messages, area: Rect) -> None:
    """Stack the newest messages up from the lower left corner of ``area``; a click takes one away."""
    bottom = area.y + area.height - ui.px(14)
    width = min(ui.px(WIDTH), area.width - ui.px(28))
    for message in reversed(messages.shown[-MOST:]):
        bottom -= _draw_one(ui, messages, message, area.x + ui.px(14), bottom, width) + ui.px(8)


def _draw_one(ui: Ui, messages: Messages, message: Message, x: float, bottom: float, width: float) -> float:
    """Draw one message with its lower edge at ``bottom``; returns its height."""
    icon, colour = LOOKS[message.kind]
    text = message.text + (f"  ({message.times} times)" if message.times > 1 else "")
    margin, indent = ui.px(11), ui.px(38)
    size = imgui.calc_text_size(text, wrap_width=width - indent - margin)
    height = size.y + 2 * margin
    width = min(width, size.x + indent + margin)
    y = bottom - height
    imgui.set_cursor_screen_pos((x, y))
    if imgui.invisible_button(f"##{id(message)}", (width, height)):
        messages.dismiss(message)
    with ui.within("Messages"):
        ui.note(message.text)
    strength = message.strength
    canvas = imgui.get_window_draw_list()
    corner = (x + width, y + height)
    canvas.add_rect_filled((x, y), corner, theme.packed(theme.PANEL, 0.94 * strength), ui.px(6))
    canvas.add_rect((x, y), corner, theme.packed(theme.LINE, strength), ui.px(6))
    canvas.add_rect_filled((x, y + ui.px(6)), (x + ui.px(3), corner[1] - ui.px(6)), theme.packed(colour, strength))
    font, font_size = imgui.get_font(), imgui.get_font_size()
    canvas.add_text((x + ui.px(14), y + margin), theme.packed(colour, strength), icon)
    canvas.add_text(
        font, font_size, (x + indent, y + margin), theme.packed(theme.INK, strength), text, width - indent - margin + 1
    )
    return height
