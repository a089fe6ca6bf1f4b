"""How carefully strands are drawn and lit: for a picture to work with, and for one to keep."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..head.frame import HeadFrame
from ..wisp.strands import Strands
from .strand_points import DEFAULT_RADIUS
from .view import Sphere, View, bounding_sphere

_SAMPLE = 20_000  # of the points of strands whose bends are measured
_MOST = 80  # percent
_STRANDS = 500  # whose lengths are measured
_STEPS, _SHORTENED = (1, 2, 4, 8), 1.002


@dataclass(frozen=True)
class StrandDetail:
    """strand_pixels: strands are left out, and the others drawn wider, as long as these are no wider than so many pixels;
    0 leaves none out. bend_pixels: every second point of the strands is left out where most bend by no more than so many
    pixels from there to the next. sun_strands, sky_strands: how many strands, a fair sample of all, are drawn into the map
    of the light and into those of the sky. stride: of their points only every so many, and for the sky as few as they are
    straight. fineness: the map of the light has so many times as many texels a side as that of other shadows. pairs: of
    opposite directions that stand for the sky. spacing: of the nodes where soft light is worked out [m], where the hair is
    not too large for it. piece: segments that are sorted as one when strands are blended. Where hair turns toward the eye long
    pieces stand in a wrong order, and what lies deeper, in the shadow, is drawn over what is lit.
    """

    strand_pixels: float
    bend_pixels: float
    sun_strands: int
    sky_strands: int
    stride: int
    fineness: float
    pairs: int
    spacing: float
    piece: int


FINE = StrandDetail(
    strand_pixels=0.0,
    bend_pixels=0.0,
    sun_strands=20_000,
    sky_strands=5_000,
    stride=1,
    fineness=2.0,
    pairs=16,
    spacing=0.004,
    piece=1,
)
QUICK = StrandDetail(
    strand_pixels=0.6,
    bend_pixels=0.6,
    sun_strands=5_000,
    sky_strands=800,
    stride=2,
    fineness=1.0,
    pairs=5,
    spacing=0.006,
    piece=2,
)
ROUGH = StrandDetail(
    strand_pixels=1.5,
    bend_pixels=1.0,
    sun_strands=2_000,
    sky_strands=400,
    stride=2,
    fineness=0.5,
    pairs=3,
    spacing=0.01,
    piece=2,
)
"""For a draft, which is looked at for the blink of an eye until there are more strands."""


@dataclass(frozen=True, eq=False)
class StrandSurvey:
    """What is to be known of strands before it is decided how carefully they are drawn."""

    strands: Strands

    @cached_property
    def sphere(self) -> Sphere:
        """Around all of them, in the head frame."""
        return bounding_sphere(self.strands.points)

    def same_shape(self, strands: Strands) -> bool:
        """True if these are the same strands, whatever their colour."""
        mine = self.strands
        return mine.points is strands.points and mine.radius is strands.radius and mine.stands_for == strands.stands_for

    @cached_property
    def bend(self) -> float:
        """How far most points lie beside the straight line between their neighbours [m]."""
        points = self.strands.points
        inner = np.arange(1, len(points) - 1, max(len(points) // _SAMPLE, 1))
        first = self.strands.first
        ends = (first[np.searchsorted(first, inner)] == inner) | (first[np.searchsorted(first, inner + 1)] == inner + 1)
        inner = inner[~ends]
        aside = points[inner] - 0.5 * (points[inner - 1] + points[inner + 1])
        return float(np.percentile(np.linalg.norm(aside, axis=1), _MOST)) if len(inner) else 0.0

    def shortening(self, step: int) -> float:
        """How many times as long the strands are as they would be drawn with only every ``step``-th of their points."""
        few = self.strands.first[: -1 : max(self.strands.count // _STRANDS, 1)]
        sizes = self.strands.first[1 :: max(self.strands.count // _STRANDS, 1)] - few
        first = np.concatenate([[0], np.cumsum(sizes)])
        kept = np.repeat(few - first[:-1], sizes) + np.arange(first[-1])
        sample = Strands(self.strands.points[kept], first)
        drawn = float(thinned(sample, step).lengths.sum())
        return float(sample.lengths.sum()) / drawn if drawn > 0 else 1.0

    @cached_property
    def straight_for(self) -> int:
        """So many points go on about as straight that to leave out all but one of them shortens no strand by much."""
        return max(step for step in _STEPS if step == 1 or self.shortening(step) < _SHORTENED)

    @cached_property
    def width(self) -> float:
        """Of a strand, in the mean [m]."""
        radius = self.strands.radius
        return 2.0 * (DEFAULT_RADIUS if radius is None else float(radius.mean()))

    def pixel(self, view: View, frame: HeadFrame, height: int) -> float:
        """How large a pixel is at the nearest hair [m] in a picture ``height`` pixels high."""
        distance = float(np.linalg.norm(view.eye - frame.translation - frame.rotation.apply(self.sphere.centre)))
        return 2.0 * max(distance - self.sphere.radius, view.near) / (view.focal * height)


def thinned(strands: Strands, step: int) -> Strands:
    """The strands with only every ``step``-th of their points, and with their tips."""
    if step == 1:
        return strands
    steps = -(-(strands.counts - 1) // step)
    first = np.concatenate([[0], np.cumsum(steps + 1)])
    place = np.arange(first[-1]) - np.repeat(first[:-1], steps + 1)
    ends = np.repeat(strands.first[1:] - 1, steps + 1)
    kept = np.minimum(np.repeat(strands.first[:-1], steps + 1) + step * place, ends)
    radius = None if strands.radius is None else strands.radius[kept]
    colour = None if strands.colour is None else strands.colour[kept]
    return replace(strands, points=strands.points[kept], first=first, radius=radius, colour=colour)
