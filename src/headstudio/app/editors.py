"""The editors of the studio, one per tab: which tools and which panels of parameters each offers."""

from __future__ import annotations

from dataclasses import dataclass

from .tools.part_hair import PartHair
from .tools.scalp_curves import ShapeScalp
from .tools.shake_head import ShakeHead
from .tools.tool import Tool
from .tools.whorl import PlaceWhorl


@dataclass(frozen=True)
class Panel:
    """The parameters of one part of the document. ``elsewhere``: fields that another part of the window shows."""

    title: str
    part: str
    opened: bool = True
    elsewhere: tuple[str, ...] = ()


@dataclass(frozen=True)
class Editor:
    """One tab. The first tool is the one in the hand when the tab opens."""

    label: str
    tools: tuple[type[Tool], ...]
    panels: tuple[Panel, ...]


# Shown as ticks on the left side, beside the picture that they change.
SHOWN = ("show_hair", "show_head", "shadows", "show_particles", "show_links", "show_contact", "show_wind")

HAIR = Editor(
    "Hair",
    tools=(ShakeHead, PartHair, ShapeScalp, PlaceWhorl),
    panels=(
        Panel("Head", "head"),
        Panel("Scalp", "scalp"),
        Panel("Hair", "hair"),
        Panel("Dynamics", "lcp", elsewhere=("interactions",)),
        Panel("Look", "look", opened=False, elsewhere=SHOWN),
        Panel("Camera", "camera", opened=False),
    ),
)

EDITORS = (HAIR,)
