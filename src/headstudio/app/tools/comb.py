"""Comb: strokes that bend the styling force field their way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from imgui_bundle import icons_fontawesome_6 as icons

from ...head.mesh import Floats
from ...params import number
from ...scene.animation import Animation
from ...wisp.strokes import Stroke
from ..parameter_widgets import edit_item
from ..studio import Studio
from ..styling_items import Chosen, with_items
from ..ui import Ui
from .freehand import Freehand, draw_line, evenly
from .tool import Canvas, Pointer

_SPACING, _MOST = 0.012, 40  # of the points that are kept [m]
_FAINT = 0.45
_USUAL = Stroke(path=())


@dataclass(frozen=True)
class CombSettings:
    """The comb in the hand: what the next stroke will be like."""

    lift: float = number(0.02, "Height", "m", 0.0, 0.2, "How far above the skin the stroke is drawn.", shown="cm")
    radius: float = number(
        _USUAL.radius, "Radius", "m", 0.005, 0.3, "Within this distance hair follows the stroke.", shown="cm"
    )
    strength: float = number(_USUAL.strength, "Strength", "", 0.0, 5.0, "Length of the force along the stroke.")


class Comb(Freehand):
    """A line drawn on or beside the head becomes a stroke of the styling force field."""

    label = "Comb"
    icon = icons.ICON_FA_WIND
    help = "Draw on the head and beyond: hair near the stroke flows along it."

    def __init__(self, studio: Studio) -> None:
        super().__init__(studio)
        self._settings = CombSettings()

    @property
    def lift(self) -> float:  # type: ignore[override]
        """How far above the skin the line is drawn [m]."""
        return self._settings.lift

    def finish(self, line: Floats, pointer: Pointer, animation: Animation) -> None:
        """Another stroke."""
        places = self.proportions.measure(evenly(line, _SPACING, _MOST))
        path = tuple((float(x), float(y), float(z)) for x, y, z in places)
        stroke = Stroke(path, self._settings.radius, self._settings.strength)
        strokes = self.studio.document.styling.strokes
        self.studio.work.change(with_items(self.studio.document, "strokes", (*strokes, stroke)), "Comb")
        self.studio.chosen = Chosen("strokes", len(strokes))

    def options(self, ui: Ui) -> None:
        """The comb."""
        self._settings, _ = edit_item(ui, self._settings)

    def draw(self, canvas: Canvas) -> None:
        """The line so far, and the strokes that there are."""
        if self._animation is not None:
            for stroke in self.studio.document.styling.strokes:
                draw_line(canvas, self.proportions.place(np.array(stroke.path)), _FAINT)
        super().draw(canvas)
