"""Arithmetic on many vectors, a row each: products with a matrix of ones, which is how numpy adds short rows fast."""

from __future__ import annotations

import numpy as np

from .mesh import Floats


def row_dot(a: Floats, b: Floats) -> Floats:
    """a_i . b_i of vectors (n, k), (n,)."""
    product = a * b
    dots: Floats = product @ np.ones(product.shape[-1])
    return dots


def row_length(a: Floats) -> Floats:
    """|a_i| of vectors (n, k), (n,)."""
    return np.sqrt(row_dot(a, a))
