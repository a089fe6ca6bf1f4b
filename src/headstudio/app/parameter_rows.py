"""Parameters of the document as rows of widgets; turns what the user does to them into entries of the history."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any

from imgui_bundle import imgui

from ..params import Parameter, walk
from ..scene.document import Document
from . import parameter_widgets, theme
from .parameter_widgets import ItemT
from .studio import Studio
from .ui import Ui


@dataclass(frozen=True)
class Panel:
    """The parameters of one part of the document. ``elsewhere``: fields that another part of the window shows.

    in_steps: the steps of the editor show it, so that it is drawn only for what a search finds in it.
    """

    title: str
    part: str
    opened: bool = True
    elsewhere: tuple[str, ...] = ()
    in_steps: bool = False


@cache
def defaults() -> dict[str, tuple[Parameter, Any]]:
    """Declaration and default value of every parameter, by dotted path."""
    return {path: (declared, value) for path, declared, value in walk(Document())}


class ParameterRows:
    """Draws rows for parameters by their paths. Whatever happens while the mouse is down is one entry."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.wanted = ""
        self._editing = False
        self._complaint = ""

    def panel(self, ui: Ui, panel: Panel, before: Callable[[], None] | None = None) -> None:
        """A folding panel with the parameters of one part of the document, those that match the search.

        ``before``: draws something above the parameters.
        """
        paths = [
            path
            for path in defaults()
            if path.rpartition(".")[0] == panel.part
            and path.rpartition(".")[2] not in panel.elsewhere
            and self._matches(path, panel)
        ]
        if not paths or (panel.in_steps and not self.wanted):
            return
        if self.wanted:
            imgui.set_next_item_open(True)
        with ui.section(panel.title, opened=panel.opened) as shown:
            if not shown:
                return
            if before is not None and not self.wanted:
                before()
            for path in paths:
                self.row(ui, path)

    def row(self, ui: Ui, path: str) -> None:
        """One parameter with its label."""
        declared, default = defaults()[path]
        edit = parameter_widgets.draw(ui, declared, value_at(self.studio.document, path), default)
        if edit is not None:
            self._complaint = edit.complaint
            self.set(path, edit.value)

    def rows(self, ui: Ui, part: str, fields: Iterable[str]) -> None:
        """Several parameters of one part of the document."""
        for field in fields:
            self.row(ui, f"{part}.{field}")

    def item(self, ui: Ui, item: ItemT, only: Iterable[str] = ()) -> ItemT:
        """The parameters of something in a list, or ``only`` some; returns it as it is after what the user did."""
        item, complaint = parameter_widgets.edit_item(ui, item, only)
        self._complaint = complaint or self._complaint
        return item

    def tick(self, ui: Ui, path: str) -> None:
        """A switch as a box with its label behind it."""
        declared, _ = defaults()[path]
        value = value_at(self.studio.document, path)
        chosen = ui.checkbox(declared.label, value, declared.doc)
        if chosen != value:
            self.set(path, chosen)

    def set(self, path: str, value: Any) -> None:
        """Set a parameter, as a part of the gesture when a widget is held."""
        label = defaults()[path][0].label
        self.hold(label, path)
        self.studio.set(path, value, label)

    def change(self, document: Document, label: str) -> None:
        """Replace the document, as a part of the gesture when a widget is held."""
        if document != self.studio.document:
            self.hold(label)
            self.studio.work.change(document, label)

    def finish_frame(self) -> None:
        """Close the gesture once nothing is held any more, and say what could not be done. Call once a frame."""
        if imgui.is_any_item_active():
            return
        if self._editing:
            self.studio.work.end_gesture()
            self._editing = False
        if self._complaint:
            self.studio.messages.say(self._complaint, "warning")
            self._complaint = ""

    def search(self, ui: Ui) -> None:
        """The field that narrows the panels down to what is looked for."""
        imgui.set_next_item_width(-1)
        imgui.push_style_color(imgui.Col_.frame_bg.value, theme.rgba(theme.GROUND))
        _, self.wanted = imgui.input_text_with_hint("##search", "Find a parameter", self.wanted)
        imgui.pop_style_color()
        ui.note("Search")

    def hold(self, label: str, path: str = "") -> None:
        """What changes from now on until the widget is let go is one entry."""
        if imgui.is_any_item_active() and not self.studio.work.in_gesture:
            self.studio.work.begin_gesture(label, path)
            self._editing = True

    def _matches(self, path: str, panel: Panel) -> bool:
        declared, _ = defaults()[path]
        text = f"{panel.title} {path} {declared.label} {declared.doc}".lower()
        return all(word in text for word in self.wanted.lower().split())


def value_at(document: Document, path: str) -> Any:
    """The value of the parameter at a dotted path."""
    value: Any = document
    for name in path.split("."):
        value = getattr(value, name)
    return value
