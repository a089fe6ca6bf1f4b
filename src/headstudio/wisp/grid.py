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
        return self.origin.astype(np.float32)

    @cached_property
    def _last(self) -> Singles:
        """The last place of a cell's first corner, a hair below the last node but one."""
        return (np.array(self.shape) - 1 - 1e-3).astype(np.float32)

    @cached_property
    def _strides(self) -> NDArray[np.float32]:
        # A node's number fits a float32 only below 2^24, so numbers are made of integers; this is for the corners.
        return np.array([self.shape[1] * self.shape[2], self.shape[2], 1])

    @cached_property
    def _corner_numbers(self) -> Corners:
        return (_STEPS @ self._strides).astype(np.intp)

    def cells(self, points: Floats | Singles) -> tuple[Corners, Singles]:
        """Numbers of the eight nodes around ``points`` [m], (k, 3): (k, 8); and where in the cell they are, 0 to 1, (k, 3)."""
        at = (points.astype(np.float32, copy=False) - self._origin) * np.float32(1 / self.spacing)
        np.clip(at, 0, self._last, out=at)
        cell = at.astype(np.intp)
        at -= cell
        first = (cell[:, 0] * self.shape[1] + cell[:, 1]) * self.shape[2] + cell[:, 2]
        return first[:, None] + self._corner_numbers, at

    def value(self, values: Singles, points: Floats | Singles) -> Singles:
        """``values`` at the nodes, (size,) or (size, d), at ``points`` [m], (k, 3): (k,) or (k, d)."""
        corners, at = self.cells(points)
        if values.ndim == 1:
            return np.einsum("ij,ij->i", corner_weights(at), values[corners])
        return np.matmul(corner_weights(at)[:, None, :], values[corners])[:, 0]

    def value_and_gradient(self, values: Singles, points: Floats | Singles) -> tuple[Singles, Singles]:
        """``values`` at the nodes, (size,), at ``points``, (k,), and their gradient there [1/m], (k, 3)."""
        corners, at = self.cells(points)
        here = values[corners].reshape(-1, 2, 2, 2)
        x, y, z = (at[:, k, None] for k in range(3))
        along_x = here[:, 1] - here[:, 0]
        plane = here[:, 0] + x[..., None] * along_x
        along_y = plane[:, 1] - plane[:, 0]
        line = plane[:, 0] + y * along_y
        along_z = line[:, 1] - line[:, 0]
        slope_x = along_x[:, 0] + y * (along_x[:, 1] - along_x[:, 0])
        gradient = np.stack(
            [
                slope_x[:, 0] + z[:, 0] * (slope_x[:, 1] - slope_x[:, 0]),
                along_y[:, 0] + z[:, 0] * (along_y[:, 1] - along_y[:, 0]),
                along_z,
            ],
            axis=1,
        )
        gradient *= np.float32(1 / self.spacing)
        return line[:, 0] + z[:, 0] * along_z, gradient


def corner_weights(at: Singles) -> Singles:
    """Trilinear weights of the eight corners, (k, 8), at places inside cells, (k, 3)."""
    low = 1 - at
    x = np.stack([low[:, 0], at[:, 0]], axis=1)
    y = np.stack([low[:, 1], at[:, 1]], axis=1)
    z = np.stack([low[:, 2], at[:, 2]], axis=1)
    return (x[:, :, None, None] * y[:, None, :, None] * z[:, None, None, :]).reshape(-1, 8)
