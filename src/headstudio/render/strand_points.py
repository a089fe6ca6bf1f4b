"""Strands on the graphics card: points in textures that shaders pull from, and the order in which they are drawn.

Strands are shuffled once, so that the first so many of them are a fair sample of the hairstyle: a coarser level of detail
is a prefix, drawn with wider strands.
"""

from __future__ import annotations

from dataclasses import dataclass

import moderngl
import numpy as np
from numpy.typing import NDArray

from ..head.mesh import Ints
from ..wisp.strands import Singles, Strands

POINT_ROW = 2048
"""Points in a row of the textures; ``point_row`` in common/strand_points.glsl."""

DEFAULT_RADIUS = 4e-5
"""Half the thickness of a shaft [m] where the strands do not say it; the last fifth of a strand tapers to half of it."""

_SHUFFLE = 20051
# The direction of hair where points of a strand lie on each other.
_DOWN = np.array([0.0, -1e-3, 0.0], np.float32)
_RESTART = np.uint32(0xFFFFFFFF)


@dataclass(frozen=True, eq=False)
class PackedStrands:
    """Shuffled strands as arrays, ready to be sent.

    points: position [m] and radius [m], (p, 4). tangents: along the hair, of any length, (p, 3). first: where each strand
    starts, (n + 1,). source: which of the points they were, (p,).
    """

    points: Singles
    tangents: Singles
    first: NDArray[np.int64]
    source: Ints

    @property
    def count(self) -> int:
        """How many strands, n."""
        return len(self.first) - 1


def pack(strands: Strands) -> PackedStrands:
    """Shuffle strands and find their tangents."""
    order = np.random.default_rng(_SHUFFLE).permutation(strands.count)
    counts = strands.counts[order]
    first = np.concatenate([[0], np.cumsum(counts)])
    source = np.repeat(strands.first[order] - first[:-1], counts) + np.arange(first[-1])
    points = np.empty((len(source), 4), np.float32)
    place = strands.points.take(source, axis=0)
    points[:, :3] = place
    points[:, 3] = _default_radius(first) if strands.radius is None else strands.radius.take(source)
    tangents = np.empty((len(source), 3), np.float32)
    np.subtract(place[2:], place[:-2], out=tangents[1:-1])
    start, end = first[:-1], first[1:] - 1
    tangents[start] = place[start + 1] - place[start]
    tangents[end] = place[end] - place[end - 1]
    tangents[~tangents.any(axis=1)] = _DOWN
    return PackedStrands(points, tangents, first, source)


def strip_indices(first: NDArray[np.int64], shown: int, stride: int = 1) -> NDArray[np.uint32]:
    """The first ``shown`` strands as triangle strips: two vertices for every point, a restart after every strand.

    stride: only every so many points, and the tip.
    """
    steps = -(-(np.diff(first[: shown + 1]) - 1) // stride)
    ends = np.concatenate([[0], np.cumsum(2 * steps + 3)])
    strand = np.repeat(np.arange(shown), 2 * steps + 3)
    place = np.arange(ends[-1]) - ends[strand]
    point = np.minimum(first[strand] + stride * (place // 2), first[strand + 1] - 1)
    strips = (2 * point + place % 2).astype(np.uint32)
    strips[ends[1:] - 1] = _RESTART
    return strips


def piece_indices(first: NDArray[np.int64], shown: int, piece: int) -> tuple[NDArray[np.uint32], Ints]:
    """The first ``shown`` strands in pieces of ``piece`` segments: strips (k, 2 piece + 3), and how many pieces the first 0, 1,
    2 ... strands have, (shown + 1,).

    A shorter piece repeats its last vertices: triangles without area.
    """
    segments = np.diff(first[: shown + 1]) - 1
    pieces = -(-segments // piece)
    which = np.arange(pieces.sum()) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    start = np.repeat(first[:shown], pieces) + piece * which
    last = np.repeat(first[1 : shown + 1] - 1, pieces)
    strips = np.full((len(start), 2 * piece + 3), _RESTART, np.uint32)
    vertex, end = (2 * start).astype(np.uint32), (2 * last + 1).astype(np.uint32)
    for k in range(2 * piece + 2):
        np.minimum(vertex + np.uint32(k), end, out=strips[:, k])
    return strips, np.concatenate([[0], np.cumsum(pieces)])


def piece_spheres(packed: PackedStrands, strips: NDArray[np.uint32]) -> tuple[Singles, Singles]:
    """The middle of every piece [m], (k, 3), halfway along it, and how far it reaches from there [m], (k,)."""
    points = strips[:, :-1:2] // 2
    piece = points.shape[1] - 1
    place = packed.points[:, :3]
    middle = 0.5 * (place[points[:, piece // 2]] + place[points[:, (piece + 1) // 2]])
    farthest = np.zeros(len(points), np.float32)
    for point in points.T:
        away = place[point] - middle
        np.maximum(farthest, np.einsum("ij,ij->i", away, away), out=farthest)
    return middle, np.sqrt(farthest)


class StrandTextures:
    """The arrays of packed strands as textures of POINT_ROW points a row."""

    def __init__(self, context: moderngl.Context, packed: PackedStrands) -> None:
        self.rows = -(-len(packed.points) // POINT_ROW)
        self.points = self._texture(context, packed.points)
        self.tangents = self._texture(context, packed.tangents)
        self.colour: moderngl.Texture | None = None
        self._context = context
        self._source = packed.source

    def paint(self, colour: Singles | None) -> None:
        """Give the points of the strands that were packed their colours, linear, (p, 3); None: they have none."""
        self.colour = None
        if colour is not None:
            # Colours need no more than half floats.
            self.colour = self._texture(self._context, colour.astype(np.float16).take(self._source, axis=0), "f2")

    def _texture(self, context: moderngl.Context, values: NDArray[np.floating], kind: str = "f4") -> moderngl.Texture:
        parts = values.shape[1]
        padded = np.zeros((self.rows * POINT_ROW, parts), values.dtype)
        padded[: len(values)] = values
        texture = context.texture((POINT_ROW, self.rows), parts, padded, dtype=kind, alignment=1)
        texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
        return texture


def _default_radius(first: NDArray[np.int64]) -> Singles:
    counts = np.diff(first)
    place = np.arange(first[-1]) - np.repeat(first[:-1], counts)
    along = place / np.repeat(counts - 1, counts)
    return (DEFAULT_RADIUS * np.minimum(1.0, 0.5 + 2.5 * (1 - along))).astype(np.float32)
