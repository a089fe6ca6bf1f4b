"""The smoothing kernel of smoothed particle hydrodynamics: Bando et al. 2006, eq. 2 (Monaghan's cubic spline)."""

from __future__ import annotations

import math

import numpy as np

from ..head.mesh import Floats


def kernel(distance: Floats, smoothing_length: float) -> Floats:
    """W(r, h) of eq. 2 [1/m^3]; zero from r = 2h on, integral over space 1. distance r >= 0 [m], any shape."""
    h = smoothing_length
    q = np.asarray(distance) / h
    # (2 - q)^3 - 4 (1 - q)^3 is 4 - 6 q^2 + 3 q^3 below q = 1: one expression for both branches.
    outer = np.maximum(2.0 - q, 0.0)
    inner = np.maximum(1.0 - q, 0.0)
    return (outer * outer * outer - 4.0 * inner * inner * inner) / (4.0 * math.pi * h**3)


def kernel_slope(distance: Floats, smoothing_length: float) -> Floats:
    """dW/dr of eq. 2 [1/m^4]; never positive, zero at r = 0 and from r = 2h on. distance r >= 0 [m], any shape."""
    h = smoothing_length
    q = np.asarray(distance) / h
    outer = np.maximum(2.0 - q, 0.0)
    inner = np.maximum(1.0 - q, 0.0)
    return (-3.0 * outer * outer + 12.0 * inner * inner) / (4.0 * math.pi * h**4)
