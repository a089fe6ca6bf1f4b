"""The strand that a particle stands for, from its root to the particle: it pulls once it is taut.

Not in the paper. Its springs tie a particle to hair all around, which may slide along it, and nothing holds all of them to
the length of the hair: what has once been torn off they let go for good. A strand of length s that reaches to a distance
of (1 + e) s pulls its particle back with the force

    m A e,     e > 0.

It pulls from nothing on, so that long steps see it come. A hard stop, met at no certain instant, would leave an error in
proportion to the step.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.rows import row_dot, row_length, rows_at
from .contact import Touching
from .hold import Hold
from .model import HairModel

_SHORTEST = 0.1  # of the mean distance of particles: no strand is stiffer than one of this length
_STEEPEST = 0.3  # sine of the angle up to which a pull into the body becomes one along it as strong
_THIN = 0.001  # as if hair were at least so thick [m]
_TAUTNESS = 3000.0  # A: stretched by a hundredth, a strand carries three times its weight [m/s^2]


def led_along(ways: Floats, which: Ints, touch: Touching) -> Floats:
    """Ways of the particles ``which``, (k, 3), that do not lead into the body: the more along it, the more hair is pressed.

    ways: unit vectors, (k, 3).
    """
    normals = rows_at(touch.normals, which)
    keep = touch.keep[which]
    pressed = np.clip((keep - touch.distance[which]) / np.maximum(keep, _THIN), 0.0, 1.0)
    into = pressed * np.minimum(row_dot(ways, normals), 0.0)
    along = ways - into[:, None] * normals
    # A way straight into the body leads nowhere.
    return along / np.maximum(row_length(along), _STEEPEST)[:, None]


class Strands:
    """The strands of one head of hair.

    square_frequency: A / s, with which a particle swings on its own strand [1/s^2], (n,); nothing at root particles.
    """

    def __init__(self, model: HairModel) -> None:
        self._root_points, self._length = model.root_points, np.where(model.fixed, np.inf, model.arc_length)
        self.square_frequency = _TAUTNESS / np.maximum(self._length, _SHORTEST * model.spacing)
        self._stiffness = model.mass * self.square_frequency
        self._damping = 2.0 * model.mass * np.sqrt(self.square_frequency)  # critical

    def taut(self, velocities: Floats, touch: Touching) -> Hold:
        """Those that reach further than they are long, where ``touch`` is seen from. velocities: head frame [m/s], (n, 3).

        Hair on the body is drawn along it.
        """
        from_root = touch.positions - self._root_points
        reach = row_length(from_root)
        which = np.flatnonzero(reach > self._length)
        length, stiffness = reach[which], self._stiffness[which]
        pull = stiffness * (length - self._length[which])
        outward = rows_at(from_root, which) / length[:, None]
        return Hold(
            which,
            direction=-led_along(-outward, which, touch),
            push=-pull,
            slip=rows_at(velocities, which),
            stiffness_along=stiffness,
            stiffness_across=pull / length,
            damping_along=self._damping[which],
            damping_across=np.zeros(len(which)),
        )
