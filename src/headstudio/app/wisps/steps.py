"""The right side of the editor of hairstyles."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from imgui_bundle import imgui

from ..parameter_rows import ParameterRows
from ..tools.tool import Tool
from ..ui import Ui
from ..viewport import Viewport
from .distributions import WispStep
from .hairdressing import Hairdressing
from .hand import Hand
from .maps import MapStep
from .prototype import PrototypeStep
from .styles import StyleList

_GLOBAL = ("wisps", "strands", "points", "segments", "seed")
_FIELD = (
    "gravity",
    "back",
    "forward",
    "left",
    "right",
    "up",
    "spiky",
    "blown",
    "blown_heading",
    "parted",
    "parting",
    "off_face",
    "inward",
    "close",
    "off_shoulders",
    "unevenness",
    "stroke_reach",
)
_DEFORMATION = ("bending_stiffness", "density_threshold")
_COLOUR = (
    ("pigment", "eumelanin", "pheomelanin", "dye", "gray"),
    ("tip_colour", "tip_amount", "tip_start", "streak_colour", "streaks"),
)
_SPREAD = (
    "hue_distribution",
    "hue_spread",
    "wisp_hue_spread",
    "saturation_distribution",
    "saturation_spread",
    "wisp_saturation_spread",
    "value_distribution",
    "value_spread",
    "wisp_value_spread",
    "seed",
)
_BEARD = (
    "style",
    "length",
    "strands",
    "prototype",
    "curl_size",
    "curl_length",
    "protrusion",
    "fuzziness",
    "stiffness",
    "shaft",
    "seed",
)


class WispSteps:
    """A style to start from, the seven steps of Choe, Ko 2005, section 6, and what is done to the hair after them."""

    def __init__(self, rows: ParameterRows, viewport: Viewport, tools: Sequence[Tool]) -> None:
        self.rows = rows
        hand = Hand(viewport, tools)
        dressing = self._dressing = Hairdressing(rows, hand)
        self._sections: tuple[tuple[str, bool, Callable[[Ui], None]], ...] = (
            ("Styles", True, StyleList(rows).draw),
            ("1 Maps", True, MapStep(rows, hand).draw),
            ("2 Global", True, self._draw_global),
            ("3 Prototype", True, PrototypeStep(rows).draw),
            ("4 Wisp", False, WispStep(rows).draw),
            ("5 Styling force field", False, self._draw_field),
            ("6 Deformation", False, lambda ui: rows.rows(ui, "styling", _DEFORMATION)),
            ("7 Colour", False, self._draw_colour),
            ("Operations", False, dressing.draw_operations),
            ("Cuts", False, dressing.draw_cuts),
            ("Accessories", False, dressing.draw_accessories),
            ("Beard", False, lambda ui: rows.rows(ui, "beard", _BEARD)),
        )

    def draw(self, ui: Ui) -> None:
        """All sections, each below a heading that folds it; imported hair above them, while it takes their place."""
        if self.rows.studio.document.groom.hair is not None:
            with ui.section("Imported hair") as shown:
                if shown:
                    self._draw_groom(ui)
        for title, opened, draw in self._sections:
            with ui.section(title, opened=opened) as shown:
                if shown:
                    draw(ui)

    def _draw_groom(self, ui: Ui) -> None:
        document = self.rows.studio.document
        hair = document.groom.hair
        if hair is None:
            return
        imgui.push_text_wrap_pos(0)
        ui.muted(f"{hair.strands.count:,} strands of {hair.name}")
        imgui.pop_text_wrap_pos()
        self.rows.rows(ui, "groom", ("reroot", "lift"))
        if hair.strands.radius is None:
            self.rows.rows(ui, "wisp", ("shaft_root", "shaft_tip"))
        self.rows.row(ui, "look.strands_shown")
        if ui.button(
            "Style hair instead", "Take the imported strands away, and show the hairstyle of the steps below."
        ):
            self.rows.change(replace(document, groom=replace(document.groom, hair=None)), "Style hair instead")

    def _draw_global(self, ui: Ui) -> None:
        self.rows.rows(ui, "wisp", _GLOBAL)
        self.rows.row(ui, "look.strands_shown")

    def _draw_field(self, ui: Ui) -> None:
        self.rows.rows(ui, "styling", _FIELD)
        self._dressing.draw_strokes(ui)

    def _draw_colour(self, ui: Ui) -> None:
        for fields in _COLOUR:
            self.rows.rows(ui, "colour", fields)
        ui.caption("Spread over strands and wisps")
        self.rows.rows(ui, "colour", _SPREAD)
