"""The hairstyles that ship, to start from."""

from __future__ import annotations

from collections.abc import Mapping

from imgui_bundle import imgui

from ...params import ParameterError
from ...scene.styles import Style, load_style, style_names
from ..parameter_rows import ParameterRows
from ..ui import Ui

HEIGHT = 152.0
COLUMNS = 2


class StyleList:
    """All styles as a grid of names; a click puts one on the head, as one change."""

    def __init__(self, rows: ParameterRows) -> None:
        self.rows = rows
        self._styles: Mapping[str, Style] | None = None
        self._wanted = ""

    def draw(self, ui: Ui) -> None:
        """A field to search in and the grid below it."""
        if self._styles is None:
            self._styles = self._load()
        imgui.set_next_item_width(-1)
        _, self._wanted = imgui.input_text_with_hint("##find style", "Find a style", self._wanted)
        ui.note("Find a style")
        words = self._wanted.lower().split()
        found = [
            style
            for style in self._styles.values()
            if all(word in f"{style.name} {style.title} {style.description}".lower() for word in words)
        ]
        imgui.begin_child("##styles", (0, ui.px(HEIGHT)))
        width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / COLUMNS
        for k, style in enumerate(found):
            if k % COLUMNS:
                imgui.same_line()
            if ui.button(style.name, f"{style.title}. {style.description}", text=_label(style), width=width):
                self.rows.change(style.on(self.rows.studio.document), f"Style {_label(style)}")
        if not found:
            ui.muted("No style is called that.")
        imgui.end_child()

    def _load(self) -> dict[str, Style]:
        """Every style that can be read; what is wrong with the others becomes a message."""
        styles: dict[str, Style] = {}
        for name in style_names():
            try:
                styles[name] = load_style(name)
            except (ParameterError, OSError) as error:
                self.rows.studio.messages.say(str(error), "warning")
        figures = {name: style for name, style in styles.items() if name.startswith("figure")}
        return {name: style for name, style in styles.items() if name not in figures} | figures


def _label(style: Style) -> str:
    """A name short enough for half the panel."""
    return style.name.replace("-", " ").capitalize()
