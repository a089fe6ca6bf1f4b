"""Is a map to texture space one to one, and how much does it distort?

A map of a connected surface with a border covers every point of the plane as often as its border winds around that
point, when no triangle is turned over. So it is one to one when every triangle is positive, no two pieces of the border
cross, and the border is one outline with holes in it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..head.mesh import Floats, Ints, TriangleMesh
from ..head.repair import face_components
from .metric import face_metrics
from .projection import Layout, border_cycles, loop_steps
from .texture_map import TextureMap


@dataclass(frozen=True)
class Distortion:
    """How a map distorts, over triangles weighted by area.

    area_low, area_high: the 5th and 95th percentile of area in the square per area of skin, over their mean.
    anisotropy, anisotropy_high: mean and 95th percentile of the longer over the shorter stretch (1: angles are kept).
    """

    area_low: float
    area_high: float
    anisotropy: float
    anisotropy_high: float

    def __str__(self) -> str:
        return (
            f"area {self.area_low:.2f} to {self.area_high:.2f} of the mean (5 % to 95 %), "
            f"stretch {self.anisotropy:.2f}, 95 % under {self.anisotropy_high:.2f}"
        )


def signed_areas(corners: Floats) -> Floats:
    """Area of plane triangles, (m, 3, 2), negative where they are turned over, (m,)."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def why_not_one_to_one(mesh: TriangleMesh, layout: Layout) -> str | None:
    """What keeps a layout from being one to one and topology preserving, for the user; None when nothing does."""
    areas = signed_areas(layout.corners(mesh.faces))
    if not np.isfinite(areas).all():
        return "it has no finite coordinates"
    turned = int((areas <= 0).sum())
    if turned:
        return f"{turned:,} of {len(areas):,} triangles are turned over"
    cycles = border_cycles(mesh.faces)
    if _crossings(layout, cycles):
        return "its border crosses itself"
    piece = face_components(mesh.faces)
    for k in range(piece.max() + 1):
        own = np.zeros(len(mesh.vertices), dtype=bool)
        own[mesh.faces[piece == k]] = True
        mine = [cycle for cycle in cycles if own[cycle[0]]]
        if not layout.period and sum(_area(layout.places[cycle]) > 0 for cycle in mine) != 1:
            return "it covers a part of the plane more than once"
        others = [cycle for cycle in cycles if not own[cycle[0]]]
        point = layout.places[mesh.faces[piece == k][0, 0]]
        if round(sum(_winding_about(layout.places[cycle] - point) for cycle in others)):
            return "two pieces of it lie on top of each other"
    return None


def distortion(texture_map: TextureMap) -> Distortion:
    """Distortion figures of a map."""
    mesh = texture_map.mesh
    shares = mesh.face_areas / mesh.face_areas.sum()
    metric = face_metrics(mesh, texture_map.corner_uv)
    trace, determinant = metric[:, 0, 0] + metric[:, 1, 1], np.linalg.det(metric)
    root = np.sqrt(np.maximum(trace**2 / 4 - determinant, 0.0))
    stretch = np.sqrt((trace / 2 + root) / np.maximum(trace / 2 - root, np.finfo(float).tiny))
    area = 1.0 / np.sqrt(determinant)
    area /= shares @ area
    low, high = _percentiles(area, shares, [0.05, 0.95])
    return Distortion(low, high, float(shares @ np.minimum(stretch, 1e3)), _percentiles(stretch, shares, [0.95])[0])


def _percentiles(values: Floats, shares: Floats, at: list[float]) -> list[float]:
    order = np.argsort(values)
    return [float(v) for v in values[order][np.searchsorted(np.cumsum(shares[order]), at).clip(max=len(values) - 1)]]


def _area(outline: Floats) -> float:
    after = np.roll(outline, -1, axis=0)
    return 0.5 * float((outline[:, 0] * after[:, 1] - after[:, 0] * outline[:, 1]).sum())


def _winding_about(outline: Floats) -> float:
    """How often an outline winds around the origin."""
    after = np.roll(outline, -1, axis=0)
    cross = outline[:, 0] * after[:, 1] - outline[:, 1] * after[:, 0]
    return float(np.arctan2(cross, np.einsum("ij,ij->i", outline, after)).sum() / (2 * np.pi))


def _crossings(layout: Layout, cycles: list[Ints]) -> int:
    """How many pairs of border pieces cross or touch where they do not share a vertex."""
    start = np.concatenate([layout.places[cycle] for cycle in cycles])
    step = np.concatenate([loop_steps(layout, cycle) for cycle in cycles])
    ends = np.concatenate([np.stack([cycle, np.roll(cycle, -1)], axis=1) for cycle in cycles])
    if layout.period:
        shift = np.array([[-layout.period, 0.0], [0.0, 0.0], [layout.period, 0.0]])
        start = (start + shift[:, None]).reshape(-1, 2)
        step, ends = np.tile(step, (3, 1)), np.tile(ends, (3, 1))
    # Long pieces are few: pairs come from a tree of the middles, with the longest piece as reach.
    reach = np.linalg.norm(step, axis=1).max()
    pairs = cKDTree(start + step / 2).query_pairs(reach, output_type="ndarray")
    joined = (ends[pairs[:, 0]][:, :, None] == ends[pairs[:, 1]][:, None, :]).any(axis=(1, 2))
    a, b = pairs[~joined].T
    return int(
        (_opposite(start[a], step[a], start[b], step[b]) & _opposite(start[b], step[b], start[a], step[a])).sum()
    )


def _opposite(start: Floats, step: Floats, other: Floats, other_step: Floats) -> np.ndarray:
    """Whether the ends of the other piece lie on different sides of the line through this one."""

    def side(points: Floats) -> Floats:
        return step[:, 0] * (points[:, 1] - start[:, 1]) - step[:, 1] * (points[:, 0] - start[:, 0])

    return side(other) * side(other + other_step) <= 0
