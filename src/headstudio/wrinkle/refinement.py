"""Smaller triangles around furrows, and only there (after Volino and Magnenat-Thalmann 1999).

Edges are halved where they are longer than the furrows near them ask for in their direction; a triangle always gives up
its longest edge first (Rivara 1984), so that no angle gets small however often it is split, and both triangles at an edge
split it alike, so that there is no crack and no T-junction.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from .refined_mesh import RefinedMesh
from .vectors import unit

# How long edges may be at a distance from a furrow, both in widths: near the sharp floor, on the bulge, on its slope.
_BANDS = ((0.7, 1.0), (2.6, 2.2), (5.0, 5.0))
# Along a furrow its profile hardly changes: edges may be so many times as long there as across it.
_ALONG = 2.5
_MOST_ROUNDS = 40
# Splitting the longest edge of a triangle may ask for that of its neighbour: so many rings of them are seldom left.
_RINGS = 3


@dataclass(frozen=True, eq=False)
class FurrowLine:
    """A furrow on the skin: points along it [m], closer together than its finest triangles, (k, 3), and its width [m]."""

    points: Floats
    width: float

    @cached_property
    def tree(self) -> cKDTree:
        """For the nearest point."""
        return cKDTree(self.points)

    @cached_property
    def directions(self) -> Floats:
        """Unit vectors along the furrow at its points, (k, 3)."""
        return unit(np.gradient(self.points, axis=0))


def refine_around(
    refined: RefinedMesh, line: FurrowLine, fineness: float, border: NDArray[np.bool_] | None = None
) -> RefinedMesh | None:
    """Halve edges until around a furrow they are at most ``fineness`` widths long.

    fineness: length of edges across the floor of a furrow over its width; farther away and along it they may be longer.
    border: vertices where the mesh is a part of a larger one, (N,); None is returned if an edge would be split there.
    """
    known = 0
    for _ in range(_MOST_ROUNDS):
        edges, edge_of = unique_edges(refined.faces)
        start, end = refined.vertices[edges[:, 0]], refined.vertices[edges[:, 1]]
        length = np.linalg.norm(end - start, axis=1)
        # What was short enough before still is; every new edge ends at a new vertex.
        fresh = edges[:, 1] >= known
        known = len(refined.home)
        marked = np.zeros(len(edges), dtype=bool)
        marked[fresh] = length[fresh] > _allowed(start[fresh], end[fresh], line, fineness)
        if not marked.any():
            break
        marked = _longest_first(marked, edge_of, length)
        if border is not None:
            single = np.bincount(edge_of.ravel(), minlength=len(edges)) == 1
            inner = (edges < len(border)).all(axis=1) & single & marked
            if border[edges[inner]].all(axis=1).any():
                return None
        number = np.where(marked, np.cumsum(marked) - 1, -1)
        refined = refined.split(number[edge_of], *refined.between(edges[marked], number[edge_of]))
    return refined


def faces_around(refined: RefinedMesh, line: FurrowLine) -> NDArray[np.bool_]:
    """The triangles that may have to be split for a furrow, and some around them, (M,)."""
    reach = _BANDS[-1][0] * line.width
    corners = refined.vertices[refined.faces]
    low, high = line.points.min(axis=0) - reach, line.points.max(axis=0) + reach
    boxed = np.flatnonzero(((corners.max(axis=1) > low) & (corners.min(axis=1) < high)).all(axis=1))
    middles = corners[boxed].mean(axis=1)
    radii = np.linalg.norm(corners[boxed] - middles[:, None], axis=2).max(axis=1)
    near = np.zeros(len(refined.faces), dtype=bool)
    near[boxed[line.tree.query(middles)[0] - radii < reach]] = True
    for _ in range(_RINGS):
        touched = np.zeros(len(refined.home), dtype=bool)
        touched[refined.faces[near]] = True
        near[:] = touched[refined.faces].any(axis=1)
    return near


def unique_edges(faces: Ints) -> tuple[Ints, Ints]:
    """Every edge once, (e, 2), and for the edges 0-1, 1-2, 2-0 of every triangle which it is, (m, 3)."""
    ends = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2), axis=2).reshape(-1, 2)
    count = int(faces.max()) + 1
    keys, edge_of = np.unique(ends @ [count, 1], return_inverse=True)
    return np.stack(np.divmod(keys, count), axis=1), edge_of.reshape(-1, 3)


def _allowed(start: Floats, end: Floats, line: FurrowLine, fineness: float) -> Floats:
    """How long the edges from ``start`` to ``end``, (e, 3) each, may be [m], (e,)."""
    allowed = np.full(len(start), np.inf)
    middles, halves = 0.5 * (start + end), 0.5 * np.linalg.norm(end - start, axis=1)
    distance, nearest = line.tree.query(middles)
    away = np.maximum(distance - 0.5 * halves, 0.0)
    cosine = np.einsum("ij,ij->i", unit(end - start), line.directions[nearest])
    # The length whose part across the furrow, and whose part along it over _ALONG, together make 1.
    longer = 1.0 / np.sqrt(np.maximum(1.0 - cosine**2 * (1.0 - _ALONG**-2), _ALONG**-2))
    for band, length in reversed(_BANDS):
        inside = away < band * line.width
        allowed[inside] = length * fineness * line.width * longer[inside]
    return allowed


def _longest_first(marked: np.ndarray, edge_of: Ints, length: Floats) -> np.ndarray:
    """The edges to split, with the longest edge of every triangle that loses one."""
    # Edges of one length are told apart by their number: which is the longest is agreed on by both triangles.
    rank = np.empty(len(length), dtype=np.int64)
    rank[np.argsort(length, kind="stable")] = np.arange(len(length))
    longest = edge_of[np.arange(len(edge_of)), rank[edge_of].argmax(axis=1)]
    marked = marked.copy()
    while True:
        wanted = longest[marked[edge_of].any(axis=1)]
        if marked[wanted].all():
            return marked
        marked[wanted] = True
