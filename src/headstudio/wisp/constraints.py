"""The three styling constraints and the force fields Psi they make (Choe, Ko 2005, section 4, figure 10).

Places are in metres in the head frame. A wisp does not go for the middle of a tie or a path but for a lane of its own
beside it: ``lanes`` are places in the unit ball, (k, 3), and half the tolerance is what they are multiplied with. So a
thousand wisps make a lock and not a thread.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from ..head.rows import row_unit
from .ears import before_ears
from .surroundings import Surroundings

LANE = 0.5  # part of the tolerance that lanes take up
SAMPLING = 0.0025  # of trajectories [m]

# Hair that is held is taut: Psi of a point or a trajectory is so many times the stiffness that it works against, however
# stiff the hair. Off a trajectory by the tolerance it is ASTRAY more; so many segments from a point, NEAR over their
# square.
_TAUT, _ASTRAY, _NEAR = 1.3, 2.5, 200.0
# From the last so many segments on, a wisp takes a bow that makes a joint end on the point.
_BOW = 6
_AHEAD = 1.5  # how far ahead on a trajectory a wisp aims, in segments
# What hair is led away from, in proportions of the head, while it is so near to the skin [m].
_FACE, _BESIDE_SKIN = np.array([0.0, -1.0, 1.2]), 0.03
_RISE = 1.0  # how much hair on its way back rises before an ear, against the way itself
_PRESS = 0.05  # at this distance from a tie hair may be twice as dense as elsewhere [m]


@dataclass(frozen=True)
class Joint:
    """What all joints have in common: the length of a segment [m] and its stiffness, kappa of eq. 5 for this length."""

    segment: float
    stiffness: float


@dataclass(frozen=True, eq=False)
class Pull:
    """What a constraint does to wisps: psi, the vectors Psi, (k, 3); weight, w of eq. 7, (k,); press, how many times
    denser than elsewhere hair may lie, (k,), infinite where it may be pressed together at will.
    """

    psi: Floats
    weight: Floats
    press: Floats


@dataclass(frozen=True, eq=False)
class Progress:
    """Where wisps stand: along, how far on the trajectory, in samples, (k,); met, who has met the constraint, (k,); done,
    who is through with it, (k,).
    """

    along: NDArray[np.int64]
    met: NDArray[np.bool_]
    done: NDArray[np.bool_]


class Constraint(Protocol):
    """What a queue asks of a constraint, whichever of the three it is."""

    def begin(self, ends: Floats, lanes: Floats) -> Progress:
        """The wisps whose ends are at ``ends`` [m], (k, 3), come under the constraint."""

    def pull(self, ends: Floats, lanes: Floats, progress: Progress, joint: Joint) -> Pull:
        """What it does to the next segment."""

    def judge(self, ends: Floats, lanes: Floats, progress: Progress) -> Progress:
        """Where the wisps stand after that segment."""

    def widest(self, ends: Floats, progress: Progress) -> Floats:
        """The largest radius of a wisp there [m], (k,)."""


@dataclass(frozen=True, eq=False)
class PointConstraint:
    """Draws hair to ``point`` [m], (3,), until it is within ``tolerance`` [m]. Around ``surroundings``' head it takes the way
    over the scalp; without any it goes straight.
    """

    point: Floats
    tolerance: float
    weight: float = 1.0
    surroundings: Surroundings | None = None

    def begin(self, ends: Floats, lanes: Floats) -> Progress:
        """See Constraint."""
        near = self._distance(ends) <= self.tolerance
        return Progress(np.zeros(len(ends), dtype=np.int64), near, near.copy())

    def pull(self, ends: Floats, lanes: Floats, progress: Progress, joint: Joint) -> Pull:
        """Toward the wisp's lane through the point; near it harder, in a bow whose joints come out even."""
        way = self.point + LANE * self.tolerance * lanes - ends
        distance = np.linalg.norm(way, axis=1)
        segments = distance / joint.segment
        urgency = (1.0 + joint.stiffness) * (_TAUT + _NEAR / np.maximum(segments, 0.5) ** 2)
        toward = row_unit(way, otherwise=np.broadcast_to([0.0, -1.0, 0.0], way.shape))
        outward = np.broadcast_to([0.0, -1.0, 0.0], way.shape)
        if self.surroundings is not None:
            over, outward = _over_scalp(self.surroundings, ends, toward)
            toward = np.where((segments > _BOW)[:, None], over, toward)
        psi = urgency[:, None] * _bowed(toward, outward, segments, (1 - LANE) * 0.8 * self.tolerance / joint.segment)
        press = 1.0 + (_PRESS / np.maximum(self._distance(ends) - self.tolerance, 1e-3)) ** 2
        return Pull(psi, np.full(len(ends), self.weight), press)

    def judge(self, ends: Floats, lanes: Floats, progress: Progress) -> Progress:
        """Met, and done with, as soon as a joint is within the tolerance."""
        met = progress.met | (self._distance(ends) <= self.tolerance)
        return Progress(progress.along, met, met)

    def widest(self, ends: Floats, progress: Progress) -> Floats:
        """What fits beside the lane at the point, and more the farther away."""
        return (1 - LANE) * 0.9 * self.tolerance + 0.4 * np.maximum(self._distance(ends) - self.tolerance, 0.0)

    def _distance(self, ends: Floats) -> Floats:
        return np.linalg.norm(ends - self.point, axis=1)


def _over_scalp(surroundings: Surroundings, ends: Floats, toward: Floats) -> tuple[Floats, Floats]:
    """Unit directions, (k, 3), to something that may lie behind the head, and away from the skin, (k, 3).

    Where the straight way goes into the skin hair turns away from the face, as a comb would lead it, since along the
    skin both ways around may look alike. Before an ear it rises, to pass above it.
    """
    distance, outward = surroundings.distance_and_gradient(ends)
    blocked = np.clip(-np.einsum("ij,ij->i", toward, outward), 0.0, 1.0) * (distance < _BESIDE_SKIN)
    from_face = row_unit(ends - surroundings.proportions.place(_FACE), otherwise=toward)
    rise = before_ears(surroundings.proportions.measure(ends)) * (toward[:, 2] < 0)
    over = toward + blocked[:, None] * from_face + _RISE * rise[:, None] * np.array([0.0, 1.0, 0.0])
    return row_unit(over, otherwise=toward), outward.astype(np.float64)


def _bowed(toward: Floats, outward: Floats, segments: Floats, slack: float) -> Floats:
    """Unit directions, (k, 3), that start a bow of equal segments to a point ``segments`` of them away, (k,), and ``toward``
    it, (k, 3). The bow stands out to the side of ``outward``, (k, 3), where there is room. To end ``slack`` segments short is
    near enough.

    Segments of one length reach a point in a straight line only from a whole number of them away. Else n of them make an
    arc whose chord is the distance; its first segment leaves the chord by (n - 1) / 2 of the angle at a joint. The arc's
    chord is s sin(n a / 2) / sin(a / 2), exact here for two segments and to the fourth order of a for more.
    """
    count = np.ceil(segments - slack)
    bowing = (count >= 2) & (count <= _BOW)
    count = np.where(bowing, count, 2.0)
    part = np.clip(np.where(bowing, segments, 2.0) / count, 0.0, 1.0)
    angle = np.where(count == 2, 2.0 * np.arccos(part), np.sqrt(24.0 * (1.0 - part) / (count**2 - 1.0)))
    off = np.clip(0.5 * (count - 1.0) * angle, 0.0, 1.3)[:, None]
    least = np.eye(3)[np.abs(toward).argmin(axis=1)]
    free = outward - np.einsum("ij,ij->i", outward, toward)[:, None] * toward
    return np.cos(off) * toward + np.sin(off) * row_unit(
        free, otherwise=row_unit(np.cross(toward, least), otherwise=least)
    )


@dataclass(frozen=True, eq=False)
class _Path:
    """A polyline [m], (n, 3), resampled evenly."""

    points: Floats

    @cached_property
    def samples(self) -> Floats:
        """Points every SAMPLING [m] or a little less, (m, 3)."""
        return np.stack([self.sampled(self.points[:, k]) for k in range(3)], axis=1)

    def sampled(self, values: Floats) -> Floats:
        """Values that are known at the points, (n,), at the samples, (m,)."""
        steps = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        length = np.concatenate([[0.0], np.cumsum(steps)])
        even = np.linspace(0.0, length[-1], max(int(np.ceil(length[-1] / SAMPLING)), 1) + 1)
        return np.interp(even, length, values)

    @cached_property
    def tangents(self) -> Floats:
        """Unit tangents at the samples, (m, 3)."""
        slope = np.gradient(self.samples, axis=0)
        return row_unit(slope, otherwise=np.broadcast_to([0.0, -1.0, 0.0], slope.shape))

    def nearest(self, places: Floats, within: float = 0.0) -> NDArray[np.int64]:
        """The sample nearest to each place [m], (k,); of samples that are farther by no more than ``within`` [m] the first."""
        distance = np.sqrt(((places[:, None] - self.samples) ** 2).sum(axis=2))
        return (distance <= distance.min(axis=1, keepdims=True) + within).argmax(axis=1)

    def onward(self, places: Floats, along: NDArray[np.int64], reach: float) -> NDArray[np.int64]:
        """The nearest sample at most ``reach`` [m] onward from ``along``, (k,): never back, and no leap to a strand of
        the path that passes close by.
        """
        window = np.arange(int(np.ceil(reach / SAMPLING)) + 1)
        index = np.minimum(along[:, None] + window, len(self.samples) - 1)
        squared = ((places[:, None] - self.samples[index]) ** 2).sum(axis=2)
        return index[np.arange(len(places)), squared.argmin(axis=1)]


@dataclass(frozen=True, eq=False)
class TrajectoryConstraint:
    """Leads hair along a trajectory, a polyline [m], (n, 3), within ``tolerance`` [m], one for all of it or one at each of
    its points, (n,): toward it from outside, along it inside. The two are joined smoothly: a wisp aims at a place a little
    ahead on its lane.
    """

    trajectory: Floats
    tolerance: float | Floats
    weight: float = 1.0
    path: _Path = field(init=False, repr=False)
    breadth: Floats = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", _Path(np.asarray(self.trajectory, dtype=np.float64)))
        object.__setattr__(self, "breadth", self.path.sampled(np.broadcast_to(self.tolerance, len(self.trajectory))))

    def begin(self, ends: Floats, lanes: Floats) -> Progress:
        """See Constraint."""
        first = np.zeros(len(ends), dtype=np.int64)
        along = self.path.nearest(ends - self._offset(lanes, first), within=self.breadth[0])
        met = self._off(ends, lanes, along) <= self.breadth[along]
        return Progress(along, met, along >= len(self.path.samples) - 1)

    def pull(self, ends: Floats, lanes: Floats, progress: Progress, joint: Joint) -> Pull:
        """Along the trajectory, and toward it in the measure of the distance."""
        ahead = round(_AHEAD * joint.segment / SAMPLING)
        goal = np.minimum(progress.along + ahead, len(self.path.samples) - 1)
        way = self.path.samples[goal] + self._offset(lanes, goal) - ends
        astray = np.minimum(self._off(ends, lanes, progress.along) / self.breadth[progress.along], 1.0)
        psi = ((1.0 + joint.stiffness) * (_TAUT + _ASTRAY * astray))[:, None] * row_unit(
            way, otherwise=self.path.tangents[progress.along]
        )
        return Pull(psi, np.full(len(ends), self.weight), np.full(len(ends), np.inf))

    def judge(self, ends: Floats, lanes: Floats, progress: Progress) -> Progress:
        """Met once inside the tolerance; done with at the end of the trajectory."""
        along = self.path.onward(ends - self._offset(lanes, progress.along), progress.along, 0.04)
        met = progress.met | (self._off(ends, lanes, along) <= self.breadth[along])
        # A sample before the last is the end: the last may be nearest to a place beside it only.
        return Progress(along, met, along >= len(self.path.samples) - 2)

    def widest(self, ends: Floats, progress: Progress) -> Floats:
        """What fits beside the lanes."""
        return (1 - LANE) * 0.9 * self.breadth[progress.along]

    def _offset(self, lanes: Floats, along: NDArray[np.int64]) -> Floats:
        return LANE * self.breadth[along, None] * lanes

    def _off(self, ends: Floats, lanes: Floats, along: NDArray[np.int64]) -> Floats:
        return np.linalg.norm(ends - self._offset(lanes, along) - self.path.samples[along], axis=1)


@dataclass(frozen=True, eq=False)
class DirectionConstraint:
    """Combs hair along a trajectory, a polyline [m], (n, 3), wherever it is within ``radius`` [m] of it."""

    trajectory: Floats
    radius: float
    weight: float = 0.8
    path: _Path = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", _Path(np.asarray(self.trajectory, dtype=np.float64)))

    def begin(self, ends: Floats, lanes: Floats) -> Progress:
        """See Constraint."""
        nobody = np.zeros(len(ends), dtype=bool)
        along = self.path.nearest(ends)
        return Progress(along, self._within(ends, along), nobody)

    def pull(self, ends: Floats, lanes: Floats, progress: Progress, joint: Joint) -> Pull:
        """Along the tangent of the nearest place, inside the radius; nothing outside."""
        within = self._within(ends, progress.along)
        return Pull(self.path.tangents[progress.along], np.where(within, self.weight, 0.0), np.ones(len(ends)))

    def judge(self, ends: Floats, lanes: Floats, progress: Progress) -> Progress:
        """Met once inside; done with when it has come out again, or to the end."""
        along = self.path.nearest(ends)
        within = self._within(ends, along)
        met = progress.met | within
        return Progress(along, met, met & (~within | (along >= len(self.path.samples) - 1)))

    def widest(self, ends: Floats, progress: Progress) -> Floats:
        """A comb does not press hair together."""
        return np.full(len(ends), np.inf)

    def _within(self, ends: Floats, along: NDArray[np.int64]) -> NDArray[np.bool_]:
        return np.linalg.norm(ends - self.path.samples[along], axis=1) <= self.radius
