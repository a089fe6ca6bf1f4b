"""All forces on hair at one instant: what both solvers share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from .bending import Bending
from .body import Body
from .contact import Touching, looked_again, pressed, touching
from .direction import DirectionUpdate
from .hold import Hold
from .interactions import hair_hair_forces
from .limits import Tethers, put_back
from .model import HairModel, HairState
from .neighbours import NeighbourList
from .parting import Parting
from .settings import DynamicsSettings
from .springs import LinkState, Springs
from .strand import Strands
from .timing import Timer


@dataclass(frozen=True, eq=False)
class Circumstances:
    """What a step finds: the settings, the frame of the head at its end, and forces from outside [N], (n, 3) or None.

    motion: the frame of the head at any time [s], for solvers that go through a step in parts; without it the head is
    taken to have its frame all the time. parting: hands that hold the hair apart.
    """

    settings: DynamicsSettings
    frame: HeadFrame
    outside: Floats | None = None
    motion: Callable[[float], HeadFrame] | None = None
    parting: Parting | None = None

    def at(self, time: float) -> HeadFrame:
        """The frame of the head at a time within the step [s]."""
        return self.motion(time) if self.motion else self.frame


class Dynamics:
    """The forces on one head of hair, and the neighbour list that they are summed over."""

    def __init__(self, model: HairModel, body: Body) -> None:
        self.model = model
        self.body = body
        self.springs = Springs(model)
        self.directions = DirectionUpdate(model)
        self.strands = Strands(model)
        self.bending = Bending(model)
        self.tethers = Tethers(model)
        self.timer = Timer()
        self.forget()

    def forget(self) -> None:
        """Start over: what is still known of earlier positions would change the order of sums, and so their last bit."""
        self.neighbours = NeighbourList(2.0 * self.model.smoothing_length)
        self.timer.take()

    def outer_acceleration(self, state: HairState, now: Circumstances, dt: float) -> Floats:
        """What hair and the outside do to hair [m/s^2], (n, 3): forces that change little within dt, a step [s].

        state: at which hair-hair forces are found, for the best that of the middle of the step.
        """
        acceleration = np.zeros_like(state.positions)
        if now.outside is not None:
            acceleration += now.outside / self.model.mass[:, None]
        if now.settings.interactions:
            with self.timer.stage("neighbours"):
                pairs = self.neighbours.pairs(state.positions)
            with self.timer.stage("interactions"):
                force, _ = hair_hair_forces(self.model, now.settings, state, pairs, dt)
                acceleration += force / self.model.mass[:, None]
        return acceleration

    def bending_acceleration(
        self, settings: DynamicsSettings, positions: Floats, velocities: Floats, directions: Floats, dt: float = 0.0
    ) -> Floats:
        """What keeps a single hair in shape [m/s^2], (n, 3).

        positions [m], velocities [m/s] and unit hair directions: (n, 3). dt: of an explicit step to come [s]; hair too
        stiff for it is taken as stiff as it can be.
        """
        with self.timer.stage("bending"):
            rest_turn = self.bending.rest_turn(directions)
            rigidity = self.bending.rigidity(settings) * self.bending.carried(settings, dt)
            force = self.bending.curvature_force(positions, velocities, rest_turn, rigidity)
            return self.bending.place(positions, settings) + force / self.model.mass[:, None]

    def touch(self, positions: Floats, frame: HeadFrame) -> Touching:
        """Where the body is, seen from every particle."""
        with self.timer.stage("contact"):
            return touching(self.model, self.body, positions, frame)

    def links(self, positions: Floats, settings: DynamicsSettings) -> LinkState:
        """The springs at ``positions`` [m], (n, 3)."""
        with self.timer.stage("springs"):
            return self.springs.at(positions, settings.elastic_modulus)

    def holds(self, velocities: Floats, touch: Touching, settings: DynamicsSettings) -> tuple[Hold, Hold]:
        """The strands that are taut, and hair pressed on the body, where ``touch`` is seen from. velocities: [m/s], (n, 3)."""
        with self.timer.stage("springs"):
            taut = self.strands.taut(velocities, touch)
        with self.timer.stage("contact"):
            return taut, pressed(self.model, touch, velocities, settings.body_friction)

    def guided(self, start: Floats, velocities: Floats, now: Circumstances) -> Floats:
        """Velocities [m/s] after hands have had their say, (n, 3), in a step from ``start`` [m], (n, 3)."""
        return velocities if now.parting is None else now.parting.guided(start, velocities)

    def put_back(
        self, positions: Floats, velocities: Floats, touch: Touching, now: Circumstances, frame: HeadFrame | None
    ) -> tuple[Floats, Floats]:
        """Positions [m] and velocities [m/s], (n, 3), with what is too deep or too far put back and stopped.

        touch: the body seen from elsewhere. frame: of the head, for another look at it; without, its planes are the same.
        """
        with self.timer.stage("contact"):
            drawn = self.tethers.drawn_along(positions) if now.parting is None else positions
            there = looked_again(self.body, touch, drawn, frame) if frame else touch.seen_from(drawn)
            return put_back(self.model, drawn, velocities, there)

    def turn(self, links: LinkState, directions: Floats) -> Floats:
        """Hair directions where ``links`` are (eq. 15), unit, (n, 3)."""
        with self.timer.stage("directions"):
            return self.directions.led_by(links, directions)
