"""The right side of the editor of wrinkles."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..parameter_rows import ParameterRows
from ..tools.tool import Tool
from ..ui import Ui
from ..viewport import Viewport
from .expressions import ExpressionPanel
from .furrow_panel import FurrowPanel
from .furrow_tool import FurrowTool

FINE = (
    "on",
    "texture_size",
    "unit",
    "depth",
    "strength",
    "initial_amplitude",
    "crossing",
    "roundness",
    "laws",
    "pores",
    "pore_size",
    "pore_depth",
    "seed",
)


class WrinkleSteps:
    """Expressions, furrows, fine wrinkles and tissue, in the order of Bando's thesis, sections 2.5 and 2.6."""

    def __init__(self, rows: ParameterRows, viewport: Viewport, tools: Sequence[Tool]) -> None:
        self.rows = rows
        (tool,) = (tool for tool in tools if isinstance(tool, FurrowTool))
        self._sections: tuple[tuple[str, bool, Callable[[Ui], None]], ...] = (
            ("Expression", True, ExpressionPanel(rows).draw),
            ("Furrows", True, FurrowPanel(rows, tool.set, tool.proposals).draw),
            ("Fine wrinkles", False, lambda ui: rows.rows(ui, "fine", FINE)),
            ("Tissue", False, lambda ui: rows.rows(ui, "face", ("tissue", "tissue_lift"))),
        )

    def draw(self, ui: Ui) -> None:
        """All sections, each below a heading that folds it."""
        for title, opened, draw in self._sections:
            with ui.section(title, opened=opened) as shown:
                if shown:
                    draw(ui)
