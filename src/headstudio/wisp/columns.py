"""Arithmetic on some hundreds of vectors, a column each, (3, k): numpy goes along them in three rows, and not over three
numbers at a time. So the styler lays its wisps."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats

RealT = TypeVar("RealT", np.float32, np.float64)

_SHORTEST = 1e-9


def dot(one: NDArray[RealT], other: NDArray[RealT]) -> NDArray[RealT]:
    """The products of vectors, (3, k) each: (k,). Of some hundreds einsum takes longer to begin than to sum up."""
    x, y, z = one * other
    return x + y + z


def cross(one: Floats, other: Floats) -> Floats:
    """The vector product of vectors, (3, k) each."""
    result = np.empty_like(one)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        np.multiply(one[i], other[j], out=result[k])
        result[k] -= one[j] * other[i]
    return result


def unit(vectors: Floats, otherwise: Floats) -> Floats:
    """``vectors``, (3, k), of length 1; where one vanishes, ``otherwise``."""
    length = np.sqrt(dot(vectors, vectors))
    if length.min(initial=1.0) > _SHORTEST:
        return vectors / length
    return np.where(length <= _SHORTEST, otherwise, vectors / np.maximum(length, _SHORTEST))
