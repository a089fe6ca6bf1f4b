"""A parting: a line on the scalp that hair leans away from, and that no wisp reaches across."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from ..head.scalp import Scalp
from ..params import ParameterError
from .settings import CurvePoints, WispSettings

_LINES: Mapping[str, CurvePoints] = {
    "none": (),
    "centre": ((0.5, 0.0), (0.5, 0.42)),
    "left": ((0.63, 0.0), (0.6, 0.22), (0.54, 0.42)),
    "right": ((0.37, 0.0), (0.4, 0.22), (0.46, 0.42)),
    "zigzag": ((0.5, 0.0), (0.54, 0.06), (0.46, 0.13), (0.54, 0.2), (0.46, 0.27), (0.54, 0.34), (0.5, 0.42)),
    "to nape": ((0.5, 0.0), (0.5, 1.0)),
}
_SPACING = 0.001  # between the points that stand for the line [m]
# Skin this near to the line is told apart by its side [m].
_APART = 0.015
# Hair that grows as far from the line as this is in no doubt about its side [m].
_TURN = 0.02
# The line itself is bare, and a comb draws hair from so far to its edge: half its breadth, and how far [m].
_BARE, _DRAWN = 0.0007, 0.010
# A line that ends this near to the border of the square goes on so far beyond it [m].
_BORDER, _BEYOND = 0.03, 0.02


@dataclass(frozen=True, eq=False)
class Parting:
    """A line on the skin as points [m], (k, 3), a millimetre apart, with unit vectors to its left on the skin, (k, 3). Where
    it ends at the border of the scalp it goes straight on for a little.

    reach: how far from the line hair leans away from it [m].
    """

    points: Floats
    leftward: Floats
    reach: float

    @classmethod
    def of(cls, scalp: Scalp, settings: WispSettings) -> Parting | None:
        """The parting that the settings ask for, if any. Raises ParameterError for a drawn line that is none."""
        line = settings.parting_line or _LINES[settings.parting]
        return cls._along(scalp, line, settings.parting_reach) if line else None

    @classmethod
    @lru_cache(maxsize=4)
    def _along(cls, scalp: Scalp, points_uv: CurvePoints, reach: float) -> Parting:
        line = np.array(points_uv, dtype=np.float64)
        if line.ndim != 2 or line.shape[1] != 2 or len(line) < 2 or not np.isfinite(line).all():
            raise ParameterError("a parting is a line of two or more points (u, v)")
        uv = _evenly(line, 400)
        points = _beyond_border(_evenly(scalp.points(uv), None), uv)
        along = np.gradient(points, axis=0)
        leftward = np.cross(scalp.normals(scalp.locate(points)), along)
        length = np.linalg.norm(leftward, axis=1, keepdims=True)
        return cls(points, leftward / np.maximum(length, np.finfo(float).tiny), reach)

    def detour(self, points: Floats) -> Floats:
        """How far aside of the line points of the skin [m], (n, 3), are taken to be, in a fourth direction [m], (n,).

        It keeps the two banks of the parting apart: across the line it jumps, and it is zero away from it. Who measures
        distance in these four coordinates finds no neighbours on the other bank.
        """
        return self._short_of(_APART, points)[0]

    def aside(self, points: Floats) -> Floats:
        """How far aside of where it is hair that grows at ``points`` [m], (n, 3), feels a force field [m], (n, 3).

        A field turns from one side of the parting to the other over some breadth, and its own parting may lie a little
        beside the line. So hair that grows nearer to the line than that feels what hair on its bank feels at that
        distance: it would else hang between the banks, over the face.
        """
        short, index = self._short_of(_TURN, points)
        return short[:, None] * self.leftward[index]

    def distance(self, points: Floats) -> Floats:
        """How far from the line points of the skin are [m], (n, 3): (n,)."""
        distance: Floats = self._tree.query(points)[0]
        return distance

    def drawn(self, roots: Floats) -> Floats:
        """Roots of hair [m], (n, 3), where a comb takes them: nearer to the line, and not onto it; each stays on its bank."""
        distance, index = self._tree.query(roots, distance_upper_bound=_DRAWN)
        near = np.flatnonzero(np.isfinite(distance))
        across = self.leftward[index[near]]
        side = np.einsum("ij,ij->i", roots[near] - self.points[index[near]], across)
        wanted = _BARE + (1.0 - _BARE / _DRAWN) * side**2 / _DRAWN
        drawn = roots.copy()
        drawn[near] += (np.copysign(wanted, side) - side)[:, None] * across
        return drawn

    def _short_of(self, reach: float, points: Floats) -> tuple[Floats, Ints]:
        """By how much points, (n, 3), are nearer to the line than ``reach`` [m], (n,), negative on the right of it, and
        next to which of its points, (n,).
        """
        distance, index = self._tree.query(points)
        side = np.sign(np.einsum("ij,ij->i", points - self.points[index], self.leftward[index]))
        return side * np.maximum(reach - distance, 0.0), index

    def lean(self, points: Floats, normals: Floats, flow: Floats) -> Floats:
        """Unit directions along the skin in which hair lies, (n, 3): away from the line near it, ``flow`` far from it.

        points: on the skin [m], normals: of the skin, flow: unit or zero, (n, 3) each.
        """
        distance, index = self._tree.query(points)
        away = points - self.points[index]
        away -= np.einsum("ij,ij->i", away, normals)[:, None] * normals
        weight = np.exp(-((distance / self.reach) ** 2))[:, None]
        return unit((1 - weight) * flow + weight * unit(away))

    @property
    def _tree(self) -> cKDTree:
        return cKDTree(self.points)


def _beyond_border(points: Floats, uv: Floats) -> Floats:
    """A line [m], (k, 3), that goes straight on where it ends at the border of the scalp: hair at its end falls to either
    side of it, too, and not over the face. uv: of its ends and what lies between, (n, 2).
    """
    onward = np.arange(1, round(_BEYOND / _SPACING) + 1)[:, None]
    steps = min(len(points) - 1, 5)
    ends = [points]
    if _at_border(uv[0]):
        ends.insert(0, points[0] + onward[::-1] * (points[0] - points[steps]) / steps)
    if _at_border(uv[-1]):
        ends.append(points[-1] + onward * (points[-1] - points[-1 - steps]) / steps)
    return np.concatenate(ends)


def _at_border(place: Floats) -> bool:
    return bool(min(*place, *(1.0 - place)) < _BORDER)


def unit(vectors: Floats) -> Floats:
    """Vectors, (..., 3), at unit length; zero stays zero."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)


def _evenly(line: Floats, count: int | None) -> Floats:
    """Points along a polyline, (k, d), evenly spaced: ``count`` of them, or one a millimetre."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    wanted = count or max(int(length[-1] / _SPACING) + 1, 2)
    at = np.linspace(0.0, length[-1], wanted)
    return np.stack([np.interp(at, length, column) for column in line.T], axis=1)
