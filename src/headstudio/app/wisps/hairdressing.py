"""After the seven steps: strokes of the field, hairdressing, scissors and what is worn (Choe, Ko 2005, section 6.2)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from imgui_bundle import imgui

from ...wisp.accessories import Band, HairTie, Pin, Ribbon
from ...wisp.operations import AlongPath, Braid, Bun, Constrain, Cut, InDirection, Place, Step, Tie, ToPoint, Updo
from ...wisp.selection import REGIONS, Selection
from ...wisp.strokes import Stroke
from ..parameter_rows import ParameterRows
from ..parameter_widgets import begin_row
from ..styling_items import selection_of
from ..ui import Ui
from .hand import Hand
from .item_list import ItemList, remark

_OPERATIONS = {
    "Tie": Tie,
    "Braid": Braid,
    "Bun": Bun,
    "Updo": Updo,
    "Point constraint": lambda: Constrain(steps=(ToPoint(),)),
    "Trajectory constraint": lambda: Constrain(steps=(AlongPath(),)),
    "Direction constraint": lambda: Constrain(steps=(InDirection(),)),
}
_STEPS: dict[str, type[Step]] = {"Point": ToPoint, "Trajectory": AlongPath, "Direction": InDirection}
_ACCESSORIES = {"Band": Band, "Pin": Pin, "Ribbon": Ribbon, "Hair tie": HairTie}
_OWN = "own choice"
_EXPRESSION = (
    "Parts of the scalp and comparisons: u runs from the right ear (0) to the left (1), v from forehead to nape."
)


class Hairdressing:
    """The lists of a styling."""

    def __init__(self, rows: ParameterRows, hand: Hand) -> None:
        self.rows = rows
        self._hand = hand
        self._strokes = self._list("strokes", {}, lambda item: "Stroke")
        self._operations = self._list("operations", _OPERATIONS, _operation_name)
        self._cuts = self._list("cuts", {"Cut": Cut}, lambda item: "Cut")
        self._accessories = self._list("accessories", _ACCESSORIES, lambda item: _name_in(_ACCESSORIES, item))

    def draw_strokes(self, ui: Ui) -> None:
        """Step 5: the strokes that bend the styling force field."""
        if not self._strokes.items:
            remark(ui, "Comb the head with strokes to bend the field.")
        self._strokes.draw(ui)
        self._hand.button(ui, "Comb", "Draw a stroke", -1)

    def draw_operations(self, ui: Ui) -> None:
        """Hairdressing, carried out one after the other."""
        if not self._operations.items:
            remark(ui, "Ties, braids and buns, one after the other; handles in the view move them.")
        self._operations.draw(ui)

    def draw_cuts(self, ui: Ui) -> None:
        """The strokes of the scissors."""
        self._cuts.draw(ui)
        self._hand.button(ui, "Scissors", "Cut with scissors", -1)

    def draw_accessories(self, ui: Ui) -> None:
        """What is worn in the hair."""
        self._accessories.draw(ui)

    def _list(self, field: str, kinds: Any, describe: Any) -> ItemList:
        return ItemList(self.rows, field, kinds, describe, self._draw_details, lambda: self._hand.take("Adjust"))

    def _draw_details(self, ui: Ui, item: Any) -> Any:
        if isinstance(item, Constrain):
            item = self._draw_steps(ui, item)
        if isinstance(item, Braid | Stroke):
            item = _draw_path(ui, item)
        selection = selection_of(item)
        if selection is not None:
            changed = self._draw_selection(ui, selection)
            item = item if changed == selection else replace(item, selection=changed)
        return item

    def _draw_steps(self, ui: Ui, item: Constrain) -> Constrain:
        """The queue: one constraint until all wisps have met it, then the next."""
        steps = list(item.steps)
        for k, step in enumerate(item.steps):
            with ui.within(f"Step {k + 1}"):
                ui.caption(f"Step {k + 1}: {_name_in(_STEPS, step)}")
                steps[k] = self.rows.item(ui, step)
                if not isinstance(step, ToPoint):
                    steps[k] = _draw_path(ui, steps[k])
                if ui.button("Earlier", enabled=k > 0):
                    return replace(item, steps=(*item.steps[: k - 1], step, item.steps[k - 1], *item.steps[k + 1 :]))
                imgui.same_line()
                if ui.button("Remove", enabled=len(steps) > 1):
                    return replace(item, steps=(*item.steps[:k], *item.steps[k + 1 :]))
        imgui.set_next_item_width(-1)
        name = ui.choose("Then", "Then...", _STEPS, "Another constraint, once all wisps have met the ones before it.")
        more = () if name is None else (_STEPS[name](),)
        return replace(item, steps=(*steps, *more))

    def _draw_selection(self, ui: Ui, selection: Selection) -> Selection:
        """Which wisps: a part of the scalp, an expression, a lasso or a painted mask."""
        begin_row(ui, "Wisps", changed=selection != Selection())
        plain = not selection.lasso and selection.mask is None
        shown = selection.where if plain and selection.where in REGIONS else _OWN
        region = ui.choose("Region", shown, REGIONS, "Which part of the scalp it is for.")
        if region is not None:
            return Selection(region)
        begin_row(ui, "Where")
        flags = imgui.InputTextFlags_.enter_returns_true.value
        entered, where = imgui.input_text("##where", selection.where, flags)
        ui.note("Where")
        ui.hint(f"{_EXPRESSION} For example: back and not (u > 0.4 and v < 0.8).")
        if entered and where != selection.where:
            with self.rows.studio.reporting():
                selection = replace(selection, where=where)
        width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        self._hand.button(ui, "Lasso", "Lasso", width)
        imgui.same_line()
        self._hand.button(ui, "Select", "Paint", width)
        return selection


def _draw_path(ui: Ui, item: Any) -> Any:
    """Points of a path are added at its end and taken from there; the view moves them."""
    path: tuple[Place, ...] = item.path
    least = 0 if isinstance(item, Braid) else 2
    if ui.button("Add a point", "Another place at the end of the path.", enabled=len(path) < 64):
        return replace(item, path=(*path, _next_place(item, path)))
    imgui.same_line()
    if ui.button("Take one away", "The last place of the path goes.", enabled=len(path) > least):
        kept = path[:-1]
        return replace(item, path=kept if len(kept) >= 2 else path[:least])
    return item


def _next_place(item: Any, path: tuple[Place, ...]) -> Place:
    """As far behind the last place of a path as that is behind the one before."""
    if len(path) >= 2:
        (x0, y0, z0), (x1, y1, z1) = path[-2:]
        return 2 * x1 - x0, 2 * y1 - y0, 2 * z1 - z0
    x, y, z = path[-1] if path else item.place
    return x, y - 0.5, z


def _operation_name(operation: Any) -> str:
    if isinstance(operation, Constrain):
        return " > ".join(_name_in(_STEPS, step) for step in operation.steps)
    return type(operation).__name__


def _name_in(kinds: dict[str, Any], item: Any) -> str:
    return next(name for name, kind in kinds.items() if kind is type(item))
