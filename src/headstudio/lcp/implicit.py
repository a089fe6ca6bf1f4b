"""The real-time solver: springs implicitly, everything else explicitly, second order in time.

The backward difference formula of second order (BDF2) looks at two earlier states. With x^ = (4 x_n - x_{n-1}) / 3, v^
alike and g = 2/3 of the step,

    x = x^ + g v,     M (v - v^) = g f(x, v),

is solved by one Newton step from the present velocities, with the forces that they lead to:

    (M (1 + g c + g^2 kappa) + g D + g^2 K) dv = M (v^ - (1 + g c) v) + g f(x^ + g v, v),

K and D being the stiffness and damping of the springs, kappa that of bending, c air friction. The matrix is symmetric
and positive definite (compressed links count only along themselves), its pattern never changes, and conjugate gradients
solve it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import sparse

from ..head.mesh import Floats
from .dynamics import Circumstances, Dynamics
from .model import HairState
from .settings import DynamicsSettings
from .springs import LinkState

# A step has two parts for links of 3 cm and more the shorter they are, so that between two parts no link turns round; and
# more, for accuracy, as long as few particles leave the time for it.
_FEWEST_PARTS, _MOST_PARTS = 2, 6
_PART_LENGTH = 0.056  # [m]
_PARTICLES_IN_TIME = 5000  # particles times parts that keep up with real time
_STRAIGHTENED = 3.0  # times a kink: what a stop takes from the path behind
_TOLERANCE = 1e-2
_MOST_ITERATIONS = 60


class ImplicitSolver:
    """Steps hair at the rate of the display, whatever the stiffness."""

    def __init__(self, dynamics: Dynamics, parts: int | None = None, tolerance: float = _TOLERANCE) -> None:
        """parts: of a step; by the length of links and what real time affords if not given. tolerance: of the solution."""
        self.dynamics = dynamics
        self.iterations = 0
        model = dynamics.model
        length = float(np.median(model.rest_length)) if len(model.rest_length) else _PART_LENGTH
        affordable = min(_PARTICLES_IN_TIME // max(model.count, 1), _MOST_PARTS)
        self.parts = parts or max(_FEWEST_PARTS, round(_PART_LENGTH / length), affordable)
        self._matrix = _SpringMatrix(dynamics, tolerance)

    def step(self, state: HairState, now: Circumstances, dt: float) -> HairState:
        """The state one step of dt [s] later, by section 3.1 of the paper.

        Hair-hair interactions are the dear part and change slowly: they are found once. Springs, inertia and contact go
        through the step in ``parts``.
        """
        dynamics = self.dynamics
        outer = dynamics.outer_acceleration(state, now, dt)
        directions = state.directions
        rest_turn = dynamics.bending.rest_turn(directions)
        for _ in range(self.parts):
            state = self._part(state, now, outer, rest_turn, dt / self.parts)
        return replace(state, directions=dynamics.turn(state.positions, directions, now.settings))

    def _part(self, state: HairState, now: Circumstances, outer: Floats, rest_turn: Floats, dt: float) -> HairState:
        """One BDF2 step of dt [s] under the accelerations ``outer`` [m/s^2], with Bending.rest_turn, (n, 3) each."""
        dynamics, settings, frame = self.dynamics, now.settings, now.at(state.time + dt)
        model = dynamics.model
        mass = model.mass[:, None]
        x, v = state.positions, state.velocities
        x_before, v_before = state.before or self._earlier(state, now, outer, rest_turn, dt)
        # Hair that lies on the body goes on lying there. Without that push the solution would let it fall, and take its
        # neighbours along before the body could stop it.
        push = np.zeros_like(x) if state.before is None or state.push is None else state.push
        x_hat, v_hat = (4.0 * x - x_before) / 3.0, (4.0 * v - v_before) / 3.0
        g = 2.0 * dt / 3.0

        ahead = x_hat + g * v
        links = dynamics.links(ahead, settings)
        force = mass * (outer + push + dynamics.inner_acceleration(settings, frame, ahead, v, rest_turn, dt))
        force += dynamics.springs.forces(links, v, settings)
        right = mass * (v_hat - (1.0 + g * settings.air_friction) * v) + g * force
        with dynamics.timer.stage("solve"):
            inertia = 1.0 + g * settings.air_friction + g * g * dynamics.bending.kappa(settings)
            self._matrix.update(links, settings, g, inertia * model.mass)
            change = self._matrix.solve(right, v - v_before)
            self.iterations += self._matrix.iterations

        free = v + change
        # The plane that a particle would run into tells how far from it the step starts.
        touch = dynamics.touch(x_hat + g * free, frame)
        distance = touch.distance - g * np.einsum("ij,ij->i", free - touch.velocity, touch.normals)
        # The push is found anew: what is not needed any more is taken away again.
        v_new, push = dynamics.hold(x_hat, free - g * push, touch, distance, now, g)
        distance = distance + g * np.einsum("ij,ij->i", v_new - touch.velocity, touch.normals)
        x_new = dynamics.put_back(x_hat + g * v_new, touch, distance, now)
        # A stopped particle has a kink in its path. It looks back on one straightened by that much, or it would bounce.
        kink = x_new - (x_hat + g * free)
        before = (
            x + _along(kink, x_new - dt * v_new - x, _STRAIGHTENED),
            v + _along(kink, v_new - v, _STRAIGHTENED / g),
        )
        return HairState(x_new, v_new, state.directions, state.time + dt, before, push)

    def _earlier(
        self, state: HairState, now: Circumstances, outer: Floats, rest_turn: Floats, dt: float
    ) -> tuple[Floats, Floats]:
        """A position and velocity for the part before the first, such that the first is of second order, too."""
        dynamics, settings, frame = self.dynamics, now.settings, now.at(state.time)
        x, v = state.positions, state.velocities
        touch = dynamics.touch(x, frame)
        springs = dynamics.springs.forces(dynamics.links(x, settings), v, settings)
        acceleration = outer - settings.air_friction * v
        acceleration += dynamics.inner_acceleration(settings, frame, x, v, rest_turn, dt)
        acceleration += springs / dynamics.model.mass[:, None]
        held, _ = dynamics.hold(x, v + dt * acceleration, touch, touch.distance, now, dt)
        acceleration = (held - v) / dt
        return x - dt * v + 0.5 * dt * dt * acceleration, v - dt * acceleration


def _along(way: Floats, a: Floats, most: float) -> Floats:
    """The part of ``a`` along ``way``, row by row, no longer than ``most`` times that way, (n, 3)."""
    square = np.einsum("ij,ij->i", way, way)
    share = np.einsum("ij,ij->i", way, a) / np.maximum(square, 1e-30)
    return np.clip(share, -most, most)[:, None] * way


def _inverse_of_symmetric(blocks: Floats) -> Floats:
    """The inverses of symmetric 3 x 3 matrices by their cofactors, (n, 3, 3): a third of the time of a general solver."""
    a, b, c = blocks[:, 0, 0], blocks[:, 0, 1], blocks[:, 0, 2]
    d, e, f = blocks[:, 1, 1], blocks[:, 1, 2], blocks[:, 2, 2]
    cofactors = np.empty_like(blocks)
    cofactors[:, 0, 0] = d * f - e * e
    cofactors[:, 0, 1] = cofactors[:, 1, 0] = c * e - b * f
    cofactors[:, 0, 2] = cofactors[:, 2, 0] = b * e - c * d
    cofactors[:, 1, 1] = a * f - c * c
    cofactors[:, 1, 2] = cofactors[:, 2, 1] = b * c - a * e
    cofactors[:, 2, 2] = a * d - b * b
    determinant = a * cofactors[:, 0, 0] + b * cofactors[:, 0, 1] + c * cofactors[:, 0, 2]
    return cofactors / determinant[:, None, None]


class _SpringMatrix:
    """The matrix of the free particles in 3 x 3 blocks, with a fixed pattern, and its solution."""

    def __init__(self, dynamics: Dynamics, tolerance: float) -> None:
        self.tolerance = tolerance
        self.springs = dynamics.springs
        model = dynamics.model
        self.model = model
        free = np.flatnonzero(~model.fixed)
        self.free = free
        place = np.full(model.count, -1)
        place[free] = np.arange(len(free))
        rootward, tipward = place[model.links].T
        inner = np.flatnonzero((rootward >= 0) & (tipward >= 0))
        a, b = rootward[inner], tipward[inner]
        count = len(free)
        # Numbering the blocks and letting scipy sort them tells where each one goes.
        rows = np.concatenate([np.arange(count), a, b])
        columns = np.concatenate([np.arange(count), b, a])
        numbered = sparse.csr_array((np.arange(1, len(rows) + 1), (rows, columns)), shape=(count, count))
        numbered.sort_indices()
        place_of = np.empty(len(rows), dtype=np.int64)
        place_of[numbered.data - 1] = np.arange(len(rows))
        self._diagonal = place_of[:count]
        # The link that couples the two particles of a block; blocks of the diagonal are overwritten.
        self._link_of = np.zeros(len(rows), dtype=np.int64)
        self._link_of[place_of[count:]] = np.concatenate([inner, inner])
        self._blocks = np.zeros((len(rows), 3, 3))
        self._matrix = sparse.bsr_array((self._blocks, numbered.indices, numbered.indptr), shape=(3 * count, 3 * count))
        self._blocks = self._matrix.data
        self.iterations = 0

    def update(self, links: LinkState, settings: DynamicsSettings, g: float, inertia: Floats) -> None:
        """Fill the blocks for the links at one instant. inertia: what stands on the diagonal besides them [kg], (n,)."""
        springs = self.springs
        pull, stiffness = springs.tension(links, settings.bending_scale)
        damping = springs.damping(stiffness, settings.spring_damping)
        # A pulled link also resists turning; a pushed one would help it, and is left out to keep the matrix definite.
        turning = g * g * np.maximum(pull, 0.0) / np.maximum(links.length, 1e-9)
        along = g * g * stiffness + g * damping - turning
        across = turning + g * springs.friction(settings.inner_friction)
        block = (along[:, None] * links.unit)[:, :, None] * links.unit[:, None, :]
        block.reshape(-1, 9)[:, ::4] += across[:, None]
        diagonal = springs.sum_around(block.reshape(-1, 9))[self.free]
        diagonal[:, ::4] += inertia[self.free, None]
        np.take(-block, self._link_of, axis=0, out=self._blocks, mode="clip")
        self._blocks[self._diagonal] = diagonal.reshape(-1, 3, 3)
        self._inverse = _inverse_of_symmetric(diagonal.reshape(-1, 3, 3))

    def solve(self, right: Floats, guess: Floats) -> Floats:
        """Conjugate gradients from ``guess``, preconditioned with the inverted diagonal blocks; (n, 3), root particles zero."""
        matrix, inverse = self._matrix, self._inverse
        wanted = right[self.free].ravel()
        solution = guess[self.free].ravel()
        residual = wanted - matrix @ solution

        def precondition(r: Floats) -> Floats:
            return np.einsum("nij,nj->ni", inverse, r.reshape(-1, 3)).ravel()

        z = precondition(residual)
        direction = z.copy()
        rho = residual @ z
        if not np.isfinite(rho):
            # A force that is no number must not pass for one that is solved.
            return np.full_like(right, np.nan)
        goal = self.tolerance**2 * (wanted @ precondition(wanted))
        self.iterations = 0
        while rho > goal and self.iterations < _MOST_ITERATIONS:
            image = matrix @ direction
            step = rho / (direction @ image)
            solution += step * direction
            residual -= step * image
            z = precondition(residual)
            rho, last = residual @ z, rho
            direction = z + (rho / last) * direction
            self.iterations += 1
        result = np.zeros_like(right)
        result[self.free] = solution.reshape(-1, 3)
        return result
