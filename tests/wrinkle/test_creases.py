"""Displaced skin: the measured profile, its volume, crossings, poses, and the two sides of a fold."""

from dataclasses import replace

import igl
import numpy as np
import pytest

from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.creases import Creases
from headstudio.wrinkle.furrow import Furrow
from headstudio.wrinkle.furrow_bed import prepare_bed
from headstudio.wrinkle.mapping import map_to_texture
from headstudio.wrinkle.shape import amplitude, wrinkle_shape
from headstudio.wrinkle.skin_layout import SkinLayout

from .skins import cap, flat_map, line_between, sheet, volume_between

D, W = 1.5e-3, 2e-3


def furrow_on_sheet(stretch, angle, cells=30, **values):
    """A sheet mapped with different scales in u and v, and a furrow of 6 cm through its middle at an angle on the skin."""
    flat = sheet(cells)
    layout = SkinLayout.of_map(flat_map(flat, stretch))
    half = 0.03 * np.array([np.cos(angle), np.sin(angle)])
    start, end = (0.1 + (0.05 + sign * half) * stretch for sign in (-1, 1))
    furrow = replace(line_between(tuple(start), tuple(end), depth=D, width=W), **values)
    return flat, prepare_bed(layout, [furrow], 0.25)


def profile_at(mesh: TriangleMesh, points: np.ndarray) -> np.ndarray:
    """Height of a displaced plane, looked up by rays from above."""
    starts = np.column_stack([points, np.full(len(points), 1.0)])
    hits = igl.AABB()
    hits.init(mesh.vertices * 1e3, mesh.faces)
    down = np.tile([0.0, 0.0, -1.0], (len(points), 1))
    _, distance, _ = hits.intersect_ray_first(mesh.vertices * 1e3, mesh.faces, starts * 1e3, down)
    return 1.0 - distance / 1e3


@pytest.mark.parametrize("stretch", [(8.0, 8.0), (8.0, 3.5)])
@pytest.mark.parametrize("angle", [0.0, 0.5, 1.3])
def test_the_measured_profile_is_the_shape_function(stretch, angle):
    """On the surface between vertices, too, in true millimetres however the map stretches."""
    flat, bed = furrow_on_sheet(np.array(stretch), angle)
    creases = Creases(bed)
    wrinkled = creases.displaced(flat.vertices)
    mesh = TriangleMesh(wrinkled.positions, creases.faces)
    l = np.linspace(-7 * W, 7 * W, 141)  # noqa: E741
    for along in (-0.008, 0.0, 0.007):
        direction, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        points = 0.05 + along * direction + l[:, None] * across
        error = profile_at(mesh, points) - wrinkle_shape(np.abs(l), D, W)
        assert np.abs(error).max() < 0.02 * D


@pytest.mark.parametrize("fineness", [0.2, 0.3, 0.45])
def test_no_volume_is_gained_or_lost_on_a_plane(fineness):
    flat = sheet(20)
    layout = SkinLayout.of_map(flat_map(flat))
    curve = Furrow(controls=((0.3, 0.4), (0.45, 0.6), (0.6, 0.35), (0.7, 0.5)), depth=D, width=W, initial=0.3)
    bed = prepare_bed(layout, [curve], fineness)
    creases = Creases(bed)
    wrinkled = creases.displaced(flat.vertices)
    before = np.column_stack([wrinkled.positions[:, :2], np.zeros(len(wrinkled.positions))])
    gained = volume_between(creases.faces, before, wrinkled.positions)
    furrow = 2 * 0.3 * D * W / np.e * bed.furrows[0].length
    assert abs(gained) < 0.002 * furrow


@pytest.mark.parametrize("initial", [0.3, 1.0])
def test_no_volume_is_gained_or_lost_on_curved_skin(initial):
    ball = cap(0.0)
    layout = SkinLayout.of_map(map_to_texture(ball, "planar"))
    curve = Furrow(controls=((0.35, 0.45), (0.45, 0.6), (0.55, 0.4), (0.65, 0.55)), depth=D, width=W, initial=initial)
    bed = prepare_bed(layout, [curve], 0.25)
    creases, flat = Creases(bed), Creases(bed, strength=0.0)
    wrinkled, smooth = creases.displaced(ball.vertices), flat.displaced(ball.vertices)
    gained = volume_between(creases.faces, smooth.positions, wrinkled.positions)
    furrow = 2 * initial * D * W / np.e * bed.furrows[0].length
    assert abs(gained) < 0.01 * furrow


def test_the_ends_fade_smoothly():
    flat, bed = furrow_on_sheet(np.array([8.0, 8.0]), 0.0)
    creases = Creases(bed)
    wrinkled = creases.displaced(flat.vertices)
    mesh = TriangleMesh(wrinkled.positions, creases.faces)
    x = np.linspace(-0.035, 0.035, 300)
    floor = profile_at(mesh, np.column_stack([0.05 + x, np.full(300, 0.05 + 1e-7)]))
    assert floor.min() == pytest.approx(-D, rel=1e-3)
    assert np.abs(floor[np.abs(x) > 0.0305]).max() < 1e-3 * D
    assert np.abs(np.diff(floor)).max() < 0.06 * D


@pytest.mark.parametrize("angle", [np.pi / 2, 0.6, 0.15])
def test_furrows_that_cross_are_not_twice_as_deep(angle):
    flat = sheet(24)
    half = 0.2 * np.array([np.cos(angle), np.sin(angle)])
    furrows = [
        line_between((0.3, 0.5), (0.7, 0.5), depth=D, width=W),
        line_between(tuple(0.5 - half), tuple(0.5 + half), depth=D, width=W),
    ]
    creases = Creases(prepare_bed(SkinLayout.of_map(flat_map(flat)), furrows))
    height = creases.displaced(flat.vertices).height
    assert -1.13 * D < height.min() < -D
    assert height.max() < 0.4 * D


@pytest.mark.parametrize("adds", [(True, True), (True, False)])
def test_furrows_that_add_up_are_as_deep_as_both_where_they_cross(adds):
    flat = sheet(24)
    ends = [((0.3, 0.5), (0.7, 0.5)), ((0.5, 0.3), (0.5, 0.7))]
    lines = [replace(line_between(*end, depth=D, width=W), adds=add) for end, add in zip(ends, adds)]
    bed = prepare_bed(SkinLayout.of_map(flat_map(flat)), lines)
    both = Creases(bed).displaced(flat.vertices).height
    single = [
        Creases(bed, [replace(line, depth=D * (k == n)) for n, line in enumerate(lines)]).displaced(flat.vertices)
        for k in (0, 1)
    ]
    assert np.allclose(both, sum(one.height for one in single), atol=1e-12)
    assert both.min() < -1.8 * D


def test_furrows_far_apart_do_not_know_each_other():
    flat = sheet(24)
    layout = SkinLayout.of_map(flat_map(flat))
    lines = [line_between((0.3, v), (0.7, v), depth=D, width=1e-3) for v in (0.3, 0.7)]
    bed = prepare_bed(layout, lines)
    both = Creases(bed).displaced(flat.vertices).height
    single = [
        Creases(bed, [replace(lines[0], depth=D * (k == 0)), replace(lines[1], depth=D * (k == 1))]) for k in (0, 1)
    ]
    assert np.allclose(both, sum(one.displaced(flat.vertices).height for one in single), atol=1e-12)


@pytest.mark.parametrize("initial", [0.0, 0.25])
def test_a_pose_deepens_what_it_shrinks_across(initial):
    """Figure 2.17 on displaced skin: squeezed along x, the upright furrow deepens as (2.4) says; the level one stays."""
    flat = sheet(24)
    layout = SkinLayout.of_map(flat_map(flat))
    furrows = [
        line_between((0.35, 0.3), (0.35, 0.75), depth=D, width=1e-3, initial=initial),
        line_between((0.5, 0.6), (0.85, 0.6), depth=D, width=1e-3, initial=initial),
    ]
    bed = prepare_bed(layout, furrows)
    creases = Creases(bed)
    squeezed = creases.displaced(flat.vertices * [0.7, 1.0, 1.0])
    deepest = [-squeezed.height[bed.vertex[bed.furrow == k]].min() for k in (0, 1)]
    wanted = D * amplitude(np.array([0.3, 0.0]), initial)
    assert np.allclose(deepest, wanted, atol=1e-9)
    assert np.allclose(squeezed.shrinkage[bed.furrow == 0], 0.3)
    assert np.abs(squeezed.shrinkage[bed.furrow == 1]).max() < 1e-12


def test_normals_belong_to_the_displaced_surface():
    flat, bed = furrow_on_sheet(np.array([8.0, 5.0]), 0.4, depth=0.4e-3)
    creases = Creases(bed)
    rng = np.random.default_rng(0)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    wrinkled = creases.displaced(flat.vertices * [0.9, 1.05, 1.0] @ turn.T)
    assert np.allclose(np.linalg.norm(wrinkled.normals, axis=1), 1)
    own = igl.per_vertex_normals(wrinkled.positions, creases.faces, igl.PER_VERTEX_NORMALS_WEIGHTING_TYPE_ANGLE)
    walls = bed.vertex[(bed.beside.distance > 0.6 * W) & (bed.beside.distance < 6 * W)]
    tilt = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", own, wrinkled.normals)[walls], -1, 1)))
    assert np.percentile(tilt, 95) < 2.5
    steepest = np.degrees(np.arccos(np.clip(wrinkled.normals @ turn[:, 2], -1, 1))).max()
    assert steepest > 5


def test_outside_the_furrows_nothing_moves():
    flat, bed = furrow_on_sheet(np.array([8.0, 8.0]), 0.7)
    posed = flat.vertices * [1.0, 0.9, 1.0] + [0, 0, 0.01]
    wrinkled = Creases(bed).displaced(posed)
    far = np.setdiff1d(np.arange(len(posed)), np.union1d(bed.vertex, bed.refined.added))
    assert len(far) > 100
    assert np.array_equal(wrinkled.positions[far], posed[far])
    assert (wrinkled.height[far] == 0).all()


def test_depths_change_without_preparing_the_skin_again():
    flat, bed = furrow_on_sheet(np.array([8.0, 8.0]), 0.3)
    deeper = replace(bed.furrows[0].furrow, depth=2 * D)
    assert Creases(bed, [deeper]).displaced(flat.vertices).height.min() == pytest.approx(-2 * D)
    assert Creases(bed, strength=0.5).displaced(flat.vertices).height.min() == pytest.approx(-D / 2)
    with pytest.raises(ValueError, match="prepared for 1"):
        Creases(bed, [])
