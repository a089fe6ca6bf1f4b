"""Hair that lies on the body, or is at the end of its reach, within the solution of an implicit step.

Springs press it on the body and draw it along. If it were stopped only after the solution, they would not know until the
next step, and the force of the body would lag behind by many. So what the springs are solved for is

    A dv = b + g lambda n,     n . (v + dv - v_b) >= w,     lambda >= 0,

with v_b the velocity of the body, n its normal, w the least departure of contact.py and lambda the force that holds a
particle, which is zero wherever it leaves faster than that. Coulomb's friction mu lambda across n (eq. 3.22, 3.23) is a
drag, mu lambda / |slip| times the slip v + dv - v_b across n. Which particles are held, and how strongly they are dragged,
is taken from the step before and then from a first, rough solution. Hair that is taut is held alike, by a plane square to
its root.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from ..head.rows import row_dot, row_length, rows_at
from .contact import LONGEST_REACH, RESTING, Touching, least_departure
from .model import HairModel
from .spring_matrix import SpringMatrix

_ROUGHLY = 10.0  # times the tolerance: good enough to tell which particles are held
_STICKING = 0.005  # hair that would slide more slowly sticks [m/s]
_SLACK = 1e-4  # what rounding may do to a speed [m/s]


@dataclass(frozen=True, eq=False)
class Meeting:
    """What the body asks of the velocities that a step ends with.

    touch: the planes that the particles are heading for. distance: of where they start from [m], (n,). slip: what they are
    faster than the body there at present [m/s], (n, 3). leaving: the part of it along the normal, and least: how large that
    must become [m/s], (n,). lies: True where a particle is heading for a place on the body, (n,).
    """

    touch: Touching
    distance: Floats
    slip: Floats
    leaving: Floats
    least: Floats
    lies: NDArray[np.bool_]
    rubs: NDArray[np.bool_]

    @classmethod
    def ahead(cls, touch: Touching, velocities: Floats, dt: float) -> Meeting:
        """For planes seen from where particles with ``velocities`` [m/s], (n, 3), come to in dt [s]."""
        slip = velocities - touch.velocity
        leaving = row_dot(slip, touch.normals)
        distance = touch.distance - dt * leaving
        least = least_departure(touch, distance, dt)
        lies = touch.distance <= touch.keep + RESTING
        return cls(touch, distance, slip, leaving, least, lies, np.ones_like(lies))

    def taut(self, model: HairModel, ahead: Floats, velocities: Floats, dt: float) -> Meeting:
        """The same with what is taut: hair that ``velocities`` [m/s] lead to ``ahead`` [m] in dt [s], beyond its reach.

        ahead, velocities: (n, 3). It meets a plane square to its root, without friction, instead of its own. Hair that meets
        the body as well is left to stop_at_reach.
        """
        outward = ahead - model.root_points
        reach = row_length(outward)
        over = reach - LONGEST_REACH * model.arc_length
        which = np.flatnonzero((over > 0) & ~model.fixed & ~self.lies & (self.leaving >= self.least))
        normals = self.touch.normals.copy(order="K")
        normals[which] = -outward[which] / reach[which, None]
        leaving, least, slip, rubs = self.leaving.copy(), self.least.copy(), self.slip.copy(), self.rubs.copy()
        slip[which] = velocities[which]
        leaving[which] = row_dot(velocities[which], normals[which])
        least[which] = leaving[which] + over[which] / dt
        rubs[which] = False
        return replace(
            self, touch=replace(self.touch, normals=normals), slip=slip, leaving=leaving, least=least, rubs=rubs
        )

    def distance_after(self, change: Floats, dt: float) -> Floats:
        """Distance of the particles [m], (n,), when dt [s] pass with ``change`` [m/s], (n, 3), more velocity than now."""
        return self.distance + dt * (self.leaving + row_dot(change, self.touch.normals))


def solve_at_body(
    matrix: SpringMatrix,
    right: Floats,
    guess: Floats,
    meeting: Meeting,
    fixed: NDArray[np.bool_],
    pressing: Floats,
    friction: float,
    g: float,
    tolerance: float,
) -> tuple[Floats, Floats]:
    """The change of velocity dv [m/s], (n, 3), and the forces lambda with which the body holds particles [N], (n,).

    matrix: A, filled. right: b [kg m/s], and guess: of dv [m/s], (n, 3). fixed: root particles, (n,). pressing: lambda of
    the step before. friction: mu. g: of A [s]. tolerance: of the solution, as a part of b.
    """
    normals = meeting.touch.normals
    held = ~fixed & ((meeting.leaving < meeting.least - _SLACK) | (meeting.lies & (pressing > 0)))
    change = guess
    for rest in (_ROUGHLY * tolerance, tolerance):
        which = np.flatnonzero(held)
        normal = rows_at(normals, which)
        slip = rows_at(meeting.slip, which) - meeting.leaving[which, None] * normal
        across = _across(rows_at(change, which), normal)
        sliding = slip + across
        speed = row_length(sliding)
        drag = g * friction * meeting.rubs[which] * pressing[which] / np.maximum(speed, _STICKING)
        matrix.hold(which, normal, drag)
        dragged, start = right.copy(order="K"), change.copy(order="K")
        dragged[which] -= drag[:, None] * slip
        start[which] = across + (meeting.least - meeting.leaving)[which, None] * normal
        change, left = matrix.solve(dragged, start, rest)
        force = -row_dot(left, normals) / g
        held = np.where(held, force > 0, ~fixed & (meeting.leaving + _along(change, normals) < meeting.least - _SLACK))
        pressing = np.zeros(len(force))
        pressing[which] = np.maximum(force[which], 0.0)
    return change, pressing


def _across(vectors: Floats, normals: Floats) -> Floats:
    """The parts of ``vectors`` across unit ``normals``, (n, 3) each."""
    return vectors - _along(vectors, normals)[:, None] * normals


def _along(vectors: Floats, normals: Floats) -> Floats:
    return row_dot(vectors, normals)
