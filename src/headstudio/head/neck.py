"""The neck: where a turn of the head fades into a torso that stays, and how what lies around it is straightened again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .mesh import Floats
from .rows import cross_matrix, mapped, row_dot
from .smooth import smoothstep

_NEWTON_STEPS = 3
# Where the inner side of a bend folds up, one place at rest comes to many: there Newton's way is kept this steep.
_FLATTEST = 0.3


@dataclass(frozen=True, eq=False)
class Neck:
    """Every point turns with its share of the head's turn: 1 at the ``top``, falling smoothly to 0 along the ``length``.

    upward: unit vector, (3,), along which it falls. top: how far up that way it begins to fall [m]. length: [m].
    """

    upward: Floats
    top: float
    length: float

    def share(self, points: Floats) -> Floats:
        """The part of the head's turn that points of the bust at rest [m], (n, 3), take, 0 to 1, (n,)."""
        return self._share(self._below(points @ self.upward))

    def reaches(self, points: Floats) -> NDArray[np.bool_]:
        """True for points of the bust at rest [m], (n, 3), that do not turn wholly with the head, (n,)."""
        return points @ self.upward < self.top

    def slope(self, points: Floats) -> Floats:
        """How fast the share grows along ``upward`` at points of the bust at rest [m], (n, 3): [1/m], (n,)."""
        return self._slope(self._below(points @ self.upward))

    def shares_when_bent(self, points: Floats, turn: Floats) -> Floats:
        """The part w of ``turn`` that leads from rest to ``points`` of the bent neck [m], (n, 3): (2, n).

        turn: rotation vector of the head against the torso, in whose axes the points are, (3,). w is the root of
        w - share(R(-w turn) x), by Newton's method from 1 and from 0: where skin of the head comes to lie on that of the
        torso there is one from above and one from below.
        """
        angle = float(np.linalg.norm(turn))
        if angle < 1e-9:
            return np.tile(self.share(points), (2, 1))
        axis = turn / angle
        # The height of R(-w turn) x is that of its part along the axis, a cosine and a sine.
        height = points @ self.upward
        still = (points @ axis) * (axis @ self.upward)
        cosine, sine = height - still, points @ (cross_matrix(self.upward) @ axis)
        w = np.repeat([[1.0], [0.0]], len(points), axis=1)
        for _ in range(_NEWTON_STEPS):
            c, s = np.cos(angle * w), np.sin(angle * w)
            below = self._below(still + c * cosine - s * sine)
            steepness = 1.0 + angle * (s * cosine + c * sine) * self._slope(below)
            w -= (w - self._share(below)) / np.maximum(steepness, _FLATTEST)
            w = np.minimum(np.maximum(w, 0.0), 1.0)
        return w

    def bent_normals(self, points: Floats, normals: Floats, turn: Floats) -> Floats:
        """What becomes of unit ``normals`` of surfaces through ``points`` of the bust at rest [m], (n, 3) each.

        turn: as above. Not turned yet by their share of it, and as long as distances become shorter: a bend shears and
        stretches what it bends. With J = R (1 + (turn x p) grad w^T) it is the inverse transpose of J without its R.
        """
        slope = self.slope(points)
        lever = mapped(points, cross_matrix(turn))
        steepness = np.maximum(1.0 + (lever @ self.upward) * slope, _FLATTEST)
        return normals - (slope * row_dot(lever, normals) / steepness)[:, None] * self.upward

    def _below(self, height: Floats) -> Floats:
        """The part of the way down that is done at a height [m], 0 to 1, (n,)."""
        return np.minimum(np.maximum((self.top - height) / self.length, 0.0), 1.0)

    def _share(self, below: Floats) -> Floats:
        return 1.0 - smoothstep(below)

    def _slope(self, below: Floats) -> Floats:
        return (6.0 / self.length) * below * (1.0 - below)


NO_NECK = Neck(np.array([0.0, 1.0, 0.0]), -np.inf, 1.0)
"""That of a head alone, all of which turns."""


def turned_by(vectors: Floats, turn: Floats, share: Floats) -> Floats:
    """``vectors``, (n, 3), each turned by its ``share``, (n,), of the rotation vector ``turn``, (3,) (Rodrigues)."""
    angle = float(np.linalg.norm(turn))
    if angle < 1e-9:
        return vectors
    axis = turn / angle
    c, s = np.cos(angle * share)[:, None], np.sin(angle * share)[:, None]
    still = mapped(vectors, np.outer(axis, axis))
    return still + c * (vectors - still) + s * mapped(vectors, cross_matrix(axis))
