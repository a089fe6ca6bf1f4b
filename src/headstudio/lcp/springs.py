"""The springs that carry hair lengthwise and let it go sideways: Bando et al. 2006, section 3.3.

The links are few and fixed, so everything about them that does not move is worked out once, and the sums over the links
of a particle are products with sparse matrices.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..head.mesh import Floats
from ..head.rows import OnColumns, row_dot, row_length
from .kernel import kernel
from .model import HairModel
from .settings import DynamicsSettings

HAIR_MATERIAL_DENSITY = 1300.0  # delta of eq. 9 [kg/m^3]
# A particle whose links have all but let go keeps this part of its lifeline, and alpha is bounded where a sum of springs
# has fallen below this part of what it was at rest.
_LAST_HOLD = 1e-3


@dataclass(frozen=True, eq=False)
class LinkState:
    """The links at one instant, m of them: unit vectors from the rootward to the tipward particle, (m, 3), lengths [m] and
    scaled spring coefficients alpha_ij k_ij [N/m], (m,)."""

    unit: Floats
    length: Floats
    stiffness: Floats


@dataclass(frozen=True, eq=False)
class Load:
    """What damped springs do at one instant, m of them: how strongly each pulls [N], negative when it pushes, its stiffness
    then [N/m], its damping along itself [kg/s], and its friction in all directions [kg/s], (m,)."""

    pull: Floats
    stiffness: Floats
    damping: Floats
    friction: Floats


class Springs:
    """The springs of one head of hair.

    section: A_i of eq. 9 [m^2], (n,). around: the matrix that sums over all links of a particle, (n, m).
    """

    def __init__(self, model: HairModel) -> None:
        self.model = model
        count, links = model.count, len(model.links)
        rows = np.arange(links)
        ones = np.ones(links)
        rootward, tipward = model.links.T
        shape = (count, links)
        self._sum_at_rootward = sparse.csr_array((ones, (rootward, rows)), shape=shape)
        self._sum_at_tipward = sparse.csr_array((ones, (tipward, rows)), shape=shape)
        spread = (self._sum_at_rootward - self._sum_at_tipward).tocsr()
        self._spread, self._difference = OnColumns(spread), OnColumns(-spread.T.tocsr())
        self.around = (self._sum_at_rootward + self._sum_at_tipward).tocsr()
        self.section = (model.mass / HAIR_MATERIAL_DENSITY) ** (2.0 / 3.0)
        rest = model.strength * kernel(model.rest_length, model.smoothing_length_links)
        self._least = np.zeros(links)
        held = model.lifeline[model.lifeline >= 0]
        self._least[held] = _LAST_HOLD * np.maximum(rest[held], _LAST_HOLD * rest.mean())
        first, second = model.mass[model.links].T
        self._reduced_mass = first * second / (first + second)
        degree = np.maximum(np.bincount(model.links.ravel(), minlength=count), 1)
        # A particle that moves against all that it is linked to is slowed down at the rate of the inner friction.
        self._shared_mass = np.sqrt(np.prod((model.mass / degree)[model.links], axis=1))
        self._least_tipward_sum = np.maximum(_LAST_HOLD * (self._sum_at_rootward @ (model.rest_length * rest)), 1e-300)

    def at(self, positions: Floats, elastic_modulus: float) -> LinkState:
        """Directions, lengths and coefficients of the springs. positions: [m], (n, 3). elastic_modulus: E [Pa]."""
        offset = self._difference @ positions
        length = row_length(offset)
        unit = offset / np.maximum(length, 1e-9)[:, None]
        return LinkState(unit, length, self._stiffness(length, elastic_modulus))

    def _stiffness(self, length: Floats, elastic_modulus: float) -> Floats:
        """alpha_ij k_ij: eq. 7, then 13 for both sides, then their mean, 14."""
        model = self.model
        rootward, tipward = model.links.T
        raw = np.maximum(model.strength * kernel(length, model.smoothing_length_links), self._least)  # eq. 7
        pull = model.rest_length * raw
        wanted = elastic_modulus * self.section
        # A tipward particle sees the link among its rootward ones, and the other way round. Lifelines keep the first sum
        # above zero; the second falls to zero at a tip that everything has left.
        alpha_r = wanted / np.maximum(self._sum_at_tipward @ pull, 1e-300)  # eq. 13
        alpha_t = wanted / np.maximum(self._sum_at_rootward @ pull, self._least_tipward_sum)
        return 0.5 * (alpha_r[tipward] + alpha_t[rootward]) * raw  # eq. 14

    def tension(self, links: LinkState, bending_scale: float) -> tuple[Floats, Floats]:
        """Force along each link [N], positive when it pulls, and its stiffness [N/m], both (m,).

        Compressed springs keep only ``bending_scale`` of their force (thesis, section 3.3.2).
        """
        stretch = links.length - self.model.rest_length
        stiffness = np.where(stretch >= 0, links.stiffness, bending_scale * links.stiffness)
        return stiffness * stretch, stiffness

    def damping(self, stiffness: Floats, ratio: float) -> Floats:
        """Damping coefficient of each link [kg/s], ``ratio`` of the critical one of its two ends, (m,)."""
        return 2.0 * ratio * np.sqrt(stiffness * self._reduced_mass)

    def friction(self, rate: float) -> Floats:
        """Coefficient of each link [kg/s] with which linked hair takes up a common velocity at ``rate`` [1/s], (m,)."""
        return rate * self._shared_mass

    def load(self, links: LinkState, settings: DynamicsSettings) -> Load:
        """What the springs do under these settings."""
        pull, stiffness = self.tension(links, settings.bending_scale)
        damping = self.damping(stiffness, settings.spring_damping)
        return Load(pull, stiffness, damping, self.friction(settings.inner_friction))

    def forces(self, links: LinkState, load: Load, velocities: Floats) -> Floats:
        """Force of the damped springs on every particle [N], (n, 3). velocities: [m/s], (n, 3)."""
        parting = self._difference @ velocities
        closing = row_dot(parting, links.unit)
        pull = load.pull + load.damping * closing
        return self.spread(pull[:, None] * links.unit + load.friction[:, None] * parting)

    def spread(self, pull: Floats) -> Floats:
        """Add what pulls along every link to its rootward particle and take it from its tipward one, (m, 3) to (n, 3)."""
        return self._spread @ pull
