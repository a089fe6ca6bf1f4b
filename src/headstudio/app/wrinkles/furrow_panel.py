"""The list of furrows, what the chosen one is like, and sets to start from."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import icons_fontawesome_6 as icons
from imgui_bundle import imgui

from ...params import parameters_of
from ...wrinkle.furrow import Furrow
from .. import theme
from ..parameter_rows import ParameterRows
from ..ui import Ui
from .furrow_set import FurrowSet
from .proposals import Proposals

AGES = {"Child": 0.05, "Young": 0.2, "Adult": 0.4, "Aged": 0.7, "Old": 1.0}
HEIGHT = 150.0
WORDS = tuple(name for name, declared in parameters_of(Furrow).items() if declared.kind == "text")
SHAPE = tuple(name for name in parameters_of(Furrow) if name not in WORDS)
LARGE = ("shown", "strength", "breadth", "fineness", "self_contact", "shrinkage")


class FurrowPanel:
    """Everything about large wrinkles: Bando's thesis, section 2.5."""

    def __init__(self, rows: ParameterRows, furrows: FurrowSet, proposals: Proposals) -> None:
        self.rows = rows
        self._set = furrows
        self._proposals = proposals
        self._seen: int | None = None

    def draw(self, ui: Ui) -> None:
        """Ages, proposals, the list, the chosen furrow, and what holds for all."""
        self._draw_ages(ui)
        self._draw_proposals(ui)
        self._draw_list(ui)
        number = self._set.chosen
        if number is None:
            ui.muted("Click a furrow, here or on the face.")
        else:
            self._draw_chosen(ui, number)
        self._draw_all(ui)

    def _draw_ages(self, ui: Ui) -> None:
        document = self.rows.studio.document
        own = bool(document.wrinkle.furrows)
        ui.caption("Start from the default set")
        gap = imgui.get_style().item_spacing.x / 2
        width = (imgui.get_content_region_avail().x - gap * (len(AGES) - 1)) / len(AGES)
        for k, (name, age) in enumerate(AGES.items()):
            if k:
                imgui.same_line(0, gap)
            help_ = f"The furrows of a face of this age ({age:g}), in the place of those that are there."
            if ui.button(name, help_, on=not own and document.wrinkle.age == age, width=width):
                self._start_from(age, name)
        before = document.wrinkle
        after = self.rows.item(ui, before, ("age",))
        if after != before:
            # An artist's own furrows have their depths already; a new age is a new start.
            self.rows.change(replace(document, wrinkle=replace(after, furrows=())), "Age of the skin")

    def _start_from(self, age: float, name: str) -> None:
        document = self.rows.studio.document
        wrinkle = replace(document.wrinkle, age=age, furrows=())
        self._set.chosen = None
        self.rows.change(replace(document, wrinkle=wrinkle), f"{name} skin")

    def _draw_proposals(self, ui: Ui) -> None:
        proposals = self._proposals
        proposals.poll()
        with ui.within("Proposals"):
            progress = proposals.progress
            if progress is not None:
                left = imgui.get_content_region_avail().x - ui.px(86)
                imgui.progress_bar(progress, (left, 0), "Watching the skin")
                imgui.same_line()
                if ui.button("Cancel", "Propose nothing.", width=ui.px(78)):
                    proposals.cancel()
                return
            help_ = "Furrows where expressions press the skin together, for you to accept, drag or reject."
            if ui.button("Propose from expressions", help_, icon=icons.ICON_FA_WAND_MAGIC_SPARKLES, width=-1.0):
                proposals.search()
            if proposals.furrows:
                self._draw_answers(ui)

    def _draw_answers(self, ui: Ui) -> None:
        """What is proposed, and what the artist says to it."""
        proposals, number = self._proposals, self._proposals.chosen
        count = len(proposals.furrows)
        if number is None:
            ui.muted(f"{count} proposed, dashed on the face. Click one to look at it.")
        else:
            furrow = proposals.furrows[number]
            ui.muted(
                f"{furrow.name}: {1e3 * furrow.depth:.1f} mm deep, {1e3 * furrow.width:.1f} mm wide, "
                f"{furrow.initial:.0%} at rest"
            )
        width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        if ui.button("Accept", "Make this proposal a furrow.", enabled=number is not None, width=width):
            assert number is not None
            self._set.chosen = proposals.accept(number)
        imgui.same_line()
        if ui.button("Reject", "Take this proposal away (Delete).", enabled=number is not None, width=width):
            assert number is not None
            proposals.reject(number)
        if ui.button("Accept all", "Make all proposals furrows.", width=width):
            proposals.accept_all()
        imgui.same_line()
        if ui.button("Reject all", "Take all proposals away.", width=width):
            proposals.reject_all()

    def _draw_list(self, ui: Ui) -> None:
        furrows = self._set.furrows
        regions = dict.fromkeys(furrow.region for furrow in furrows)
        ui.caption(f"{len(furrows)} furrows{'' if self.rows.studio.document.wrinkle.furrows else ', the default set'}")
        imgui.push_style_color(imgui.Col_.child_bg.value, theme.rgba(theme.GROUND))
        imgui.begin_child("##furrows", (0, ui.px(HEIGHT)), imgui.ChildFlags_.always_use_window_padding.value)
        chosen_anew = self._set.chosen is not None and self._set.chosen != self._seen
        for region in regions:
            own = [k for k, furrow in enumerate(furrows) if furrow.region == region]
            if chosen_anew and self._set.chosen in own:
                imgui.set_next_item_open(True)
            title = region.capitalize() or "No region"
            opened = imgui.tree_node_ex(f"{title}  {len(own)}###{title}")
            ui.note(title)
            if not opened:
                continue
            with ui.within(title):
                for k in own:
                    self._draw_entry(ui, k, reveal=chosen_anew and k == self._set.chosen)
            imgui.tree_pop()
        imgui.end_child()
        imgui.pop_style_color()
        self._seen = self._set.chosen

    def _draw_entry(self, ui: Ui, number: int, *, reveal: bool) -> None:
        furrow = self._set.furrows[number]
        if imgui.selectable(f"{furrow.name}##{number}", number == self._set.chosen)[0]:
            self._set.chosen = number
        if reveal and not imgui.is_item_visible():
            imgui.set_scroll_here_y()
        ui.note(furrow.name)
        ui.hint(
            f"{1e3 * furrow.depth:.1f} mm deep, {1e3 * furrow.width:.1f} mm wide, {furrow.initial:.0%} of it at rest."
        )

    def _draw_chosen(self, ui: Ui, number: int) -> None:
        furrow = self._set.furrows[number]
        with ui.within("Furrow"):
            # What shapes it comes before what it is called.
            edited = self.rows.item(ui, self.rows.item(ui, furrow, SHAPE), WORDS)
            if edited != furrow:
                self.rows.hold("Furrow")
                self._set.put(number, edited, "Furrow")
            width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
            help_ = "The same furrow on the other side of the face."
            if ui.button("Mirror", help_, icon=icons.ICON_FA_LEFT_RIGHT, width=width):
                self._set.mirror_over(number)
            imgui.same_line()
            if ui.button("Remove", "Take this furrow away (Delete).", icon=icons.ICON_FA_TRASH_CAN, width=width):
                self._set.remove(number)

    def _draw_all(self, ui: Ui) -> None:
        imgui.separator()
        ui.caption("All furrows")
        self.rows.rows(ui, "wrinkle", LARGE)
