"""Which tool is in the hand, for panels that hand one out."""

from __future__ import annotations

from collections.abc import Sequence

from ..tools.tool import Tool
from ..ui import Ui
from ..viewport import Viewport


class Hand:
    """The tools of an editor by their labels, and the viewport they are used in."""

    def __init__(self, viewport: Viewport, tools: Sequence[Tool]) -> None:
        self.viewport = viewport
        self._tools = {tool.label: tool for tool in tools}

    def take(self, label: str) -> None:
        """Take the tool with this label."""
        self.viewport.tool = self._tools[label]

    def holds(self, label: str) -> bool:
        """Whether it is the tool with this label."""
        return self.viewport.tool is self._tools[label]

    def button(self, ui: Ui, label: str, text: str, width: float = 0.0) -> None:
        """A button with ``text`` that takes the tool."""
        tool = self._tools[label]
        if ui.button(text, tool.help, icon=tool.icon, on=self.holds(label), width=width):
            self.take(label)
