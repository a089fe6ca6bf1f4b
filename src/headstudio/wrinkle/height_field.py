"""Normals of a height field, for bump mapping and baking."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def normal_map(height: NDArray[np.float32], texel: float, wrapped: bool) -> NDArray[np.float32]:
    """Unit normals of a height field in tangent space (along u, along v, outward), (rows, columns, 3).

    height: of the skin over its surface [m], (rows, columns), row 0 at v = 0. texel: edge of a texel on the skin [m].
    wrapped: whether the last column lies beside the first.
    """
    # One texel more on every side, so that the borders have two neighbours too.
    padded = np.pad(height, ((0, 0), (1, 1)), mode="wrap" if wrapped else "edge")
    along_u = (padded[:, 2:] - padded[:, :-2]) / (2 * texel)
    padded = np.pad(height, ((1, 1), (0, 0)), mode="edge")
    along_v = (padded[2:] - padded[:-2]) / (2 * texel)
    normals = np.stack([-along_u, -along_v, np.ones_like(along_u)], axis=2)
    unit: NDArray[np.float32] = (normals / np.linalg.norm(normals, axis=2, keepdims=True)).astype(np.float32)
    return unit
