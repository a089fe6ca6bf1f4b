"""The bending stiffness that the springs lack.

The springs of the paper hold hair lengthwise; "the bending stiffness is not modeled explicitly" (Bando et al. 2006,
section 6). So a head of hair would begin by sinking from its cantilever shape, and fold between one particle and the
next, where a hair of that length is far too stiff to fold. Hair here keeps the rigidity B of the beam that shaped it, in
two ways.

Near the root it keeps its place. A beam of length s, with the bending length l, carries the weight across it and swings
with the square frequency kappa(s) = 12.4 g l^3 / s^4 of its first mode: each particle is drawn to its place in the initial
shape with kappa(s), strong at the root and nothing at the tip.

Everywhere it keeps its curvature. At each particle the mean way to its tipward neighbours, per length, less the mean way
from its rootward ones is how far the hair turns there; the beam answers with the energy B / 2 times curvature squared.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import eigsh

from ..head.mesh import Floats
from ..head.rows import OnColumns, in_columns, row_dot, row_length
from .kernel import kernel
from .model import HairModel
from .settings import DynamicsSettings

_FIRST_MODE = 12.36  # 1.8751^4: first mode of a clamped beam
_STANDARD_GRAVITY = 9.81  # the one the beam was bent by [m/s^2]
_HIGHEST = 2000.0  # of kappa [1/s^2]: stiffer hair moves with the head all the same
_REACH = 2.0  # bending lengths at which half of the weight is still carried
# Of a square frequency times a square step: what a step carries that is explicit in everything, and what one does whose
# springs are implicit, and whose limit without them would be 1.75.
_STEP_LIMIT, _PART_LIMIT = 0.5, 1.0
_RELAXATION = 0.004  # bending dies away within this time beyond its period [s]


@dataclass(frozen=True, eq=False)
class StiffTurning:
    """Energy of bending, the sum of rigidity / 2 [J], (k,), times the squares of the turns that ``turn`` makes of positions,
    (k, n) [rad/m]."""

    turn: sparse.csr_array
    rigidity: Floats

    def damped(self, g: float) -> Floats:
        """``rigidity`` in M + g D + g^2 K for an implicit step of weight g [s], (k,)."""
        return g * (g + _RELAXATION) * self.rigidity


class Bending:
    """What a model needs to know about its bending stiffness."""

    def __init__(self, model: HairModel) -> None:
        self.model = model
        s = np.maximum(model.arc_length, 1e-6)
        length = model.bending_length
        self._kappa = np.minimum(_FIRST_MODE * _STANDARD_GRAVITY * length**3 / s**4, _HIGHEST)
        down = np.array([0.0, -1.0, 0.0])
        t = model.rest_directions
        across = down - (t @ down)[:, None] * t
        carried = 1.0 / (1.0 + (s / (_REACH * length)) ** 4)
        self._support = -carried[:, None] * across
        self._turn, distance = _turning(model)
        self._turns, self._turn_back = OnColumns(self._turn), OnColumns(self._turn.T.tocsr())
        self._rest_turn = in_columns(self._turn @ model.rest_positions)
        # B = w l^3 with w the weight per length: energy of a turn of one radian over the distance, per mass [J/kg].
        self._rigidity = _STANDARD_GRAVITY * length**3 / distance**2
        self._fastest = _square_frequencies(self._turn, self._rigidity)

    def kappa(self, settings: DynamicsSettings) -> Floats:
        """Square frequency with which every particle returns to its place [1/s^2], (n,)."""
        return settings.hold * self._kappa

    def place(self, positions: Floats, settings: DynamicsSettings) -> Floats:
        """Acceleration back to the initial shape, and of the weight that it carries [m/s^2], (n, 3).

        positions: head frame [m], (n, 3). All of the weight is carried from ``hold`` 1 on.
        """
        back = self.kappa(settings)[:, None] * (self.model.rest_positions - positions)
        return back + min(settings.hold, 1.0) * settings.gravity * self._support

    def rest_turn(self, directions: Floats) -> Floats:
        """How far hair of these unit directions, (n, 3), turns at every particle when it is at rest [rad], (n, 3)."""
        return turned_along(self._rest_turn, self.model.rest_directions, directions)

    def rigidity(self, settings: DynamicsSettings) -> Floats:
        """Energy of a turn of one radian at every particle, times two [J], (n,)."""
        return self.model.mass * settings.stiffness * self._rigidity

    def carried(self, settings: DynamicsSettings, dt: float) -> Floats:
        """Part of ``rigidity``, 0 to 1, that an explicit step of dt [s] carries, (n,)."""
        return 1.0 / np.maximum(settings.stiffness * self._fastest * dt * dt / _STEP_LIMIT, 1.0)

    def curvature_force(self, positions: Floats, velocities: Floats, rest_turn: Floats, rigidity: Floats) -> Floats:
        """Force that restores the curvature of the initial shape [N], (n, 3).

        positions [m] and velocities [m/s], head frame, and what ``rest_turn`` says of the directions, (n, 3). rigidity: as
        above [J], (n,).
        """
        excess = self._turns @ (positions + _RELAXATION * velocities) - rest_turn
        return -(self._turn_back @ (rigidity[:, None] * excess))

    def too_stiff(self, settings: DynamicsSettings, dt: float) -> StiffTurning:
        """What of the bending an explicit step of dt [s] does not carry, for the matrix of an implicit one."""
        rows = np.flatnonzero(settings.stiffness * self._fastest * dt * dt > _PART_LIMIT)
        return StiffTurning(self._turn[rows], self.rigidity(settings)[rows])


def _square_frequencies(turn: sparse.csr_array, rigidity: Floats) -> Floats:
    """Square of the fastest bending frequency around every particle [1/s^2], (n,), at stiffness 1.

    In proportion to how sharply each can turn against its neighbours, and scaled to the fastest there is.
    """
    around = rigidity * np.asarray(abs(turn).sum(axis=1)) ** 2
    if not around.any():
        return around
    energy = turn.T @ sparse.diags_array(rigidity) @ turn
    fastest = eigsh(energy, k=1, return_eigenvectors=False, v0=np.ones(turn.shape[0]), tol=1e-2)[0]
    return around * (float(fastest) / around.max())


def _turning(model: HairModel) -> tuple[sparse.csr_array, Floats]:
    """The matrix from positions to how far hair turns at every particle [rad], and over what distance [m], (n,).

    A row is empty where there is nothing on one side: at root particles and at tips.
    """
    rootward, tipward = model.links.T
    h = model.smoothing_length_links
    # A link that reaches further than 2 h_1 may be all that a particle has.
    weight = model.strength * np.maximum(kernel(model.rest_length, h), 1e-6 * kernel(np.zeros(1), h))
    shape = (model.count, model.count)
    before = _mean_of(tipward, rootward, weight, shape)
    after = _mean_of(rootward, tipward, weight, shape)
    whole = ((abs(before).sum(axis=1) > 0) & (abs(after).sum(axis=1) > 0) & ~model.fixed).astype(float)
    one = sparse.eye_array(model.count, format="csr")
    from_root, to_tip = (one - before) @ model.rest_positions, (after - one) @ model.rest_positions
    from_root, to_tip = (np.maximum(row_length(a), 1e-3) for a in (from_root, to_tip))
    scaled = sparse.diags_array(whole / to_tip) @ (after - one) - sparse.diags_array(whole / from_root) @ (one - before)
    return scaled.tocsr(), 0.5 * (from_root + to_tip)


def _mean_of(at: np.ndarray, of: np.ndarray, weight: Floats, shape: tuple[int, int]) -> sparse.csr_array:
    """The matrix that takes the weighted mean over the particles ``of`` at the particles ``at``, row by row."""
    total = np.bincount(at, weight, shape[0])
    return sparse.csr_array((weight / total[at], (at, of)), shape=shape)


def turned_along(vectors: Floats, before: Floats, after: Floats) -> Floats:
    """``vectors`` turned by the smallest turn that leads from the unit directions ``before`` to ``after``, (n, 3) each."""
    cosine = row_dot(before, after)
    along_before, along_after = row_dot(before, vectors), row_dot(after, vectors)
    # Rodrigues' formula v + a x v + a x (a x v) / (1 + cos) about a, the cross product of the directions, written out.
    # Hair that points the other way round turns about any axis.
    scale = 1.0 / np.maximum(1.0 + cosine, 1e-3)
    to_after = along_before + scale * (cosine * along_before - along_after)
    to_before = along_after + scale * (along_before - cosine * along_after)
    return vectors + to_after[:, None] * after - to_before[:, None] * before
