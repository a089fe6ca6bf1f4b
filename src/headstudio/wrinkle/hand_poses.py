"""Named poses of a hand, in degrees from straight fingers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..head.rig import FINGERS

Bend = tuple[float, float, float]


@dataclass(frozen=True)
class Touch:
    """What the thumb reaches for: the middle between two joints of a finger, beside the bone. lift: how far from it
    toward the pad of the finger, or toward its back below 0, in lengths of the palm."""

    finger: str
    between: tuple[str, str]
    lift: float


@dataclass(frozen=True)
class HandPose:
    """How a pose holds the hand.

    fingers: bend of knuckle, middle and last joint, by finger [deg]. thumb: bend of its two joints [deg]. spread: how
    far fingers are apart, 1 for as far as they go, below 0 together. touch: what the thumb reaches for, if anything.
    """

    fingers: Mapping[str, Bend]
    thumb: tuple[float, float]
    spread: float = 0.0
    touch: Touch | None = None


def _fingers(index: Bend, middle: Bend, ring: Bend, little: Bend) -> dict[str, Bend]:
    return dict(zip(FINGERS[1:], (index, middle, ring, little)))


_OVER_MIDDLE = Touch("middle", ("intermediate", "distal"), -0.17)

POSES: Mapping[str, HandPose] = {
    "relaxed": HandPose(_fingers((18, 26, 14), (24, 30, 16), (28, 34, 18), (30, 36, 20)), (14, 18)),
    "open": HandPose(_fingers((0, 2, 0), (0, 2, 0), (0, 2, 0), (0, 2, 0)), (0, 0), spread=0.6),
    "fist": HandPose(
        _fingers((80, 100, 62), (82, 100, 64), (84, 100, 64), (86, 96, 62)), (30, 50), spread=-0.25, touch=_OVER_MIDDLE
    ),
    "point": HandPose(
        _fingers((2, 4, 2), (80, 98, 62), (84, 98, 62), (86, 94, 60)), (30, 45), spread=-0.2, touch=_OVER_MIDDLE
    ),
    "pinch": HandPose(
        _fingers((54, 54, 34), (38, 34, 18), (30, 28, 16), (24, 24, 14)),
        (15, 30),
        touch=Touch("index", ("tip", "tip"), 0.09),
    ),
}
"""By name; "rest" is how the hand came."""
