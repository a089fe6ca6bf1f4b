"""What hair lies on and hangs beside: the body as signed distances, and the space where hair may be."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..head.hair_tight import standing_on_floor
from ..head.head import Head
from ..head.locate import Locator
from ..head.mesh import Floats, TriangleMesh
from ..head.sampling import sample_surface
from .columns import dot
from .ears import at_ears
from .grid import Grid
from .proportions import Proportions
from .strands import Singles

_VOXEL = 0.0035  # of the signed distances [m]
_BAND = 2.0  # how far from the skin distances are exact, in voxels
_MARGIN = 0.02  # of the grid around the body [m]
_FOLD = 0.014  # radius of the ball that does not get into a fold of the face [m]
_BESIDE = 0.009  # a straight way from farther off the skin than this to the next point does not cut an ear [m]
_LEAF = 0.009  # the breadth of a blur in which an ear is a bump [m]
_REACH = 0.32  # how far hair may stand off the body or hang below the bust [m]


@dataclass(frozen=True, eq=False)
class Surroundings:
    """The space around a head, built once for it.

    skin_grid: nodes of the signed distances. distances: from every node to the skin [m], negative inside, (size,).
    proportions: the frame of the skull. low, high: corners of the box where hair may be [m], (3,).
    """

    skin_grid: Grid
    distances: Singles
    proportions: Proportions
    low: Floats
    high: Floats

    @classmethod
    def around(cls, head: Head) -> Surroundings:
        """Measure the space around ``head``. Below the bust the body is taken to go straight down."""
        body = standing_on_floor(head)
        grid = Grid.over(body.bounds[0] - _MARGIN, body.bounds[1] + _MARGIN, _VOXEL)
        distances = _signed_distances(body, grid)
        proportions = Proportions.of(head.landmarks)
        _close_face(distances.reshape(grid.shape), grid, proportions, body)
        low, high = head.skin.bounds[0] - _REACH, head.skin.bounds[1] + _REACH
        return cls(grid, distances.astype(np.float32), proportions, low, high)

    def distance(self, points: Floats | Singles) -> Singles:
        """Signed distance to the skin [m], negative below it, (k,), at ``points`` [m], (k, 3)."""
        return self.skin_grid.value(self.distances, points)

    def gradient(self, points: Floats | Singles) -> Singles:
        """Unit direction that leads away from the skin, (k, 3), at ``points`` [m], (k, 3)."""
        return self.distance_and_gradient(points)[1]

    def distance_and_gradient(self, points: Floats | Singles) -> tuple[Singles, Singles]:
        """Both at once: (k,) [m] and unit vectors, (k, 3)."""
        distance, gradient = self.skin_grid.value_and_gradient(self.distances, points)
        columns = gradient.T
        columns /= np.maximum(np.sqrt(dot(columns, columns)), np.float32(1e-6))
        return distance, gradient

    def distance_and_gradient_anywhere(self, points: Floats) -> tuple[Floats, Floats]:
        """Both beyond the grid of the distances, too, to the breadth of its margin: (k,) [m] and unit vectors, (k, 3)."""
        grid = self.skin_grid
        known = np.clip(points, grid.origin, grid.origin + grid.spacing * (np.array(grid.shape) - 1))
        distance, gradient = self.distance_and_gradient(known)
        return distance + np.linalg.norm(points - known, axis=1), gradient.astype(np.float64)

    def keep_outside(self, points: Singles, margin: float) -> Singles:
        """``points`` [m], float32, (k, 3), with those nearer to the skin than ``margin`` [m] moved straight out to it.

        Points are moved in place, and returned. Millions of points are sorted out by one look at a table of places that
        may be too near; only those few are measured.
        """
        near = np.flatnonzero(self._may_be_nearer(margin)[self.nearest_nodes(points)])
        for _ in range(_PUSHES):
            distance, gradient = self.distance_and_gradient(points[near])
            too_near = distance < margin
            near, distance, gradient = near[too_near], distance[too_near], gradient[too_near]
            if len(near) == 0:
                break
            # A little farther than needed: the field is bent between nodes, and another round costs more.
            points[near] += (np.float32(margin + 1e-4) - distance)[:, None] * gradient
        return points

    def nearest_nodes(self, points: Singles) -> NDArray[np.int32]:
        """Number of the node of the skin's grid next to each point [m], (..., 3): (...)."""
        grid = self.skin_grid
        number = np.zeros(points.shape[:-1], dtype=np.int32)
        for axis in range(3):
            # One axis after the other: a third of the memory traffic, which is all this costs.
            step = points[..., axis] * np.float32(1 / grid.spacing)
            step += np.float32(0.5 - grid.origin[axis] / grid.spacing)
            np.clip(step, 0, grid.shape[axis] - 1, out=step)
            number *= grid.shape[axis]
            number += step.astype(np.int32)
        return number

    def _may_be_nearer(self, margin: float) -> NDArray[np.bool_]:
        """Per node: whether a point that rounds to it may be nearer to the skin than ``margin``."""
        if margin not in self._near_tables:
            self._near_tables[margin] = self.distances < margin + np.sqrt(0.75) * self.skin_grid.spacing
        return self._near_tables[margin]

    def around_ears(self, points: Floats | Singles) -> Singles:
        """Unit direction away from a body whose ears are no leaves but bumps, (k, 3), at ``points`` [m], (k, 3): from both
        sides of an ear it leads around its rim.
        """
        gradient = self.skin_grid.value_and_gradient(self._without_leaves, points)[1]
        columns = gradient.T
        columns /= np.maximum(np.sqrt(dot(columns, columns)), np.float32(1e-6))
        return gradient

    @cached_property
    def _without_leaves(self) -> Singles:
        """Distances blurred until what is as thin as an ear has no sides of its own [m], (size,)."""
        blurred = ndimage.gaussian_filter(self.distances.reshape(self.skin_grid.shape), _LEAF / self.skin_grid.spacing)
        return blurred.ravel()

    @cached_property
    def beside_ears(self) -> NDArray[np.bool_]:
        """Per node of the skin's grid: whether a strand that has a point there may cut an ear, (size,)."""
        near = self.distances < _BESIDE
        near[near] = at_ears(self.proportions.measure(self.skin_grid.nodes[near]))
        return near

    @cached_property
    def _near_tables(self) -> dict[float, NDArray[np.bool_]]:
        return {}


# How often a point is pushed. Where the skin folds (behind an ear) the way out bends.
_PUSHES = 16


def _signed_distances(body: TriangleMesh, grid: Grid) -> Floats:
    """Signed distance of every node to a closed surface [m]: exact in a band around it, beyond it to about a voxel."""
    points, _ = sample_surface(body, spacing=0.4 * grid.spacing)
    index = np.round((points - grid.origin) / grid.spacing).astype(int)
    away = np.ones(grid.shape, dtype=bool)
    away[tuple(index.T)] = False
    rough = ndimage.distance_transform_edt(away)
    band = np.flatnonzero(rough.ravel() <= _BAND)
    # What the band cuts off from the far corner of the grid lies inside.
    parts, _ = ndimage.label(rough > _BAND)
    distances = np.where(parts == parts[-1, -1, -1], rough, -rough).ravel() * grid.spacing
    distances[band] = _exact(body, grid.nodes[band])
    return distances


def _close_face(distances: Floats, grid: Grid, proportions: Proportions, body: TriangleMesh) -> None:
    """Close what a ball does not get into on the face, in place: sockets, lids, nostrils and lips are no place for hair.

    As ``hair_tight_surface`` does for simulated hair, but not around the ears: behind them hair is rooted. Distances are
    measured as far as the ball reaches: to a voxel they would depend on the random points that stand for the skin, and
    whether a node between mouth and jaw is closed on those of the whole body.
    """
    low, high = proportions.place(np.array([[-0.85, -1.9, 0.35], [0.85, 0.55, 1.5]]))
    start = np.maximum(np.floor((low - grid.origin) / grid.spacing).astype(int), 0)
    end = np.ceil((high - grid.origin) / grid.spacing).astype(int) + 1
    face = tuple(slice(a, b) for a, b in zip(start, end))
    # Looked at with what lies around: at the border of the face the nearest open place may be beyond it.
    rim = np.minimum(start, math.ceil(2 * _FOLD / grid.spacing))
    wide = tuple(slice(a - r, b + math.ceil(2 * _FOLD / grid.spacing)) for a, b, r in zip(start, end, rim))
    inner = tuple(slice(r, r + n) for r, n in zip(rim, distances[face].shape))
    around = distances[wide]
    reached = (np.abs(around) > _BAND * grid.spacing) & (np.abs(around) < _FOLD + grid.spacing)
    nodes = grid.nodes.reshape(*grid.shape, 3)[wide][reached]
    around[reached] = np.copysign(Locator(body.vertices, body.faces).nearest(nodes)[1], around[reached])
    # Half a voxel less, so that an open and even surface stays where it is.
    closed = _FOLD - (ndimage.distance_transform_edt(around <= _FOLD) - 0.5)[inner] * grid.spacing
    folds = (distances[face] <= _FOLD) & (closed < distances[face] - grid.spacing)
    distances[face][folds] = closed[folds]


def _exact(body: TriangleMesh, points: Floats) -> Floats:
    """Signed distance to the surface [m], (k,): the side is that of the normal, interpolated to the nearest point."""
    nearest, distance = Locator(body.vertices, body.faces).nearest(points)
    closest = nearest.blend(body.vertices, body.faces)
    normals = nearest.blend(body.vertex_normals, body.faces)
    below = np.einsum("ij,ij->i", points - closest, normals) < 0
    return np.where(below, -distance, distance)
