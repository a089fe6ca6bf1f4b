"""Hair as particles: what is built once, and what moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats, Ints


@dataclass(frozen=True, eq=False)
class HairModel:
    """Everything about a head of hair that stays constant while it moves, n particles and m links.

    coordinates: (u, v, s) of every particle, s being the arc length from the scalp [m] and negative below it, (n, 3).
    root_points: where the particle's hair leaves the scalp [m], (n, 3), head frame. rest_positions [m] and
    rest_directions (unit): the initial state, (n, 3). mass [kg], (n,). fixed: True for root particles, (n,).

    links: particle pairs, the rootward one first, (m, 2). rest_length l_ij [m], alignment a_ij (eq. 6) and strength
    c_ij (eq. 5), (m,). rest_cosine: cosines of theta_ij and theta_ji, (m, 2). lifeline: the link by which a particle
    hangs on the scalp, -1 for root particles, (n,).

    smoothing_length_links is h_1 and smoothing_length is h_2 of the paper [m]; spacing is the mean distance of
    neighbours [m]. rest_density: density in the initial state [kg/m^3], (n,). rest_clearance: distance to the body in the
    initial state [m], infinite far from it, (n,). bending_length: of the beams that gave the initial state [m].
    """

    coordinates: Floats
    root_points: Floats
    rest_positions: Floats
    rest_directions: Floats
    mass: Floats
    fixed: NDArray[np.bool_]
    links: Ints
    rest_length: Floats
    alignment: Floats
    strength: Floats
    rest_cosine: Floats
    lifeline: Ints
    smoothing_length_links: float
    smoothing_length: float
    spacing: float
    rest_density: Floats
    rest_clearance: Floats
    bending_length: float

    @property
    def count(self) -> int:
        """Number of particles."""
        return len(self.mass)

    @property
    def arc_length(self) -> Floats:
        """s of every particle [m], (n,)."""
        return self.coordinates[:, 2]


@dataclass(frozen=True, eq=False)
class HairState:
    """What moves: positions [m], velocities [m/s] and unit hair directions in the head frame, (n, 3), at a time [s].

    before: positions and velocities one step earlier on a straight path, for solvers that look back; None after a fresh
    start.
    """

    positions: Floats
    velocities: Floats
    directions: Floats
    time: float = 0.0
    before: tuple[Floats, Floats] | None = None

    @classmethod
    def at_rest(cls, model: HairModel) -> HairState:
        """The initial state of the model."""
        return cls(
            model.rest_positions.copy(order="K"),
            np.zeros_like(model.rest_positions),
            model.rest_directions.copy(order="K"),
        )
