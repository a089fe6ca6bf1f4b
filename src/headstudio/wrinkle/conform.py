"""Edges along the floor of a furrow, so that it is as sharp on the mesh as it is in equation 2.1.

Vertices close to the curve are slid onto it over the surface; where the curve still crosses an edge, the edge is split
at the crossing. What was a ragged band of triangles across the floor becomes a chain of edges in it. The same is done at
a small distance on either side, so that the walls of the furrow are even strips, lit evenly.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints
from .laid_furrow import LaidFurrow
from .one_to_one import signed_areas
from .refined_mesh import RefinedMesh
from .refinement import unique_edges
from .skin_layout import SkinLayout

# A vertex this close to the curve, as a part of the shortest edge at it, is moved onto it.
_SNAP = 0.4
# An edge is cut only where at least this part of it is left on either side.
_CUT = 0.08
# A triangle that a moved vertex leaves with less than this part of its area is not worth the move.
_LEFT = 0.15
# Where less than this of a furrow's depth is there, it needs no edge.
_FAINT = 0.02
# Triangles within this many widths of the curve can be cut; the lines beside it are nearer than that.
_NEAR = 1.2

Mask = np.ndarray


def conform(
    refined: RefinedMesh, layout: SkinLayout, furrow: LaidFurrow, offset: float, fixed: Mask
) -> tuple[RefinedMesh, Mask]:
    """Bring a chain of edges onto a furrow, or onto the line ``offset`` [m] to the left of it (below 0: right).

    fixed: vertices that stay where they are, (N,); returned with those on the line.
    """
    faces = _faces_near(refined, layout, furrow)
    near = np.unique(refined.faces[faces])
    # On the border of the map a vertex may be at home in a triangle beyond it, where nothing is known.
    near = near[layout.mapped[refined.home[near]]]
    beside = furrow.beside(layout.uv(refined, near), layout.metrics(refined, near))
    uv = np.full((len(fixed), 2), np.nan)
    uv[near] = furrow.whole(layout.uv(refined, near))
    signed, target = np.zeros(len(fixed)), np.full((len(fixed), 2), np.nan)
    useful = np.zeros(len(fixed), dtype=bool)
    signed[near] = beside.side * beside.distance - offset
    useful[near] = beside.inside & (beside.fade > _FAINT) & ((beside.side * offset > 0) | (offset == 0))
    target[near] = furrow.beside_curve(beside, uv[near], abs(offset))

    shortest = _shortest_edges(refined, faces)
    wanted = near[(np.abs(signed[near]) < _SNAP * shortest[near]) & useful[near] & ~fixed[near]]
    moved = _movable(refined.faces[faces], uv, target, np.setdiff1d(wanted, np.flatnonzero(_rim(refined, faces))))
    uv[moved] = target[moved]
    refined = refined.moved(moved, *layout.place(uv[moved]))
    on_line = np.zeros(len(fixed), dtype=bool)
    on_line[moved] = True

    edges, near_edge_of = unique_edges(refined.faces[faces])
    a, b = edges.T
    crossed = useful[a] & useful[b] & (signed[a] * signed[b] < 0) & ~on_line[a] & ~on_line[b]
    # Two sides of a fold are far apart along the curve, or farther from it than the edge is long.
    length = np.linalg.norm(refined.vertices[a] - refined.vertices[b], axis=1)
    crossed &= np.abs(signed[a]) + np.abs(signed[b]) < 1.5 * length
    part = np.divide(np.abs(signed[a]), np.abs(signed[a]) + np.abs(signed[b]), out=np.zeros(len(a)), where=crossed)
    crossed &= (part > _CUT) & (part < 1 - _CUT)
    edge_of = np.full(refined.faces.shape, -1)
    edge_of[faces] = np.where(crossed, np.cumsum(crossed) - 1, -1)[near_edge_of]
    part = part[crossed, None]
    refined = refined.split(edge_of, *layout.place((1 - part) * uv[a[crossed]] + part * uv[b[crossed]]))
    added = np.ones(len(refined.home) - len(fixed), dtype=bool)
    return refined, np.concatenate([fixed | on_line, added])


def _faces_near(refined: RefinedMesh, layout: SkinLayout, furrow: LaidFurrow) -> Ints:
    """Mapped triangles with a corner close to the furrow."""
    reach = _NEAR * furrow.furrow.width
    low, high = furrow.points.min(axis=0) - reach, furrow.points.max(axis=0) + reach
    boxed = np.flatnonzero(((refined.vertices > low) & (refined.vertices < high)).all(axis=1))
    line = cKDTree(furrow.line(0.25 * furrow.furrow.width))
    close = np.zeros(len(refined.home), dtype=bool)
    close[boxed] = np.isfinite(line.query(refined.vertices[boxed], distance_upper_bound=reach)[0])
    return np.flatnonzero(close[refined.faces].any(axis=1) & layout.mapped[refined.parent])


def _shortest_edges(refined: RefinedMesh, faces: Ints) -> Floats:
    """The shortest edge of the given triangles at every vertex [m], (N,)."""
    shortest = np.full(len(refined.home), np.inf)
    start, end = refined.faces[faces].ravel(), np.roll(refined.faces[faces], -1, axis=1).ravel()
    length = np.linalg.norm(refined.vertices[start] - refined.vertices[end], axis=1)
    np.minimum.at(shortest, start, length)
    np.minimum.at(shortest, end, length)
    return shortest


def _movable(corners: Ints, uv: Floats, target: Floats, wanted: Ints) -> Ints:
    """Those of the ``wanted`` vertices that can go to their ``target``, (N, 2), without turning a triangle over."""
    before = signed_areas(uv[corners])
    moving = np.zeros(len(uv), dtype=bool)
    moving[wanted] = True
    while True:
        after = signed_areas(np.where(moving[corners][..., None], target[corners], uv[corners]))
        spoilt = moving[corners] & (after < _LEFT * before)[:, None]
        if not spoilt.any():
            return np.flatnonzero(moving)
        moving[corners[spoilt]] = False


def _rim(refined: RefinedMesh, faces: Ints) -> Mask:
    """Whether a vertex has triangles besides the given ones, or lies on their border, (N,)."""
    count = len(refined.home)
    edges, edge_of = unique_edges(refined.faces[faces])
    border = edges[np.bincount(edge_of.ravel(), minlength=len(edges)) == 1]
    some = np.bincount(refined.faces[faces].ravel(), minlength=count)
    rim = some != np.bincount(refined.faces.ravel(), minlength=count)
    rim[border] = True
    return rim
