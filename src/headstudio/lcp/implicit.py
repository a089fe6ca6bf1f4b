"""The real-time solver: springs implicitly, everything else explicitly, second order in time.

The backward difference formula of second order (BDF2) looks at two earlier states. With x^ = (4 x_n - x_{n-1}) / 3, v^
alike and g = 2/3 of the step,

    x = x^ + g v,     M (v - v^) = g f(x, v),

is solved by one Newton step from the present velocities, with the forces that they lead to:

    (M (1 + g c + g^2 kappa) + g D + g^2 K) dv = M (v^ - (1 + g c) v) + g f(x^ + g v, v),

K and D being the stiffness and damping of the springs, kappa that of bending, c air friction. The matrix is symmetric
and positive definite (compressed links count only along themselves), its pattern never changes, and conjugate gradients
solve it, with hair that lies on the body held there (resting.py).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..head.mesh import Floats
from ..head.rows import row_dot
from .dynamics import Circumstances, Dynamics
from .inertia import apparent_acceleration
from .model import HairState
from .resting import Meeting, solve_at_body
from .settings import DynamicsSettings
from .spring_matrix import SpringMatrix

# A step has three parts for links of 3 cm, and more the shorter they are: of what a head's shake does in a part, no link
# turns far. And more, for accuracy, as long as few particles leave the time for it.
_FEWEST_PARTS, _MOST_PARTS = 3, 6
_PART_LENGTH = 0.09  # [m]
_PARTICLES_IN_TIME = 6000  # particles times parts that keep up with real time
_STRAIGHTENED = 3.0  # times a kink: what a stop takes from the path behind
_TOLERANCE = 2e-2
_G = 2.0 / 3.0  # of a part: the weight of what BDF2 finds at its end


class ImplicitSolver:
    """Steps hair at the rate of the display, whatever the stiffness."""

    def __init__(self, dynamics: Dynamics, parts: int | None = None, tolerance: float = _TOLERANCE) -> None:
        """parts: of a step; by the length of links and what real time affords if not given. tolerance: of the solution."""
        self.dynamics = dynamics
        model = dynamics.model
        length = float(np.median(model.rest_length)) if len(model.rest_length) else _PART_LENGTH
        affordable = min(_PARTICLES_IN_TIME // max(model.count, 1), _MOST_PARTS)
        self.parts = parts or max(_FEWEST_PARTS, round(_PART_LENGTH / length), affordable)
        self.tolerance = tolerance
        self._matrix = SpringMatrix(model, dynamics.springs)
        self._stiffened: tuple[float, float] | None = None

    def step(self, state: HairState, now: Circumstances, dt: float) -> HairState:
        """The state one step of dt [s] later, by section 3.1 of the paper.

        Hair-hair interactions are the dear part and change slowly: they are found once, for the middle of the step.
        Springs, inertia and contact go through the step in ``parts``.
        """
        outer = self.dynamics.outer_acceleration(self._halfway(state, dt), now, dt)
        self._stiffen(now.settings, dt / self.parts)
        for _ in range(self.parts):
            state = self._part(state, now, outer, dt / self.parts)
        return state

    def _stiffen(self, settings: DynamicsSettings, dt: float) -> None:
        """Let the matrix know of the bending that parts of dt [s] do not carry by themselves."""
        if (settings.stiffness, dt) != self._stiffened:
            self._matrix.stiffen(self.dynamics.bending.too_stiff(settings, dt), _G * dt)
            self._stiffened = (settings.stiffness, dt)

    def _halfway(self, state: HairState, dt: float) -> HairState:
        """Where hair comes to in half of a step of dt [s], and how fast, if it goes on to gain what it gained last."""
        gained = state.velocities - state.before[1] if state.before else 0.0
        return replace(
            state,
            positions=state.positions + 0.5 * dt * state.velocities,
            velocities=state.velocities + 0.5 * self.parts * gained,
        )

    def _part(self, state: HairState, now: Circumstances, outer: Floats, dt: float) -> HairState:
        """One BDF2 step of dt [s] under the accelerations ``outer`` [m/s^2], (n, 3)."""
        dynamics, settings, frame = self.dynamics, now.settings, now.at(state.time + dt)
        model = dynamics.model
        mass = model.mass[:, None]
        x, v = state.positions, state.velocities
        x_before, v_before = state.before or self._earlier(state, now, outer, dt)
        x_hat, v_hat = (4.0 * x - x_before) / 3.0, (4.0 * v - v_before) / 3.0
        g = _G * dt

        ahead = x_hat + g * v
        links = dynamics.links(ahead, settings)
        directions = dynamics.turn(links, state.directions)
        load = dynamics.springs.load(links, settings)
        force = mass * (outer + dynamics.bending_acceleration(settings, ahead, v, directions))
        # Coriolis turns with the velocity and stays out of the matrix, which is symmetric: it takes the velocity to come,
        # or it would lag behind by a part.
        coming = v + (v - v_before)
        force += mass * apparent_acceleration(frame, x_hat + g * coming, coming, settings.gravity)
        force += dynamics.springs.forces(links, load, v)
        right = mass * (v_hat - (1.0 + g * settings.air_friction) * v) + g * force
        # The plane that a particle is heading for tells how far from it the step starts.
        meeting = Meeting.ahead(dynamics.touch(ahead, frame), v, g)
        bounds = meeting.taut(model, ahead, v, g)
        pressing = np.zeros(model.count) if state.before is None or state.pressing is None else state.pressing
        with dynamics.timer.stage("solve"):
            inertia = 1.0 + g * settings.air_friction + g * g * dynamics.bending.kappa(settings)
            self._matrix.update(links, load, g, inertia * model.mass)
            change, pressing = solve_at_body(
                self._matrix,
                right,
                v - v_before,
                bounds,
                model.fixed,
                pressing,
                settings.body_friction,
                g,
                self.tolerance,
            )

        free = v + change
        v_new, impulse = dynamics.hold(x_hat, free, meeting.touch, meeting.distance, now, g)
        x_new = dynamics.put_back(x_hat + g * v_new, meeting.touch, meeting.distance_after(v_new - v, g), now)
        # A stopped particle has a kink in its path. It looks back on one straightened by that much, or it would bounce.
        kink = x_new - (x_hat + g * free)
        held = pressing > 0
        kink[held] = bounds.touch.normals[held]
        before = (
            x + _along(kink, x_new - dt * v_new - x, _STRAIGHTENED),
            v + _along(kink, v_new - v, _STRAIGHTENED / g),
        )
        pressing = np.where(held & bounds.rubs, pressing, model.mass * impulse / g)
        return HairState(x_new, v_new, directions, state.time + dt, before, pressing)

    def _earlier(self, state: HairState, now: Circumstances, outer: Floats, dt: float) -> tuple[Floats, Floats]:
        """A position and velocity for the part before the first, such that the first is of second order, too."""
        dynamics, settings, frame = self.dynamics, now.settings, now.at(state.time)
        x, v = state.positions, state.velocities
        touch = dynamics.touch(x, frame)
        links = dynamics.links(x, settings)
        springs = dynamics.springs.forces(links, dynamics.springs.load(links, settings), v)
        acceleration = outer - settings.air_friction * v
        acceleration += apparent_acceleration(frame, x, v, settings.gravity)
        acceleration += dynamics.bending_acceleration(settings, x, v, state.directions, dt)
        acceleration += springs / dynamics.model.mass[:, None]
        held, _ = dynamics.hold(x, v + dt * acceleration, touch, touch.distance, now, dt)
        acceleration = (held - v) / dt
        return x - dt * v + 0.5 * dt * dt * acceleration, v - dt * acceleration


def _along(way: Floats, a: Floats, most: float) -> Floats:
    """The part of ``a`` along ``way``, row by row, no longer than ``most`` times that way, (n, 3)."""
    square = row_dot(way, way)
    share = row_dot(way, a) / np.maximum(square, 1e-30)
    return np.clip(share, -most, most)[:, None] * way
