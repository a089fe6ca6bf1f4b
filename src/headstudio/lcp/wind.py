"""Wind as particles of air: Bando et al. 2006, section 3.5, after Hadap and Magnenat-Thalmann.

Air particles enter on the upwind side of a box around the hair, are carried along by the wind, push each other apart as a
gas, and leave downwind. Where they pass through hair, each pair of neighbours exchanges momentum until their velocities
meet: the hair is blown, and the air is slowed down by the same amount.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.frame import HeadFrame
from ..head.mesh import Floats, Ints
from .body import Body
from .kernel import kernel, kernel_slope
from .model import HairModel
from .neighbours import find_pairs
from .settings import WindSettings

AIR_DENSITY = 1.2  # [kg/m^3]
_SPACING = 0.045  # of air particles [m]
_SMOOTHING = 1.1  # smoothing length of air, in spacings
_MARGIN = 0.12  # of the box around the hair [m]
_RELAXATION = 3.0  # rate at which free air takes up the speed of the wind again [1/s]
_SOUND = 6.0  # speed of pressure in the air [m/s]: far below the real one, fast enough that it does not pile up
_EXCHANGE_RATE = 30.0  # rate at which hair of the default drag takes up the velocity of still dense air [1/s]


@dataclass(frozen=True, eq=False)
class AirState:
    """Particles of air in the world: positions [m] and velocities [m/s], (k, 3), and how far the wind has blown [m]."""

    positions: Floats
    velocities: Floats
    blown: float = 0.0


@dataclass(frozen=True, eq=False)
class Exchange:
    """Momentum that a step moves from air to hair [N s]: what hair gains, (n, 3), and what air gains, (k, 3)."""

    hair: Floats
    air: Floats


class Wind:
    """The air around one head of hair. The box stands still in the world; its floor lies below the longest hair."""

    def __init__(self, model: HairModel, body: Body, seed: int = 0) -> None:
        self.model = model
        self.body = body
        self._rng = np.random.default_rng(seed)
        reach = np.ptp(model.arc_length) * 0.5 + _MARGIN
        low, high = model.rest_positions.min(axis=0), model.rest_positions.max(axis=0)
        self.centre = 0.5 * (low + high)
        self.half = np.maximum(0.5 * (high - low) + _MARGIN, 0.6 * reach)
        self.mass = AIR_DENSITY * _SPACING**3
        self.smoothing_length = _SMOOTHING * _SPACING

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
        """The air one step of dt [s] later, and the momentum exchanged. Hair in the world: [m], [m/s], (n, 3)."""
        direction = np.array([math.sin(settings.heading), 0.0, math.cos(settings.heading)])
        speed = settings.speed * (1.0 + settings.gusts * _gust(time))
        wind = speed * direction
        positions, velocities = self._enter(air, direction, wind, speed * dt)
        velocities = velocities + dt * self._acceleration(positions, velocities, wind)
        exchange = self.exchange(positions, velocities, hair_positions, hair_velocities, settings.drag, dt)
        velocities = velocities + exchange.air / self.mass
        velocities = self._stop_at_body(positions, velocities, frame)
        positions = positions + dt * velocities
        inside = np.all(np.abs(positions - self.centre) <= self.half + _SPACING, axis=1)
        blown = air.blown + speed * dt
        blown -= _SPACING * math.floor(blown / _SPACING)
        return AirState(positions[inside], velocities[inside], blown), exchange

    def _enter(self, air: AirState, direction: Floats, wind: Floats, advance: float) -> tuple[Floats, Floats]:
        """The air with the layers that the wind has brought to the upwind side since the last step."""
        layers = math.floor((air.blown + advance) / _SPACING)
        if layers == 0:
            return air.positions, air.velocities
        sideways = np.array([direction[2], 0.0, -direction[0]])
        depth = float(np.abs(direction) @ self.half)
        width = float(np.abs(sideways) @ self.half)
        across = np.arange(-width, width + 1e-9, _SPACING)
        up = np.arange(-self.half[1], self.half[1] + 1e-9, _SPACING)
        a, b, c = (part.ravel() for part in np.meshgrid(across, up, np.arange(layers), indexing="ij"))
        fresh = (
            self.centre
            + a[:, None] * sideways
            + b[:, None] * np.array([0.0, 1.0, 0.0])
            + (c * _SPACING - depth)[:, None] * direction
        )
        fresh = fresh + self._rng.uniform(-0.25 * _SPACING, 0.25 * _SPACING, fresh.shape)
        fresh = fresh[np.all(np.abs(fresh - self.centre) <= self.half + _SPACING, axis=1)]
        return (
            np.concatenate([air.positions, fresh]),
            np.concatenate([air.velocities, np.broadcast_to(wind, fresh.shape)]),
        )

    def _acceleration(self, positions: Floats, velocities: Floats, wind: Floats) -> Floats:
        """Pressure of the air (eq. 16 for a gas) and the wind that drives it on [m/s^2], (k, 3)."""
        acceleration = _RELAXATION * (wind - velocities)
        h = self.smoothing_length
        pairs = find_pairs(positions, 2.0 * h)
        if len(pairs) == 0:
            return acceleration
        i, j = pairs.T
        x = positions[j] - positions[i]
        distance = np.linalg.norm(x, axis=1)
        count = len(positions)
        weight = kernel(distance, h)
        own = kernel(np.zeros(1), h)
        density = self.mass * (own + np.bincount(i, weight, count) + np.bincount(j, weight, count))
        # Only crowding pushes: the edges of the box are no vacuum that would suck the air out.
        over_square = _SOUND**2 * np.maximum(density - AIR_DENSITY, 0.0) / density**2
        slope = kernel_slope(distance, h) / np.maximum(distance, 1e-9)
        push = (self.mass * (over_square[i] + over_square[j]) * slope)[:, None] * x
        for axis in range(3):
            acceleration[:, axis] += np.bincount(i, push[:, axis], count) - np.bincount(j, push[:, axis], count)
        return acceleration

    def exchange(
        self, air: Floats, air_velocities: Floats, hair: Floats, hair_velocities: Floats, drag: float, dt: float
    ) -> Exchange:
        """Drag between air and hair that are near each other: equal and opposite momentum for each pair.

        Positions [m] and velocities [m/s] in the world, (k, 3) and (n, 3). dt: [s]. Pairs relax toward each other; a
        particle with many neighbours shares itself among them, so that no step can overshoot.
        """
        h = self.smoothing_length
        pairs = _near_pairs(air, hair, 2.0 * h)
        hair_gain, air_gain = np.zeros_like(hair), np.zeros_like(air)
        if drag == 0.0 or len(pairs) == 0:
            return Exchange(hair_gain, air_gain)
        a, b = pairs.T
        weight = kernel(np.linalg.norm(air[a] - hair[b], axis=1), h)
        mass_b = self.model.mass[b]
        # Coefficient of each pair [kg/s]: in air of its normal density hair is slowed at the exchange rate.
        coefficient = drag * _EXCHANGE_RATE * (self.mass / AIR_DENSITY) * weight * mass_b
        load_a = np.bincount(a, coefficient, len(air))[a] / self.mass
        load_b = np.bincount(b, coefficient, len(hair))[b] / mass_b
        coefficient = coefficient * dt / (1.0 + dt * (load_a + load_b))
        impulse = coefficient[:, None] * (air_velocities[a] - hair_velocities[b])
        for axis in range(3):
            hair_gain[:, axis] = np.bincount(b, impulse[:, axis], len(hair))
            air_gain[:, axis] = -np.bincount(a, impulse[:, axis], len(air))
        return Exchange(hair_gain, air_gain)

    def _stop_at_body(self, positions: Floats, velocities: Floats, frame: HeadFrame) -> Floats:
        """Air flows around the head and does not blow through it."""
        distance, normals, _ = self.body.planes(frame.to_head(positions), frame)
        normals = frame.rotation.apply(normals)
        near = distance < 0.5 * _SPACING
        inward = np.minimum(np.einsum("ij,ij->i", velocities, normals), 0.0)
        return velocities - np.where(near, inward, 0.0)[:, None] * normals


def _near_pairs(first: Floats, second: Floats, radius: float) -> Ints:
    """Pairs (a, b) with first[a] and second[b] closer than ``radius`` [m], (p, 2)."""
    if len(first) == 0 or len(second) == 0:
        return np.zeros((0, 2), dtype=np.int64)
    found = cKDTree(first).sparse_distance_matrix(cKDTree(second), radius, output_type="ndarray")
    return np.column_stack([found["i"], found["j"]])


def _gust(time: float) -> float:
    """A slow irregular swing between -1 and 1: three sines that do not share a period. time: [s]."""
    return (math.sin(2.1 * time) + math.sin(3.7 * time + 1.0) + math.sin(6.1 * time + 2.0)) / 3.0
