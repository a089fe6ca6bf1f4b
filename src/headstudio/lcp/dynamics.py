"""All forces on hair at one instant: what both solvers share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..head.frame import HeadFrame
from ..head.mesh import Floats
from ..head.rows import row_dot
from .bending import Bending
from .body import Body
from .contact import Tethers, Touching, put_back, stop_at_body, stop_at_reach, touching
from .direction import updated_directions
from .interactions import hair_hair_forces
from .model import HairModel, HairState
from .neighbours import NeighbourList
from .parting import Parting
from .settings import DynamicsSettings
from .springs import LinkState, Springs
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

    def hold(
        self, start: Floats, velocities: Floats, touch: Touching, distance: Floats, now: Circumstances, dt: float
    ) -> tuple[Floats, Floats]:
        """Velocities [m/s] after hands, body and reach have had their say, (n, 3), and what the body did along its normal.

        A step leads from ``start`` [m], (n, 3), at ``distance`` from the body [m], (n,), over dt [s]. The latter: [m/s],
        (n,).
        """
        with self.timer.stage("contact"):
            if now.parting is not None:
                velocities = now.parting.guided(start, velocities)
            velocities, stopped = stop_at_body(velocities, touch, distance, now.settings.body_friction, dt)
            velocities = stop_at_reach(self.model, start, velocities, touch, distance, dt)
        velocities[self.model.fixed] = stopped[self.model.fixed] = 0.0
        return velocities, stopped

    def put_back(self, positions: Floats, touch: Touching, distance: Floats, now: Circumstances) -> Floats:
        """Positions [m], (n, 3), at ``distance`` from their planes, with what is too deep or too far put back."""
        with self.timer.stage("contact"):
            if now.parting is None:
                drawn = self.tethers.drawn_along(positions)
                distance = distance + row_dot(drawn - positions, touch.normals)
                positions = drawn
            return put_back(self.model, positions, touch, distance)

    def turn(self, links: LinkState, directions: Floats) -> Floats:
        """Hair directions where ``links`` are (eq. 15), unit, (n, 3)."""
        with self.timer.stage("directions"):
            return updated_directions(self.model, self.springs, links, directions)
