"""Draw a parting on the scalp."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from ...head.mesh import Floats
from ...scene.animation import Animation
from ..ui import Ui
from .freehand import Freehand, draw_line, evenly
from .tool import Canvas, Pointer

_SPACING, _MOST = 0.012, 24  # of the points that are kept [m]
_LEAST = 0.01  # a parting shorter than this was a slip of the hand [m]
_BESIDE = 0.01  # a line may begin so far off the scalp [m]


class DrawParting(Freehand):
    """A line on the scalp becomes the parting."""

    label = "Parting"
    icon = icons.ICON_FA_GRIP_LINES_VERTICAL
    help = "Draw a line on the scalp: hair leans away from it to both sides."

    def begins(self, pointer: Pointer) -> bool:
        """On the scalp."""
        if pointer.hit is None or self._animation is None:
            return False
        scalp, place = self._animation.scalp, pointer.hit.point[None]
        return bool(np.linalg.norm(scalp.points(scalp.locate(place)) - place) < _BESIDE)

    def finish(self, line: Floats, pointer: Pointer, animation: Animation) -> None:
        """The line as (u, v) of the scalp takes the place of the parting."""
        kept = evenly(line, _SPACING, _MOST)
        if np.linalg.norm(np.diff(kept, axis=0), axis=1).sum() < _LEAST:
            return
        uv = tuple((float(u), float(v)) for u, v in np.clip(animation.scalp.locate(kept), 0.0, 1.0))
        document = self.studio.document
        self.studio.work.change(replace(document, wisp=replace(document.wisp, parting_line=uv)), "Draw a parting")

    def options(self, ui: Ui) -> None:
        """Take the drawn one away."""
        document = self.studio.document
        if ui.button("Remove parting", "Back to the named parting.", enabled=bool(document.wisp.parting_line)):
            self.studio.work.change(replace(document, wisp=replace(document.wisp, parting_line=())), "Remove parting")

    def draw(self, canvas: Canvas) -> None:
        """The line so far, or the drawn parting."""
        super().draw(canvas)
        drawn = self.studio.document.wisp.parting_line
        if drawn and not self._line and self._animation is not None:
            draw_line(canvas, self._animation.scalp.points(evenly(np.array(drawn), 0.01, 64)), 0.6)
