"""Scissors: strands end where they cross the plane of a cut (Choe, Ko 2005, section 6.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from .operations import EVERYWHERE, Cut, Place
from .proportions import Proportions
from .strands import Singles

# What is left of a strand that is rooted beyond a cut, as a part of its length: stubble.
_STUBBLE = 0.01
# A blade that ends in the middle of the hair curves away, and leaves no corner there: at its end by a part of its reach.
_CURVE, _POWER = 0.35, 4


@dataclass(frozen=True, eq=False)
class Blade:
    """A cut on one head: a place on the plane [m], (3,), the unit normal that points to what falls, (3,), how far from the
    place the blade reaches [m], by up to how much strands end before the plane [m], and which wisps it cuts, (W,).
    """

    place: Floats
    normal: Floats
    reach: float
    ragged: float
    wisps: NDArray[np.bool_]

    @classmethod
    def of(cls, cut: Cut, proportions: Proportions, uv: Floats) -> Blade:
        """The blade of ``cut`` on the head of ``proportions``, among wisps rooted at (u, v), (W, 2)."""
        normal = np.array(cut.normal, dtype=np.float64)
        place, normal = proportions.place(np.array(cut.place)), normal / np.linalg.norm(normal)
        return cls(place, normal, cut.reach, cut.ragged, cut.selection.of(uv))

    def kept(self, points: Singles, early: Singles) -> Singles:
        """What part of each strand the blade leaves, (n,); points of the strands [m], (n, k, 3), k evenly along each. early:
        what part of the blade's raggedness each ends before the plane, (n,).
        """
        offset = points - self.place.astype(np.float32)
        height = offset @ self.normal.astype(np.float32)
        squared = np.einsum("ijk,ijk->ij", offset, offset)
        if self.reach < EVERYWHERE:
            aside = np.maximum(squared - height**2, 0.0) / np.float32(self.reach**2)
            height -= np.float32(_CURVE * self.reach) * aside ** (_POWER // 2)
        height += np.float32(self.ragged) * early[:, None]
        crosses = (height > 0) & (squared < self.reach**2)
        last = points.shape[1] - 1
        first = np.where(crosses.any(axis=1), crosses.argmax(axis=1), last + 1)
        cut = np.flatnonzero((first > 0) & (first <= last))
        above, below = height[cut, first[cut]], height[cut, first[cut] - 1]
        part = np.ones(len(points), dtype=np.float32)
        # A blade that ends in the middle of the hair may meet a strand that is beyond its plane already.
        part[cut] = (first[cut] - np.where(below < 0, above / (above - np.minimum(below, 0)), 0)) / last
        part[first == 0] = 0.0
        return np.maximum(part, np.float32(_STUBBLE))


def cut_strands(points: Singles, owner: NDArray[np.integer], early: Singles, blades: Sequence[Blade]) -> Singles:
    """Strands cut by all ``blades``: points [m], (n, k, 3), of which each strand keeps k, closer together; in place.

    owner: the wisp of every strand, (n,). early: from 0 to 1, how early a ragged cut ends each, (n,).
    """
    for blade in blades:
        under = np.flatnonzero(blade.wisps[owner])
        parts = blade.kept(points[under], early[under])
        shorter = parts < 1.0
        points[under[shorter]] = _shortened(points[under[shorter]], parts[shorter])
    return points


def _shortened(points: Singles, parts: Singles) -> Singles:
    """The first ``parts``, (n,), of strands, (n, k, 3), through as many points."""
    last = points.shape[1] - 1
    at = parts[:, None] * np.arange(last + 1, dtype=np.float32)
    first = np.minimum(at.astype(np.int64), last - 1)
    rest = (at - first)[:, :, None]
    row = np.arange(len(points))[:, None]
    return (1 - rest) * points[row, first] + rest * points[row, first + 1]


def scissor_stroke(start: Floats, end: Floats, eye: Floats, proportions: Proportions) -> Cut:
    """The cut that a stroke of scissors from ``start`` to ``end`` makes, seen from ``eye`` [m], (3,) each.

    The plane goes through the stroke and the eye. What falls is on the side away from the middle of the skull.
    """
    normal = np.cross(end - start, eye - start)
    if normal @ (start - proportions.centre) < 0:
        normal = -normal
    middle = 0.5 * (start + end)
    return Cut(place=_triple(proportions.measure(middle)), normal=_triple(normal / np.linalg.norm(normal)))


def _triple(vector: Floats) -> Place:
    return float(vector[0]), float(vector[1]), float(vector[2])
