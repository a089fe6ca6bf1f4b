"""The one curve by which things begin and end without a corner."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Real = TypeVar("Real", np.float32, np.float64)


def smoothstep(value: NDArray[Real], start: float = 0.0, end: float = 1.0) -> NDArray[Real]:
    """0 up to ``start``, 1 from ``end`` on and 3 t^2 - 2 t^3 between, level at both, of the shape of ``value``.

    ``end`` may lie below ``start``.
    """
    t = np.clip((value - start) / (end - start), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
