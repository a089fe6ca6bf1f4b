"""Widgets that remember where they are.

A thin layer over Dear ImGui: every widget notes the rectangle it was drawn in under the path of its labels
("Dynamics/Elastic modulus"), so that a test, or a script, finds it the way a person does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from imgui_bundle import imgui

from . import theme


@dataclass(frozen=True)
class Rect:
    """A rectangle in window units, x to the right and y down from the window's upper left corner."""

    x: float
    y: float
    width: float
    height: float

    @property
    def centre(self) -> tuple[float, float]:
        """Its middle."""
        return self.at(0.5, 0.5)

    def at(self, across: float, down: float) -> tuple[float, float]:
        """The point at the given fractions of width and height."""
        return self.x + across * self.width, self.y + down * self.height


class Ui:
    """One frame's widgets. ``rectangles`` maps label paths to where they were drawn in the frame that ended last."""

    def __init__(self, fonts: theme.Fonts, scale: float) -> None:
        self.fonts = fonts
        self.scale = scale
        self.rectangles: dict[str, Rect] = {}
        self._path: list[str] = []

    def new_frame(self) -> None:
        """Forget the rectangles of the frame before."""
        self.rectangles = {}
        self._path = []

    def px(self, units: float) -> float:
        """A length given for a plain screen, in window units of this one."""
        return units * self.scale

    @contextmanager
    def within(self, name: str) -> Iterator[None]:
        """Everything drawn inside is found below ``name``."""
        self._path.append(name)
        imgui.push_id(name)
        try:
            yield
        finally:
            imgui.pop_id()
            self._path.pop()

    def note(self, label: str, rect: Rect | None = None) -> None:
        """Record where ``label`` is: ``rect``, or else the item drawn last."""
        if rect is None:
            low, size = imgui.get_item_rect_min(), imgui.get_item_rect_size()
            rect = Rect(low.x, low.y, size.x, size.y)
        self.rectangles["/".join([*self._path, label.partition("##")[0]])] = rect

    def hint(self, text: str) -> None:
        """Explain the last item while the mouse rests on it."""
        if text and imgui.begin_item_tooltip():
            imgui.push_text_wrap_pos(self.px(320))
            imgui.text_unformatted(text)
            imgui.pop_text_wrap_pos()
            imgui.end_tooltip()

    def button(
        self,
        label: str,
        help_: str = "",
        *,
        icon: str = "",
        text: str | None = None,
        on: bool = False,
        width: float = 0.0,
        enabled: bool = True,
    ) -> bool:
        """A button; ``on`` shows it pressed in, in the accent colour.

        ``text`` is what is written on it, when that is not the label; ``icon`` stands before it.
        """
        shown = "  ".join(part for part in (icon, label if text is None else text) if part)
        colours = (theme.ACCENT_DEEP, theme.ACCENT_DEEP, theme.ACCENT) if on else ()
        slots = (imgui.Col_.button, imgui.Col_.button_hovered, imgui.Col_.button_active)
        for slot, colour in zip(slots, colours):
            imgui.push_style_color(slot.value, theme.rgba(colour))
        imgui.begin_disabled(not enabled)
        pressed = imgui.button(f"{shown}###{label}", (width, 0))
        imgui.end_disabled()
        imgui.pop_style_color(len(colours))
        self.note(label)
        self.hint(help_)
        return pressed

    def checkbox(self, label: str, value: bool, help_: str = "") -> bool:
        """A box to tick; returns the new value."""
        _, value = imgui.checkbox(label, value)
        self.note(label)
        self.hint(help_)
        return value

    @contextmanager
    def menu(self, label: str, *, enabled: bool = True) -> Iterator[bool]:
        """A menu of the menu bar, or a menu inside one; the body draws its items when the value is true."""
        shown = imgui.begin_menu(label, enabled)
        if not shown:
            self.note(label)
        self._path.append(label)
        try:
            yield shown
        finally:
            self._path.pop()
            if shown:
                imgui.end_menu()
                self.note(label)

    def item(self, label: str, keys: str = "", *, on: bool = False, enabled: bool = True) -> bool:
        """An entry of a menu; true in the frame it is chosen."""
        chosen = imgui.menu_item_simple(label, keys, on, enabled)
        self.note(label)
        return chosen

    @contextmanager
    def section(self, label: str, *, opened: bool = True) -> Iterator[bool]:
        """A heading that folds what is below it."""
        imgui.push_font(self.fonts.strong, 0.0)
        imgui.set_next_item_open(opened, imgui.Cond_.once.value)
        shown = imgui.collapsing_header(label)
        imgui.pop_font()
        self.note(label)
        with self.within(label):
            yield shown
        if shown:
            imgui.dummy((0, self.px(4)))

    def choose(self, label: str, shown: str, options: Iterable[str], help_: str = "") -> str | None:
        """A list that opens below what is ``shown``; returns the option that was clicked in this frame."""
        chosen = None
        opened = imgui.begin_combo(f"##{label}", shown)
        self.note(label)
        if not opened:
            self.hint(help_)
            return None
        with self.within(label):
            for option in options:
                if imgui.selectable(option, option == shown)[0]:
                    chosen = option
                self.note(option)
        imgui.end_combo()
        return chosen

    def caption(self, text: str) -> None:
        """A small heading."""
        imgui.push_style_color(imgui.Col_.text.value, theme.rgba(theme.MUTED))
        imgui.push_font(self.fonts.strong, theme.BODY_SIZE * 0.8)
        imgui.text_unformatted(text.upper())
        imgui.pop_font()
        imgui.pop_style_color()

    def muted(self, text: str) -> None:
        """A line of quiet text."""
        imgui.push_style_color(imgui.Col_.text.value, theme.rgba(theme.MUTED))
        imgui.text_unformatted(text)
        imgui.pop_style_color()
