"""Arithmetic on many vectors, a row each, in the ways in which numpy is fast on short rows.

It adds along them best by a product with ones, and multiplies them by a number each best where each column lies in a
piece, which every operation on such arrays then hands on.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .mesh import Floats


def row_dot(a: Floats, b: Floats) -> Floats:
    """a_i . b_i of vectors (n, k), (n,)."""
    product = a * b
    dots: Floats = product @ _ones(product.shape[-1])
    return dots


@cache
def _ones(count: int) -> Floats:
    return np.ones(count)


def in_columns(a: Floats) -> Floats:
    """The same vectors, each column in a piece (Fortran's order)."""
    return np.asfortranarray(a)


def rows_at(a: Floats, which: NDArray[np.integer]) -> Floats:
    """The rows ``which`` of vectors (n, k) in columns, in columns, too."""
    return a.T.take(which, axis=1).T


def mapped(a: Floats, matrix: Floats) -> Floats:
    """matrix a_i of vectors (n, k), in columns, (n, l). matrix: (l, k)."""
    image: Floats = matrix @ a.T
    return image.T


class OnColumns:
    """A sparse matrix (l, n) that acts on vectors (n, k) in columns, and gives such: one product for all k at once."""

    def __init__(self, matrix: sparse.csr_array, columns: int = 3) -> None:
        self._columns = columns
        self._matrix = sparse.block_diag([matrix] * columns, format="csr")

    def __matmul__(self, vectors: Floats) -> Floats:
        return (self._matrix @ vectors.ravel(order="F")).reshape((-1, self._columns), order="F")


def row_length(a: Floats) -> Floats:
    """|a_i| of vectors (n, k), (n,)."""
    return np.sqrt(row_dot(a, a))


def row_unit(vectors: Floats, otherwise: Floats) -> Floats:
    """``vectors``, (n, 3), of length 1; where one vanishes, ``otherwise``."""
    length = row_length(vectors)[:, None]
    return np.where(length <= 1e-9, otherwise, vectors / np.maximum(length, 1e-9))


def cross_matrix(a: Floats) -> Floats:
    """The matrix of x -> a cross x, (3, 3)."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])
