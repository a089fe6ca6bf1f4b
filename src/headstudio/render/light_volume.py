"""Soft light between the strands: worked out on a grid that is only filled where hair is, and read by every point."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import moderngl
import numpy as np

from ..head.mesh import Floats, Ints
from ..wisp.strands import Singles
from .soft_light import NUMBERS
from .view import bounds_of

MOST_NODES = 600_000


@dataclass(frozen=True, eq=False)
class Grid:
    """Nodes around hair. low: the first node [m]; spacing [m]; shape: nodes along x, y and z; near_hair: the flat index
    (x fastest) of every node that some point of the hair reads, (k,)."""

    low: Floats
    spacing: float
    shape: tuple[int, int, int]
    near_hair: Ints

    @property
    def places(self) -> Floats:
        """Where the nodes near hair are [m], (k, 3)."""
        x, rest = self.near_hair % self.shape[0], self.near_hair // self.shape[0]
        return self.low + self.spacing * np.stack([x, rest % self.shape[1], rest // self.shape[1]], axis=1)


def grid_around(points: Singles, finest: float) -> Grid:
    """The grid around points of hair [m], (p, 3), its nodes ``finest`` [m] apart where that is not too many."""
    low, high = bounds_of(points)
    spacing = max(finest, float(np.cbrt(np.prod(high - low + finest) / MOST_NODES)))
    nx, ny, nz = (
        int((np.float32(b) - np.float32(a)) * np.float32(1 / spacing)) + 2 for a, b in zip(low, high, strict=True)
    )
    flat = np.zeros(len(points), np.int32)
    for k, nodes in ((2, 1), (1, ny), (0, nx)):
        flat *= nodes
        flat += ((points[:, k] - np.float32(low[k])) * np.float32(1 / spacing)).astype(np.int32)
    used = np.zeros(nx * ny * nz, bool)
    used[flat] = True
    cell = np.flatnonzero(used)
    for step in (1, nx, nx * ny):
        cell = np.concatenate([cell, cell + step])
    used[cell] = True
    return Grid(low, spacing, (nx, ny, nz), np.flatnonzero(used))


def lit_from_beside(grid: Grid, light: Floats) -> Floats:
    """The light at the nodes near hair, (k, 8, 4), where those inside the body, which have none, take the mean of the nodes
    around them that have some: hair that lies on the skin reads nodes on both of its sides.
    """
    nx, ny, nz = grid.shape
    row = np.full((nz + 2, ny + 2, nx + 2), -1, np.int32)  # of every node in ``light``, with a rim
    flat = grid.near_hair
    x, y, z = flat % nx + 1, flat // nx % ny + 1, flat // (nx * ny) + 1
    row[z, y, x] = np.arange(len(flat))
    lit = np.abs(light).max(axis=(1, 2)) > 0.0
    dark = np.flatnonzero(~lit)
    total, count = np.zeros((len(dark), *light.shape[1:])), np.zeros(len(dark))
    for dx, dy, dz in product((-1, 0, 1), repeat=3):
        beside = row[z[dark] + dz, y[dark] + dy, x[dark] + dx]
        has = (beside >= 0) & lit[beside]
        total[has] += light[beside[has]]
        count[has] += 1.0
    filled = light.copy()
    filled[dark] = total / np.maximum(count, 1.0)[:, None, None]
    return filled


class LightVolume:
    """The light at the nodes of a grid as a texture: eight volumes of four numbers, one above the other."""

    def __init__(self, context: moderngl.Context, grid: Grid, light: Floats) -> None:
        """``light`` at the nodes near hair, (k, 8, 4), as render/soft_light.py says."""
        self._grid = grid
        values = np.zeros((NUMBERS, int(np.prod(grid.shape)), 4), np.float16)
        values[:, grid.near_hair] = light.transpose(1, 0, 2)
        nx, ny, nz = grid.shape
        self._volume = context.texture3d((nx, ny, nz * NUMBERS), 4, values, dtype="f2")
        self._volume.repeat_x = self._volume.repeat_y = self._volume.repeat_z = False

    def bind(self, unit: int) -> dict[str, object]:
        """Bind the texture to a unit; returns the uniforms of common/soft_light.glsl."""
        self._volume.use(unit)
        size = self._grid.spacing * np.array(self._grid.shape)
        low = self._grid.low - 0.5 * self._grid.spacing
        return {"soft_volumes": unit, "soft_low": tuple(low), "soft_size": tuple(size)}
