"""The bending stiffness that the springs lack: hair keeps, near its root, the shape that it grew in.

The springs of the paper hold hair lengthwise; "the bending stiffness is not modeled explicitly" (Bando et al. 2006,
section 6), so a head of hair would start to move by sinking from its cantilever shape. But that shape is one of balance:
a beam of length s, with the bending length l, carries the weight across it and swings back with the square frequency

    kappa(s) = 12.4 g l^3 / s^4

of its first mode. So each particle is drawn to its place in the initial shape with kappa(s), which is strong at the root
and nothing at the tip, and the part of its weight across the hair is carried, near the root, as it is in the beam.
"""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .model import HairModel
from .settings import DynamicsSettings

_FIRST_MODE = 12.36  # 1.8751^4: first mode of a clamped beam
_STANDARD_GRAVITY = 9.81  # the one the beam was bent by [m/s^2]
_HIGHEST = 2000.0  # of kappa [1/s^2]: stiffer hair moves with the head all the same
_REACH = 2.0  # bending lengths at which half of the weight is still carried


class Bending:
    """What a model needs to know about its bending stiffness."""

    def __init__(self, model: HairModel) -> None:
        self.rest_positions = model.rest_positions
        s = np.maximum(model.arc_length, 1e-6)
        length = model.bending_length
        self._kappa = np.minimum(_FIRST_MODE * _STANDARD_GRAVITY * length**3 / s**4, _HIGHEST)
        down = np.array([0.0, -1.0, 0.0])
        t = model.rest_directions
        across = down - (t @ down)[:, None] * t
        carried = 1.0 / (1.0 + (s / (_REACH * length)) ** 4)
        self._support = -carried[:, None] * across

    def kappa(self, settings: DynamicsSettings) -> Floats:
        """Square frequency with which every particle returns to its place [1/s^2], (n,)."""
        return settings.hold * self._kappa

    def support(self, settings: DynamicsSettings) -> Floats:
        """The weight that bending carries [m/s^2], head frame, (n, 3): all of it from ``hold`` 1 on."""
        return min(settings.hold, 1.0) * settings.gravity * self._support

    def acceleration(self, positions: Floats, settings: DynamicsSettings) -> Floats:
        """Both together [m/s^2], (n, 3). positions: head frame [m], (n, 3)."""
        back = self.kappa(settings)[:, None] * (self.rest_positions - positions)
        return back + self.support(settings)
