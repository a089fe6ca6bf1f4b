"""Flat sheets and tubes to carve, and an independent look at what was carved."""

from __future__ import annotations

import numpy as np

from headstudio.head.mesh import Floats, TriangleMesh
from headstudio.wrinkle.direction_field import DirectionField
from headstudio.wrinkle.segments import Segments
from headstudio.wrinkle.texels import texel_map
from headstudio.wrinkle.texture_map import TextureMap


def sheet(cells: int = 12, metres: float = 0.05, low: float = 0.0, high: float = 1.0) -> TextureMap:
    """A square sheet whose map covers the square from ``low`` to ``high``; the whole unit square is ``metres`` wide."""
    uv, faces = _grid(cells)
    uv = low + (high - low) * uv
    mesh = TriangleMesh(np.column_stack([uv * metres, np.zeros(len(uv))]), faces)
    return TextureMap(mesh, uv, uv[faces], metres, wrapped=False)


def tube(cells: int = 16, metres: float = 0.05) -> TextureMap:
    """A tube, ``metres`` around and high, whose map wraps around; v runs from 0.1 to 0.9."""
    uv, faces = _grid(cells)
    uv[:, 1] = 0.1 + 0.8 * uv[:, 1]
    corners = uv[faces]
    seam = np.arange(len(uv)) % (cells + 1) == cells
    welded = np.where(seam, np.arange(len(uv)) - cells, np.arange(len(uv)))
    used, compact = np.unique(welded, return_inverse=True)
    angle, radius = 2 * np.pi * uv[used, 0], metres / (2 * np.pi)
    around = np.column_stack([radius * np.sin(angle), metres * uv[used, 1], radius * np.cos(angle)])
    return TextureMap(TriangleMesh(around, compact[faces]), uv[used], corners, metres, wrapped=True)


def uniform_field(
    texture_map: TextureMap, size: int, magnitude: float, angle: float = 0.6, unit: float = 1.0
) -> DirectionField:
    """A field of one direction [rad] and magnitude everywhere."""
    vector = magnitude * np.array([np.cos(angle), np.sin(angle)])
    return DirectionField(texel_map(texture_map, size), np.tile(vector, (len(texture_map.uv), 1)), unit)


def crossings(segments: Segments, period: int = 0) -> int:
    """How many pairs of carved pieces of different furrows cross, each with its ends on both sides of the other."""
    count = 0
    for k in range(len(segments)):
        others = np.flatnonzero(segments.furrows > segments.furrows[k])
        offset = segments.starts[others] - segments.starts[k]
        if period:
            offset[:, 0] -= period * np.rint(offset[:, 0] / period)
        a, step = offset, segments.ends[k] - segments.starts[k]
        b = offset + segments.ends[others] - segments.starts[others]
        first = _side(step, a) * _side(step, b)
        second = _side(b - a, -a) * _side(b - a, step - a)
        count += int(((first < 0) & (second < 0)).sum())
    return count


def distance_to_furrows(segments: Segments, points: Floats) -> tuple[Floats, Floats]:
    """From points [texels], (k, 2): to the nearest carved piece, and to the edge of the nearest strip, below 0 within.

    The strip of a piece is as wide as 1 + 12 m, the printed law.
    """
    step = segments.ends - segments.starts
    squared = np.maximum((step**2).sum(axis=1), 1e-30)
    nearest, edge = np.full(len(points), np.inf), np.full(len(points), np.inf)
    for start, along, length, half in zip(
        segments.starts, step, squared, 0.5 * segments.units * (1 + 12 * segments.magnitudes)
    ):
        offset = points - start
        part = (offset @ along / length).clip(0, 1)
        away = np.linalg.norm(offset - part[:, None] * along, axis=1)
        nearest, edge = np.minimum(nearest, away), np.minimum(edge, away - half)
    return nearest, edge


def _grid(cells: int) -> tuple[Floats, np.ndarray]:
    line = np.linspace(0.0, 1.0, cells + 1)
    u, v = np.meshgrid(line, line)
    corner = np.arange(cells * cells) // cells * (cells + 1) + np.arange(cells * cells) % cells
    first = np.stack([corner, corner + 1, corner + cells + 2], axis=1)
    second = np.stack([corner, corner + cells + 2, corner + cells + 1], axis=1)
    return np.column_stack([u.ravel(), v.ravel()]), np.concatenate([first, second])


def _side(along: Floats, point: Floats) -> Floats:
    return along[..., 0] * point[..., 1] - along[..., 1] * point[..., 0]
