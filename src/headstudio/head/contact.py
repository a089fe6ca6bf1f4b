"""The body as hair feels it: one plane a voxel (Bando's thesis, section 3.5)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .locate import Locator
from .mesh import Floats, TriangleMesh
from .rows import in_columns, row_dot, rows_at
from .sampling import sample_surface

_SAMPLES_PER_VOXEL = 24  # on a plane through it
# So far from the surface voxels have planes: what a fast step, or how hair was grown, put this deep comes out again [m].
_BORDER = 0.028


@dataclass(frozen=True, eq=False)
class ContactField:
    """Planes that approximate a surface, one in every voxel near it.

    origin: corner of the first voxel [m], (3,). voxel: edge of a voxel [m]. plane: index of the plane in every voxel, -1
    where the surface is far away, (nx, ny, nz). points: a point on every plane [m], normals: its unit normal, (p, 3).

    Voxels that hold samples of the surface have their mean plane. Those within ``_BORDER`` of them have the plane that
    touches the surface nearest to them: a particle that got below the surface in one step is still brought back. (A plane
    borrowed from the voxel next door would, beyond a ridge, call outside what is inside, and the other way round.)
    """

    origin: Floats
    voxel: float
    plane: NDArray[np.int32]
    points: Floats
    normals: Floats

    @classmethod
    def around(cls, mesh: TriangleMesh, voxel: float, seed: int = 0) -> ContactField:
        """Sample the surface evenly by area and average positions and normals in each voxel of edge ``voxel`` [m]."""
        positions, normals = sample_surface(mesh, voxel / math.sqrt(_SAMPLES_PER_VOXEL), seed)
        layers = math.ceil(_BORDER / voxel)
        origin = mesh.bounds[0] - (layers + 1) * voxel
        shape = np.ceil((mesh.bounds[1] - origin) / voxel).astype(int) + layers + 1
        cell = np.ravel_multi_index(tuple(((positions - origin) / voxel).astype(int).T), tuple(shape))
        occupied, member, count = np.unique(cell, return_inverse=True, return_counts=True)
        mean = np.stack([np.bincount(member, positions[:, k]) for k in range(3)], axis=1) / count[:, None]
        normal = np.stack([np.bincount(member, normals[:, k]) for k in range(3)], axis=1)
        length = np.linalg.norm(normal, axis=1)
        # A voxel with both sides of something thin has no plane that means anything: its neighbours decide there.
        clear = length > 0.5 * count
        plane = np.full(shape, -1, dtype=np.int32)
        plane.flat[occupied[clear]] = np.arange(np.count_nonzero(clear), dtype=np.int32)
        mean, normal = mean[clear], normal[clear] / length[clear, None]
        nearby = _shell(plane, layers)
        centres = origin + (np.stack(np.nonzero(nearby), axis=1) + 0.5) * voxel
        below, facing = _tangent_planes(mesh, centres)
        # Where the surface ends its planes go on for a voxel and no further: beyond its border nothing is below it.
        across = np.cross(centres - below, facing)
        ends = row_dot(across, across) > voxel**2
        plane[nearby] = np.where(ends, -1, len(mean) + np.arange(len(centres)))
        return cls(origin, voxel, plane, np.vstack([mean, below]), np.vstack([normal, facing]))

    def at(self, positions: Floats) -> tuple[Floats, Floats]:
        """Signed distance d to the local plane [m] (thesis eq. 3.19), infinite far from the body, (n,); its normals, zero
        there, (n, 3). positions: [m], (n, 3)."""
        plane = self._plane_of_cell.take(self._cells(positions))
        normals = rows_at(self._normals, plane)
        return row_dot(positions, normals) - self._offsets.take(plane), normals

    def _cells(self, positions: Floats) -> NDArray[np.int32]:
        """Where in ``_plane_of_cell`` positions are, (n,): outside, and where they are no numbers, in its border."""
        last = np.array(self.plane.shape) + 1
        cell = (positions - (self.origin - self.voxel)) / self.voxel
        whole = np.fmin(np.fmax(cell, 0.0), last).astype(np.int32)
        return (whole[:, 0] * (last[1] + 1) + whole[:, 1]) * (last[2] + 1) + whole[:, 2]

    @cached_property
    def _plane_of_cell(self) -> NDArray[np.int32]:
        """``plane`` with a border of -1, flat."""
        return np.pad(self.plane, 1, constant_values=-1).ravel()

    @cached_property
    def _normals(self) -> Floats:
        """The normals, and none last: the plane -1 is infinitely far from everything."""
        return in_columns(np.vstack([self.normals, np.zeros(3)]))

    @cached_property
    def _offsets(self) -> Floats:
        """Where each plane is along its normal [m]."""
        return np.append(row_dot(self.points, self.normals), -np.inf)


def _shell(plane: NDArray[np.int32], layers: int) -> NDArray[np.bool_]:
    """Which voxels lie within so many layers of those that have a plane and have none themselves."""
    distance = ndimage.distance_transform_edt(plane < 0)
    return (distance > 0.0) & (distance <= layers)


def _tangent_planes(mesh: TriangleMesh, centres: Floats) -> tuple[Floats, Floats]:
    """The point of the surface nearest to each of ``centres`` [m], and the unit normal there, (k, 3) each."""
    nearest, _ = Locator(mesh.vertices, mesh.faces).nearest(centres)
    normals = nearest.blend(mesh.vertex_normals, mesh.faces)
    length = np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    return nearest.blend(mesh.vertices, mesh.faces), normals / length
