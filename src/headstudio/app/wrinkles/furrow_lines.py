"""Furrows as lines on the skin, ready to be drawn and touched; worked out once for each set and head."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...head.locate import SurfacePoints
from ...head.mesh import Ints
from ...wrinkle.bezier import BezierChain
from ...wrinkle.furrow import Controls
from .face_places import FacePlaces

_SAMPLES = 14  # points of the drawn line for each Bezier curve


@dataclass(frozen=True, eq=False)
class FurrowLines:
    """Points of all lines, p of them. furrow: which one each lies on, (p,)."""

    places: SurfacePoints
    furrow: Ints

    def line(self, number: int) -> slice:
        """Where the points of one furrow are."""
        low, high = np.searchsorted(self.furrow, [number, number + 1])
        return slice(int(low), int(high))


@lru_cache(maxsize=8)
def furrow_lines(faces: FacePlaces, lines: tuple[Controls, ...]) -> FurrowLines:
    """The lines of furrows with these control points on the chart, as far as the face reaches."""
    chains = [_sampled(controls) for controls in lines]
    furrow = np.repeat(np.arange(len(chains)), [len(points) for points in chains])
    places, reached = faces.of_chart(np.concatenate([np.zeros((0, 2)), *chains]))
    return FurrowLines(SurfacePoints(places.faces[reached], places.weights[reached]), furrow[reached])


@lru_cache(maxsize=8)
def handle_places(faces: FacePlaces, controls: Controls) -> tuple[SurfacePoints, Ints]:
    """Where the control points of a furrow that the face reaches are, (k,), and which they are, (k,)."""
    places, reached = faces.of_chart(np.array(controls))
    return SurfacePoints(places.faces[reached], places.weights[reached]), np.flatnonzero(reached)


@lru_cache(maxsize=256)
def _sampled(controls: Controls) -> np.ndarray:
    return BezierChain(np.array(controls)).sampled(_SAMPLES)[1]


def part(places: SurfacePoints, which: slice | Sequence[int] | np.ndarray) -> SurfacePoints:
    """Some of the places."""
    return SurfacePoints(places.faces[which], places.weights[which])
