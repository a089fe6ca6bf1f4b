"""Finer skin around furrows: no crack, no T-junction, no flat needle, only where needed, on the same surface."""

from functools import cache

import igl
import numpy as np
import pytest
from scipy.spatial import KDTree, cKDTree

from headstudio.head.locate import Locator
from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.creases import Creases
from headstudio.wrinkle.furrow import Furrow
from headstudio.wrinkle.furrow_bed import FurrowBed, prepare_bed
from headstudio.wrinkle.mapping import map_to_texture
from headstudio.wrinkle.skin_layout import SkinLayout

from .skins import cap, flat_map, line_between, sheet, tube

CURVED = Furrow(controls=((0.3, 0.35), (0.45, 0.7), (0.6, 0.25), (0.75, 0.6)), depth=1e-3, width=1.5e-3, initial=1.0)
CROSSING = Furrow(controls=((0.3, 0.6), (0.4, 0.5), (0.6, 0.5), (0.7, 0.3)), depth=1e-3, width=1.5e-3, initial=1.0)


@cache
def bed_on(name: str) -> FurrowBed:
    if name == "sheet":
        return prepare_bed(SkinLayout.of_map(flat_map(sheet(12))), [CURVED, CROSSING])
    mesh, method = (cap(0.0, 0.04), "planar") if name == "cap" else (tube(radius=0.012), "cylindrical")
    return prepare_bed(SkinLayout.of_map(map_to_texture(mesh, method)), [CURVED, CROSSING])


SKINS = ["sheet", "cap", "finger"]


@pytest.mark.parametrize("name", SKINS)
def test_triangles_meet_edge_to_edge(name):
    bed = bed_on(name)
    refined, coarse = bed.refined, bed.layout.skin
    assert len(refined.faces) > len(coarse.faces)
    assert igl.is_edge_manifold(refined.faces)
    before, after = (sum(map(len, igl.boundary_loop_all(mesh.faces))) for mesh in (coarse, refined))
    # A T-junction would be an inner border; the border itself keeps its vertices and may get more.
    loops = [len(igl.boundary_loop_all(mesh.faces)) for mesh in (coarse, refined)]
    assert loops[0] == loops[1]
    assert after >= before
    area = TriangleMesh(refined.vertices, refined.faces).face_areas
    assert area.min() > 0
    assert area.sum() == pytest.approx(coarse.face_areas.sum(), rel=2e-3)


@pytest.mark.parametrize("name", SKINS)
def test_new_vertices_lie_on_the_old_surface(name):
    refined = bed_on(name).refined
    _, distance = Locator(refined.coarse.vertices, refined.coarse.faces).nearest(refined.vertices)
    assert distance.max() < 1e-12
    count = len(refined.coarse.vertices)
    posed = refined.coarse.vertices @ np.array([[1.0, 0.2, 0.0], [0.0, 0.8, 0.1], [0.3, 0.0, 1.1]])
    carried = refined.interpolation(np.arange(len(refined.home))) @ posed
    assert np.allclose(carried, refined.vertices @ np.array([[1.0, 0.2, 0.0], [0.0, 0.8, 0.1], [0.3, 0.0, 1.1]]))
    kept = np.setdiff1d(np.arange(count), refined.added)
    assert np.array_equal(refined.vertices[kept], refined.coarse.vertices[kept])


@pytest.mark.parametrize("name", SKINS)
def test_triangles_are_small_at_the_floor_and_left_alone_far_away(name):
    bed = bed_on(name)
    refined = bed.refined
    edges = refined.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    middle = refined.vertices[edges].mean(axis=1)
    along = refined.vertices[edges[:, 1]] - refined.vertices[edges[:, 0]]
    length = np.linalg.norm(along, axis=1)
    line = np.concatenate([laid.line(1e-4) for laid in bed.furrows])
    direction = np.concatenate([np.gradient(laid.line(1e-4), axis=0) for laid in bed.furrows])
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    distance, nearest = cKDTree(line).query(middle)
    across = np.linalg.norm(
        along - (along * direction[nearest]).sum(axis=1, keepdims=True) * direction[nearest], axis=1
    )
    # Cutting along the floor moves a corner by less than half an edge.
    assert across[distance < 0.3 * CURVED.width].max() < 1.6 * 0.25 * CURVED.width
    assert length[distance < 0.3 * CURVED.width].max() < 2.5 * 1.6 * 0.25 * CURVED.width
    untouched = np.isin(refined.faces, np.arange(len(refined.coarse.vertices))).all(axis=1)
    assert length.reshape(-1, 3)[untouched].max() > 2 * length[distance < 0.3 * CURVED.width].max()
    assert length[distance > 8 * CURVED.width].mean() > 0.8 * np.sqrt(refined.coarse.face_areas.mean())


@pytest.mark.parametrize("name", SKINS)
def test_angles_stay_open(name):
    refined, coarse = bed_on(name).refined, bed_on(name).layout.skin
    angles = igl.internal_angles(refined.vertices, refined.faces)
    smallest_before = igl.internal_angles(coarse.vertices, coarse.faces).min()
    assert np.percentile(angles.min(axis=1), 1) > min(np.radians(12), 0.5 * smallest_before)
    assert angles.min() > np.radians(1)


@pytest.mark.parametrize("name", SKINS)
def test_edges_run_along_the_floor(name):
    """Where a furrow is at full depth its floor is a chain of edges: no edge crosses it."""
    bed = bed_on(name)
    for k in range(len(bed.furrows)):
        own = bed.furrow == k
        signed = np.full(len(bed.refined.home), np.nan)
        full = own & (bed.beside.fade > 0.3) & bed.beside.inside
        signed[bed.vertex[full]] = (bed.beside.side * bed.beside.distance)[full]
        edges = np.unique(np.sort(bed.refined.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
        a, b = signed[edges].T
        length = np.linalg.norm(np.diff(bed.refined.vertices[edges], axis=1)[:, 0], axis=1)
        floor = 0.03 * CURVED.width
        crossing = (a * b < 0) & (np.minimum(abs(a), abs(b)) > floor) & (abs(a) + abs(b) < 1.5 * length)
        near = (abs(a) < floor) & (abs(b) < floor)
        assert near.sum() > 20
        assert crossing.sum() <= 0.06 * near.sum()


def test_a_furrow_across_the_seam_of_a_tube():
    """It is refined and measured as if there were no seam."""
    mesh = tube(radius=0.012)
    layout = SkinLayout.of_map(map_to_texture(mesh, "cylindrical"))
    height = float(np.median(layout.texture_map.uv[:, 1]))
    across, plain = (
        prepare_bed(layout, [line_between((u, height), (u + 0.2, height), width=1e-3)]) for u in (0.9, 0.4)
    )
    assert across.furrows[0].length == pytest.approx(plain.furrows[0].length, rel=0.02)
    assert len(across.vertex) == pytest.approx(len(plain.vertex), rel=0.1)
    assert across.beside.distance.min() < 1e-9


def test_a_skin_without_furrows_is_left_as_it_is():
    bed = prepare_bed(SkinLayout.of_map(flat_map(sheet(6))), [])
    assert np.array_equal(bed.refined.faces, bed.layout.skin.faces)
    assert len(bed.vertex) == 0


BESIDE = Furrow(controls=((0.3, 0.45), (0.4, 0.5), (0.55, 0.35), (0.7, 0.45)), width=1.2e-3)


def same_bed(one: FurrowBed, other: FurrowBed) -> bool:
    entries = [np.lexsort((bed.vertex, bed.furrow)) for bed in (one, other)]
    same = [
        np.array_equal(one.refined.faces, other.refined.faces),
        np.allclose(one.refined.weights, other.refined.weights),
    ]
    same += [np.array_equal(getattr(one, k)[entries[0]], getattr(other, k)[entries[1]]) for k in ("vertex", "furrow")]
    return all(same) and np.allclose(one.beside.distance[entries[0]], other.beside.distance[entries[1]])


@pytest.mark.parametrize("name", ["sheet", "finger"])
def test_one_furrow_more_gives_the_bed_that_all_at_once_give(name):
    before = bed_on(name)
    whole = prepare_bed(before.layout, [CURVED, CROSSING, BESIDE])
    laid = []
    grown = prepare_bed(before.layout, [CURVED, CROSSING, BESIDE], known=before, tick=lambda: laid.append(1))
    assert len(laid) == 1
    assert same_bed(grown, whole)
    # And back: what comes before the first other furrow is kept.
    assert same_bed(prepare_bed(before.layout, [CURVED, CROSSING], known=grown), before)


def test_a_furrow_that_is_moved_or_taken_away_leaves_finer_triangles_until_the_bed_is_settled():
    before = bed_on("sheet")
    moved = prepare_bed(before.layout, [BESIDE, CROSSING], known=before, settled=False)
    fresh = prepare_bed(before.layout, [BESIDE, CROSSING])
    assert not moved.settled
    assert igl.is_edge_manifold(moved.refined.faces)
    # The same furrows displace the same skin, whatever the triangles: compared where both have a vertex.
    heights = [Creases(bed).displaced(before.layout.skin.vertices) for bed in (moved, fresh)]
    places = [KDTree(skin.positions[:, :2]) for skin in heights]
    near, at = places[1].query(places[0].data, distance_upper_bound=1e-6)
    both = np.isfinite(near)
    assert both.sum() > 500
    assert np.allclose(heights[0].height[both], heights[1].height[at[both]], atol=2e-5)
    settled = prepare_bed(before.layout, [BESIDE, CROSSING], known=moved)
    assert settled.settled
    assert same_bed(settled, fresh)
