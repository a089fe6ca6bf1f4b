"""How fine wrinkles rise and fall as the skin moves: Bando's thesis, section 2.6.4."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..head.mesh import Floats
from .shape import amplitude
from .shrinkage import ShrinkageGauge


@dataclass(frozen=True, eq=False)
class FineGrowth:
    """Measures both fields of a body part. gauges: across the furrows of each, at every vertex of its map.
    initial_amplitude: r of eq. 2.4."""

    gauges: tuple[ShrinkageGauge, ...]
    initial_amplitude: float

    def shrinkage(self, posed: Floats) -> Floats:
        """How far the skin shrinks across the furrows of each field at every vertex, (n, 2).

        posed: positions of the map's vertices [m], (n, 3).
        """
        return np.stack([gauge.shrinkage(posed) for gauge in self.gauges], axis=1)

    def amplitudes(self, posed: Floats) -> Floats:
        """M of both fields at every vertex, (n, 2). Between vertices it is interpolated.

        posed: positions of the map's vertices [m], (n, 3).
        """
        return amplitude(self.shrinkage(posed), self.initial_amplitude)
