"""A brush for painting maps on a surface: for every editor that has something to paint."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from ..head.mesh import Floats
from ..params import choice, number, switch

# How much paint there is at a distance from the middle, 0 to 1 of the radius, (n,).
FALLOFFS: dict[str, Callable[[Floats], Floats]] = {
    "smooth": lambda r: (1 - r * r) ** 2,
    "round": lambda r: np.sqrt(1 - r * r),
    "linear": lambda r: 1 - r,
    "sharp": lambda r: (1 - r) ** 2,
    "flat": np.ones_like,
}


@dataclass(frozen=True)
class Brush:
    """How paint is put on. It is a tool in the hand and no part of the document."""

    radius: float = number(0.02, "Radius", "m", 0.002, 0.1, "Radius of the brush.", shown="mm", log=True)
    strength: float = number(0.4, "Strength", "", 0.01, 1.0, "How much one stroke changes the map at most.")
    falloff: str = choice("smooth", "Falloff", tuple(FALLOFFS), "How the brush fades from its middle to its rim.")
    mirror: bool = switch(True, "Mirror", "Paint the other half of the head as well.")


@dataclass(frozen=True, eq=False)
class Sheet:
    """What a map covers: where each of its texels lies on the surface [m], (rows, columns, 3), and the x of the plane on
    whose two sides the surface is alike [m].
    """

    places: Floats
    middle: float


class BrushStroke:
    """One stroke over a map.

    Every texel is changed by the most paint that it got on the way of the brush, so that neither the speed of the hand nor
    the number of frames changes the result, and rubbing to and fro does not pile up; that is what another stroke is for.
    """

    def __init__(self, brush: Brush, sheet: Sheet, before: Floats, action: str) -> None:
        """``before``: the map, (rows, columns), 0 to 1. ``action``: "raise", "lower" or "smooth"."""
        self._brush = brush
        self._sheet = sheet
        self._before = before
        self._toward = _smoothed(before, sheet, brush.radius) if action == "smooth" else before
        self._sign = {"raise": 1.0, "lower": -1.0, "smooth": 0.0}[action]
        self._paint = np.zeros(before.shape)
        self._last: Floats | None = None

    def move(self, place: Floats) -> None:
        """The brush goes straight on to ``place`` [m], (3,)."""
        start = place if self._last is None else self._last
        self._put(start, place)
        if self._brush.mirror:
            self._put(self._mirrored(start), self._mirrored(place))
        self._last = place

    @property
    def result(self) -> Floats:
        """The map as it is now, (rows, columns), 0 to 1."""
        paint = self._brush.strength * self._paint
        if self._sign:
            return np.clip(self._before + self._sign * paint, 0.0, 1.0)
        # Smoothing has no amount of its own: at full strength all that is uneven below the brush goes.
        return self._before + np.minimum(2 * paint, 1.0) * (self._toward - self._before)

    def _put(self, start: Floats, end: Floats) -> None:
        """Paint along a straight way [m], (3,) each."""
        places, radius = self._sheet.places, self._brush.radius
        low, high = np.minimum(start, end) - radius, np.maximum(start, end) + radius
        near = np.flatnonzero(((places >= low) & (places <= high)).all(axis=2))
        way = end - start
        offset = places.reshape(-1, 3)[near] - start
        along = np.clip(offset @ way / max(float(way @ way), 1e-18), 0.0, 1.0)
        distance = np.linalg.norm(offset - along[:, None] * way, axis=1) / radius
        inside = distance < 1
        texels = near[inside]
        paint = self._paint.reshape(-1)
        paint[texels] = np.maximum(paint[texels], FALLOFFS[self._brush.falloff](distance[inside]))

    def _mirrored(self, place: Floats) -> Floats:
        return np.array([2 * self._sheet.middle - place[0], place[1], place[2]])


def _smoothed(values: Floats, sheet: Sheet, radius: float) -> Floats:
    """``values`` without what is finer than half a brush of ``radius`` [m]."""
    down, across = (np.linalg.norm(np.diff(sheet.places, axis=axis), axis=2) for axis in (0, 1))
    texel = np.array([np.median(down), np.median(across)])
    return gaussian_filter(values, 0.5 * radius / np.maximum(texel, 1e-6), mode="nearest")
