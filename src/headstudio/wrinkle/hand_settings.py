"""What an artist decides about a hand."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ..params import choice, number

HAND_POSES = ("rest", "relaxed", "open", "fist", "point", "pinch")


def _curl(finger: str) -> Any:
    return number(
        0.0, f"Curl {finger}", "", -1.0, 1.0, f"Bends the {finger} further, or straightens it below 0.", live=True
    )


@dataclass(frozen=True)
class HandSettings:
    """A pose, how much of it, and what each finger does beyond it."""

    pose: str = choice("rest", "Pose", HAND_POSES, "How the hand is held.", live=True)
    strength: float = number(1.0, "Strength", "", 0.0, 1.0, "How much of the pose, from the hand at rest.", live=True)
    curl_thumb: float = _curl("thumb")
    curl_index: float = _curl("index")
    curl_middle: float = _curl("middle")
    curl_ring: float = _curl("ring")
    curl_little: float = _curl("little")
    spread: float = number(0.0, "Spread", "", -1.0, 1.0, "Fingers apart, or together below 0.", live=True)
    wrist: float = number(
        0.0,
        "Wrist",
        "rad",
        math.radians(-60),
        math.radians(60),
        "Bends the hand toward its palm.",
        shown="deg",
        live=True,
    )
