"""What holds a particle by itself, along a direction of its own: the skin that it is pressed on, the strand that it ends."""

from __future__ import annotations

from dataclasses import dataclass

from ..head.mesh import Floats, Ints
from ..head.rows import row_dot


@dataclass(frozen=True, eq=False)
class Hold:
    """Springs with damping on k particles.

    which: the particles, (k,), and direction: a vector for each, of length 1 or shorter, (k, 3). push: the force of the
    spring along it [N], (k,). slip: the velocity that is damped [m/s], (k, 3). Stiffness [N/m] and damping [kg/s] along the
    direction and across it, (k,).
    """

    which: Ints
    direction: Floats
    push: Floats
    slip: Floats
    stiffness_along: Floats
    stiffness_across: Floats
    damping_along: Floats
    damping_across: Floats

    def forces(self, load: Floats | float = 0.0) -> Floats:
        """On their particles [N], (k, 3).

        load: a step over the masses [s/kg], (k,), for explicit steps: damping takes no more of the slip than there is.
        """
        speed = row_dot(self.slip, self.direction)[:, None] * self.direction
        along = self.damping_along / (1.0 + load * self.damping_along)
        across = self.damping_across / (1.0 + load * self.damping_across)
        return self.push[:, None] * self.direction - along[:, None] * speed - across[:, None] * (self.slip - speed)

    def along(self, g: float) -> Floats:
        """What the hold adds to M + g D + g^2 K along the direction [kg], (k,). g: of the implicit step [s]."""
        return g * self.damping_along + g * g * self.stiffness_along

    def across(self, g: float) -> Floats:
        """The same across the direction."""
        return g * self.damping_across + g * g * self.stiffness_across
