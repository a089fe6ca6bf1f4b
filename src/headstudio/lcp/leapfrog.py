"""The reference: explicit leapfrog steps, small enough for the stiffest spring (thesis, section 3.6)."""

from __future__ import annotations

import math

import numpy as np

from .contact import square_frequency
from .dynamics import Circumstances, Dynamics
from .inertia import apparent_acceleration
from .model import HairState
from .settings import DynamicsSettings

_STEP_OF_LIMIT = 0.4
_LONGEST_STEP = 2e-3  # for contact and inertia, where springs are weak [s]


class LeapfrogSolver:
    """Steps hair with the integrator of the paper, in as many equal parts as stability asks for."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics

    def stable_step(self, settings: DynamicsSettings) -> float:
        """A step [s] well within the limit of the springs, by the stiffness and damping that meet at one particle at rest.

        An oscillation of frequency w with the damping rate d stays bounded while d h + w^2 h^2 / 2 < 2.
        """
        model, springs = self.dynamics.model, self.dynamics.springs
        stiffness = springs.at(model.rest_positions, settings.elastic_modulus).stiffness
        damping = springs.damping(stiffness, settings.spring_damping) + springs.friction(settings.inner_friction)
        square, rate = (2.0 * (springs.around @ each) / model.mass for each in (stiffness, damping))
        own = self.dynamics.strands.square_frequency + square_frequency(model)
        square, rate = square + own, rate + 2.0 * np.sqrt(own)
        limit = 4.0 / (rate + np.sqrt(rate * rate + 4.0 * square) + 1e-9)
        return _STEP_OF_LIMIT * float(np.min(limit, initial=_LONGEST_STEP))

    def step(self, state: HairState, now: Circumstances, dt: float) -> HairState:
        """The state one step of dt [s] later, by section 3.1 of the paper, done in small parts."""
        parts = max(1, math.ceil(dt / self.stable_step(now.settings)))
        for _ in range(parts):
            state = self._small_step(state, now, dt / parts)
        return state

    def _small_step(self, state: HairState, now: Circumstances, dt: float) -> HairState:
        dynamics, settings, frame = self.dynamics, now.settings, now.at(state.time + dt)
        x, v = state.positions, state.velocities
        mass = dynamics.model.mass[:, None]
        touch = dynamics.touch(x, frame)
        acceleration = dynamics.outer_acceleration(state, now, dt)
        acceleration += apparent_acceleration(frame, x, v, settings.gravity)
        acceleration += dynamics.bending_acceleration(settings, x, v, state.directions, dt)
        links = dynamics.links(x, settings)
        acceleration += dynamics.springs.forces(links, dynamics.springs.load(links, settings), v) / mass
        for hold in dynamics.holds(v, touch, settings):
            held = mass[hold.which]
            acceleration[hold.which] += hold.forces(dt / held[:, 0]) / held
        v = (v + dt * acceleration) / (1.0 + dt * settings.air_friction)
        v[dynamics.model.fixed] = 0.0
        v = dynamics.guided(x, v, now)
        x, v = dynamics.put_back(x + dt * v, v, touch, now, frame)
        return HairState(x, v, dynamics.turn(dynamics.links(x, settings), state.directions), state.time + dt)
