"""The editors of the studio, one per tab: which tools and which panels of parameters each offers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from .parameter_rows import Panel, ParameterRows
from .studio import Studio
from .tools.part_hair import PartHair
from .tools.scalp_curves import ShapeScalp
from .tools.shake_head import ShakeHead
from .tools.tool import Tool
from .tools.whorl import PlaceWhorl
from .ui import Ui
from .viewport import Viewport
from .wisps.steps import WispSteps


class Steps(Protocol):
    """What an editor shows on the right side above its panels."""

    def draw(self, ui: Ui) -> None:
        """All of it, in the current ImGui window."""


@dataclass(frozen=True)
class Editor:
    """One tab. The first tool is the one in the hand when the tab opens.

    hair_as: what hair is made of while the tab is open, one of HAIR_AS. shown: the ticks on the left side, beside the
    picture that they change. steps: makes what stands above the panels.
    """

    label: str
    hair_as: str
    tools: tuple[Callable[[Studio], Tool], ...]
    panels: tuple[Panel, ...]
    shown: tuple[str, ...]
    steps: Callable[[ParameterRows, Viewport, Sequence[Tool]], Steps] | None = None


# Fields of the look that other parts of the window show.
TICKS = ("show_hair", "show_head", "shadows", "show_particles", "show_links", "show_contact", "show_wind")
ELSEWHERE = (*TICKS, "hair_as")

HAIR = Editor(
    "Hair",
    "particles",
    tools=(ShakeHead, PartHair, ShapeScalp, PlaceWhorl),
    panels=(
        Panel("Head", "head"),
        Panel("Scalp", "scalp"),
        Panel("Hair", "hair"),
        Panel("Dynamics", "lcp", elsewhere=("interactions",)),
        Panel("Look", "look", opened=False, elsewhere=ELSEWHERE),
        Panel("Camera", "camera", opened=False),
    ),
    shown=TICKS,
)

WISPS = Editor(
    "Wisps",
    "strands",
    tools=(ShakeHead, ShapeScalp, PlaceWhorl),
    panels=(
        Panel("Shape of hair", "wisp", in_steps=True),
        Panel("Styling", "styling", in_steps=True),
        Panel("Colour of hair", "colour", in_steps=True),
        Panel("Facial hair", "beard", in_steps=True),
        Panel("Head", "head", opened=False),
        Panel("Look", "look", opened=False, elsewhere=ELSEWHERE),
        Panel("Camera", "camera", opened=False),
    ),
    shown=TICKS[:3],
    steps=WispSteps,
)

EDITORS = (HAIR, WISPS)
