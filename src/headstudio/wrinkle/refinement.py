"""Smaller triangles around furrows, and only there (after Volino and Magnenat-Thalmann 1999).

Edges are halved where they are longer than the furrows near them ask for; a triangle always gives up its longest edge
first (Rivara 1984), so that no angle gets small however often it is split, and both triangles at an edge split it
alike, so that there is no crack and no T-junction.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints, TriangleMesh
from .refined_mesh import RefinedMesh

# How long edges may be at a distance from a furrow, both in widths: near the sharp floor, on the bulge, on its slope.
_BANDS = ((0.7, 1.0), (2.6, 2.2), (5.0, 5.0))
_MOST_ROUNDS = 40


@dataclass(frozen=True, eq=False)
class FurrowLine:
    """A furrow on the skin: points along it [m], closer together than its finest triangles, (k, 3), and its width [m]."""

    points: Floats
    width: float


def refine_around(mesh: TriangleMesh, lines: Sequence[FurrowLine], fineness: float) -> RefinedMesh:
    """Halve the edges of ``mesh`` until around every furrow they are at most ``fineness`` widths long.

    fineness: length of edges at the floor of a furrow over its width; farther away they may be longer.
    """
    refined = RefinedMesh.unrefined(mesh)
    trees = [(line, cKDTree(line.points)) for line in lines]
    known = 0
    for _ in range(_MOST_ROUNDS):
        edges, edge_of = unique_edges(refined.faces)
        start, end = refined.vertices[edges[:, 0]], refined.vertices[edges[:, 1]]
        length = np.linalg.norm(end - start, axis=1)
        # What was short enough before still is; every new edge ends at a new vertex.
        fresh = edges[:, 1] >= known
        known = len(refined.home)
        marked = np.zeros(len(edges), dtype=bool)
        allowed = _allowed(0.5 * (start + end)[fresh], 0.5 * length[fresh], trees, fineness)
        marked[fresh] = length[fresh] > allowed
        if not marked.any():
            break
        marked = _longest_first(marked, edge_of, length)
        number = np.where(marked, np.cumsum(marked) - 1, -1)
        refined = refined.split(number[edge_of], *refined.between(edges[marked], number[edge_of]))
    return refined


def unique_edges(faces: Ints) -> tuple[Ints, Ints]:
    """Every edge once, (e, 2), and for the edges 0-1, 1-2, 2-0 of every triangle which it is, (m, 3)."""
    ends = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2), axis=2).reshape(-1, 2)
    count = int(faces.max()) + 1
    keys, edge_of = np.unique(ends @ [count, 1], return_inverse=True)
    return np.stack(np.divmod(keys, count), axis=1), edge_of.reshape(-1, 3)


def _allowed(middles: Floats, halves: Floats, trees: Sequence[tuple[FurrowLine, cKDTree]], fineness: float) -> Floats:
    """How long each edge may be [m], (e,), from its middle and half its length."""
    allowed = np.full(len(middles), np.inf)
    for line, tree in trees:
        reach = _BANDS[-1][0] * line.width
        low, high = line.points.min(axis=0) - reach, line.points.max(axis=0) + reach
        near = np.flatnonzero(((middles + halves[:, None] > low) & (middles - halves[:, None] < high)).all(axis=1))
        away = np.maximum(tree.query(middles[near])[0] - 0.5 * halves[near], 0.0)
        for distance, length in reversed(_BANDS):
            inside = near[away < distance * line.width]
            allowed[inside] = np.minimum(allowed[inside], length * fineness * line.width)
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
