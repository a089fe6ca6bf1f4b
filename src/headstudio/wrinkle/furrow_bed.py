"""Skin prepared for its furrows: fine enough to carry them, and who lies beside what.

Nothing here depends on depth or amplitude, so that those can be changed at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Ints
from .conform import conform
from .furrow import Furrow
from .laid_furrow import Beside, LaidFurrow
from .refined_mesh import RefinedMesh
from .refinement import FurrowLine, refine_around
from .skin_layout import SkinLayout

# Distances in space are a little shorter than on the skin; candidates are looked for this much farther.
_SLACK = 1.05


@dataclass(frozen=True, eq=False)
class FurrowBed:
    """A refined skin and where its vertices lie beside furrows.

    layout: the skin and its map. furrows: k of them, laid in texture space. chosen: which of the furrows that were asked
    for these are, (k,). refined: the finer mesh, N vertices.
    The rest has an entry for every vertex within reach of a furrow (once for each furrow), i entries: vertex: which, (i,).
    furrow: beside which, (i,). beside: where.
    """

    layout: SkinLayout
    furrows: tuple[LaidFurrow, ...]
    chosen: tuple[int, ...]
    refined: RefinedMesh
    vertex: Ints
    furrow: Ints
    beside: Beside


def prepare_bed(layout: SkinLayout, furrows: Sequence[Furrow], fineness: float = 0.25) -> FurrowBed:
    """Refine a skin around furrows whose control points are in its texture space.

    fineness: length of the finest edges over the width of their furrow.
    """
    laid = tuple(LaidFurrow(furrow, layout) for furrow in furrows)
    spacing = [0.5 * fineness * furrow.furrow.width for furrow in laid]
    lines = [FurrowLine(furrow.line(step), furrow.furrow.width) for furrow, step in zip(laid, spacing)]
    refined = refine_around(layout.skin, lines, fineness)
    fixed = np.zeros(len(refined.home), dtype=bool)
    for furrow in laid:
        for part in (0.0, fineness, -fineness):
            refined, fixed = conform(refined, layout, furrow, part * furrow.furrow.width, fixed)
    entries = [_within_reach(refined, layout, furrow) for furrow in laid]
    return FurrowBed(
        layout,
        laid,
        tuple(range(len(laid))),
        refined,
        np.concatenate([np.zeros(0, dtype=np.int64), *(vertices for vertices, _ in entries)]),
        np.repeat(np.arange(len(laid)), [len(vertices) for vertices, _ in entries]),
        _joined([beside for _, beside in entries]),
    )


def _within_reach(refined: RefinedMesh, layout: SkinLayout, furrow: LaidFurrow) -> tuple[Ints, Beside]:
    """The vertices that a furrow displaces, and where they lie beside it."""
    low, high = furrow.points.min(axis=0) - furrow.reach, furrow.points.max(axis=0) + furrow.reach
    boxed = ((refined.vertices > low) & (refined.vertices < high)).all(axis=1) & layout.mapped[refined.home]
    vertices = np.flatnonzero(boxed & (refined.weights.sum(axis=1) > 0))
    line = furrow.line(0.1 * furrow.reach)
    reach = _SLACK * (furrow.reach + 0.05 * furrow.reach)
    away, _ = cKDTree(line).query(refined.vertices[vertices], distance_upper_bound=reach)
    vertices = vertices[np.isfinite(away)]
    beside = furrow.beside(layout.uv(refined, vertices), layout.metrics(refined, vertices))
    kept = (beside.distance < furrow.reach) & (beside.fade > 0)
    return vertices[kept], Beside(*(values[kept] for values in vars(beside).values()))


def _joined(parts: Sequence[Beside]) -> Beside:
    if not parts:
        none = np.zeros(0)
        return Beside(none, none, none, none.astype(bool), none, np.zeros((0, 2)), np.zeros((0, 2)))
    return Beside(*(np.concatenate([getattr(part, name) for part in parts]) for name in vars(parts[0])))
