"""From a field to triangles: marching cubes, only where the surface is."""

from __future__ import annotations

import igl
import numpy as np

from ..mesh import Floats, Ints
from .fields import Field, Vector

# Corner order of a cell in igl.marching_cubes (x, y, z).
_CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
_BLOCK = 4


def polygonise(field: Field, low: Vector, high: Vector, cell: float) -> tuple[Floats, Ints]:
    """The zero surface of ``field`` in a box as vertices, shape (n, 3), and outward faces, shape (m, 3).

    The box is filled with cubes of edge ``cell``. First one value is taken in each block of 4 x 4 x 4 cubes; where it
    is larger than the block is wide, no surface can pass, and the block is left out. The surface is open where it
    meets the sides of the box, and there it ends exactly in the plane of the side.
    """
    origin = np.asarray(low, dtype=float)
    blocks = np.ceil((np.asarray(high) - origin) / (cell * _BLOCK)).astype(np.int64)
    block_index = np.indices(blocks).reshape(3, -1).T
    middles = origin + (block_index + 0.5) * (cell * _BLOCK)
    reach = 2.2 * cell * _BLOCK * np.sqrt(3.0) / 2.0
    block_index = block_index[np.abs(field(middles)) < reach]

    within = np.indices((_BLOCK,) * 3).reshape(3, -1).T
    cells = (block_index[:, None, :] * _BLOCK + within).reshape(-1, 3)
    corners = cells[:, None, :] + _CORNERS
    count = blocks * _BLOCK + 1
    flat = np.ravel_multi_index(tuple(corners.reshape(-1, 3).T), tuple(count))
    used, cell_corners = np.unique(flat, return_inverse=True)
    points = origin + cell * np.stack(np.unravel_index(used, tuple(count)), axis=1)
    vertices, faces, _ = igl.marching_cubes(field(points), points, cell_corners.reshape(-1, 8), 0.0)
    return vertices, faces
