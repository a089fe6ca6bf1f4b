"""No two locks go quite alike: each strays from the way that all go, slowly to and fro, and its neighbours with it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats, Ints

# Waves over the scalp, so many, and how long: shorter than a lock is none, and from a third of the head on hair would lean.
_WAVES, _OVER = 6, (0.012, 0.05)  # [m]
_ALONG = (0.12, 0.40)  # how long they are along hair [m]
_ONSET = 0.06  # so far from the root locks stray in full [m]


@dataclass(frozen=True, eq=False)
class Stray:
    """Waves that run over the scalp and along hair. phases: of each at the roots of W wisps, (K, W). along: how fast they
    turn along hair [rad/m], (K,). ways: to where each leads, (3, K), so that all together have a mean square of 1.
    """

    phases: Floats
    along: Floats
    ways: Floats

    @classmethod
    def over(cls, roots: Floats, seed: int) -> Stray:
        """The waves of wisps rooted at ``roots`` [m], (W, 3)."""
        rng = np.random.default_rng([seed, 8])
        over = _some(rng) * (math.tau / rng.uniform(*_OVER, _WAVES))[:, None]
        phases = over @ roots.T + rng.uniform(0.0, math.tau, _WAVES)[:, None]
        ways = math.sqrt(2.0 / _WAVES) * _some(rng).T
        return cls(phases, math.tau / rng.uniform(*_ALONG, _WAVES), ways)

    def at(self, wisps: Ints, way: Floats) -> Floats:
        """How far ``wisps`` stray at so far from their roots [m], (k,): (3, k), without a unit."""
        waves = np.sin(self.phases.take(wisps, axis=1) + self.along[:, None] * way)
        return np.minimum(way / _ONSET, 1.0) * (self.ways @ waves)


def _some(rng: np.random.Generator) -> Floats:
    """Directions at random, (K, 3)."""
    some = rng.standard_normal((_WAVES, 3))
    return some / np.linalg.norm(some, axis=1, keepdims=True)
