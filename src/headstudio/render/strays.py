"""What holds a particle that strays from the hair: the lock between it and the particle it hangs on.

A particle at the border of the hair has few links, and they may be long: hair that falls from the nape over a shoulder
parts there from what falls down the back. A curve of the usual length, drawn at such a particle, would be a tuft that
floats in the air. The strands it stands for come from the rootward end of its lifeline, and so does the curve that is
drawn; where no hair could come from there, nothing is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from ..head.mesh import Floats, Ints
from ..head.smooth import smoothstep
from ..lcp.model import HairModel

_STRAYS = (0.014, 0.034)
"""A particle begins to count as astray when the particle it hangs on, and the middle of all its rootward neighbours, lie
so far [m] off the course of its hair, and does so altogether at the second."""

_LONGEST = (0.045, 0.085)
"""Hair that would have to come to the particle from so far [m], or by a kink, is not drawn."""

KINK = (np.radians(35), np.radians(55))
"""Hair that would have to turn on the spot by the first angle begins to go, by the second it has gone [rad]."""

_GENERATIONS = 4
"""How many particles may hang one on the other, and be lost with the first."""


@dataclass(frozen=True, eq=False)
class Strays:
    """Particles that stray, m of n.

    which: their indices, (m,). astray: 0 for a particle amid its hair to 1 for one that is drawn along its lifeline alone,
    (m,). start [m] of the lifeline and unit direction of the hair there, (m, 3). lost: 1 for a particle that no hair would
    come to along its lifeline, and for those that hang on such particles, (n,).
    """

    which: Ints
    astray: Floats
    start: Floats
    start_direction: Floats
    lost: Floats


class StrayFinder:
    """Finds the particles of one model that stray.

    rootward_mean: the operator that gives each particle the mean of its rootward neighbours, n x n.
    """

    def __init__(self, model: HairModel, rootward_mean: csr_array) -> None:
        self._rootward_mean = rootward_mean
        self._held = np.flatnonzero(model.lifeline >= 0)
        self._holds = model.links[model.lifeline[self._held], 0]

    def find(self, positions: Floats, directions: Floats) -> Strays:
        """positions [m] and unit directions of the hair at all particles, (n, 3)."""
        held, holds = self._held, self._holds
        here, course = positions[held], directions[held]
        way = here - positions[holds]
        off = np.minimum(_off(way, course), _off(here - (self._rootward_mean @ positions)[held], course))
        astray = smoothstep(off, *_STRAYS)
        out = np.flatnonzero(astray)
        length = np.sqrt(np.einsum("mi,mi->m", way[out], way[out]))
        ahead = np.einsum("mi,mi->m", way[out], course[out]) / np.maximum(length, 1e-12)
        lost = np.zeros(len(positions))
        lost[held[out]] = astray[out] * (1 - goes_round(ahead) * (1 - smoothstep(length, *_LONGEST)))
        for _ in range(_GENERATIONS):
            lost = np.maximum(lost, smoothstep(self._rootward_mean @ lost, 0.5, 1.0))
        return Strays(held[out], astray[out], positions[holds[out]], directions[holds[out]], lost)


def goes_round(cosine: Floats) -> Floats:
    """From 1 where hair goes on to 0 where it would have to turn on the spot, of the shape of the ``cosine`` of its turns."""
    return smoothstep(cosine, np.cos(KINK[1]), np.cos(KINK[0]))


def _off(way: Floats, course: Floats) -> Floats:
    """How far [m] the places that lie ``way`` [m], (m, 3), behind particles are off the straight course of their hair."""
    length = np.sqrt(np.einsum("mi,mi->m", way, way))
    aside = way - length[:, None] * course
    return np.sqrt(np.einsum("mi,mi->m", aside, aside))
