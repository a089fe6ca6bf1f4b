"""How much hair there is around every particle: Bando et al. 2006, eq. 1."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats, Ints
from ..head.rows import row_length
from .kernel import kernel


def density(positions: Floats, mass: Floats, pairs: Ints, smoothing_length: float) -> Floats:
    """rho_i = sum_j m_j W(|x_j - x_i|, h) [kg/m^3], the particle itself included, (n,).

    positions: [m], (n, 3). mass: [kg], (n,). pairs: every pair closer than 2h, each once, (p, 2); farther ones do no harm.
    """
    i, j = pairs.T
    weight = kernel(row_length(positions[j] - positions[i]), smoothing_length)
    own = mass * kernel(np.zeros(1), smoothing_length)
    return own + np.bincount(i, mass[j] * weight, len(mass)) + np.bincount(j, mass[i] * weight, len(mass))
