"""Headbands as hair feels them: what would stand above a band is pressed under it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from ..head.smooth import smoothstep
from .accessories import Band, band_path
from .paths import STEP
from .strands import Singles
from .surroundings import Surroundings

# How fast hair comes up again beside the band [m per m], and how far beside it is felt at all [m].
_RISE, _REACH = 0.3, 0.045
# How hard the edge is: hair as high as the band goes in by a sixth, and hair well below is left alone.
_EDGE = 4
# Behind the ears hair falls over the ends of a band: so far from them it presses on none, and on all [m].
_TUCKED = (0.02, 0.08)
_APPROACHES = 2  # the way straight to the skin bends


@dataclass(frozen=True, eq=False)
class Headband:
    """A band over the head: the middle of it [m], (n, 3), unit directions along it, (n, 3), how high hair may stand under
    it [m], (n,), how firmly it presses, 0 to 1, (n,), half its width [m], and the body it is on.
    """

    path: Floats
    along: Floats
    room: Floats
    firm: Floats
    half_width: float
    surroundings: Surroundings

    @classmethod
    def of(cls, band: Band, surroundings: Surroundings) -> Headband:
        """The band on the head of ``surroundings``."""
        path = band_path(band, surroundings)
        along = np.gradient(path, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        room = surroundings.distance(path).astype(np.float64)
        to_end = STEP * np.minimum(np.arange(len(path)), np.arange(len(path))[::-1])
        return cls(path, along, room, smoothstep(to_end, *_TUCKED), 0.5 * band.width, surroundings)

    def pressed(self, points: Singles, owner: Ints) -> Singles:
        """Strands, (n, k, 3) [m], with what stands above the band pressed under it; in place. owner: not asked for."""
        flat = points.reshape(-1, 3)
        near = self._beside(flat)
        # Between two points a strand is straight, so both beside the band have to be under it.
        spacing = np.linalg.norm(np.diff(points, axis=1), axis=2).mean(axis=1)[near // points.shape[1]]
        distance, nearest = cKDTree(self.path).query(flat[near], distance_upper_bound=2.0 * _REACH)
        met = np.flatnonzero(np.isfinite(distance))
        near, nearest, spacing = near[met], nearest[met], spacing[met]
        offset = flat[near] - self.path[nearest]
        lengthwise = np.einsum("ij,ij->i", offset, self.along[nearest])
        height = self.surroundings.distance(flat[near])
        rise = height - self.room[nearest]
        sideways = np.sqrt(np.maximum(np.einsum("ij,ij->i", offset, offset) - rise**2 - lengthwise**2, 0.0))
        # Beside the band, and beyond its ends.
        beside = np.maximum(sideways - self.half_width - 0.5 * spacing, 0.0)
        off = np.hypot(beside, np.maximum(np.abs(lengthwise) - STEP, 0.0))
        under = (off < _REACH) & (height > 0)
        near, nearest, height, off = (each[under] for each in (near, nearest, height, off))
        room = self.room[nearest] + _RISE * off
        lower = 1.0 - (1.0 + (height / room) ** _EDGE) ** (-1.0 / _EDGE)
        wanted = height * (1.0 - self.firm[nearest] * smoothstep(1.0 - off / _REACH, 0.0, 0.7) * lower)
        for _ in range(_APPROACHES):
            height, away = self.surroundings.distance_and_gradient(flat[near])
            flat[near] += (wanted - height)[:, None] * away
        return points

    def _beside(self, points: Singles) -> Ints:
        """Which of ``points``, (m, 3), may be beside the band: those near the plane it nearly lies in, (k,)."""
        middle = self.path.mean(axis=0)
        _, _, axes = np.linalg.svd(self.path - middle)
        normal = axes[2].astype(np.float32)
        bow = np.abs((self.path - middle) @ axes[2]).max()
        off = np.abs(points @ normal - np.float32(middle @ axes[2]))
        return np.flatnonzero(off < bow + self.half_width + _REACH)
