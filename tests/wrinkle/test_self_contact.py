"""Skin that faces itself: the two sides of a fold, furrows side by side in it, and parts that lie against each other."""

from __future__ import annotations

import igl
import numpy as np
import pytest

from headstudio.head.mesh import Floats, Ints
from headstudio.wrinkle.creases import Creases
from headstudio.wrinkle.furrow_bed import FurrowBed, prepare_bed
from headstudio.wrinkle.mapping import map_to_texture
from headstudio.wrinkle.skin_layout import SkinLayout

from .skins import flat_map, line_between, sheet, tube

W = 2e-3
SIZE = 0.05


def bed_with(*places: float, depth: float = 9e-3, width: float = W) -> FurrowBed:
    """A sheet of 5 cm with furrows along y at these places [m]."""
    layout = SkinLayout.of_map(flat_map(sheet(50, size=SIZE, jitter=0.1), (16.0, 16.0)))
    lines = [line_between((0.1 + 16 * x, 0.2), (0.1 + 16 * x, 0.8), depth=depth, width=width) for x in places]
    return prepare_bed(layout, lines, 0.3)


def folded(points: Floats, opening: float, round_over: float = 1.5e-3) -> Floats:
    """The sheet folded about its middle, its halves ``opening`` degrees apart, round at the bottom."""
    x = points[:, 0] - 0.5 * SIZE
    way = np.linspace(0, 0.03, 3000)
    lean = np.radians(90 - opening / 2) * np.clip(way / round_over, 0, 1)
    out, up = (np.concatenate([[0], np.cumsum(f(lean))[:-1]]) * way[1] for f in (np.cos, np.sin))
    return np.column_stack([np.sign(x) * np.interp(abs(x), way, out), points[:, 1], np.interp(abs(x), way, up)])


def passing(points: Floats, faces: Ints, other: Ints) -> int:
    """How many edges of some triangles pass through others, which share no vertex with them."""
    edges = np.unique(np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    edges = edges[~np.isin(edges, other).any(axis=1)]
    tree = igl.AABB()
    tree.init(points * 1e3, other)
    start, end = points[edges[:, 0]] * 1e3, points[edges[:, 1]] * 1e3
    _, distance, _ = tree.intersect_ray_first(points * 1e3, other, start, end - start)
    return int((distance < 1.0).sum())


def halves(bed: FurrowBed, along: int, middle: float) -> tuple[Ints, Ints]:
    """Triangles of a refined skin before and behind a place at rest."""
    faces = bed.refined.faces
    behind = bed.refined.vertices[faces][..., along].mean(axis=1) > middle
    return faces[~behind], faces[behind]


@pytest.mark.parametrize("opening", [-6.0, 0.0, 4.0])
def test_the_two_sides_of_a_fold_do_not_pass_through_each_other(opening):
    """As the skin of a finger's joint folds about a line."""
    bed = bed_with(0.5 * SIZE)
    posed = folded(bed.layout.skin.vertices, opening)
    base = Creases(bed, strength=0.0).displaced(posed).positions
    free, kept = (Creases(bed, self_contact=on).displaced(posed) for on in (False, True))
    side = np.sign(bed.refined.vertices[:, 0] - 0.5 * SIZE)
    # The bulges; where the halves of the bare skin are apart, those of the wrinkled skin stay apart.
    looked_at = (free.height > 0) & (side * base[:, 0] > 0)
    assert (side * free.positions[:, 0])[looked_at].min() < -1e-4
    assert (side * kept.positions[:, 0])[looked_at].min() > -6e-5
    assert (kept.height <= free.height).all()
    assert (kept.height[free.height <= 0] == free.height[free.height <= 0]).all()


@pytest.mark.parametrize("opening", [3.0, 40.0])
def test_deep_furrows_beside_a_fold_do_not_meet_in_it(opening):
    """The fold is nobody's own: its sides belong to different furrows, one of them farther away."""
    bed = bed_with(0.5 * SIZE - 4e-3, 0.5 * SIZE + 6e-3, depth=14e-3)
    posed = folded(bed.layout.skin.vertices, opening)
    free, kept = (Creases(bed, self_contact=on).displaced(posed) for on in (False, True))
    sides = halves(bed, 0, 0.5 * SIZE)
    if opening < 10:
        assert passing(free.positions, *sides) > 20
    assert passing(kept.positions, *sides) == 0
    side = np.sign(bed.refined.vertices[:, 0] - 0.5 * SIZE)
    bulges = free.height > 0
    assert (side * free.positions[:, 0])[bulges].min() < -1e-3
    assert (side * kept.positions[:, 0])[bulges].min() > -6e-5


def test_a_bulge_stops_half_way_to_bare_skin_that_lies_against_it():
    """As the palm against a finger: a sheet bent around into a U, a furrow on one side of it alone."""
    bed = bed_with(0.010, depth=14e-3)
    x, gap = bed.layout.skin.vertices[:, 0], 2e-3
    turn = np.pi * gap / 2
    way = np.clip(x - 0.02, 0.0, turn)
    angle = way / (gap / 2)
    posed = np.column_stack(
        [
            np.minimum(x, 0.02) + gap / 2 * np.sin(angle) - np.maximum(x - 0.02 - turn, 0.0),
            bed.layout.skin.vertices[:, 1],
            gap / 2 * (1 - np.cos(angle)),
        ]
    )
    free, kept = (Creases(bed, self_contact=on).displaced(posed) for on in (False, True))
    upper = bed.refined.vertices[:, 0] < 0.018
    assert free.positions[upper, 2].max() > 0.8 * gap
    assert kept.positions[upper, 2].max() == pytest.approx(gap / 2, abs=2e-5)


@pytest.mark.parametrize("bend", [150.0, 165.0])
def test_the_inner_side_of_a_bent_finger_does_not_pass_through_itself(bend):
    """A tube that bends over 26 mm of its length, with two deep lines on the inner side."""
    finger = tube(around=60, along=60)
    layout = SkinLayout.of_map(map_to_texture(finger, "cylindrical"))
    across = np.linspace(-0.006, 0.006, 9)
    lines = []
    for level in (0.0280, 0.0320):
        uv = _in_front(layout, across, level)
        lines.append(line_between(tuple(uv[0]), tuple(uv[-1]), depth=12e-3, width=0.8e-3))
    bed = prepare_bed(layout, lines, 0.3)
    turn = np.radians(bend) * np.clip((finger.vertices[:, 1] - 0.030) / 0.026 + 0.5, 0.0, 1.0)
    radius = 0.026 / np.radians(bend)
    straight = finger.vertices[:, 1] - np.clip(finger.vertices[:, 1], 0.017, 0.043)
    inward = finger.vertices[:, 2]
    posed = np.column_stack(
        [
            finger.vertices[:, 0],
            (radius - inward) * np.sin(turn) + straight * np.cos(turn),
            radius - (radius - inward) * np.cos(turn) + straight * np.sin(turn),
        ]
    )
    bare = Creases(bed, strength=0.0).displaced(posed).positions
    free, kept = (Creases(bed, self_contact=on).displaced(posed) for on in (False, True))
    sides = halves(bed, 1, 0.030)
    assert passing(bare, *sides) == 0
    assert passing(free.positions, *sides) > 5
    assert passing(kept.positions, *sides) == 0


def _in_front(layout: SkinLayout, x: Floats, level: float) -> Floats:
    """Texture coordinates of the vertices in front at these places across, at a level [m]."""
    skin = layout.skin
    front = np.flatnonzero(skin.vertices[:, 2] > 0)
    away = (skin.vertices[front, 0] - x[:, None]) ** 2 + (skin.vertices[front, 1] - level) ** 2
    vertex = front[away.argmin(axis=1)]
    uv = layout.texture_map.uv[vertex].copy()
    uv[:, 1] = uv[:, 1].mean()
    return uv


@pytest.mark.parametrize("opening", [180.0, 160.0])
def test_an_open_skin_knows_no_contact(opening):
    bed = bed_with(0.5 * SIZE - 4e-3, 0.5 * SIZE + 4e-3)
    posed = folded(bed.layout.skin.vertices, opening, round_over=10e-3)
    heights = [Creases(bed, self_contact=on).displaced(posed).height for on in (False, True)]
    assert np.array_equal(*heights)


def test_parts_that_come_near_and_go_again_are_found_in_any_order():
    """What is near is remembered from pose to pose, and must not depend on what was shown before."""
    bed = bed_with(0.5 * SIZE)
    poses = [folded(bed.layout.skin.vertices, opening) for opening in (0.0, 150.0, 10.0, 4.0)]
    remembering = Creases(bed)
    for posed in poses:
        assert np.array_equal(remembering.displaced(posed).height, Creases(bed).displaced(posed).height)
