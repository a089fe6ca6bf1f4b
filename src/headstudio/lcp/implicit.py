"""The real-time solver: springs implicitly, everything else explicitly, second order in time.

The backward difference formula of second order (BDF2) looks at two earlier states. With x^ = (4 x_n - x_{n-1}) / 3, v^
alike and g = 2/3 of the step,

    x = x^ + g v,     M (v - v^) = g f(x, v),

is solved by one Newton step from the velocities that the last two steps foretell:

    (M (1 + g c) + g D + g^2 K) dv = M v^ + g f - M (1 + g c) v,

K and D being the stiffness and damping of the springs, c air friction. The matrix is symmetric and positive definite
(compressed links count only along themselves), its pattern never changes, and conjugate gradients solve it.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ..head.mesh import Floats
from .dynamics import Circumstances, Dynamics
from .model import HairState
from .springs import LinkState

_TOLERANCE = 1e-3
_MOST_ITERATIONS = 60


class ImplicitSolver:
    """Steps hair at the rate of the display, whatever the stiffness."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.iterations = 0
        self._matrix = _SpringMatrix(dynamics)

    def step(self, state: HairState, now: Circumstances, dt: float) -> HairState:
        """The state one step of dt [s] later, by section 3.1 of the paper."""
        dynamics, settings = self.dynamics, now.settings
        model = dynamics.model
        mass = model.mass[:, None]
        x, v = state.positions, state.velocities
        x_before, v_before = state.before or (x - dt * v, v)
        x_hat, v_hat = (4.0 * x - x_before) / 3.0, (4.0 * v - v_before) / 3.0
        g = 2.0 * dt / 3.0

        foretold = 2.0 * v - v_before
        ahead = x_hat + g * foretold
        touch = dynamics.touch(ahead, now.frame)
        soft = dynamics.soft_acceleration(now, ahead, foretold, v, state.directions, touch, dt)
        links = dynamics.links(ahead, settings)
        force = mass * soft + dynamics.springs.forces(links, foretold, settings)
        inertia = 1.0 + g * settings.air_friction
        right = mass * v_hat + g * force - mass * inertia * foretold
        with dynamics.timer.stage("solve"):
            self._matrix.update(links, settings, g, inertia)
            change = self._matrix.solve(right)
            self.iterations += self._matrix.iterations

        v_new = foretold + change
        # The distance of x^ on the plane that was seen from ``ahead``.
        distance = touch.distance - g * np.einsum("ij,ij->i", foretold, touch.normals)
        v_new, held = dynamics.hold(x_hat, v_new, touch, distance, settings.body_friction, g)
        x_new = x_hat + g * v_new
        directions = dynamics.turn(x_new, state.directions, settings)
        # A held particle has a kink in its path: it looks back on a straight one, or it would bounce.
        before = (np.where(held[:, None], x_new - dt * v_new, x), np.where(held[:, None], v_new, v))
        return HairState(x_new, v_new, directions, state.time + dt, before)


class _SpringMatrix:
    """The matrix of the free particles in 3 x 3 blocks, with a fixed pattern, and its solution."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.springs = dynamics.springs
        model = dynamics.model
        self.model = model
        free = np.flatnonzero(~model.fixed)
        self.free = free
        place = np.full(model.count, -1)
        place[free] = np.arange(len(free))
        rootward, tipward = place[model.links].T
        self.inner = np.flatnonzero((rootward >= 0) & (tipward >= 0))
        a, b = rootward[self.inner], tipward[self.inner]
        count = len(free)
        # Numbering the blocks and letting scipy sort them tells where each one goes.
        rows = np.concatenate([np.arange(count), a, b])
        columns = np.concatenate([np.arange(count), b, a])
        numbered = sparse.csr_array((np.arange(1, len(rows) + 1), (rows, columns)), shape=(count, count))
        numbered.sort_indices()
        place_of = np.empty(len(rows), dtype=np.int64)
        place_of[numbered.data - 1] = np.arange(len(rows))
        self._diagonal = place_of[:count]
        self._upper = place_of[count : count + len(a)]
        self._lower = place_of[count + len(a) :]
        self._blocks = np.zeros((len(rows), 3, 3))
        self._matrix = sparse.bsr_array((self._blocks, numbered.indices, numbered.indptr), shape=(3 * count, 3 * count))
        self._blocks = self._matrix.data
        self.iterations = 0

    def update(self, links: LinkState, settings: object, g: float, inertia: float) -> None:
        """Fill the blocks for the links at one instant."""
        springs, model = self.springs, self.model
        pull, stiffness = springs.tension(links, settings.bending_scale)  # type: ignore[attr-defined]
        damping = springs.damping(stiffness, settings.spring_damping)  # type: ignore[attr-defined]
        # A pulled link also resists turning; a pushed one would help it, and is left out to keep the matrix definite.
        turning = g * g * np.maximum(pull, 0.0) / np.maximum(links.length, 1e-9)
        along = g * g * stiffness + g * damping - turning
        block = (along[:, None] * links.unit)[:, :, None] * links.unit[:, None, :]
        block[:, [0, 1, 2], [0, 1, 2]] += turning[:, None]
        flat = block.reshape(-1, 9)
        self._blocks[self._upper] = -block[self.inner]
        self._blocks[self._lower] = -block[self.inner]
        diagonal = springs.sum_at_ends(flat, flat)[self.free].reshape(-1, 3, 3)
        diagonal[:, [0, 1, 2], [0, 1, 2]] += (inertia * model.mass[self.free])[:, None]
        self._blocks[self._diagonal] = diagonal
        self._inverse = np.linalg.inv(diagonal)

    def solve(self, right: Floats) -> Floats:
        """Conjugate gradients, preconditioned with the inverted diagonal blocks; (n, 3), zero for root particles."""
        matrix, inverse = self._matrix, self._inverse
        residual = right[self.free].ravel()
        solution = np.zeros_like(residual)

        def precondition(r: Floats) -> Floats:
            return np.einsum("nij,nj->ni", inverse, r.reshape(-1, 3)).ravel()

        z = precondition(residual)
        direction = z.copy()
        rho = residual @ z
        goal = _TOLERANCE**2 * rho
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
