"""The real-time solver: springs implicitly, everything else explicitly, second order in time.

A step of the generalised-alpha method (generalised_alpha.py) leads from x, v by way of x^ and v^, which its past decides, to

    x^ + g v',     M (v' - v^) = g / a f(x_a, v_a),

with forces felt at the part a of the way. It is solved by one Newton step from the present velocities,

    (M (1 + g c + g^2 kappa) + g D + g^2 K) dv = M (v^ - v) + g / a f(x_a, v),

K and D being the stiffness and damping of springs and holds, kappa that of bending, c air friction. The matrix is symmetric
and positive definite (compressed links count only along themselves), its pattern never changes, and conjugate gradients
solve it. Taut strands and the body hold single particles: they are in f, K and D as the springs are.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from .contact import Touching
from .dynamics import Circumstances, Dynamics
from .generalised_alpha import FORCE_AT, WEIGHT, gone_on, looking_back, on_the_way, way_begun
from .inertia import apparent_acceleration
from .model import HairState
from .settings import DynamicsSettings
from .spring_matrix import SpringMatrix

# A step has two parts for links of 3 cm, and more the shorter they are: of what a head's shake does in a part, no link
# turns far. And more, for accuracy, as long as few particles leave the time for it.
_FEWEST_PARTS, _MOST_PARTS = 2, 4
_PART_LENGTH = 0.06  # [m]
_PARTICLES_IN_TIME = 6000  # particles times parts that keep up with real time
# How often a step looks for the planes of the body: they are tangents, and good for some way.
_LOOKS = 2
# Stiffer hair is turned too far by a part of half a step, and breaks [Pa].
_MODULUS_CARRIED = 1e6
# Of what a solution leaves. More parts in a step bring more than solutions that are twice as good, and cost the same.
_TOLERANCE = 4e-3


class ImplicitSolver:
    """Steps hair at the rate of the display, whatever the stiffness."""

    def __init__(self, dynamics: Dynamics, parts: int | None = None, tolerance: float = _TOLERANCE) -> None:
        """parts: of a step; as ``parts`` says if not given. tolerance: of the solution."""
        self.dynamics = dynamics
        model = dynamics.model
        length = float(np.median(model.rest_length)) if len(model.rest_length) else _PART_LENGTH
        affordable = min(_PARTICLES_IN_TIME // max(model.count, 1), _MOST_PARTS)
        self._given = parts
        self._fewest = max(_FEWEST_PARTS, round(_PART_LENGTH / length), affordable)
        self.tolerance = tolerance
        self._matrix = SpringMatrix(model, dynamics.springs)
        self._stiffened: tuple[float, float] | None = None

    def parts(self, settings: DynamicsSettings) -> int:
        """How many parts a step has: by the length of links, what real time affords and the stiffness of hair."""
        stiff = math.ceil(_FEWEST_PARTS * math.sqrt(settings.elastic_modulus / _MODULUS_CARRIED))
        return self._given or max(self._fewest, stiff)

    def step(self, state: HairState, now: Circumstances, dt: float) -> HairState:
        """The state one step of dt [s] later, by section 3.1 of the paper.

        Hair-hair interactions are the dear part and change slowly: they are found once, for the middle of the step.
        Springs, inertia and contact go through the step in ``parts``. The body is looked at ``_LOOKS`` times, and again when
        hair has come to where it was heading.
        """
        parts = self.parts(now.settings)
        outer = self.dynamics.outer_acceleration(_halfway(state, dt, parts), now, dt)
        self._stiffen(now.settings, dt / parts)
        frame = now.at(state.time)
        for some in np.array_split(np.arange(parts), _LOOKS):
            seen = None
            for k in some:
                frames = frame, (frame := now.at(state.time + dt / parts))
                state, seen = self._part(state, now, frames, outer, dt / parts, seen, look_again=k == some[-1])
        return state

    def _stiffen(self, settings: DynamicsSettings, dt: float) -> None:
        """Let the matrix know of the bending that parts of dt [s] do not carry by themselves."""
        if (settings.stiffness, dt) != self._stiffened:
            self._matrix.stiffen(self.dynamics.bending.too_stiff(settings, dt), WEIGHT * dt)
            self._stiffened = (settings.stiffness, dt)

    def _part(
        self,
        state: HairState,
        now: Circumstances,
        frames: tuple[HeadFrame, HeadFrame],
        outer: Floats,
        dt: float,
        seen: Touching | None,
        look_again: bool,
    ) -> tuple[HairState, Touching]:
        """One step of the generalised-alpha method of dt [s] under the accelerations ``outer`` [m/s^2], (n, 3).

        frames: of the head at its beginning and at its end. seen: the body, as it was looked at in the part before; without,
        it is looked at. look_again: at its end. Gives the body as it was seen, too.
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
        # The planes that particles are heading for, as far away as they are when forces are felt.
        touch = seen.seen_from(ahead, dt) if seen else dynamics.touch(ahead, frames[1])
        holds = dynamics.holds(v, touch.seen_from(x_felt, (FORCE_AT - 1.0) * dt), settings)
        for hold in holds:
            force[hold.which] += hold.forces()
        right = mass * (v_hat - v) + g / FORCE_AT * (force - settings.air_friction * mass * v)
        with dynamics.timer.stage("solve"):
            inertia = 1.0 + g * settings.air_friction + g * g * dynamics.bending.kappa(settings)
            self._matrix.update(links, load, holds, g, inertia * model.mass)
            change = self._matrix.solve(right, gained, self.tolerance)

        free = v + change
        guided = dynamics.guided(x_hat, free, now)
        x_free = x_hat + g * guided
        x_new, v_new = dynamics.put_back(x_free, guided, touch, now, frames[1] if look_again else None)
        # What hands and limits did is no part of the slopes.
        before = (
            looking_back(x_free, x, x_before) + (x_new - x_free),
            looking_back(free, v, v_before) + (v_new - free),
        )
        return HairState(x_new, v_new, directions, state.time + dt, before), touch

    def _earlier(
        self, state: HairState, now: Circumstances, frame: HeadFrame, outer: Floats, dt: float
    ) -> tuple[Floats, Floats]:
        """What the first part looks back to: positions and velocities a part of dt [s] before on a straight path."""
        dynamics, settings = self.dynamics, now.settings
        x, v = state.positions, state.velocities
        links = dynamics.links(x, settings)
        force = dynamics.springs.forces(links, dynamics.springs.load(links, settings), v)
        for hold in dynamics.holds(v, dynamics.touch(x, frame), settings):
            force[hold.which] += hold.forces(dt / dynamics.model.mass[hold.which])
        acceleration = outer - settings.air_friction * v
        acceleration += apparent_acceleration(frame, x, v, settings.gravity)
        acceleration += dynamics.bending_acceleration(settings, x, v, state.directions, dt)
        acceleration += force / dynamics.model.mass[:, None]
        acceleration[dynamics.model.fixed] = 0.0
        return x - dt * v, v - dt * acceleration


def _halfway(state: HairState, dt: float, parts: int) -> HairState:
    """Where hair comes to in half of a step of dt [s], and how fast, if it goes on to gain what it gained in the last part."""
    gained = state.velocities - state.before[1] if state.before else 0.0
    return replace(
        state,
        positions=state.positions + 0.5 * dt * state.velocities,
        velocities=state.velocities + 0.5 * parts * gained,
    )
