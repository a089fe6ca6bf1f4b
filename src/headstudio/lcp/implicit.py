"""The real-time solver: springs implicitly, everything else explicitly, second order in time.

A step of the generalised-alpha method (generalised_alpha.py) leads from x, v by way of x^ and v^, which its past decides, to

    x^ + g v',     M (v' - v^) = g / a f(x_a, v_a),

with forces felt at the part a of the way. It is solved by one Newton step from the present velocities,

    (M (1 + g c + g^2 kappa) + g D + g^2 K) dv = M (v^ - v) + g / a f(x_a, v),

K and D being the stiffness and damping of the springs, kappa that of bending, c air friction. The matrix is symmetric
and positive definite (compressed links count only along themselves), its pattern never changes, and conjugate gradients
solve it, with hair that lies on the body held there (resting.py).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..head.rows import row_dot
from .dynamics import Circumstances, Dynamics
from .generalised_alpha import FORCE_AT, WEIGHT, gone_on, looking_back, on_the_way, way_begun
from .inertia import apparent_acceleration
from .model import HairState
from .resting import Meeting, solve_at_body
from .settings import DynamicsSettings
from .spring_matrix import SpringMatrix

# A step has two parts for links of 3 cm, and more the shorter they are: of what a head's shake does in a part, no link
# turns far. And more, for accuracy, as long as few particles leave the time for it.
_FEWEST_PARTS, _MOST_PARTS = 2, 4
_PART_LENGTH = 0.06  # [m]
_PARTICLES_IN_TIME = 4000  # particles times parts that keep up with real time
_STRAIGHTENED = 3.0  # times a kink: what a stop takes from the path behind
# What is left of a solution goes on into the next ones: this is the dearest number of the solver, and pays for itself.
_TOLERANCE = 5e-3


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
        frame = now.at(state.time)
        for _ in range(self.parts):
            frames = frame, (frame := now.at(state.time + dt / self.parts))
            state = self._part(state, now, frames, outer, dt / self.parts)
        return state

    def _stiffen(self, settings: DynamicsSettings, dt: float) -> None:
        """Let the matrix know of the bending that parts of dt [s] do not carry by themselves."""
        if (settings.stiffness, dt) != self._stiffened:
            self._matrix.stiffen(self.dynamics.bending.too_stiff(settings, dt), WEIGHT * dt)
            self._stiffened = (settings.stiffness, dt)

    def _halfway(self, state: HairState, dt: float) -> HairState:
        """Where hair comes to in half of a step of dt [s], and how fast, if it goes on to gain what it gained last."""
        gained = state.velocities - state.before[1] if state.before else 0.0
        return replace(
            state,
            positions=state.positions + 0.5 * dt * state.velocities,
            velocities=state.velocities + 0.5 * self.parts * gained,
        )

    def _part(
        self, state: HairState, now: Circumstances, frames: tuple[HeadFrame, HeadFrame], outer: Floats, dt: float
    ) -> HairState:
        """One step of the generalised-alpha method of dt [s] under the accelerations ``outer`` [m/s^2], (n, 3).

        frames: of the head at its beginning and at its end.
        """
        dynamics, settings = self.dynamics, now.settings
        model = dynamics.model
        mass = model.mass[:, None]
        x, v = state.positions, state.velocities
        x_before, v_before = state.before or self._earlier(state, now, frames[0], outer, dt)
        x_hat, v_hat = gone_on(x, x_before) + way_begun(v, dt), gone_on(v, v_before)
        g, gained = WEIGHT * dt, v - v_before

        ahead = x_hat + g * v
        x_felt = on_the_way(x, ahead)
        links = dynamics.links(x_felt, settings)
        directions = dynamics.turn(links, state.directions)
        load = dynamics.springs.load(links, settings)
        force = mass * (outer + dynamics.bending_acceleration(settings, x_felt, v, directions))
        # Coriolis turns with the velocity and stays out of the matrix, which is symmetric: it takes the velocity to come,
        # or it would lag behind by a part.
        coming = FORCE_AT * gained
        apparent = (apparent_acceleration(at, x_felt + g * coming, v + coming, settings.gravity) for at in frames)
        force += mass * on_the_way(*apparent)
        force += dynamics.springs.forces(links, load, v)
        right = mass * (v_hat - v) + g / FORCE_AT * (force - settings.air_friction * mass * v)
        # The plane that a particle is heading for tells how far from it the step starts.
        meeting = Meeting.ahead(dynamics.touch(ahead, frames[1]), v, g)
        bounds = meeting.taut(model, ahead, v, g)
        pressing = np.zeros(model.count) if state.before is None or state.pressing is None else state.pressing
        with dynamics.timer.stage("solve"):
            inertia = 1.0 + g * settings.air_friction + g * g * dynamics.bending.kappa(settings)
            self._matrix.update(links, load, g, inertia * model.mass)
            change, pressing = solve_at_body(
                self._matrix, right, gained, bounds, model.fixed, pressing, settings.body_friction, g, self.tolerance
            )

        free = v + change
        v_new, impulse = dynamics.hold(x_hat, free, meeting.touch, meeting.distance, now, g)
        x_new = dynamics.put_back(x_hat + g * v_new, meeting.touch, meeting.distance_after(v_new - v, g), now)
        # A stopped particle has a kink in its path. It looks back on one straightened by that much, or it would bounce.
        kink = x_new - (x_hat + g * free)
        held = pressing > 0
        kink[held] = bounds.touch.normals[held]
        x_behind, v_behind = looking_back(x_new, x, x_before), looking_back(v_new, v, v_before)
        before = (
            x_behind + _along(kink, x_new - dt * v_new - x_behind, _STRAIGHTENED),
            v_behind + _along(kink, v_new - v_behind, _STRAIGHTENED / g),
        )
        pressing = np.where(held & bounds.rubs, pressing, model.mass * impulse / g)
        return HairState(x_new, v_new, directions, state.time + dt, before, pressing)

    def _earlier(
        self, state: HairState, now: Circumstances, frame: HeadFrame, outer: Floats, dt: float
    ) -> tuple[Floats, Floats]:
        """What the first part looks back to: positions and velocities a part of dt [s] before on a straight path."""
        dynamics, settings = self.dynamics, now.settings
        x, v = state.positions, state.velocities
        touch = dynamics.touch(x, frame)
        links = dynamics.links(x, settings)
        springs = dynamics.springs.forces(links, dynamics.springs.load(links, settings), v)
        acceleration = outer - settings.air_friction * v
        acceleration += apparent_acceleration(frame, x, v, settings.gravity)
        acceleration += dynamics.bending_acceleration(settings, x, v, state.directions, dt)
        acceleration += springs / dynamics.model.mass[:, None]
        held, _ = dynamics.hold(x, v + dt * acceleration, touch, touch.distance, now, dt)
        return x - dt * v, 2.0 * v - held


def _along(way: Floats, a: Floats, most: float) -> Floats:
    """The part of ``a`` along ``way``, row by row, no longer than ``most`` times that way, (n, 3)."""
    square = row_dot(way, way)
    share = row_dot(way, a) / np.maximum(square, 1e-30)
    return np.clip(share, -most, most)[:, None] * way
