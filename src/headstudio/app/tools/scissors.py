"""Scissors: cut hair with a straight stroke across the view."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from ...head.mesh import Floats
from ...params import number
from ...scene.animation import Animation
from ...wisp.cutting import scissor_stroke
from ...wisp.operations import EVERYWHERE
from ..parameter_widgets import edit_item
from ..studio import Studio
from ..styling_items import Chosen, with_items
from ..ui import Ui
from .freehand import Freehand, draw_line
from .tool import Canvas, Pointer

_LEAST = 0.01  # a shorter stroke was a slip of the hand [m]


@dataclass(frozen=True)
class ScissorSettings:
    """The scissors in the hand."""

    reach: float = number(
        EVERYWHERE, "Reach", "m", 0.005, EVERYWHERE, "How far around the stroke hair is cut; 2 m is all.", log=True
    )


class Scissors(Freehand):
    """A straight stroke from where the button went down; what lies beyond it, seen from the head, falls."""

    label = "Scissors"
    icon = icons.ICON_FA_SCISSORS
    help = "Draw a straight stroke across the hair: what lies beyond it, away from the head, falls. Alt+drag turns."

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._settings = ScissorSettings()

    def begins(self, pointer: Pointer) -> bool:
        """Anywhere: hair hangs beside the head, too."""
        return True

    def finish(self, line: Floats, pointer: Pointer, animation: Animation) -> None:
        """Another cut, by the plane through the stroke and the eye."""
        start, end = line[0], line[-1]
        if np.linalg.norm(end - start) < _LEAST:
            return
        eye = pointer.frame.to_head(pointer.view.eye[None])[0]
        cut = replace(scissor_stroke(start, end, eye, self.proportions), reach=self._settings.reach)
        cuts = self.studio.document.styling.cuts
        self.studio.work.change(with_items(self.studio.document, "cuts", (*cuts, cut)), "Cut")
        self.studio.chosen = Chosen("cuts", len(cuts))

    def options(self, ui: Ui) -> None:
        """The scissors."""
        self._settings, _ = edit_item(ui, self._settings)

    def draw(self, canvas: Canvas) -> None:
        """The stroke, straight."""
        if len(self._line) >= 2:
            draw_line(canvas, np.array([self._line[0], self._line[-1]]))
