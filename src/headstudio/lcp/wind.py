"""Wind as particles of air: Bando et al. 2006, section 3.5, after Hadap and Magnenat-Thalmann.

Air particles enter on the upwind side of a box around the hair, are carried along by the wind, push each other apart as a
gas, and leave downwind. Where they pass through hair, each pair of neighbours exchanges momentum until their velocities
meet: the hair is blown, and the air is slowed down by the same amount.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints
from ..head.rows import row_dot, row_length
from .body import Body
from .kernel import kernel, kernel_slope
from .model import HairModel
from .neighbours import find_pairs
from .settings import WindSettings

Bools = NDArray[np.bool_]

AIR_DENSITY = 1.2  # [kg/m^3]
_SPACING = 0.05  # of air particles [m]
_SMOOTHING = 1.0  # smoothing length of the air as a gas, in spacings
_CONTACT = 0.75  # smoothing length of the drag between air and hair, in spacings: each hair feels some dozen particles
_MARGIN = 0.12  # of the box around the hair [m]
_INLET = 0.05  # depth of the layer behind the upwind sides in which air keeps the speed of the wind [m]
_JITTER = 0.1  # largest shift of fresh air off its lattice, in spacings
_PERIOD = 16  # lattice points after which the shifts repeat
_RELAXATION = 3.0  # rate at which free air takes up the speed of the wind again [1/s]
_SOUND = 6.0  # speed of pressure in the air [m/s]: far below the real one, fast enough that it does not pile up
_CROWDED = 1.15  # density from which air pushes, over that of free air: the disturbed lattice itself must not
_COURANT = 0.8  # smoothing lengths that pressure may travel in one evaluation
_EVALUATIONS = 2  # of the pressure in a step
_STRIDE = 0.02  # farthest that air moves before it meets the contact planes again [m]: they reach 28 mm and more
_MOST_STRIDES = 24  # in a step; what is faster is held to it
_GAP = 0.012  # that air keeps from the skin [m]
_LOST = -0.014  # air deeper in the body than this does not find out again [m]
_EXCHANGE_RATE = 30.0  # rate at which hair of the default drag takes up the velocity of still dense air [1/s]


@dataclass(frozen=True, eq=False)
class AirState:
    """Particles of air in the world: positions [m] and velocities [m/s], (k, 3), and how far the wind has blown [m], (3,)."""

    positions: Floats
    velocities: Floats
    blown: Floats = field(default_factory=lambda: np.zeros(3))


@dataclass(frozen=True, eq=False)
class Exchange:
    """Momentum that a step moves from air to hair [N s]: what hair gains, (n, 3), and what air gains, (k, 3)."""

    hair: Floats
    air: Floats


class Wind:
    """The air around one head of hair. The box stands still in the world; its floor lies below the longest hair.

    Far away the air is a lattice, a little disturbed, that moves with the wind as a whole. Its points become particles
    as they come into the box, so a free stream has the same density and speed everywhere, whatever the heading.
    """

    def __init__(self, model: HairModel, body: Body, seed: int = 0) -> None:
        self.model = model
        self.body = body
        reach = np.ptp(model.arc_length) * 0.5 + _MARGIN
        low, high = model.rest_positions.min(axis=0), model.rest_positions.max(axis=0)
        self.centre = 0.5 * (low + high)
        self.half = np.maximum(0.5 * (high - low) + _MARGIN, 0.6 * reach)
        self.mass = AIR_DENSITY * _SPACING**3
        self.smoothing_length = _SMOOTHING * _SPACING
        # Drawn once and looked up by lattice point: a run that is repeated meets the same air.
        largest = _JITTER * _SPACING
        self._shifts = np.random.default_rng(seed).uniform(-largest, largest, (_PERIOD, _PERIOD, _PERIOD, 3))

    def still_air(self) -> AirState:
        """An empty box, before the wind has arrived."""
        return AirState(np.zeros((0, 3)), np.zeros((0, 3)))

    def step(
        self,
        air: AirState,
        settings: WindSettings,
        frame: HeadFrame,
        hair_positions: Floats,
        hair_velocities: Floats,
        time: float,
        dt: float,
    ) -> tuple[AirState, Exchange]:
        """The air one step of dt [s] later, and the momentum exchanged. Hair in the world: [m], [m/s], (n, 3).

        Air that is no longer finite leaves the box; hair that is not is answered with momentum that is not.
        """
        direction = np.array([math.sin(settings.heading), 0.0, math.cos(settings.heading)])
        wind = settings.speed * (1.0 + settings.gusts * _gust(time)) * direction
        with np.errstate(invalid="ignore", over="ignore"):
            exchange = self.exchange(air.positions, air.velocities, hair_positions, hair_velocities, settings.drag, dt)
            velocities = air.velocities + exchange.air / self.mass
            sound = np.isfinite(velocities).all(axis=1)
            blown = air.blown + wind * dt
            fresh = self._entering(blown, wind * dt)
            positions = np.concatenate([air.positions[sound], fresh])
            velocities = np.concatenate([velocities[sound], np.broadcast_to(wind, fresh.shape)])
            positions, velocities = self._move(positions, velocities, wind, direction, frame, dt)
            kept = self._is_in_box(positions) & np.isfinite(velocities).all(axis=1)
            kept &= self._plane(positions, frame)[0] > _LOST
        return AirState(positions[kept], velocities[kept], blown), exchange

    def _is_in_box(self, positions: Floats) -> Bools:
        inside: Bools = np.all(np.abs(positions - self.centre) <= self.half, axis=1)
        return inside

    def _is_at_inlet(self, positions: Floats, direction: Floats) -> Bools:
        """Where air keeps the speed of the wind, as a fan gives it: next to the sides that the wind comes in by."""
        return ~self._is_in_box(positions - _INLET * direction)

    def _entering(self, blown: Floats, advance: Floats) -> Floats:
        """Points of the lattice that come into the box while it moves by ``advance`` to ``blown`` [m], (k, 3).

        They are given where they stand before that, so that even in a storm no air appears in the middle of the head.
        """
        if not np.any(advance):
            return np.zeros((0, 3))
        first = np.floor((self.centre - self.half - blown) / _SPACING - _JITTER).astype(np.int64)
        last = np.ceil((self.centre + self.half - blown) / _SPACING + _JITTER).astype(np.int64)
        ranges = (np.arange(a, b + 1) for a, b in zip(first, last, strict=True))
        point = np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, 3)
        place = point * _SPACING + self._shifts[tuple((point % _PERIOD).T)] + blown
        before = place - advance
        return before[self._is_in_box(place) & ~self._is_in_box(before)]

    def _move(
        self, positions: Floats, velocities: Floats, wind: Floats, direction: Floats, frame: HeadFrame, dt: float
    ) -> tuple[Floats, Floats]:
        """Positions [m] and velocities [m/s] after dt, in strides that no contact plane is too thin for."""
        fastest = np.max(row_length(velocities), initial=0.0)
        strides = math.ceil(min(max(fastest * dt / _STRIDE, _EVALUATIONS), _MOST_STRIDES))
        part = dt / strides
        top_speed = _MOST_STRIDES * _STRIDE / dt
        evaluations = {round(k * strides / _EVALUATIONS) for k in range(_EVALUATIONS)}
        # Air that comes near other air within the step is seen in the next one.
        pairs = find_pairs(positions, 2.0 * self.smoothing_length)
        for stride in range(strides):
            if stride in evaluations:
                push = dt / _EVALUATIONS * self._acceleration(positions, velocities, wind, pairs, dt / _EVALUATIONS)
                held = self._is_at_inlet(positions, direction)[:, None]
                velocities = np.where(held, wind, velocities + push)
                speed = np.linalg.norm(velocities, axis=1, keepdims=True)
                velocities = velocities * np.minimum(1.0, top_speed / np.maximum(speed, 1e-9))
            positions, velocities = self._slide(positions, velocities, frame, part)
        # Nor does what was thrown back into the inlet blow against the wind.
        return positions, np.where(self._is_at_inlet(positions, direction)[:, None], wind, velocities)

    def _acceleration(self, positions: Floats, velocities: Floats, wind: Floats, pairs: Ints, dt: float) -> Floats:
        """Pressure of the air (eq. 16 for a gas) and the wind that drives it on [m/s^2], (k, 3), to act for dt [s]."""
        acceleration = _RELAXATION * (wind - velocities)
        h = self.smoothing_length
        if len(pairs) == 0:
            return acceleration
        i, j = pairs.T
        x = positions[j] - positions[i]
        distance = row_length(x)
        count = len(positions)
        weight = kernel(distance, h)
        own = kernel(np.zeros(1), h)
        density = self.mass * (own + np.bincount(i, weight, count) + np.bincount(j, weight, count))
        # Only crowding pushes: the edges of the box are no vacuum that would suck the air out.
        sound = min(_SOUND, _COURANT * h / dt)
        over_square = sound**2 * np.maximum(density - _CROWDED * AIR_DENSITY, 0.0) / density**2
        both = over_square[i] + over_square[j]
        crowded = both > 0.0
        i, j, x, distance, both = i[crowded], j[crowded], x[crowded], distance[crowded], both[crowded]
        slope = kernel_slope(distance, h) / np.maximum(distance, 1e-9)
        push = (self.mass * both * slope)[:, None] * x
        for axis in range(3):
            acceleration[:, axis] += np.bincount(i, push[:, axis], count) - np.bincount(j, push[:, axis], count)
        return acceleration

    def _slide(self, positions: Floats, velocities: Floats, frame: HeadFrame, dt: float) -> tuple[Floats, Floats]:
        """One stride: air flows around the body and does not blow through it; what the body has run into gives way."""
        distance, normals = self._plane(positions, frame)
        near = np.flatnonzero(distance < _GAP + 2.0 * _STRIDE)
        ahead, n = distance[near] - _GAP, normals[near]
        approach = row_dot(velocities[near], n)
        slowest = -np.maximum(ahead, 0.0) / dt
        velocities = velocities.copy()
        velocities[near] += np.maximum(slowest - approach, 0.0)[:, None] * n
        positions = positions + dt * velocities
        positions[near] += np.maximum(-ahead, 0.0)[:, None] * n
        return positions, velocities

    def _plane(self, positions: Floats, frame: HeadFrame) -> tuple[Floats, Floats]:
        """Distance of the nearest contact plane [m], infinite far from the body, (k,), and its normal, (k, 3), in the world."""
        planes = self.body.planes(frame.to_head(positions), frame)
        return planes.distance, frame.rotation.apply(planes.normals)

    def exchange(
        self, air: Floats, air_velocities: Floats, hair: Floats, hair_velocities: Floats, drag: float, dt: float
    ) -> Exchange:
        """Drag between air and hair that are near each other: equal and opposite momentum for each pair.

        Positions [m] and velocities [m/s] in the world, (k, 3) and (n, 3). dt: [s]. Pairs relax toward each other; a
        particle with many neighbours shares itself among them, so that no step can overshoot. Hair at no
        finite place is answered with NaN.
        """
        hair_gain, air_gain = np.where(np.isfinite(hair), 0.0, np.nan), np.zeros_like(air)
        a, b, distance = _near_pairs(air, hair, 2.0 * _CONTACT * _SPACING)
        if drag == 0.0 or len(a) == 0:
            return Exchange(hair_gain, air_gain)
        weight = kernel(distance, _CONTACT * _SPACING)
        mass_b = self.model.mass[b]
        # Coefficient of each pair [kg/s]: in air of its normal density hair is slowed at the exchange rate.
        coefficient = drag * _EXCHANGE_RATE * (self.mass / AIR_DENSITY) * weight * mass_b
        load_a = (np.bincount(a, coefficient, len(air)) / self.mass)[a]
        load_b = np.bincount(b, coefficient, len(hair))[b] / mass_b
        coefficient = coefficient * dt / (1.0 + dt * (load_a + load_b))
        for axis in range(3):
            impulse = coefficient * (air_velocities[a, axis] - hair_velocities[b, axis])
            hair_gain[:, axis] += np.bincount(b, impulse, len(hair))
            air_gain[:, axis] = -np.bincount(a, impulse, len(air))
        return Exchange(hair_gain, air_gain)


def _near_pairs(first: Floats, second: Floats, radius: float) -> tuple[Ints, Ints, Floats]:
    """Pairs (a, b) with first[a] and second[b] closer than ``radius`` [m], and their distances [m], (p,) each."""
    none = np.zeros(0, dtype=np.int64)
    if len(first) == 0:
        return none, none, np.zeros(0)
    low, high = first.min(axis=0) - radius, first.max(axis=0) + radius
    # What is not finite is in no reach, and what is far away does not overflow the tree.
    reachable = np.flatnonzero(((second >= low) & (second <= high)).all(axis=1))
    if len(reachable) == 0:
        return none, none, np.zeros(0)
    found = cKDTree(first).sparse_distance_matrix(cKDTree(second[reachable]), radius, output_type="ndarray")
    return found["i"], reachable[found["j"]], found["v"]


def _gust(time: float) -> float:
    """A slow irregular swing between -1 and 1: three sines that do not share a period. time: [s]."""
    return (math.sin(2.1 * time) + math.sin(3.7 * time + 1.0) + math.sin(6.1 * time + 2.0)) / 3.0
