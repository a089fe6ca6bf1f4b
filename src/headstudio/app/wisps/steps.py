"""The right side of the editor of hairstyles."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..parameter_rows import ParameterRows
from ..tools.tool import Tool
from ..ui import Ui
from ..viewport import Viewport
from .styles import StyleList

GLOBAL = ("wisps", "strands", "points", "segments", "seed")


class WispSteps:
    """A style to start from, the seven steps of Choe, Ko 2005, section 6, and what is done to the hair after them."""

    def __init__(self, rows: ParameterRows, viewport: Viewport, tools: Sequence[Tool]) -> None:
        self.rows = rows
        self._sections: tuple[tuple[str, bool, Callable[[Ui], None]], ...] = (
            ("Styles", True, StyleList(rows).draw),
            ("2 Global", True, self._draw_global),
        )

    def draw(self, ui: Ui) -> None:
        """All sections, each below a heading that folds it."""
        for title, opened, draw in self._sections:
            with ui.section(title, opened=opened) as shown:
                if shown:
                    draw(ui)

    def _draw_global(self, ui: Ui) -> None:
        self.rows.rows(ui, "wisp", GLOBAL)
        self.rows.row(ui, "look.strands_shown")
