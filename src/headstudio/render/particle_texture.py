"""Textures that hold a record for every particle, which shaders read by the particle's number."""

from __future__ import annotations

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Ints

ROW = 256
"""Records per row; ``row`` in common/particles.glsl."""


class RecordTexture:
    """Records of a dtype made of float32, four to a texel, ROW of them in a row of the texture."""

    def __init__(self, context: moderngl.Context, dtype: np.dtype, count: int) -> None:
        self._dtype = dtype
        texels, rest = divmod(dtype.itemsize, 16)
        if rest:
            raise ValueError("a record fills whole texels of four float32")
        self._rows = max(1, -(-count // ROW))
        self.texture = context.texture((ROW * texels, self._rows), 4, dtype="f4")
        self.texture.filter = (moderngl.NEAREST, moderngl.NEAREST)

    def write(self, records: NDArray[np.void]) -> None:
        """Send all records, (count,)."""
        padded = np.zeros(self._rows * ROW, self._dtype)
        padded[: len(records)] = records
        self.texture.write(padded.tobytes())


def neighbour_records(links: Ints, count: int) -> tuple[np.dtype, NDArray[np.void]]:
    """Who is linked to whom, for a shader: each particle's rootward and tipward neighbours, filled up with -1.

    links: pairs, the rootward one first, (m, 2). Returns the dtype and the records, (count,): two lists of the same
    length, a multiple of four.
    """
    degree = max(np.bincount(links[:, side], minlength=1).max(initial=0) for side in (0, 1))
    slots = 4 * max(1, -(-int(degree) // 4))
    dtype = np.dtype([("rootward", "f4", slots), ("tipward", "f4", slots)])
    records = np.zeros(count, dtype)
    for name, of, to in (("rootward", links[:, 1], links[:, 0]), ("tipward", links[:, 0], links[:, 1])):
        records[name] = -1
        order = np.argsort(of, kind="stable")
        owner = of[order]
        place = np.arange(len(owner)) - np.searchsorted(owner, owner)
        records[name][owner, place] = to[order]
    return dtype, records
