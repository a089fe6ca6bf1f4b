"""How the window is divided: menu, left side, viewport, right side, foot; and the edges between them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from imgui_bundle import imgui

from . import theme
from .commands import Command
from .ui import Rect, Ui

_FIXED = (
    imgui.WindowFlags_.no_decoration.value
    | imgui.WindowFlags_.no_move.value
    | imgui.WindowFlags_.no_saved_settings.value
    | imgui.WindowFlags_.no_bring_to_front_on_focus.value
    | imgui.WindowFlags_.no_nav_focus.value
)
_SCROLLING = _FIXED & ~imgui.WindowFlags_.no_scrollbar.value
EDGE = 5.0
STATUS = 26.0


@dataclass
class Sizes:
    """Widths and heights on a plain screen, which the user changes by dragging the edges."""

    left: float = 252.0
    right: float = 346.0
    foot: float = 196.0
    panels: bool = True


@dataclass(frozen=True)
class Layout:
    """Where everything is in this frame."""

    left: Rect
    view: Rect
    right: Rect
    foot: Rect
    status: Rect


def lay_out(ui: Ui, sizes: Sizes, top: float) -> Layout:
    """Divide the window below the menu bar, which ends at ``top``."""
    width, height = imgui.get_io().display_size
    status = ui.px(STATUS)
    bottom = height - status
    if not sizes.panels:
        whole = Rect(0, top, width, bottom - top)
        nothing = Rect(0, 0, 0, 0)
        return Layout(nothing, whole, nothing, nothing, Rect(0, bottom, width, status))
    edge = ui.px(EDGE)
    left = min(max(ui.px(sizes.left), ui.px(190)), width * 0.3)
    right = min(max(ui.px(sizes.right), ui.px(240)), width * 0.4)
    foot = min(max(ui.px(sizes.foot), ui.px(46)), (bottom - top) * 0.6)
    middle = width - left - right - 2 * edge
    view_height = bottom - top - foot - edge
    return Layout(
        left=Rect(0, top, left, bottom - top),
        view=Rect(left + edge, top, middle, view_height),
        right=Rect(width - right, top, right, bottom - top),
        foot=Rect(left + edge, top + view_height + edge, middle, foot),
        status=Rect(0, bottom, width, status),
    )


def edges(ui: Ui, sizes: Sizes, layout: Layout) -> None:
    """The lines between the parts, which can be dragged."""
    if not sizes.panels:
        return
    edge = ui.px(EDGE)
    view, foot = layout.view, layout.foot
    high = layout.left.height
    sizes.left += _edge(ui, "Left edge", Rect(view.x - edge, view.y, edge, high), upright=True)
    sizes.right -= _edge(ui, "Right edge", Rect(view.x + view.width, view.y, edge, high), upright=True)
    sizes.foot -= _edge(ui, "Foot edge", Rect(view.x, foot.y - edge, view.width, edge), upright=False)


def region(name: str, rect: Rect, draw: Callable[[], None], *, scrolls: bool = False, plain: bool = False) -> None:
    """Draw a part of the window in its rectangle; ``plain`` is without margins."""
    if rect.width < 1 or rect.height < 1:
        return
    imgui.set_next_window_pos((rect.x, rect.y))
    imgui.set_next_window_size((rect.width, rect.height))
    if plain:
        imgui.push_style_var(imgui.StyleVar_.window_padding.value, (0, 0))
    imgui.begin(name, None, _SCROLLING if scrolls else _FIXED)
    if plain:
        imgui.pop_style_var()
    draw()
    imgui.end()


def menu_bar(ui: Ui, commands: Iterable[Command], submenus: dict[str, Callable[[], None]]) -> float:
    """Draw the menus from the list of commands; returns where the bar ends.

    ``submenus``: drawn behind the command of that label.
    """
    if not imgui.begin_main_menu_bar():
        return 0.0
    menus: dict[str, list[Command]] = {}
    for command in commands:
        menus.setdefault(command.menu, []).append(command)
    for menu, entries in menus.items():
        with ui.menu(menu) as shown:
            for command in entries if shown else ():
                _menu_entry(ui, command, submenus)
    height = imgui.get_window_height()
    imgui.end_main_menu_bar()
    return height


def _menu_entry(ui: Ui, command: Command, submenus: dict[str, Callable[[], None]]) -> None:
    if command.label == "-":
        imgui.separator()
        return
    shown = command.name() if command.name else command.label
    if imgui.menu_item_simple(f"{shown}##{command.label}", command.shown_keys, command.on(), command.enabled()):
        command.run()
    ui.note(command.label)
    if command.label in submenus:
        submenus[command.label]()


def _edge(ui: Ui, label: str, rect: Rect, *, upright: bool) -> float:
    """One edge; returns how far it was dragged in this frame, in units of a plain screen."""
    moved = 0.0

    def draw() -> None:
        nonlocal moved
        imgui.invisible_button(f"##{label}", (rect.width, rect.height))
        ui.note(label)
        held = imgui.is_item_active()
        if held or imgui.is_item_hovered():
            cursor = imgui.MouseCursor_.resize_ew if upright else imgui.MouseCursor_.resize_ns
            imgui.set_mouse_cursor(cursor.value)
            colour = theme.packed(theme.ACCENT if held else theme.ACCENT_DEEP)
            far = (rect.x + rect.width, rect.y + rect.height)
            imgui.get_window_draw_list().add_rect_filled((rect.x, rect.y), far, colour)
        delta = imgui.get_io().mouse_delta
        moved = (delta.x if upright else delta.y) / ui.scale if held else 0.0

    imgui.push_style_color(imgui.Col_.window_bg.value, theme.rgba(theme.GROUND))
    imgui.push_style_var(imgui.StyleVar_.window_min_size.value, (1, 1))
    region(label, rect, draw, plain=True)
    imgui.pop_style_var()
    imgui.pop_style_color()
    return moved
