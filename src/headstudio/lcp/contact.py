"""Hair that touches the body (thesis, section 3.5).

What surrounds a particle is as thick as the hair that it stands for, and gives way when it is pressed. The thesis stops a
particle at a plane, all at once (eq. 3.20, 3.21), and adds a spring for what gets through (3.24). Here the spring begins
where the hair touches, with critical damping: it stops hair within its thickness, and is stiffer below the skin. Only what
no spring stops is stopped as in the thesis (limits.py). A stop at no certain instant leaves an error in proportion to the
step, and the springs of the hair know of it a step late.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..head.rows import row_dot, row_length, rows_at
from .body import Body
from .hold import Hold
from .model import HairModel

_THICKNESS = 0.5  # of the mean distance of particles: where the surface of a particle's hair touches the body
_BEGINNING = 3.0  # of it: so much of a hair may lie closer to the skin than that
# Pressed by six times its weight, hair gives way by this part of its thickness, and by so much where it begins [m].
_PRESSED = 60.0  # [m/s^2]
_GIVES = 0.4
_LEAST_GIVES = 0.001
_SKIN = 1e5  # what comes to it below the skin, k_r of eq. 3.24 for each mass [1/s^2]
_STICKING = 0.005  # hair that would slide more slowly sticks [m/s]


@dataclass(frozen=True, eq=False)
class Touching:
    """The planes nearest to particles at ``positions`` [m]: distance d [m], (n,), unit normal and velocity [m/s], (n, 3).

    keep: the distance at which the particle touches [m], (n,): less next to the scalp, where hair begins closer to the
    skin than that, and below zero where a plane is too coarse for the skin that hair lies on.
    """

    positions: Floats
    distance: Floats
    normals: Floats
    velocity: Floats
    keep: Floats

    def seen_from(self, positions: Floats, later: float = 0.0) -> Touching:
        """The same planes from other ``positions`` [m], (n, 3), when they have moved on for ``later`` [s]."""
        way = positions - self.positions
        if later:
            way -= later * self.velocity
        return replace(self, positions=positions, distance=self.distance + row_dot(way, self.normals))


def touching(model: HairModel, body: Body, positions: Floats, frame: HeadFrame) -> Touching:
    """Where the body is, seen from every particle (eq. 3.19). positions: head frame [m], (n, 3)."""
    planes = body.planes(positions, frame)
    thickness = _THICKNESS * model.spacing
    begins = (model.arc_length < _BEGINNING * model.spacing) | (model.rest_clearance < 0)
    keep = np.where(begins, np.minimum(thickness, model.rest_clearance), thickness)
    return Touching(positions, planes.distance, planes.normals, planes.velocity, keep)


def looked_again(body: Body, touch: Touching, positions: Floats, frame: HeadFrame) -> Touching:
    """``touch`` from ``positions`` [m], (n, 3), that particles have come to since.

    The same planes, but for those that may touch the body by now: in the fold of an arm that may be at another plane.
    """
    there = touch.seen_from(positions)
    close = np.flatnonzero(touch.distance < touch.keep + row_length(positions - touch.positions))
    planes = body.planes(rows_at(positions, close), frame)
    found = np.isfinite(planes.distance)  # what flew deep into the body is beyond all planes but the one it passed
    close = close[found]
    normals, velocity = touch.normals.copy(order="K"), touch.velocity.copy(order="K")
    there.distance[close], normals[close], velocity[close] = (
        of[found] for of in (planes.distance, planes.normals, planes.velocity)
    )
    return replace(there, normals=normals, velocity=velocity)


def pressed(model: HairModel, touch: Touching, velocities: Floats, friction: float) -> Hold:
    """Hair that the body presses out, and holds back where it slides.

    velocities: head frame [m/s], (n, 3). The force along the normal is f_r of eq. 3.24, with d from
    where the hair touches. Across it is Coulomb's friction of eq. 3.22 and 3.23 with the coefficient ``friction``: mu |f_r|
    against the slip, as a drag in proportion to it, and less where hair sticks.
    """
    which = np.flatnonzero((touch.distance < touch.keep) & ~model.fixed)
    normals = rows_at(touch.normals, which)
    distance, keep, mass = touch.distance[which], touch.keep[which], model.mass[which]
    deep = np.maximum(np.minimum(keep, 0.0) - distance, 0.0)
    of_hair = mass * _PRESSED / np.maximum(_GIVES * keep, _LEAST_GIVES)
    of_skin = np.where(deep > 0, mass * _SKIN, 0.0)
    stiffness = of_hair + of_skin
    push = of_hair * (keep - distance) + of_skin * deep
    slip = rows_at(velocities, which) - rows_at(touch.velocity, which)
    sliding = row_length(slip - row_dot(slip, normals)[:, None] * normals)
    return Hold(
        which,
        direction=normals,
        push=push,
        slip=slip,
        stiffness_along=stiffness,
        stiffness_across=np.zeros(len(which)),
        damping_along=2.0 * np.sqrt(stiffness * mass),
        damping_across=friction * push / np.maximum(sliding, _STICKING),
    )


def square_frequency(model: HairModel) -> Floats:
    """With which pressed hair swings at most [1/s^2], (n,)."""
    return np.where(model.fixed, 0.0, _PRESSED / _LEAST_GIVES + _SKIN)
