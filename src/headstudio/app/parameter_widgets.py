"""One widget for one declared parameter: the label, the unit, the range and the help come from its declaration."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, TypeVar

from imgui_bundle import imgui

from ..params import Parameter, parameters_of
from . import theme
from .ui import Ui

ItemT = TypeVar("ItemT", bound=Any)

LABEL_SHARE = 0.43
TYPED_RANGE = 1_000_000  # a whole number with more values than this is typed: no slider hits one of them


@dataclass(frozen=True)
class Edit:
    """What the user did to a parameter in this frame.

    value: the new value, in the parameter's own type and SI unit, within its range. complaint: what to say when the
    user is done, if the number as it stands is not one that the parameter takes.
    """

    value: Any
    complaint: str = ""


def draw(ui: Ui, declared: Parameter, value: Any, default: Any) -> Edit | None:
    """Draw one parameter with its label; returns what the user did, or None."""
    begin_row(ui, declared.label, changed=value != default)
    pointed_at = _pointed_at()
    reset = imgui.is_item_clicked(1)
    changed, shown = _WIDGETS[declared.kind](ui, declared, value)
    ui.note(declared.label)
    reset |= imgui.is_item_clicked(1)
    if _pointed_at() or pointed_at:
        _explain(ui, declared, default)
    if reset:
        return Edit(default)
    return _accept(declared, shown) if changed else None


def begin_row(ui: Ui, label: str, *, changed: bool = False) -> None:
    """Draw a label at the left; the next widget fills the row behind it."""
    width = imgui.get_content_region_avail().x
    label_width = width * LABEL_SHARE
    start = imgui.get_cursor_screen_pos()
    _draw_label(ui, label, changed=changed, width=label_width)
    imgui.same_line(0, 0)
    imgui.set_cursor_screen_pos((start.x + label_width, start.y))
    imgui.set_next_item_width(width - label_width)


def edit_item(ui: Ui, item: ItemT, only: Iterable[str] = ()) -> tuple[ItemT, str]:
    """Draw the parameters of a dataclass that stands for itself, or ``only`` some of them.

    Returns it as it is after what the user did, and what to say about that when the user is done.
    """
    complaint = ""
    defaults = {field.name: field.default for field in dataclasses.fields(item)}
    for name, declared in parameters_of(item).items():
        edit = draw(ui, declared, getattr(item, name), defaults[name]) if not only or name in only else None
        if edit is not None:
            item, complaint = dataclasses.replace(item, **{name: edit.value}), edit.complaint
    return item, complaint


def shown_text(declared: Parameter, value: Any) -> str:
    """A value as the window writes it, with its unit."""
    match declared.kind:
        case "number":
            return number_format(declared, value) % (value * declared.shown_scale)
        case "switch":
            return "on" if value else "off"
        case "colour":
            return "#" + "".join(f"{round(part * 255):02x}" for part in value)
        case _:
            return str(value)


def number_format(declared: Parameter, value: float) -> str:
    """A printf format with as many digits as range and value deserve, and the unit behind."""
    return f"%.{_digits(declared, value)}f{_unit(declared)}"


def _digits(declared: Parameter, value: float) -> int:
    """Three figures: of the value on a logarithmic slider, else of the range."""
    span = ((declared.high or 0) - (declared.low or 0)) * declared.shown_scale
    size = abs(value * declared.shown_scale) if declared.log else span
    return min(max(2 - math.floor(math.log10(size)), 0), 4) if size > 0 else 2


def _unit(declared: Parameter) -> str:
    unit = declared.shown_unit.replace("^2", "²").replace("^3", "³")
    return {"": "", "deg": "°"}.get(unit, f" {unit}")


def _draw_label(ui: Ui, label: str, *, changed: bool, width: float) -> None:
    """The name, cut where the widget begins; a dot in front tells that the value is not the default."""
    start = imgui.get_cursor_screen_pos()
    height = imgui.get_frame_height()
    canvas = imgui.get_window_draw_list()
    if changed:
        canvas.add_circle_filled((start.x + ui.px(3), start.y + height / 2), ui.px(2.5), theme.packed(theme.ACCENT))
    canvas.push_clip_rect((start.x, start.y), (start.x + width - ui.px(4), start.y + height), True)
    colour = theme.INK if changed else theme.MUTED
    middle = start.y + (height - imgui.get_font_size()) / 2
    canvas.add_text((start.x + ui.px(11), middle), theme.packed(colour), label)
    canvas.pop_clip_rect()
    imgui.dummy((width, height))


def _pointed_at() -> bool:
    """Whether the mouse rests on the last item long enough to want to know more."""
    return imgui.is_item_hovered(imgui.HoveredFlags_.for_tooltip.value)


def _explain(ui: Ui, declared: Parameter, default: Any) -> None:
    imgui.begin_tooltip()
    imgui.push_text_wrap_pos(ui.px(320))
    imgui.text_unformatted(declared.doc)
    tips = f"Default {shown_text(declared, default)}: right click."
    if declared.kind in ("number", "integer"):
        tips += " Ctrl+click to type."
    if not declared.live:
        tips += " Builds the hair again."
    ui.muted(tips)
    imgui.pop_text_wrap_pos()
    imgui.end_tooltip()


def _accept(declared: Parameter, shown: Any) -> Edit:
    """The nearest value in range, and what to say if it is not the one asked for."""
    if declared.low is None or declared.high is None:
        return Edit(shown)
    nearest = min(max(shown, declared.low), declared.high)
    if abs(shown - nearest) <= 1e-6 * (declared.high - declared.low):
        return Edit(nearest)
    low, high, taken = (shown_text(declared, bound) for bound in (declared.low, declared.high, nearest))
    return Edit(nearest, f"{declared.label} goes from {low} to {high}: {taken} was taken.")


def _number(ui: Ui, declared: Parameter, value: float) -> tuple[bool, float]:
    scale = declared.shown_scale
    low, high = (declared.low or 0.0) * scale, (declared.high or 0.0) * scale
    flags = imgui.SliderFlags_.no_round_to_format.value
    flags |= imgui.SliderFlags_.logarithmic.value if declared.log else 0
    _draw_bar(ui, _fraction(declared, value))
    with _Bare():
        changed, shown = imgui.slider_float(
            f"##{declared.label}", value * scale, low, high, number_format(declared, value), flags
        )
    # ImGui counts in single precision: six digits are what it can say.
    return changed, float(f"{shown:.6g}") / scale if changed else value


def _integer(ui: Ui, declared: Parameter, value: int) -> tuple[bool, int]:
    low, high = int(declared.low or 0), int(declared.high or 0)
    if high - low > TYPED_RANGE:
        return imgui.input_int(f"##{declared.label}", value, 1, 100)
    flags = imgui.SliderFlags_.logarithmic.value if declared.log else 0
    _draw_bar(ui, _fraction(declared, value))
    with _Bare():
        return imgui.slider_int(f"##{declared.label}", value, low, high, "%d", flags)


def _switch(ui: Ui, declared: Parameter, value: bool) -> tuple[bool, bool]:
    return imgui.checkbox(f"##{declared.label}", value)


def _choice(ui: Ui, declared: Parameter, value: str) -> tuple[bool, str]:
    index = declared.options.index(value)
    changed, index = imgui.combo(f"##{declared.label}", index, list(declared.options))
    return changed, declared.options[index]


def _text(ui: Ui, declared: Parameter, value: str) -> tuple[bool, str]:
    flags = imgui.InputTextFlags_.enter_returns_true.value | imgui.InputTextFlags_.elide_left.value
    entered, text = imgui.input_text(f"##{declared.label}", value, flags)
    return entered, text if entered else value


def _colour(ui: Ui, declared: Parameter, value: tuple[float, float, float]) -> tuple[bool, tuple[float, float, float]]:
    flags = imgui.ColorEditFlags_.display_hex.value | imgui.ColorEditFlags_.picker_hue_wheel.value
    changed, shown = imgui.color_edit3(f"##{declared.label}", list(value), flags)
    red, green, blue = (round(min(max(part, 0.0), 1.0), 5) for part in shown)
    return changed, (red, green, blue) if changed else value


# What draws each kind of parameter: takes and returns its value, and tells whether it changed.
_WIDGETS: dict[str, Callable[[Ui, Parameter, Any], tuple[bool, Any]]] = {
    "number": _number,
    "integer": _integer,
    "switch": _switch,
    "choice": _choice,
    "text": _text,
    "colour": _colour,
}


def _fraction(declared: Parameter, value: float) -> float:
    low, high = float(declared.low or 0), float(declared.high or 0)
    if declared.log:
        return math.log(value / low) / math.log(high / low)
    return (value - low) / (high - low)


def _draw_bar(ui: Ui, fraction: float) -> None:
    """A slider as a bar that is filled up to its value."""
    start = imgui.get_cursor_screen_pos()
    width, height = imgui.calc_item_width(), imgui.get_frame_height()
    corner = (start.x + width, start.y + height)
    hovered = imgui.is_window_hovered() and imgui.is_mouse_hovering_rect((start.x, start.y), corner)
    canvas = imgui.get_window_draw_list()
    canvas.add_rect_filled((start.x, start.y), corner, theme.packed(theme.HOVER if hovered else theme.RAISED), ui.px(4))
    filled = start.x + width * min(max(fraction, 0.0), 1.0)
    if filled > start.x + 1:
        canvas.push_clip_rect((start.x, start.y), (filled, start.y + height), True)
        colour = theme.packed(theme.ACCENT_DEEP, 0.95 if hovered else 0.7)
        canvas.add_rect_filled((start.x, start.y), corner, colour, ui.px(4))
        canvas.pop_clip_rect()


class _Bare:
    """A slider without a look of its own, for the bar below it to show through."""

    _SLOTS = (
        imgui.Col_.frame_bg,
        imgui.Col_.frame_bg_hovered,
        imgui.Col_.frame_bg_active,
        imgui.Col_.slider_grab,
        imgui.Col_.slider_grab_active,
    )

    def __enter__(self) -> None:
        for slot in self._SLOTS:
            imgui.push_style_color(slot.value, theme.rgba(theme.RAISED, 0.0))
        # With a wide grab the mouse would not be where the bar ends.
        imgui.push_style_var(imgui.StyleVar_.grab_min_size.value, 1.0)

    def __exit__(self, *_: object) -> None:
        imgui.pop_style_var()
        imgui.pop_style_color(len(self._SLOTS))
