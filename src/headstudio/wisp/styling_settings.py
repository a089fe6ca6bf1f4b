"""What an artist decides about the flow of hair: Choe, Ko 2005, sections 3, 4 and 6."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..params import number
from .accessories import Accessory
from .operations import Cut, Operation
from .strokes import Stroke


def _weight(default: float, label: str, doc: str) -> float:
    weight: float = number(default, label, "", 0.0, 3.0, doc)
    return weight


@dataclass(frozen=True)
class StylingSettings:
    """The styling force field as a weighted sum of presets, and how hair answers to it.

    The field at a place is the sum of the presets there, each a vector of length 1 or less times its weight.
    strokes: drawn over it, they bend it their way. operations: hairdressing, carried out one after the other. cuts: made
    when all hair lies as it will. accessories: put on at last.
    """

    bending_stiffness: float = number(
        0.5,
        "Bending stiffness",
        "",
        0.0,
        50.0,
        "Weight kappa of the hair's own shape against the styling force (eq. 5): 0.5 is soft, 2.5 springy, 20 wire.",
    )
    density_threshold: float = number(
        0.9,
        "Density threshold",
        "",
        0.02,
        1.0,
        "How densely hair may lie (tau of eq. 6): a small one gives volume.",
        log=True,
    )
    gravity: float = _weight(1.0, "Gravity", "Weight of the pull straight down.")
    back: float = _weight(0.0, "Pulled back", "Weight of the pull from the face to behind the head.")
    forward: float = _weight(0.0, "Forward", "Weight of the pull toward the face, as for a fringe.")
    left: float = _weight(0.0, "Swept left", "Weight of the pull to the person's left.")
    right: float = _weight(0.0, "Swept right", "Weight of the pull to the person's right.")
    up: float = _weight(0.0, "Up", "Weight of the pull straight up.")
    spiky: float = _weight(0.0, "Spiky", "Weight of the push away from the middle of the skull.")
    blown: float = _weight(0.0, "Blown", "Weight of a gusty wind.")
    blown_heading: float = number(
        math.radians(120),
        "Blown heading",
        "rad",
        -math.pi,
        math.pi,
        "Where the wind blows to, about the vertical: 0 along the face, 90 degrees to the person's left.",
        shown="deg",
    )
    parted: float = _weight(0.7, "Parted", "Weight of the push to both sides of the parting, on top of the head.")
    parting: float = number(
        0.55,
        "Parting",
        "",
        -1.0,
        1.0,
        "Where hair parts in front, in half breadths of the head: 0 in the middle, positive to the person's left.",
    )
    off_face: float = _weight(1.6, "Off the face", "Weight of the push from the face to the sides.")
    inward: float = _weight(0.0, "Inward", "Weight of the pull toward the neck, which turns the tips of a bob in.")
    close: float = _weight(
        0.4, "Close to the face", "Weight with which hair that hangs beside the face is drawn to it."
    )
    off_shoulders: float = _weight(
        1.0,
        "Off the shoulders",
        "Weight with which shoulders carry hair, and lead it over the breast or down the back.",
    )
    unevenness: float = number(
        0.15,
        "Unevenness",
        "",
        0.0,
        1.0,
        "How far locks stray from the way that all hair goes, as a part of the force on it.",
    )
    stroke_reach: float = number(
        0.06, "Stroke reach", "m", 0.01, 0.3, "How far around a drawn stroke hair still follows it.", shown="cm"
    )
    strokes: tuple[Stroke, ...] = ()
    operations: tuple[Operation, ...] = ()
    cuts: tuple[Cut, ...] = ()
    accessories: tuple[Accessory, ...] = ()
