"""The editors of the studio, one per tab: which tools and which panels of parameters each offers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from .painted_maps import DENSITY, LENGTH, PARTICLE_LENGTH, PROTRUSION
from .parameter_rows import Panel, ParameterRows
from .studio import Studio
from .tools.adjust import Adjust
from .tools.comb import Comb
from .tools.draw_parting import DrawParting
from .tools.paint_map import painter
from .tools.part_hair import PartHair
from .tools.scalp_curves import ShapeScalp
from .tools.scissors import Scissors
from .tools.select_wisps import Lasso, PaintSelection
from .tools.shake_head import ShakeHead
from .tools.tool import Tool
from .tools.whorl import PlaceWhorl
from .ui import Rect, Ui
from .viewport import Viewport
from .wisps.steps import WispSteps
from .wrinkles.direction_tool import DirectionTool
from .wrinkles.furrow_tool import FurrowTool
from .wrinkles.paint_tool import STRENGTH, TISSUE, skin_painter
from .wrinkles.steps import WrinkleSteps
from .wrinkles.texture_view import TextureView
from .wrinkles.timeline import Timeline


class Steps(Protocol):
    """What an editor shows on the right side above its panels."""

    def draw(self, ui: Ui) -> None:
        """All of it, in the current ImGui window."""


class SideView(Protocol):
    """A view beside that of the head, which the user opens and closes."""

    label: str
    help: str
    shown: bool

    def draw(self, ui: Ui, area: Rect) -> None:
        """All of it, in the current ImGui window."""


class TimeStrip(Protocol):
    """What happens when, above the plots of the foot."""

    def draw(self, ui: Ui) -> None:
        """All of it, in the current ImGui window."""


@dataclass(frozen=True)
class Editor:
    """One tab. The first tool is the one in the hand when the tab opens.

    hair_as: what hair is made of while the tab is open, one of HAIR_AS; None leaves it as it was. skin_as: what the skin
    does, one of SKIN_AS, or None. shown: the ticks on the left side, beside the picture that they change. steps: makes what
    stands above the panels. beside: makes another view of the same thing, beside the head.
    timeline: makes what stands above the plots. views: fields of the look that are shown below the ticks.
    """

    label: str
    hair_as: str | None
    tools: tuple[Callable[[Studio], Tool], ...]
    panels: tuple[Panel, ...]
    shown: tuple[str, ...]
    steps: Callable[[ParameterRows, Viewport, Sequence[Tool]], Steps] | None = None
    skin_as: str | None = None
    beside: Callable[[Viewport], SideView] | None = None
    timeline: Callable[[ParameterRows], TimeStrip] | None = None
    views: tuple[str, ...] = ()

    def is_about(self, hair_as: str, skin_as: str) -> bool:
        """Whether what is shown is what this tab works on."""
        return self.hair_as in (None, hair_as) and self.skin_as in (None, skin_as)


# Fields of the look that other parts of the window show.
TICKS = ("show_hair", "show_head", "shadows", "show_particles", "show_links", "show_contact", "show_wind")
ELSEWHERE = (*TICKS, "hair_as")

HAIR = Editor(
    "Hair",
    "particles",
    tools=(ShakeHead, PartHair, ShapeScalp, PlaceWhorl, painter(PARTICLE_LENGTH)),
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
    tools=(
        ShakeHead,
        painter(DENSITY),
        painter(LENGTH),
        painter(PROTRUSION),
        DrawParting,
        Comb,
        Scissors,
        Adjust,
        Lasso,
        PaintSelection,
        ShapeScalp,
        PlaceWhorl,
    ),
    panels=(
        Panel("Shape of hair", "wisp", in_steps=True),
        Panel("Styling", "styling", in_steps=True),
        Panel("Colour of hair", "colour", in_steps=True),
        Panel("Facial hair", "beard", in_steps=True),
        Panel("Imported hair", "groom", in_steps=True),
        Panel("Head", "head", opened=False),
        Panel("Look", "look", opened=False, elsewhere=ELSEWHERE),
        Panel("Camera", "camera", opened=False),
    ),
    shown=TICKS[:3],
    steps=WispSteps,
)

WRINKLES = Editor(
    "Wrinkles",
    None,
    tools=(FurrowTool, DirectionTool, skin_painter(TISSUE), skin_painter(STRENGTH), ShakeHead),
    panels=(
        Panel("Face", "face", in_steps=True),
        Panel("Wrinkles", "wrinkle", in_steps=True),
        Panel("Fine wrinkles", "fine", in_steps=True),
        Panel("Skin", "skin", opened=False),
        Panel("Head", "head", opened=False),
        Panel("Look", "look", opened=False, elsewhere=(*ELSEWHERE, "skin_as", "skin_shows", "split")),
        Panel("Camera", "camera", opened=False),
    ),
    shown=TICKS[:3],
    steps=WrinkleSteps,
    skin_as="living",
    beside=TextureView,
    timeline=Timeline,
    views=("skin_shows", "split"),
)

EDITORS = (HAIR, WISPS, WRINKLES)
