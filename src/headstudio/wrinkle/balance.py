"""Equation 2.2 on a mesh: what a furrow gives, its bulges take, on curved skin and between coarse samples too."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .furrow_bed import FurrowBed
from .smooth_surface import PosedSurface, SmoothSurface
from .vectors import cross

# A furrow that runs along a border has no room for one of its bulges; the other does not grow without bounds.
_MOST = 0.2
# How much bulges are raised to see what that gives.
_TRIAL = 0.01


def balance(bed: FurrowBed, surface: SmoothSurface, unit_height: Floats) -> tuple[Floats, Floats]:
    """How much higher bulges must be for no volume to be displaced at rest, as a part: c0 + c1 M at amplitude M.

    unit_height: at full amplitude [m], (i,). Returns c0 and c1 of every entry of the bed, (i,), zero below the skin. On a
    plane c1 is zero; on curved skin an outward displacement M h makes room for H (M h)^2 more than an inward one, H the
    mean curvature. Each is within a fifth, and some hundredths on a mesh that is fine enough for its furrows.
    """
    rest = surface.at(bed.layout.skin.vertices)
    row = surface.row_of[bed.vertex]
    constant, linear = np.zeros_like(unit_height), np.zeros_like(unit_height)
    for k in range(len(bed.furrows)):
        own = np.flatnonzero(bed.furrow == k)
        heights = unit_height[own]
        higher = np.where(heights > 0, 1.0 + _TRIAL, 1.0) * heights
        whole, half, raised = (_volume(bed, surface, rest, row[own], h) for h in (heights, 0.5 * heights, higher))
        gain = (raised - whole) / _TRIAL
        if gain > 0:
            # V(M) = a M + b M^2, and the bulges give M gain for each part they are raised by.
            bulge = own[heights > 0]
            constant[bulge] = np.clip((whole - 4 * half) / gain, -_MOST, _MOST)
            linear[bulge] = np.clip((4 * half - 2 * whole) / gain, -_MOST, _MOST)
    return constant, linear


def _volume(bed: FurrowBed, surface: SmoothSurface, rest: PosedSurface, rows: np.ndarray, heights: Floats) -> float:
    """Volume between the skin at rest and the displaced one [m^3], to which outward counts as positive."""
    fine = bed.refined.vertices.copy()
    fine[surface.vertices] = rest.positions
    touched = np.zeros(len(fine), dtype=bool)
    touched[surface.vertices[rows]] = True
    faces = bed.refined.faces[touched[bed.refined.faces].any(axis=1)]
    before = fine[faces]
    fine[surface.vertices[rows]] += heights[:, None] * rest.normals[rows]
    middle = before.mean(axis=(0, 1)) if len(faces) else np.zeros(3)
    return _enclosed(fine[faces] - middle) - _enclosed(before - middle)


def _enclosed(triangles: Floats) -> float:
    """Volume between triangles, (m, 3, 3), and the origin [m^3]."""
    return float(np.einsum("ij,ij->", triangles[:, 0], cross(triangles[:, 1], triangles[:, 2])) / 6.0)
