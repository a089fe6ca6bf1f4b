"""Skin prepared for its furrows: fine enough to carry them, and who lies beside what.

Furrows are laid one after the other, each into the skin as those before it have left it. So one more furrow changes
nothing but the skin around it, and is there at once. Nothing here depends on depth or amplitude.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Ints
from .conform import Mask, conform
from .furrow import Controls, Furrow
from .laid_furrow import Beside, LaidFurrow
from .refined_mesh import RefinedMesh
from .refinement import FurrowLine, faces_around, refine_around
from .skin_layout import SkinLayout

# Distances in space are a little shorter than on the skin; candidates are looked for this much farther.
_SLACK = 1.05
# After every so many furrows the skin is kept as it is then, and so it is before the last two: those that were drawn last.
_KEPT_EVERY, _KEPT_LAST = 6, 2
# With more new furrows than these a bed is another one, and not one that was changed.
_FEW = 4


Line = tuple[Controls, float, float, int, tuple[float, ...]]
"""All of a furrow that a bed depends on: control points, width, taper, how many heights its section has, and its swell."""


@dataclass(frozen=True, eq=False)
class BedStage:
    """The skin with the first ``count`` of its furrows. fixed: vertices on their lines, which stay where they are, (N,)."""

    count: int
    refined: RefinedMesh
    fixed: Mask


@dataclass(frozen=True, eq=False)
class FurrowBed:
    """A refined skin and where its vertices lie beside furrows.

    layout: the skin and its map. furrows: k of them, laid in texture space. chosen: which of the furrows that were asked
    for these are, (k,). refined: the finer mesh, N vertices. fineness: see ``prepare_bed``.
    The rest has an entry for every vertex within reach of a furrow (once for each furrow), i entries: vertex: which, (i,).
    furrow: beside which, (i,). beside: where. laying: the lines that were laid, in their order, with those that are no
    more. stages: what another bed can begin from.
    """

    layout: SkinLayout
    furrows: tuple[LaidFurrow, ...]
    chosen: tuple[int, ...]
    refined: RefinedMesh
    fineness: float
    vertex: Ints
    furrow: Ints
    beside: Beside
    laying: tuple[Line, ...]
    stages: tuple[BedStage, ...]

    @property
    def on_lines(self) -> Ints:
        """Vertices on the lines of furrows, (k,)."""
        return np.flatnonzero(self.stages[-1].fixed)

    @property
    def settled(self) -> bool:
        """Whether it is the same as if these furrows had been all that there ever were."""
        return self.laying == tuple(_line(laid.furrow) for laid in self.furrows)


def prepare_bed(
    layout: SkinLayout,
    furrows: Sequence[Furrow],
    fineness: float = 0.25,
    known: FurrowBed | None = None,
    tick: Callable[[], None] = lambda: None,
    *,
    settled: bool = True,
) -> FurrowBed:
    """Refine a skin around furrows whose control points are in its texture space.

    fineness: length of the finest edges over the width of their furrow. known: a bed that was prepared before; what it has
    in common with this one is taken over, and the result is the same as without it. tick: is called before each furrow that
    is laid. settled: False takes ``known`` over with all of its furrows, those that are no more leave finer triangles
    behind, and only those that are new are laid, if they are few.
    """
    if known is not None and (known.layout is not layout or known.fineness != fineness):
        known = None
    before = {_line(laid.furrow): k for k, laid in enumerate(known.furrows)} if known else {}
    lines = tuple(_line(furrow) for furrow in furrows)
    laid = {
        line: known.furrows[before[line]] if known and line in before else LaidFurrow(furrow, layout)
        for line, furrow in zip(lines, furrows)
    }
    laying = lines
    if known is not None and not settled:
        fresh = tuple(line for line in lines if line not in known.laying)
        if len(fresh) <= _FEW:
            laying = known.laying + fresh
    stages = _common_stages(layout, laying, known)
    stage = stages[-1]
    for line in laying[stage.count :]:
        tick()
        stage = _with_furrow(stage, layout, laid[line], fineness)
        if stage.count % _KEPT_EVERY == 0 or stage.count >= len(laying) - _KEPT_LAST:
            stages.append(stage)
    entries = _entries(layout, stage.refined, [laid[line] for line in lines], known, before)
    return FurrowBed(
        layout,
        tuple(laid[line].named(furrow) for line, furrow in zip(lines, furrows)),
        tuple(range(len(lines))),
        stage.refined,
        fineness,
        np.concatenate([np.zeros(0, dtype=np.int64), *(vertices for vertices, _ in entries)]),
        np.repeat(np.arange(len(lines)), [len(vertices) for vertices, _ in entries]),
        _joined([beside for _, beside in entries]),
        laying,
        tuple(stages),
    )


def _entries(
    layout: SkinLayout,
    refined: RefinedMesh,
    furrows: Sequence[LaidFurrow],
    known: FurrowBed | None,
    before: Mapping[Line, int],
) -> list[tuple[Ints, Beside]]:
    """The vertices that each furrow displaces. before: the numbers that lines have in ``known``."""
    everywhere = np.ones(len(refined.home), dtype=bool)
    changed = _changed(refined, known.refined) if known is not None else everywhere
    return [
        _kept_and_changed(known, before[_line(furrow.furrow)], refined, changed)
        if known is not None and _line(furrow.furrow) in before
        else _within_reach(refined, layout, furrow, everywhere)
        for furrow in furrows
    ]


def _line(furrow: Furrow) -> Line:
    return furrow.controls, furrow.width, furrow.taper, len(furrow.section), furrow.swell


def _common_stages(layout: SkinLayout, laying: tuple[Line, ...], known: FurrowBed | None) -> list[BedStage]:
    """The stages of ``known`` that come before the first other furrow; at least that without any."""
    if known is None:
        unrefined = RefinedMesh.unrefined(layout.skin)
        return [BedStage(0, unrefined, np.zeros(len(unrefined.home), dtype=bool))]
    same = takewhile(lambda pair: pair[0] == pair[1], zip(known.laying, laying))
    common = sum(1 for _ in same)
    return [stage for stage in known.stages if stage.count <= common]


def _with_furrow(stage: BedStage, layout: SkinLayout, furrow: LaidFurrow, fineness: float) -> BedStage:
    """The skin with one more furrow."""
    width = furrow.furrow.width
    line = FurrowLine(furrow.line(0.5 * fineness * width), width)
    near = faces_around(stage.refined, line)
    around = refine_around(stage.refined.part(near), line, fineness, stage.refined.border(near))
    if around is None:
        # Triangles have to be split as far as the end of what was looked at, and beyond.
        near = np.ones_like(near)
        around = refine_around(stage.refined, line, fineness)
        assert around is not None
    fixed = np.concatenate([stage.fixed, np.zeros(len(around.home) - len(stage.fixed), dtype=bool)])
    for part in (0.0, fineness, -fineness):
        around, fixed = conform(around, layout, furrow, part * width, fixed)
    return BedStage(stage.count + 1, around.beside(stage.refined.part(~near)), fixed)


def _changed(refined: RefinedMesh, before: RefinedMesh) -> Mask:
    """Which vertices are elsewhere on the skin than those with the same number were, or new, (N,)."""
    count = min(len(refined.home), len(before.home))
    changed = np.ones(len(refined.home), dtype=bool)
    changed[:count] = (refined.home[:count] != before.home[:count]) | (
        refined.weights[:count] != before.weights[:count]
    ).any(axis=1)
    return changed


def _kept_and_changed(known: FurrowBed, number: int, refined: RefinedMesh, changed: Mask) -> tuple[Ints, Beside]:
    """The same for a furrow that another bed has: only where vertices have ``changed``, (N,), they are looked at again."""
    entries = slice(*np.searchsorted(known.furrow, [number, number + 1]))
    vertices, beside = known.vertex[entries], _chosen(known.beside, entries)
    kept = vertices < len(changed)
    kept[kept] = ~changed[vertices[kept]]
    others, beside_others = _within_reach(refined, known.layout, known.furrows[number], changed)
    return np.concatenate([vertices[kept], others]), _joined([_chosen(beside, kept), beside_others])


def _within_reach(refined: RefinedMesh, layout: SkinLayout, furrow: LaidFurrow, among: Mask) -> tuple[Ints, Beside]:
    """The vertices that a furrow displaces, of those ``among``, (N,), and where they lie beside it."""
    low, high = furrow.points.min(axis=0) - furrow.reach, furrow.points.max(axis=0) + furrow.reach
    boxed = among & ((refined.vertices > low) & (refined.vertices < high)).all(axis=1) & layout.mapped[refined.home]
    vertices = np.flatnonzero(boxed & (refined.weights.sum(axis=1) > 0))
    line = furrow.line(0.1 * furrow.reach)
    reach = _SLACK * (furrow.reach + 0.05 * furrow.reach)
    away, _ = cKDTree(line).query(refined.vertices[vertices], distance_upper_bound=reach)
    vertices = vertices[np.isfinite(away)]
    beside = furrow.beside(layout.uv(refined, vertices), layout.metrics(refined, vertices))
    kept = (beside.distance < furrow.reach) & (beside.fade > 0)
    return vertices[kept], _chosen(beside, kept)


def _chosen(beside: Beside, which: Mask | slice) -> Beside:
    return Beside(*(values[which] for values in vars(beside).values()))


def _joined(parts: Sequence[Beside]) -> Beside:
    if not parts:
        none = np.zeros(0)
        return Beside(none, none, none, none.astype(bool), none, np.zeros((0, 2)), np.zeros((0, 2)))
    return Beside(*(np.concatenate([getattr(part, name) for part in parts]) for name in vars(parts[0])))
