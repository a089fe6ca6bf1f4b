"""Cutting: exact, through triangles, and either a disc with four sides or one clear line."""

import dataclasses
from itertools import pairwise

import numpy as np
import pytest

from headstudio.head import scalp as scalp_module
from headstudio.head.cut import cut_patch
from headstudio.head.hairline import default_curves, wreath
from headstudio.head.harmonic import map_to_square, mean_value_weights, signed_areas
from headstudio.head.head import Head, HeadError
from headstudio.head.load import load_head
from headstudio.head.locate import Locator, SurfacePoints
from headstudio.head.mesh import TriangleMesh
from headstudio.head.refine import ShadedMesh, refine_near
from headstudio.head.scalp import grow_scalp
from headstudio.head.scalp_settings import ScalpSettings

from .bumpy_heads import bumpy_head, smooth_head


def plate(count: int = 12) -> ShadedMesh:
    """A flat square of unit side in the plane z = 0, seen from +z."""
    line = np.linspace(0, 1, count + 1)
    x, y = np.meshgrid(line, line)
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    corner = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    right, up = corner + 1, corner + count + 1
    faces = np.concatenate([np.stack([corner, right, up + 1], axis=1), np.stack([corner, up + 1, up], axis=1)])
    return ShadedMesh(TriangleMesh(vertices, faces), np.tile([0.0, 0.0, 1.0], (len(vertices), 1)))


def polygon_sides(surface: ShadedMesh, corners: list[tuple[float, float]], pieces: int = 9) -> list[SurfacePoints]:
    ends = np.array([(x, y, 0.0) for x, y in corners])
    parts = np.linspace(0, 1, pieces)[:, None]
    found = Locator(surface.mesh.vertices, surface.mesh.faces)
    return [found.nearest((1 - parts) * a + parts * b)[0] for a, b in zip(ends, np.roll(ends, -1, axis=0))]


SQUARES = {
    "through triangles": [(0.21, 0.17), (0.83, 0.23), (0.77, 0.81), (0.13, 0.73)],
    "along edges and through vertices": [(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)],
    "along diagonals": [(0.5, 0.1), (0.9, 0.5), (0.5, 0.9), (0.1, 0.5)],
    "a hair beside the edges": [(0.25001, 0.25001), (0.74999, 0.25001), (0.74999, 0.74999), (0.25001, 0.74999)],
}


def area_of(corners: list[tuple[float, float]]) -> float:
    x, y = np.array(corners).T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


@pytest.mark.parametrize("corners", SQUARES.values(), ids=SQUARES)
def test_a_polygon_is_cut_out_as_it_is(corners):
    surface = plate()
    patch = cut_patch(surface, polygon_sides(surface, corners))
    assert patch.disc.mesh.face_areas.sum() == pytest.approx(area_of(corners), rel=0.02)
    assert np.all(patch.disc.mesh.face_normals[:, 2] > 0.999)
    for side, start in zip(patch.sides, corners):
        np.testing.assert_allclose(patch.disc.mesh.vertices[side[0], :2], start, atol=0.08 / 12 * 1.5)
    assert all(a[-1] == b[0] for a, b in zip(patch.sides, [*patch.sides[1:], patch.sides[0]]))


@pytest.mark.parametrize("head", [smooth_head(3), smooth_head(5), bumpy_head(2000, 9)], ids=["coarse", "fine", "bumpy"])
def test_both_sides_of_the_cut_make_up_the_whole_skin(head: Head):
    curves = grow_scalp(head, ScalpSettings()).curves
    surface = refine_near(ShadedMesh(head.skin, head.skin.vertex_normals), np.concatenate(curves), 0.008)
    found = Locator(surface.mesh.vertices, surface.mesh.faces)
    sides = [found.nearest(curve[:: max(len(curve) // 30, 1)])[0] for curve in closed(curves)]
    turned = [SurfacePoints(side.faces[::-1], side.weights[::-1]) for side in sides[::-1]]
    inside, outside = cut_patch(surface, sides), cut_patch(surface, turned)
    areas = [patch.disc.mesh.face_areas.sum() for patch in (inside, outside)]
    # Both trace the same knots, the second one backwards, where it may round a vertex on the other side.
    assert sum(areas) == pytest.approx(head.skin.face_areas.sum(), rel=2e-3)


def closed(curves):
    """Curves thinned so that each still ends where the next one starts."""
    thinned = []
    for curve in curves:
        step = max(len(curve) // 30, 1)
        thinned.append(np.concatenate([curve[:-1][::step], curve[-1:]]))
    return thinned


def test_a_corner_of_the_curve_is_a_vertex_of_both_curves():
    scalp = grow_scalp(smooth_head(4), ScalpSettings())
    for curve, following in zip(scalp.curves, [*scalp.curves[1:], scalp.curves[0]]):
        np.testing.assert_array_equal(curve[-1], following[0])
    corners = scalp.locate(np.array([curve[0] for curve in scalp.curves]))
    np.testing.assert_allclose(corners, [[0, 0], [1, 0], [1, 1], [0, 1]], atol=1e-9)


def test_refining_keeps_the_surface_closed_and_in_place():
    head = smooth_head(3)
    curve = default_curves(head)[0]
    curve = np.concatenate([np.linspace(a, b, 9) for a, b in pairwise(curve)])
    fine = refine_near(ShadedMesh(head.skin, head.skin.vertex_normals), curve, 0.006).mesh
    sides = np.sort(np.stack([fine.faces, np.roll(fine.faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges, times = np.unique(sides, axis=0, return_counts=True)
    length = np.linalg.norm(fine.vertices[edges[:, 0]] - fine.vertices[edges[:, 1]], axis=1)
    middle = fine.vertices[edges].mean(axis=1)
    near = np.linalg.norm(middle[:, None] - curve[None, ::4], axis=2).min(axis=1) < 0.006
    assert np.all(times == 2)
    assert length[near].max() <= 0.006
    assert fine.face_areas.sum() == pytest.approx(head.skin.face_areas.sum(), rel=1e-12)


def test_positive_weights_take_over_where_cotangents_turn_triangles_over():
    scalp = grow_scalp(bumpy_head(300, 15, height=0.15), ScalpSettings())
    assert "mean value" in scalp.notes[0]
    assert signed_areas(scalp.uv, scalp.patch.faces).min() > 0


def test_mean_value_weights_are_positive_even_on_caps_and_needles():
    flat = TriangleMesh(
        np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0.5, 0], [0.5, 0.5 - 1e-13, 0]]),
        np.array([[0, 1, 4], [0, 4, 2], [1, 3, 4], [3, 2, 4]]),
    )
    weights = mean_value_weights(flat)
    assert np.all(weights.data > 0)
    assert np.isfinite(weights.data).all()
    even = TriangleMesh(np.array([[0, 0, 0], [1, 0, 0], [0.5, np.sqrt(0.75), 0]]), np.array([[0, 1, 2]]))
    np.testing.assert_allclose(mean_value_weights(even).toarray()[0, 1:], np.tan(np.pi / 6), rtol=1e-12)


def test_skin_with_triangles_without_area_can_be_mapped():
    head = bumpy_head(2000, 1)
    rng = np.random.default_rng(0)
    chosen = rng.choice(len(head.skin.faces), 200, replace=False)
    a, b, c = head.skin.faces[chosen].T
    middle = len(head.skin.vertices) + np.arange(200)
    points = (head.skin.vertices[b] + head.skin.vertices[c]) / 2
    faces = np.concatenate(
        [np.delete(head.skin.faces, chosen, axis=0)]
        + [np.stack(corners, axis=1) for corners in ((a, b, middle), (b, c, middle), (c, a, middle))]
    )
    skin = TriangleMesh(np.concatenate([head.skin.vertices, points]), faces)
    scalp = grow_scalp(dataclasses.replace(head, skin=skin), ScalpSettings())
    assert signed_areas(scalp.uv, scalp.patch.faces).min() > 0


def test_a_flat_square_is_mapped_to_itself():
    surface = plate()
    patch = cut_patch(surface, polygon_sides(surface, SQUARES["along edges and through vertices"]))
    uv, method = map_to_square(patch)
    assert method == "harmonic"
    np.testing.assert_allclose(uv, (patch.disc.mesh.vertices[:, :2] - 0.25) / 0.5, atol=1e-9)


def settings_with(curves) -> ScalpSettings:
    return ScalpSettings(curves=tuple(tuple(tuple(point) for point in curve) for curve in curves))


def test_curves_that_were_dragged_are_used():
    head = smooth_head(5)
    curves = [curve.copy() for curve in default_curves(head)]
    middle = len(curves[0]) // 2
    curves[0][middle] = head.skin.vertices[np.argmin(np.linalg.norm(head.skin.vertices - [0, 0.05, 0.09], axis=1))]
    scalp = grow_scalp(head, settings_with(curves))
    nearest = np.linalg.norm(scalp.curves[0] - curves[0][middle], axis=1).min()
    assert nearest < 0.002
    assert scalp.area > grow_scalp(head, ScalpSettings()).area


@pytest.mark.parametrize(
    ("words", "spoil"),
    [
        ("bounded by four curves, got 3", lambda front, left, back, right: [front, left, back]),
        ("the left curve of the scalp starts", lambda front, left, back, right: [front, left[1:], back, right]),
        ("the front curve of the scalp leaves the skin by 4", lambda front, *rest: [front + bump(front), *rest]),
        ("coincide", lambda front, *rest: [np.repeat(front, 2, axis=0), *rest]),
        ("not points", lambda front, *rest: [front * np.nan, *rest]),
        ("cross or touch", lambda front, left, back, right: [front, over_the_temple(left), back, right]),
        ("two corners of the scalp fall together", lambda front, left, back, right: pinched(front, left, back, right)),
    ],
)
def test_curves_that_cannot_be_used_are_refused_in_one_line(words, spoil):
    head = smooth_head(4)
    with pytest.raises(HeadError, match=words) as caught:
        grow_scalp(head, settings_with(spoil(*default_curves(head))))
    assert "\n" not in str(caught.value)


def bump(curve: np.ndarray) -> np.ndarray:
    away = np.zeros_like(curve)
    away[len(curve) // 2] = [0, 0.03, 0.03]
    return away


def over_the_temple(left: np.ndarray) -> np.ndarray:
    """The left curve with a detour over the forehead, across the front curve."""
    detour = np.array([[0.05, 0.02, 0.07], [0.04, 0.06, 0.066]])
    return np.concatenate([left[:1], detour, left[1:]])


def pinched(front: np.ndarray, left: np.ndarray, back: np.ndarray, right: np.ndarray) -> list[np.ndarray]:
    """The left curve shrunk to nearly nothing."""
    end = left[0] + (left[1] - left[0]) * 1e-3
    return [front, np.stack([left[0], end]), np.concatenate([end[None], back[1:]]), right]


def test_curves_around_or_over_a_hole_are_refused():
    head = smooth_head(5)
    centres = head.skin.vertices[head.skin.faces].mean(axis=1)
    open_crown = TriangleMesh(head.skin.vertices, head.skin.faces[centres[:, 1] < 0.1])
    with pytest.raises(HeadError, match="without holes"):
        grow_scalp(dataclasses.replace(head, skin=open_crown), ScalpSettings())
    at_hairline = np.linalg.norm(centres - head.landmarks.hairline, axis=1) < 0.01
    no_forehead = TriangleMesh(head.skin.vertices, head.skin.faces[~at_hairline])
    with pytest.raises(HeadError, match=r"border|without holes"):
        grow_scalp(dataclasses.replace(head, skin=no_forehead), settings_with(default_curves(head)))


def test_a_head_without_a_persons_hairline_has_a_wreath(monkeypatch):
    """Here its curves cross, as they do on a head that is folded at the nape."""
    head = smooth_head(4)
    crossing = default_curves(head)
    monkeypatch.setattr(
        scalp_module, "default_curves", lambda head: (crossing[0], over_the_temple(crossing[1]), *crossing[2:])
    )
    scalp = grow_scalp(head, ScalpSettings())
    assert "a wreath above the ears" in scalp.notes[0]
    assert signed_areas(scalp.uv, scalp.patch.faces).min() > 0
    ears = head.landmarks.left_tragus[1]
    assert np.concatenate(scalp.curves)[:, 1].min() > ears
    assert scalp.locate(head.landmarks.crown[None]) == pytest.approx(0.5, abs=0.2)


@pytest.mark.parametrize("source", ["makehuman", "mannequin"])
def test_a_wreath_goes_on_any_head(source):
    head = load_head(source)
    curves = wreath(head)
    scalp = grow_scalp(head, settings_with(curves))
    assert signed_areas(scalp.uv, scalp.patch.faces).min() > 0
    assert 0.4 < scalp.area / grow_scalp(head, ScalpSettings()).area < 1.1


def test_landmarks_upside_down_are_refused():
    head = smooth_head(3)
    upside_down = dataclasses.replace(head.landmarks, crown=-head.landmarks.crown)
    with pytest.raises(HeadError, match="landmarks"):
        default_curves(dataclasses.replace(head, landmarks=upside_down))


def test_a_curve_led_over_an_ear_finds_its_way_around_the_fold():
    surface = plate()
    # A fin as sharp as the rim of an ear, across the way of the curve.
    vertices = surface.mesh.vertices.copy()
    fin = np.isclose(vertices[:, 0], 0.5) & (np.abs(vertices[:, 1] - 0.5) < 0.4)
    vertices[fin] += [-0.3, 0, 0.02]
    folded = ShadedMesh(TriangleMesh(vertices, surface.mesh.faces), surface.normals)
    corners = SQUARES["through triangles"]
    patch = cut_patch(folded, polygon_sides(folded, corners))
    for side, start, end in zip(patch.sides, corners, np.roll(corners, -1, axis=0)):
        line = patch.disc.mesh.vertices[side]
        np.testing.assert_allclose(line[[0, -1], :2], [start, end], atol=0.01)
        # Across the fin the way goes out and back by its depth; it does not wander.
        assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() < np.linalg.norm(np.subtract(end, start)) + 3 * 0.3
