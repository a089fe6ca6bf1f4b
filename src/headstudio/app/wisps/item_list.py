"""A list of the styling: things are added, put in order, taken away and worked on, one at a time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from .. import theme
from ..parameter_rows import ParameterRows
from ..styling_items import Chosen, with_items
from ..ui import Ui

# What moves or removes an item: its icon, its help, and how far in the list it moves the item; None takes it away.
_MOVES = (
    ("Up", icons.ICON_FA_CHEVRON_UP, "Earlier in the list.", -1),
    ("Down", icons.ICON_FA_CHEVRON_DOWN, "Later in the list.", 1),
    ("Delete", icons.ICON_FA_XMARK, "Take it out of the list.", None),
)


class ItemList:
    """One of the lists: ``field`` of the styling settings.

    kinds: what can be added, by name. describe: what an item is called in the list. details: draws more than the
    parameters of an item and returns it as it is after what the user did. chosen: called when the user picks an item.
    """

    def __init__(
        self,
        rows: ParameterRows,
        field: str,
        kinds: Mapping[str, Callable[[], Any]],
        describe: Callable[[Any], str],
        details: Callable[[Ui, Any], Any] = lambda ui, item: item,
        chosen: Callable[[], None] = lambda: None,
    ) -> None:
        self.rows = rows
        self._studio = rows.studio
        self._field = field
        self._kinds = kinds
        self._describe = describe
        self._details = details
        self._on_chosen = chosen

    @property
    def items(self) -> tuple[Any, ...]:
        """The list as it is now."""
        items: tuple[Any, ...] = getattr(self._studio.document.styling, self._field)
        return items

    def draw(self, ui: Ui) -> None:
        """What can be added, the items in their order, and below the chosen one its parameters."""
        for k, item in enumerate(self.items):
            with ui.within(str(k + 1)):
                self._draw_item(ui, k, item)
        self._draw_kinds(ui)

    def _draw_kinds(self, ui: Ui) -> None:
        if not self._kinds:
            return
        imgui.set_next_item_width(-1)
        name = ui.choose("Add", f"{icons.ICON_FA_PLUS}  Add", self._kinds, "Add another to the end of the list.")
        if name is not None:
            self._put((*self.items, self._kinds[name]()), f"Add {name}")
            self._choose(len(self.items) - 1)

    def _draw_item(self, ui: Ui, k: int, item: Any) -> None:
        on = self._studio.chosen == Chosen(self._field, k)
        side = imgui.get_frame_height()
        gap = imgui.get_style().item_inner_spacing.x
        buttons = len(_MOVES) * (side + gap)
        if ui.button("Choose", text=f"{k + 1}   {self._describe(item)}", on=on, width=-buttons):
            self._choose(None if on else k)
        for name, icon, help_, by in _MOVES:
            imgui.same_line(0, gap)
            possible = by is None or 0 <= k + by < len(self.items)
            if ui.button(name, help_, icon=icon, text="", width=side, enabled=possible):
                self._move(k, by)
        if on and k < len(self.items) and self.items[k] is item:
            imgui.indent(ui.px(8))
            changed = self._details(ui, self.rows.item(ui, item))
            imgui.unindent(ui.px(8))
            if changed != item:
                document = Chosen(self._field, k).put(self._studio.document, changed)
                self.rows.change(document, self._describe(item))

    def _choose(self, k: int | None) -> None:
        self._studio.chosen = None if k is None else Chosen(self._field, k)
        if k is not None:
            self._on_chosen()

    def _move(self, k: int, by: int | None) -> None:
        items = list(self.items)
        item = items.pop(k)
        chosen = self._studio.chosen
        if by is not None:
            items.insert(k + by, item)
        self._put(tuple(items), f"{'Delete' if by is None else 'Move'} {self._describe(item)}")
        if chosen is not None and chosen.field == self._field:
            # The items have moved: what is chosen stays chosen only if it is the one that was moved.
            self._studio.chosen = Chosen(self._field, k + by) if by is not None and chosen.index == k else None

    def _put(self, items: tuple[Any, ...], label: str) -> None:
        self.rows.change(with_items(self._studio.document, self._field, items), label)


def remark(ui: Ui, text: str) -> None:
    """A quiet line of help, broken where the panel ends."""
    imgui.push_text_wrap_pos(0)
    imgui.push_style_color(imgui.Col_.text.value, theme.rgba(theme.MUTED))
    imgui.text_unformatted(text)
    imgui.pop_style_color()
    imgui.pop_text_wrap_pos()
