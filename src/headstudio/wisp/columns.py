"""Arithmetic on some hundreds of vectors, a column each, (3, k): numpy goes along them in three rows, and not over three
numbers at a time. So the styler lays its wisps."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats

_SHORTEST = 1e-9


def dot(one: Floats, other: Floats) -> Floats:
    """The products of vectors, (3, k) each: (k,)."""
    products: Floats = np.einsum("ij,ij->j", one, other)
    return products


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
