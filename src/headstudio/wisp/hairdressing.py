"""Hairdressing operations as queues of constraints on one head (Choe, Ko 2005, section 6.2)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch
from typing import NamedTuple

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_unit
from .braiding import plait
from .constraints import Constraint, DirectionConstraint, PointConstraint, TrajectoryConstraint
from .force import ForceField
from .operations import AlongPath, Braid, Bun, Constrain, Operation, Place, Step, Tie, ToPoint, Updo
from .paths import along_skin, hang, off_skin, sideways
from .queues import Queue
from .surroundings import Surroundings

# How much longer the locks of a plait are than the plait, and how far hair goes to a knot behind the head, in half
# diagonals of the skull.
_TAKE_UP, _TO_KNOT = 1.25, 1.0
_DOWN = np.array([[0.0, -1.0, 0.0]])
_BRAID_END = 1.2  # within how many radii of a lock the end of a plait is gathered
_LIES = 0.4  # the middle of a tail lies off the skin by this part of its greatest radius
# Of a bun: how high its dome is and how low its last winding lies, how far apart windings are, in radii of the lock; and how
# far from its middle the first begins, in radii of the bun.
_DOME, _LOWEST, _APART, _FIRST = 1.0, -0.8, 0.75, 0.1
# Of the loops of an updo: how one is turned from the one before, between which angles their circles lie on the head and stand
# on it, and to what part of their radius they are wound in the end.
_GOLDEN, _LEVEL, _STEEP, _TUCKED = 2.4, 0.35, 1.5, 0.75
_OFF_SKIN = 0.002  # a tie's edge stays so far off the skin [m]


class Grown(NamedTuple):
    """How hair widens behind a tie: full, so many times the tie's radius where it is widest; after, so far from it [m]; thin,
    at the end.
    """

    full: float
    after: float
    thin: float


_TAIL, _TUFT = Grown(4.5, 0.1, 3.0), Grown(2.2, 0.03, 1.0)


@singledispatch
def queues_of(operation: object, surroundings: Surroundings, force: ForceField, longest: float) -> tuple[Queue, ...]:
    """The queues that carry out ``operation`` on the head of ``surroundings``, on hair of at most ``longest`` [m] that hangs
    as ``force`` leads it.
    """
    raise TypeError(f"{operation!r} is no hairdressing operation")


@queues_of.register
def _constrain(
    operation: Constrain, surroundings: Surroundings, force: ForceField, longest: float
) -> tuple[Queue, ...]:
    return (Queue(operation.selection, tuple(_constraint(step, surroundings) for step in operation.steps)),)


def _constraint(step: Step, surroundings: Surroundings) -> Constraint:
    if isinstance(step, ToPoint):
        point, _ = _knot(surroundings, step.place, step.tolerance)
        return PointConstraint(point, step.tolerance, step.weight, surroundings)
    path = along_skin(surroundings, np.array(step.path), _OFF_SKIN)
    if isinstance(step, AlongPath):
        return TrajectoryConstraint(path, step.tolerance, step.weight)
    return DirectionConstraint(path, step.radius, step.weight)


@queues_of.register
def _tie(operation: Tie, surroundings: Surroundings, force: ForceField, longest: float) -> tuple[Queue, ...]:
    point, away = _knot(surroundings, operation.place, operation.tolerance)
    gather = PointConstraint(point, operation.tolerance, operation.weight, surroundings)
    tail = _tail(point + operation.lift * away, away, operation.tolerance, surroundings, force, longest)
    tail = np.concatenate([point[None], tail])
    breadth = _breadth(tail, operation.tolerance, _TAIL)
    return (Queue(operation.selection, (gather, TrajectoryConstraint(tail, breadth, operation.weight))),)


def _tail(
    start: Floats, away: Floats, radius: float, surroundings: Surroundings, force: ForceField, length: float
) -> Floats:
    """Where the middle of a tail hangs that leaves a tie of ``radius`` [m]: (n, 3) [m]."""
    return hang(surroundings, force, start, away, length, _LIES * _TAIL.full * radius)


def _breadth(path: Floats, radius: float, grown: Grown) -> Floats:
    """The radius of a tail [m], (n,), along its path, (n, 3) [m]: hair that a tie of ``radius`` [m] pressed grows full, and
    thins to its end.
    """
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    return radius * np.interp(run, [0.0, grown.after, run[-1]], [1.0, grown.full, grown.thin])


@queues_of.register
def _braid(operation: Braid, surroundings: Surroundings, force: ForceField, longest: float) -> tuple[Queue, ...]:
    """A point, then one of the interleaved trajectories for every group, then the tie at the end and a tuft behind it."""
    thickness = operation.thickness
    knot, middle = _braid_path(operation, surroundings, force, longest)
    side, front = sideways(surroundings, middle)
    width = 0.31 * thickness * operation.groups
    locks = plait(middle, side, front, operation.groups, width, 0.55 * thickness, operation.period)
    gather = PointConstraint(knot, 1.5 * thickness, 1.0, surroundings)
    end = PointConstraint(middle[-1], _BRAID_END * thickness)
    tuft = hang(surroundings, force, middle[-1], middle[-1] - middle[-2], longest, 1.5 * thickness)
    loose = TrajectoryConstraint(tuft, _breadth(tuft, _BRAID_END * thickness, _TUFT))
    return tuple(
        Queue(operation.selection, (gather, TrajectoryConstraint(lock, thickness), end, loose), part, operation.groups)
        for part, lock in enumerate(locks)
    )


def _braid_path(
    operation: Braid, surroundings: Surroundings, force: ForceField, longest: float
) -> tuple[Floats, Floats]:
    """Where a braid starts [m], (3,), and the path it lies on [m], (n, 3)."""
    knot, away = _knot(surroundings, operation.place, 1.5 * operation.thickness)
    clearance = 1.5 * operation.thickness
    if operation.path:
        return knot, along_skin(surroundings, np.array(operation.path), clearance)
    # The way to the knot takes some of the hair, and a plait is shorter than its locks.
    rest = max(longest - _TO_KNOT * float(np.linalg.norm(surroundings.proportions.extent)), 0.3 * longest)
    # A plait begins flat on the head.
    flat = row_unit(_DOWN - (_DOWN @ away) * away, otherwise=_DOWN)[0]
    return knot, hang(surroundings, force, knot, flat, operation.length * rest / _TAKE_UP, clearance)


@queues_of.register
def _bun(operation: Bun, surroundings: Surroundings, force: ForceField, longest: float) -> tuple[Queue, ...]:
    knot, away = _knot(surroundings, operation.place, operation.thickness)
    coil = _coil(knot, away, operation.radius, operation.thickness, longest)
    coil = off_skin(surroundings, coil, _LIES * operation.thickness)
    gather = PointConstraint(knot, operation.thickness, 1.0, surroundings)
    return (Queue(operation.selection, (gather, TrajectoryConstraint(coil, operation.thickness))),)


@queues_of.register
def _updo(operation: Updo, surroundings: Surroundings, force: ForceField, longest: float) -> tuple[Queue, ...]:
    knot, away = _knot(surroundings, operation.place, operation.thickness)
    gather = PointConstraint(knot, 1.5 * operation.thickness, 1.0, surroundings)
    loops = [_loop(knot, away, number, operation, longest) for number in range(operation.loops)]
    return tuple(
        Queue(operation.selection, (gather, TrajectoryConstraint(loop, operation.thickness)), part, operation.loops)
        for part, loop in enumerate(loops)
    )


@dataclass(frozen=True, eq=False)
class Grip:
    """Where an operation holds hair together: the middle [m], (3,), which way hair runs there, (3,), the radius within which
    it is held [m], and the colour of the elastic that holds it, None when none is seen.
    """

    middle: Floats
    axis: Floats
    radius: float
    colour: tuple[float, float, float] | None


def grip_of(operation: Operation, surroundings: Surroundings, force: ForceField, longest: float) -> Grip | None:
    """Where ``operation`` holds hair of at most ``longest`` [m] together as an elastic does; None when it does not."""
    if isinstance(operation, Tie):
        point, away = _knot(surroundings, operation.place, operation.tolerance)
        return Grip(point, away, operation.tolerance, operation.colour if operation.elastic else None)
    if isinstance(operation, Braid):
        middle = _braid_path(operation, surroundings, force, longest)[1]
        axis = row_unit((middle[-1] - middle[-3])[None], otherwise=_DOWN)[0]
        colour = operation.colour if operation.elastic else None
        return Grip(middle[-1], axis, _BRAID_END * operation.thickness, colour)
    return None


def _knot(surroundings: Surroundings, place: Place, radius: float) -> tuple[Floats, Floats]:
    """Where a tie of ``radius`` [m] sits for ``place``, clear of the skin [m], (3,), and the direction away from it, (3,)."""
    point = off_skin(surroundings, surroundings.proportions.place(np.array(place))[None], radius + _OFF_SKIN)
    # An ear beside a tie does not turn it.
    return point[0], surroundings.around_ears(point)[0].astype(np.float64)


def _across(away: Floats) -> tuple[Floats, Floats]:
    """Two directions across ``away``, (3,): sideways and up."""
    up = np.array([0.0, 1.0, 0.0]) if abs(away[1]) < 0.95 else np.array([0.0, 0.0, 1.0])
    side = row_unit(np.cross(up, away)[None], otherwise=np.array([[1.0, 0.0, 0.0]]))[0]
    return side, np.cross(away, side)


def _coil(knot: Floats, away: Floats, radius: float, thickness: float, length: float) -> Floats:
    """A path of ``length`` [m] that rises out of the knot, and winds around itself and down to the head: a closed dome."""
    side, up = _across(away)
    height = _DOME * thickness
    angle = np.arange(0.0, length / (0.5 * radius), 0.05)
    # Windings lie side by side, as far apart as the lock is thick, until they are as wide as the bun.
    part = np.minimum(_FIRST + angle * _APART * thickness / (2 * np.pi * radius), 1.0)
    rise = _LOWEST * thickness + (height - _LOWEST * thickness) * (1.0 - part**2) ** 0.7
    circle = np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * up
    winding = knot + radius * part[:, None] * circle + rise[:, None] * away
    stem = knot + np.linspace(0.0, 1.0, 8, endpoint=False)[:, None] * (winding[0] - knot)
    points = np.concatenate([stem, winding])
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return points[run <= length]


def _loop(knot: Floats, away: Floats, number: int, updo: Updo, length: float) -> Floats:
    """A path of ``length`` [m] that winds around a ball on the knot, as the ``number``-th of its loops: each on a great circle
    of its own, as a ball is wound of yarn.
    """
    side, up = _across(away)
    turned, tilt = number * _GOLDEN, _LEVEL + (_STEEP - _LEVEL) * (number * _GOLDEN / (2 * np.pi) % 1.0)
    aside = np.cos(turned) * side + np.sin(turned) * up
    # On the circle: what is lowest of it, where hair comes from the knot, and what is a quarter farther.
    lowest = -np.sin(tilt) * away + np.cos(tilt) * aside
    onward = np.cross(np.cos(tilt) * away + np.sin(tilt) * aside, lowest)
    turn = np.arange(0.0, length / (_TUCKED * updo.radius), 0.1)
    radius = updo.radius * np.maximum(1.0 - (1.0 - _TUCKED) * turn / (4 * np.pi), _TUCKED)
    circle = np.cos(turn)[:, None] * lowest + np.sin(turn)[:, None] * onward
    points = knot + (updo.radius - 0.5 * updo.thickness) * away + radius[:, None] * circle
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return points[run <= length]
