"""Where a person's hair begins: default curves around the scalp, from landmarks and the outline of the ears.

Points are given on a cylinder about the vertical through the middle between the ears: an azimuth, 0 in front and 90
degrees at the tragus, and a height, 0 at the tragus. Each is then found on the skin, looking at the head from outside.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from .head import Head, HeadError
from .locate import Locator, locator
from .mesh import Floats

# From the middle of the forehead to the sideburn: azimuth [deg], height as a part of the hairline's in the middle. The
# line recedes over the temple, comes forward level with the brow, and falls back to the ear.
_FOREHEAD = ((14, 1.02), (29, 1.01), (40, 0.91), (47, 0.72), (53, 0.52), (63, 0.32), (73, 0.14))
_SIDEBURN_TIP = (81, -0.04)
# Heights below are parts of the height from tragus to crown; an adult's is about 130 mm, which the angles go with.
_TYPICAL_EAR = (0.24, 112.0)
_EAR_TOPS, _EAR_BACKS = (0.1, 0.5), (98.0, 132.0)
_CLEARANCE, _CLEARANCE_DEGREES = 0.05, 3.0
_NAPE_CORNER_AZIMUTH = 127.0
# The wreath from the right temple to the left one and on around the back: azimuth [deg], height as above; where each of
# its curves begins.
_WREATH = tuple((azimuth, 0.65 + 0.35 * np.cos(np.radians(azimuth))) for azimuth in range(-60, 300, 20))
_WREATH_CORNERS = (0, 6, 9, 15)
# What stands out from its surroundings by this much, seen from outside, belongs to the ear.
_EAR_STEP = 0.035


def default_curves(head: Head) -> tuple[Floats, ...]:
    """Control points [m] of a natural hairline on any head: front, left, back and right curve, each (k, 3).

    The front curve runs from the tip of the right sideburn over temples and forehead to the left one, the side curves
    over and behind the ears, and the back curve along the nape, so that the square's corners are the four tips. Raises
    HeadError when the landmarks do not lie as on a head.
    """
    around = AroundHead.of(head)
    marks = head.landmarks
    left_front, left_side = _half(around, marks.hairline, marks.nape, 1)
    right_front, right_side = _half(around, marks.hairline, marks.nape, -1)
    front = np.concatenate([right_side[:1], right_front[::-1], marks.hairline[None], left_front, left_side[:1]])
    back = np.stack([left_side[-1], marks.nape, right_side[-1]])
    return front, left_side, back, right_side[::-1]


def wreath(head: Head) -> tuple[Floats, ...]:
    """Control points [m] of four curves that keep above the ears, as ``default_curves`` gives: for heads that are hardly
    human, on whose temples, ears or nape a hairline gets lost.
    """
    around = AroundHead.of(head)
    rise = head.landmarks.hairline[1] - around.middle[1]
    azimuth, height = np.array(_WREATH).T
    height *= min(rise, 0.75 * around.unit)
    points = around.place(azimuth, height)
    begins = [*_WREATH_CORNERS, len(points)]
    closed = np.concatenate([points, points[:1]])
    return tuple(closed[start : end + 1] for start, end in pairwise(begins))


@dataclass(frozen=True)
class AroundHead:
    """The head as seen from a cylinder around it: its axis through ``middle``, its ``radius``, all in metres.

    unit: height from tragus to crown.
    """

    skin: Locator
    middle: Floats
    radius: float
    unit: float

    @classmethod
    def of(cls, head: Head) -> AroundHead:
        """The surroundings of ``head``. Raises HeadError when its landmarks do not lie as on a head."""
        marks = head.landmarks
        middle = (marks.left_tragus + marks.right_tragus) / 2
        unit = float(marks.crown[1] - middle[1])
        if not (unit > 0 and marks.hairline[1] > middle[1] > marks.nape[1]):
            raise HeadError("the landmarks do not lie as on a head: crown and hairline above the ears, the nape below")
        reach = max(np.linalg.norm((mark - middle)[[0, 2]]) for mark in (marks.nose_tip, marks.occiput))
        return cls(locator(head.skin), middle, 1.3 * float(reach), unit)

    def place(self, azimuth: ArrayLike, height: ArrayLike) -> Floats:
        """The skin [m], (k, 3), at azimuths [deg], positive to the person's left, and heights [m] over the tragus.

        Where one sees past the head, the nearest point of it.
        """
        outward, start = self._rays(azimuth, height)
        distance = self.skin.first_hit(start, -outward)
        seen = start - np.where(np.isfinite(distance), distance, self.radius)[:, None] * outward
        nearest, _ = self.skin.nearest(seen)
        return nearest.blend(self.skin.vertices, self.skin.faces)

    def ear(self, side: int) -> tuple[float, float]:
        """Height [m] of the top of an ear and azimuth [deg] of its back; typical ones when no ear stands out."""
        azimuth, height = np.arange(75.0, 135.0, 1.5), np.arange(-0.15, 0.55, 0.02) * self.unit
        grid_azimuth, grid_height = np.meshgrid(azimuth, height)
        outward, start = self._rays(side * grid_azimuth.ravel(), grid_height.ravel())
        depth = self.skin.first_hit(start, -outward).reshape(grid_azimuth.shape)
        depth = np.minimum(depth, self.radius)
        step = np.zeros(depth.shape, dtype=bool)
        step[1:] |= np.abs(np.diff(depth, axis=0)) > _EAR_STEP * self.unit
        step[:, 1:] |= np.abs(np.diff(depth, axis=1)) > _EAR_STEP * self.unit
        top = height[step.any(axis=1)].max(initial=-np.inf)
        back = azimuth[step.any(axis=0)].max(initial=-np.inf)
        is_an_ear = _EAR_TOPS[0] < top / self.unit < _EAR_TOPS[1] and _EAR_BACKS[0] < back < _EAR_BACKS[1]
        return (float(top), float(back)) if is_an_ear else (_TYPICAL_EAR[0] * self.unit, _TYPICAL_EAR[1])

    def _rays(self, azimuth: ArrayLike, height: ArrayLike) -> tuple[Floats, Floats]:
        angle, up = np.radians(azimuth), np.asarray(height, dtype=np.float64)
        outward = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=-1)
        return outward, self.middle + self.radius * outward + up[..., None] * [0.0, 1.0, 0.0]


def _half(around: AroundHead, hairline: Floats, nape: Floats, side: int) -> tuple[Floats, Floats]:
    """One half of the hairline: forehead and temple from the middle outward, and from the sideburn's tip to the nape."""
    rise, fall = hairline[1] - around.middle[1], nape[1] - around.middle[1]
    top, back = around.ear(side)
    above, behind = top + _CLEARANCE * around.unit, back + _CLEARANCE_DEGREES
    forehead = np.array(_FOREHEAD)
    around_ear = np.array(
        [
            (_SIDEBURN_TIP[0], _SIDEBURN_TIP[1] * rise),
            (83, 0.55 * top),
            (86, 0.9 * above),
            (0.5 * (88 + behind), above),
            (behind - 3, 0.8 * top),
            (behind, 0.25 * top),
            (behind, 0.4 * fall),
            (_NAPE_CORNER_AZIMUTH, 0.92 * fall),
        ]
    )
    return (
        around.place(side * forehead[:, 0], rise * forehead[:, 1]),
        around.place(side * around_ear[:, 0], around_ear[:, 1]),
    )
