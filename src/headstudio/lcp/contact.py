"""Hair that touches the body, and hair at the end of its reach (thesis, section 3.5).

Both are one-sided: a particle may leave a plane but not pass it. They act on the velocity that a step ends with, which
holds all the forces of the step already, so the impulse that stops a particle is f_c dt of the thesis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..head.rows import row_dot, row_length, rows_at
from .body import Body
from .links import LENGTHWISE
from .model import HairModel

# Hair this much longer than its arc length is drawn back: it stretches no further, however it is pulled.
LONGEST_REACH = 1.025
_LAST_REACH = 1.04
LONGEST_LINK = 1.08
# Time in which hair below the surface comes out again [s]. As a force (eq. 3.24) it would lose against a stiff spring.
_EMERGENCE = 0.03
_DEEPEST = 0.001  # that hair may be below the surface at the end of a step [m]
RESTING = 0.001
"""Hair this close to where it touches lies on the body [m]."""
_THICKNESS = 0.5  # of the mean distance of particles: where the surface of a particle's hair touches the body
_BEGINNING = 3.0  # of it: so much of a hair may lie closer to the skin than that
# A pull toward the root that would lead into the body goes along it instead, unless it stands this steep on it.
_STEEPEST = 0.3


@dataclass(frozen=True, eq=False)
class Touching:
    """The plane nearest to every particle: distance d [m], (n,), unit normal and velocity of the body [m/s], (n, 3).

    keep: the distance at which the particle touches [m], (n,): less next to the scalp, where hair begins closer to the
    skin than that, and below zero where a plane is too coarse for the skin that hair lies on.
    """

    distance: Floats
    normals: Floats
    velocity: Floats
    keep: Floats


def touching(model: HairModel, body: Body, positions: Floats, frame: HeadFrame) -> Touching:
    """Where the body is, seen from every particle (eq. 3.19). positions: head frame [m], (n, 3)."""
    planes = body.planes(positions, frame)
    thickness = _THICKNESS * model.spacing
    begins = (model.arc_length < _BEGINNING * model.spacing) | (model.rest_clearance < 0)
    keep = np.where(begins, np.minimum(thickness, model.rest_clearance), thickness)
    return Touching(planes.distance, planes.normals, planes.velocity, keep)


def least_departure(touch: Touching, distance: Floats, dt: float) -> Floats:
    """How fast a particle must at least leave its plane, so that dt [s] do not lead it into the body [m/s], (n,).

    distance: of the positions that the step starts from [m], (n,). Negative as long as it is free to approach: eq. 3.21 is
    the limit of a small step. Positive below the surface, where hair comes out (3.24).
    """
    depth = np.maximum(np.minimum(touch.keep, 0.0) - distance, 0.0)
    return np.where(depth > 0, depth / max(_EMERGENCE, dt), -np.maximum(distance - touch.keep, 0.0) / dt)


def stop_at_body(
    velocities: Floats, touch: Touching, distance: Floats, friction: float, dt: float
) -> tuple[Floats, Floats]:
    """Velocities [m/s] that do not lead into the body within dt [s], (n, 3), and what that took along the normal, (n,).

    distance: of the positions that the step starts from [m], (n,). Eq. 3.20 and 3.21 stop the normal part, 3.22 and 3.23
    (Coulomb, coefficient ``friction``) slow down the tangential one, and what is below the surface comes out (3.24).
    """
    approach = row_dot(velocities - touch.velocity, touch.normals)
    least = least_departure(touch, distance, dt)
    change = np.maximum(least - approach, 0.0)
    meets = np.flatnonzero(change > 0)
    # Friction answers what stops hair, not what lets it come out.
    impulse = np.maximum(np.minimum(least[meets], 0.0) - approach[meets], 0.0)
    normals = touch.normals.take(meets, axis=0)
    sliding = velocities.take(meets, axis=0) - touch.velocity.take(meets, axis=0) - approach[meets, None] * normals
    speed = row_length(sliding)
    braked = np.minimum(friction * impulse, speed) / np.maximum(speed, 1e-12)
    stopped = velocities.copy(order="K")
    stopped[meets] += change[meets, None] * normals - braked[:, None] * sliding
    return stopped, change


def put_back(model: HairModel, positions: Floats, touch: Touching, distance: Floats) -> Floats:
    """Positions [m], (n, 3), at ``distance`` from their planes [m], (n,), with what one step could not stop put back.

    None is deeper than ``_DEEPEST`` below its plane, then none further from its root than ``_LAST_REACH`` times its length.
    """
    back = positions.copy(order="K")
    deep = np.flatnonzero((np.minimum(touch.keep, 0.0) - _DEEPEST > distance) & ~model.fixed)
    excess = np.minimum(touch.keep[deep], 0.0) - _DEEPEST - distance[deep]
    back[deep] += excess[:, None] * touch.normals[deep]
    from_root = back - model.root_points
    reach = row_length(from_root)
    far = np.flatnonzero((reach > _LAST_REACH * model.arc_length) & ~model.fixed)
    share = _LAST_REACH * model.arc_length[far] / reach[far]
    back[far] = model.root_points[far] + share[:, None] * from_root[far]
    return back


class Tethers:
    """What keeps hair from being left far behind by the hair that it continues.

    What squeezes between head and torso can hold hair so fast that its springs would have to pull for many steps. A
    particle follows those of its rootward links that run along the hair and still hold, and its lifeline in any case.
    """

    def __init__(self, model: HairModel) -> None:
        lifeline = np.zeros(len(model.links), dtype=bool)
        lifeline[model.lifeline[model.lifeline >= 0]] = True
        chosen = np.flatnonzero(lifeline | (model.alignment >= LENGTHWISE))
        self._rootward, self._tipward = np.ascontiguousarray(model.links[chosen].T)
        self._longest = LONGEST_LINK * model.rest_length[chosen]
        self._holds_until = np.where(lifeline[chosen], np.inf, 2.0 * model.smoothing_length_links)

    def drawn_along(self, positions: Floats) -> Floats:
        """Positions [m], (n, 3), where what was left behind has followed."""
        offset = rows_at(positions, self._tipward) - rows_at(positions, self._rootward)
        square = row_dot(offset, offset)
        far = np.flatnonzero((square > self._longest**2) & (square < self._holds_until**2))
        if len(far) == 0:
            return positions
        length = np.sqrt(square[far])
        behind, count = self._tipward[far], len(positions)
        way = (self._longest[far] / length - 1.0)[:, None] * offset[far]
        share = 1.0 / np.bincount(behind, minlength=count)[behind]
        drawn = positions.copy(order="K")
        for axis in range(3):
            drawn[:, axis] += np.bincount(behind, share * way[:, axis], count)
        return drawn


def stop_at_reach(
    model: HairModel, positions: Floats, velocities: Floats, touch: Touching, distance: Floats, dt: float
) -> Floats:
    """Velocities [m/s] that do not lead further from the root than the hair is long, (n, 3).

    positions: those that the step starts from [m], (n, 3), at ``distance`` from the body [m], (n,). Not in the paper: its
    springs alone let go for good of what a hard stop has once torn off. Hair that touches the body is drawn along it.
    """
    ahead = positions + dt * velocities - model.root_points
    reach = row_length(ahead)
    far = np.flatnonzero((reach > LONGEST_REACH * model.arc_length) & ~model.fixed)
    over = reach[far] - LONGEST_REACH * np.maximum(model.arc_length[far], 0.0)
    back, normals = -ahead[far] / reach[far, None], touch.normals[far]
    inward = row_dot(back, normals)
    touches = (distance[far] <= touch.keep[far]) & (inward < 0)
    along = back - np.where(touches, inward, 0.0)[:, None] * normals
    # Going along the body brings less per way than the straight one: |along|^2 of it.
    gain = np.maximum(row_dot(along, along), _STEEPEST**2)
    stopped = velocities.copy(order="K")
    stopped[far] += (over / (dt * gain))[:, None] * along
    return stopped
