"""A regular grid of nodes with trilinear look-up: how the styler keeps its fields (Choe, Ko 2005, section 3.3)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Floats
from .strands import Singles

Corners = NDArray[np.intp]

# The eight corners of a cell, as steps along x, y and z.
_STEPS = np.array([(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)])
_ZERO = np.float32(0)


@dataclass(frozen=True, eq=False)
class Grid:
    """Nodes at ``origin`` + index * ``spacing`` [m], ``shape`` of them along x, y and z.

    Whatever lies outside takes the value of the nearest place inside.
    """

    origin: Floats
    spacing: float
    shape: tuple[int, int, int]

    @classmethod
    def over(cls, low: Floats, high: Floats, spacing: float) -> Grid:
        """The smallest grid from corner ``low`` that reaches corner ``high`` [m], (3,) each."""
        steps = np.ceil((np.asarray(high) - low) / spacing).astype(int) + 1
        return cls(np.asarray(low, dtype=np.float64), spacing, (int(steps[0]), int(steps[1]), int(steps[2])))

    @property
    def size(self) -> int:
        """How many nodes there are."""
        return self.shape[0] * self.shape[1] * self.shape[2]

    @cached_property
    def nodes(self) -> Floats:
        """Positions of all nodes [m], z counting fastest, (size, 3)."""
        axes = [self.origin[k] + self.spacing * np.arange(self.shape[k]) for k in range(3)]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)

    @cached_property
    def _origin(self) -> Singles:
        return self.origin.astype(np.float32)[:, None]

    @cached_property
    def _per_metre(self) -> np.float32:
        return np.float32(1 / self.spacing)

    @cached_property
    def _last(self) -> Singles:
        """The last place of a cell's first corner, a hair below the last node but one."""
        return (np.array(self.shape) - 1 - 1e-3).astype(np.float32)[:, None]

    @cached_property
    def _strides(self) -> NDArray[np.float32]:
        # A node's number fits a float32 only below 2^24, so numbers are made of integers; this is for the corners.
        return np.array([self.shape[1] * self.shape[2], self.shape[2], 1])

    @cached_property
    def _corner_numbers(self) -> Corners:
        return (_STEPS @ self._strides).astype(np.intp)[:, None]

    def cells(self, points: Floats | Singles) -> tuple[Corners, Singles]:
        """Numbers of the eight nodes around ``points`` [m], (k, 3): (8, k); and where in the cell they are, 0 to 1, (3, k).

        Points are counted along the last axis, so that numpy has long rows to work on.
        """
        at = np.array(points.T, dtype=np.float32, order="C")
        at -= self._origin
        at *= self._per_metre
        np.maximum(at, _ZERO, out=at)
        np.minimum(at, self._last, out=at)
        low = np.floor(at)
        at -= low
        x, y, z = low.astype(np.intp)
        first = (x * self.shape[1] + y) * self.shape[2] + z
        return first + self._corner_numbers, at

    def value(self, values: Singles, points: Floats | Singles) -> Singles:
        """``values`` at the nodes, (size,) or (d, size), at ``points`` [m], (k, 3): (k,) or (k, d)."""
        corners, at = self.cells(points)
        # A row of numbers after the other: numpy has long rows to work on, and the cache less to keep.
        shared = values.take(corners, axis=-1)
        shared *= corner_weights(at)
        total: Singles = shared.sum(axis=-2)
        return total.T

    def value_and_gradient(self, values: Singles, points: Floats | Singles) -> tuple[Singles, Singles]:
        """``values`` at the nodes, (size,), at ``points``, (k,), and their gradient there [1/m], (k, 3), column by column."""
        corners, (x, y, z) = self.cells(points)
        here = values.take(corners).reshape(2, 2, 2, -1)
        along_x = here[1] - here[0]
        plane = here[0] + x * along_x
        along_y = plane[1] - plane[0]
        line = plane[0] + y * along_y
        along_z = line[1] - line[0]
        slope_x = along_x[0] + y * (along_x[1] - along_x[0])
        gradient = np.empty((3, len(x)), np.float32)
        gradient[0] = slope_x[0] + z * (slope_x[1] - slope_x[0])
        gradient[1] = along_y[0] + z * (along_y[1] - along_y[0])
        gradient[2] = along_z
        gradient *= self._per_metre
        return line[0] + z * along_z, gradient.T


def corner_weights(at: Singles) -> Singles:
    """Trilinear weights of the eight corners, (8, k), at places inside cells, (3, k)."""
    x, y, z = sides = np.empty((3, 2, at.shape[1]), at.dtype)
    np.subtract(1, at, out=sides[:, 0])
    sides[:, 1] = at
    return (x[:, None, None] * y[None, :, None] * z[None, None]).reshape(8, -1)
