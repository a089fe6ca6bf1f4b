"""Equation 2.2 on a mesh: what a furrow gives, its bulges take, on curved skin and between coarse samples too."""

from __future__ import annotations

import numpy as np

from ..head.mesh import Floats
from .furrow_bed import FurrowBed
from .smooth_surface import PosedSurface, SmoothSurface, cross

# A furrow that runs along a border has no room for one of its bulges; the other does not grow without bounds.
_BOUNDS = (0.8, 1.25)


def balanced(bed: FurrowBed, surface: SmoothSurface, unit_height: Floats) -> Floats:
    """Heights at full amplitude [m], (i,), with the bulges of every furrow scaled so that it displaces no volume at rest.

    The factor is within 0.8 and 1.25, and some hundredths from 1 on a mesh that is fine enough for its furrows.
    """
    rest = surface.at(bed.layout.skin.vertices)
    row = surface.row_of[bed.vertex]
    heights = unit_height.copy()
    for k in range(len(bed.furrows)):
        own = np.flatnonzero(bed.furrow == k)
        bulge = own[unit_height[own] > 0]
        whole = _volume(bed, surface, rest, row[own], unit_height[own])
        raised = _volume(bed, surface, rest, row[own], np.where(unit_height[own] > 0, 1.01, 1.0) * unit_height[own])
        gain = (raised - whole) / 0.01
        if gain > 0:
            heights[bulge] *= np.clip(1.0 - whole / gain, *_BOUNDS)
    return heights


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
