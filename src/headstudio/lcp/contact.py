"""Hair that touches the body, and hair at the end of its reach (thesis, section 3.5).

Both are one-sided: a particle may leave a plane but not pass it. They act on the velocity that a step ends with, which
holds all the forces of the step already, so the impulse that stops a particle is f_c dt of the thesis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from .body import Body
from .model import HairModel

# Hair this much longer than its arc length is drawn back: it stretches no further, however it is pulled.
LONGEST_REACH = 1.03
# (k_r / m) of eq. 3.24 [1/s^2]: hair below the surface comes out within a tenth of a second.
_REPULSION = 2500.0
_THICKNESS = 0.5  # of the mean distance of particles: where the surface of a particle's hair touches the body


@dataclass(frozen=True, eq=False)
class Touching:
    """The plane nearest to every particle: distance d [m], (n,), unit normal and velocity of the body [m/s], (n, 3).

    keep: the distance at which the particle touches [m], (n,): less for hair that grows closer to the skin than that, and
    below zero where a plane is too coarse for the skin that it grows on.
    """

    distance: Floats
    normals: Floats
    velocity: Floats
    keep: Floats


def touching(model: HairModel, body: Body, positions: Floats, frame: HeadFrame) -> Touching:
    """Where the body is, seen from every particle (eq. 3.19). positions: head frame [m], (n, 3)."""
    distance, normals, velocity = body.planes(positions, frame)
    keep = np.minimum(_THICKNESS * model.spacing, model.rest_clearance)
    return Touching(distance, np.where(np.isfinite(distance)[:, None], normals, 0.0), velocity, keep)


def repulsion(touch: Touching) -> Floats:
    """Acceleration that brings particles below the surface out again (eq. 3.24) [m/s^2], (n, 3)."""
    depth = np.maximum(np.minimum(touch.keep, 0.0) - touch.distance, 0.0)
    return _REPULSION * depth[:, None] * touch.normals


def stop_at_body(velocities: Floats, touch: Touching, distance: Floats, friction: float, dt: float) -> Floats:
    """Velocities [m/s] that do not lead into the body within dt [s], (n, 3).

    distance: of the positions that the step starts from [m], (n,). Eq. 3.20 and 3.21 stop the normal part, 3.22 and 3.23
    (Coulomb, coefficient ``friction``) slow down the tangential one.
    """
    relative = velocities - touch.velocity
    approach = np.einsum("ij,ij->i", relative, touch.normals)
    # What is still free to go before the particle touches. Eq. 3.21 is the limit of a small step.
    allowed = -np.maximum(distance - touch.keep, 0.0) / dt
    impulse = np.maximum(allowed - approach, 0.0)
    sliding = relative - approach[:, None] * touch.normals
    speed = np.sqrt(np.einsum("ij,ij->i", sliding, sliding))
    braked = np.minimum(friction * impulse, speed) / np.maximum(speed, 1e-12)
    return velocities + impulse[:, None] * touch.normals - braked[:, None] * sliding


def stop_at_reach(model: HairModel, positions: Floats, velocities: Floats, dt: float) -> Floats:
    """Velocities [m/s] that do not lead further from the root than the hair is long, (n, 3).

    positions: those that the step starts from [m], (n, 3). Not in the paper: its springs alone let go for good of what a
    hard stop has once torn off.
    """
    ahead = positions + dt * velocities - model.root_points
    reach = np.sqrt(np.einsum("ij,ij->i", ahead, ahead))
    over = reach - LONGEST_REACH * np.maximum(model.arc_length, 0.0)
    held = (over > 0) & ~model.fixed
    back = np.where(held, over / (dt * np.maximum(reach, 1e-12)), 0.0)
    return velocities - back[:, None] * ahead
