"""Equation 2.2 on a mesh: what a furrow gives, its bulges take, on curved skin and between coarse samples too."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats, Ints
from .furrow_bed import FurrowBed
from .smooth_surface import SmoothSurface
from .vectors import cross

# A furrow that runs along a border has no room for one of its bulges; the other does not grow without bounds.
_MOST = 0.2
# How much bulges are raised to see what that gives.
_TRIAL = 0.01


def balance(bed: FurrowBed, surface: SmoothSurface, unit_height: Floats) -> tuple[Floats, Floats]:
    """How much higher bulges must be for no volume to be displaced at rest, as a part: c0 + c1 M at amplitude M.

    unit_height: at full amplitude [m], (i,). Returns c0 and c1 of every entry of the bed, (i,), zero below the skin. On a
    plane c1 is zero; on curved skin an outward displacement M h makes room for H (M h)^2 more than an inward one, H the
    mean curvature. Each is within a fifth, and some hundredths on a mesh that is fine enough for its furrows. A section of
    its own was measured on the skin that it is on, and stays as it is.
    """
    rest = surface.at(bed.layout.skin.vertices)
    fine = bed.refined.vertices.copy()
    fine[surface.vertices] = rest.positions
    constant, linear = np.zeros_like(unit_height), np.zeros_like(unit_height)
    for k, laid in enumerate(bed.furrows):
        if laid.furrow.section:
            continue
        own = np.flatnonzero(bed.furrow == k)
        heights = unit_height[own]
        higher = np.where(heights > 0, 1.0 + _TRIAL, 1.0) * heights
        room = _Room(bed.refined.faces, fine, bed.vertex[own], rest.normals[surface.row_of[bed.vertex[own]]])
        whole, half, raised = (room.displaced(h) for h in (heights, 0.5 * heights, higher))
        gain = (raised - whole) / _TRIAL
        if gain > 0:
            # V(M) = a M + b M^2, and the bulges give M gain for each part they are raised by.
            bulge = own[heights > 0]
            constant[bulge] = np.clip((whole - 4 * half) / gain, -_MOST, _MOST)
            linear[bulge] = np.clip((4 * half - 2 * whole) / gain, -_MOST, _MOST)
    return constant, linear


class _Room:
    """The triangles around some vertices, and how much room these make when they are displaced along their normals."""

    def __init__(self, faces: Ints, positions: Floats, vertices: Ints, normals: Floats) -> None:
        """positions: of all vertices at rest [m], (N, 3). vertices: those displaced, (k,). normals: theirs, (k, 3)."""
        touched = np.zeros(len(positions), dtype=bool)
        touched[vertices] = True
        faces = faces[touched[faces].any(axis=1)]
        used, corner = np.unique(faces, return_inverse=True)
        self._corner = corner.reshape(faces.shape)
        self._middle = positions[used].mean(axis=0) if len(used) else np.zeros(3)
        self._positions = positions[used] - self._middle
        self._place = np.searchsorted(used, vertices)
        self._normals = normals
        self._before = _enclosed(self._positions[self._corner])

    def displaced(self, heights: Floats) -> float:
        """Volume between the skin at rest and the displaced one [m^3], to which outward counts as positive."""
        moved = self._positions.copy()
        moved[self._place] += heights[:, None] * self._normals
        return _enclosed(moved[self._corner]) - self._before


def _enclosed(triangles: Floats) -> float:
    """Volume between triangles, (m, 3, 3), and the origin [m^3]."""
    return float(np.einsum("ij,ij->", triangles[:, 0], cross(triangles[:, 1], triangles[:, 2])) / 6.0)
