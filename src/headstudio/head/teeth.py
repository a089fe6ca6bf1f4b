"""Rows of teeth: fourteen rounded crowns and their gum around an arch, in the place of coarser ones."""

from __future__ import annotations

import math

import numpy as np

from .mesh import Floats, Ints, TriangleMesh

TEETH = 14
# Teeth stand at even steps of a sine of the way around the arch, so that molars are wider than what stands in front.
_WIDENING = 1.35
_COLUMNS = 8  # of vertices to a tooth
# Half the thickness of a crown, in front and at the ends of the row [m]; how much of it is left between two teeth, and how
# much longer a tooth is in its middle than at its sides [m].
_THICKNESS = (0.0018, 0.0048)
_WAIST, _CORNER = 0.55, 0.0009
# Across a row, from the outer gum over the edge to the inner one: outward in half thicknesses and besides that [m], then
# how far from the edge [m]. The last of either side reach as far as the row.
_ACROSS = np.array(
    [
        (1.0, 0.0014, 0.0140),
        (1.0, 0.0010, 0.0105),
        (1.0, 0.0004, 0.0088),
        (1.0, 0.0002, 0.0065),
        (0.98, 0.0000, 0.0035),
        (0.85, 0.0000, 0.0012),
        (0.45, 0.0000, 0.0000),
        (-0.20, 0.0000, 0.0003),
        (-0.70, 0.0000, 0.0014),
        (-1.0, 0.0000, 0.0045),
        (-1.0, -0.0004, 0.0088),
        (-1.0, -0.0014, 0.0105),
        (-1.0, -0.0024, 0.0140),
    ]
)


def along_arch(tooth: Floats) -> Floats:
    """The way around an arch, 0 at its right end to 1 at its left, where ``tooth`` of its teeth are passed, (n,).

    The shader of parts draws the lines between teeth by the inverse of this.
    """
    return 0.5 + np.arcsin((2.0 * tooth / TEETH - 1.0) * math.sin(0.5 * _WIDENING)) / _WIDENING


def dental_row(coarse: TriangleMesh, upper: bool) -> TriangleMesh:
    """The row of teeth that fills the place of a coarser one, ``coarse`` [m], in the head frame.

    Its arch is a half ellipse that opens backward; edges and gums slope from front to back as the coarse ones do.
    """
    low, high = coarse.bounds
    tooth = np.linspace(0.0, TEETH, TEETH * _COLUMNS + 1)
    angle = np.pi * (along_arch(tooth) - 0.5)
    middle, half, depth = 0.5 * (low[0] + high[0]), 0.5 * (high[0] - low[0]), high[2] - low[2]
    # A point of the arch and the way out of it, seen from above.
    arch = np.column_stack([middle + half * np.sin(angle), low[2] + depth * np.cos(angle)])
    out = np.column_stack([np.sin(angle) / half, np.cos(angle) / depth])
    out /= np.linalg.norm(out, axis=1, keepdims=True)

    ahead = np.cos(angle)
    thickness = _THICKNESS[1] + (_THICKNESS[0] - _THICKNESS[1]) * ahead**2
    beside = np.abs(2.0 * (tooth % 1.0) - 1.0) ** 3
    # Only crowns have a waist; the gum goes on past them.
    crown = np.clip((0.0105 - _ACROSS[:, 2]) / 0.003, 0.0, 1.0)
    waist = 1.0 - (1.0 - _WAIST) * beside[:, None] * crown
    outward = thickness[:, None] * waist * _ACROSS[:, 0] + _ACROSS[:, 1]
    # The outermost gum is where the coarse row ends.
    outward -= thickness[:, None] + _ACROSS[0, 1]

    sign = 1.0 if upper else -1.0
    edge, gum = _slopes(coarse, sign)
    rise = _ACROSS[:, 2] + _CORNER * beside[:, None] * (1.0 - np.clip(_ACROSS[:, 2] / 0.003, 0.0, 1.0))
    whole = np.abs(gum(ahead) - edge(ahead))[:, None]
    level = edge(ahead)[:, None] + sign * np.minimum(rise, whole)
    level[:, [0, -1]] = gum(ahead)[:, None]

    plan = arch[:, None] + outward[..., None] * out[:, None]
    vertices = np.stack([plan[..., 0], level, plan[..., 1]], axis=2)
    vertices[[0, -1]] = vertices[[0, -1]].mean(axis=1, keepdims=True)  # closed at both ends
    return TriangleMesh(vertices.reshape(-1, 3), _strips(len(tooth), len(_ACROSS), turned=upper))


def _slopes(coarse: TriangleMesh, sign: float) -> list[np.poly1d]:
    """Height of the edge and of the gum's end, [m], by how far ahead a place is: 0 at the ends of the row, 1 in front."""
    y, z = coarse.vertices[:, 1], coarse.vertices[:, 2]
    ahead = (z - z.min()) / np.ptp(z)
    back, front = y[ahead < 0.1], y[ahead > 0.9]
    ends = [(each.min(), each.max())[:: int(sign)] for each in (back, front)]
    return [np.poly1d([ends[1][k] - ends[0][k], ends[0][k]]) for k in range(2)]


def _strips(columns: int, rows: int, *, turned: bool) -> Ints:
    """Triangles between neighbouring columns of points, turned around for a grid that is seen from behind."""
    corner = np.arange(columns * rows).reshape(columns, rows)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    faces = np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)]).reshape(-1, 3)
    return faces[:, ::-1].copy() if turned else faces
