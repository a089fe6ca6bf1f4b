"""Creases of finger joints: where on a hand they run, and what they are like (Bando's thesis, figure 2.16).

On the back of a finger several short lines lie around each joint, on the palm side one deeper line.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.locate import Locator, locator
from ..head.mesh import Floats
from ..head.rig import FINGERS, BodyPart, bones_of, hand_frame
from .furrow import Furrow

# The thesis gives its furrows on the hand 0.5 to 1 mm of depth and width, and all of it at rest.
_BACK = Furrow(name="joint, back", region="hand", depth=0.6e-3, width=0.9e-3, initial=1.0)
_PALM = Furrow(name="joint, palm", region="hand", depth=0.9e-3, width=1.0e-3, initial=1.0)
# How far along the finger from the joint the lines of its back lie [m], and how far around the finger they reach [rad].
_LINES = (-0.0046, -0.0018, 0.0008, 0.0036)
_AROUND_BACK, _AROUND_PALM = np.radians(66.0), np.radians(62.0)
_SAMPLES = 17
_OUTSIDE = 0.03  # rays start this far from the joint [m]
_THICKEST = 0.015  # what lies farther from the joint is another finger, or the palm [m]


@dataclass(frozen=True, eq=False)
class SkinFurrow:
    """A furrow and the points of the skin it runs through [m], (k, 3)."""

    furrow: Furrow
    points: Floats


def joint_furrows(hand: BodyPart, seed: int = 1) -> tuple[SkinFurrow, ...]:
    """The creases of all finger joints of a hand at rest; empty for a part without a skeleton. Each differs a little."""
    if hand.rig is None:
        return ()
    rng = np.random.default_rng(seed)
    rig, surface = hand.rig, locator(hand.skin)
    _, _, back = hand_frame(rig.names, rig.positions)
    found = []
    for finger in FINGERS:
        bones = bones_of(finger)
        for before, joint, after in zip(bones[:-2], bones[1:-1], bones[2:]):
            if joint.endswith("proximal"):
                continue  # knuckles stretch over the fist and have no lines of their own
            middle = rig.at(joint)
            along = rig.at(after) - rig.at(before)
            along /= np.linalg.norm(along)
            across = np.cross(along, back)
            across /= np.linalg.norm(across)
            outward = np.cross(across, along)
            for offset in _LINES:
                reach = _AROUND_BACK * (1.0 - 50.0 * abs(offset)) * rng.uniform(0.8, 1.0)
                shift = offset + rng.normal(0.0, 1.5e-4)
                points = _around(surface, middle, along, across, outward, reach, shift, rng)
                found.append(SkinFurrow(_BACK, points))
            points = _around(surface, middle, along, across, -outward, _AROUND_PALM, 0.0, rng)
            found.append(SkinFurrow(_PALM, points))
    return tuple(each for each in found if len(each.points) > 3)


def _around(
    surface: Locator,
    middle: Floats,
    along: Floats,
    across: Floats,
    outward: Floats,
    reach: float,
    offset: float,
    rng: np.random.Generator,
) -> Floats:
    """Points of the skin on an arc around a joint, (k, 3); rays that miss the skin leave none."""
    angle = np.linspace(-reach, reach, _SAMPLES)[:, None]
    direction = np.cos(angle) * outward + np.sin(angle) * across
    # Lines bow away from the joint towards their ends, and none is quite straight.
    bow = 0.35 * offset * (angle / max(reach, 1e-9)) ** 2 + rng.normal(0.0, 2e-4) * np.sin(
        2.0 * angle / max(reach, 1e-9)
    )
    starts = middle + (offset + bow) * along + _OUTSIDE * direction
    distance = surface.first_hit(starts, -direction)
    hit = (distance < _OUTSIDE) & (distance > _OUTSIDE - _THICKEST)
    points: Floats = (starts - distance[:, None] * direction)[hit]
    return points
