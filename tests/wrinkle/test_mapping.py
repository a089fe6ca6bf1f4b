"""A body part in texture space: one to one, its topology kept, on everything that has a border."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import trimesh

from headstudio.head.makehuman import makehuman
from headstudio.head.mannequin.build import mannequin
from headstudio.head.mesh import TriangleMesh
from headstudio.wrinkle.body_part import body_part, face_part, split_at_seams
from headstudio.wrinkle.default_furrows import default_furrows
from headstudio.wrinkle.face_chart import FaceChart
from headstudio.wrinkle.face_creases import face_layout
from headstudio.wrinkle.laid_furrow import LaidFurrow
from headstudio.wrinkle.mapping import map_face, map_head, map_to_texture
from headstudio.wrinkle.one_to_one import distortion, signed_areas, why_not_one_to_one
from headstudio.wrinkle.projection import Layout, TextureMapError, axis_is_free
from headstudio.wrinkle.texture_map import TextureMap

from .skins import box_with_hole, cap, covering_counts, cut, horseshoe, sheet, sheet_with_holes, tube

FRONT = np.array([0.0, 0.0, 1.0])

ZOO = {
    "sheet": (sheet, "planar"),
    "sheet with holes": (sheet_with_holes, "planar"),
    "dome with a bay": (horseshoe, "planar"),
    "half sphere": (lambda: cap(0.001), "planar"),
    "overhanging cap": (lambda: cap(-0.035), "planar"),
    "bumpy cap": (lambda: cap(-0.02, 0.08), "planar"),
    "open box with a window": (box_with_hole, "planar"),
    "tube seen from the side": (
        lambda: cut(tube(), tube().vertices[tube().faces][..., 2].mean(axis=1) > -0.004),
        "planar",
    ),
    "finger": (tube, "cylindrical"),
    "bent finger": (lambda: tube(bend=0.006), "cylindrical"),
    "half a finger": (lambda: cut(tube(), tube().vertices[tube().faces][..., 2].mean(axis=1) > 0), "cylindrical"),
    "long tube": (lambda: tube(length=0.3), "cylindrical"),
}


@cache
def mapped(name: str) -> TextureMap:
    make, method = ZOO[name]
    return map_to_texture(make(), method)


def assert_one_to_one(texture_map: TextureMap) -> None:
    assert (signed_areas(texture_map.corner_uv) > 0).all()
    assert covering_counts(texture_map).max() == 1
    assert texture_map.uv.min() >= 0
    assert texture_map.uv.max() < 1
    turned = texture_map.corner_uv - texture_map.uv[texture_map.mesh.faces]
    assert np.abs(turned[..., 1]).max() == 0
    assert set(np.round(turned[..., 0], 12).ravel()) <= ({0.0, 1.0} if texture_map.wrapped else {0.0})


@pytest.mark.parametrize("name", ZOO)
def test_every_mesh_is_mapped_one_to_one(name):
    assert_one_to_one(mapped(name))


@pytest.mark.parametrize("name", ["finger", "bent finger", "long tube"])
def test_a_tube_wraps_around(name):
    texture_map = mapped(name)
    assert texture_map.wrapped
    assert (texture_map.corner_uv[..., 0] >= 1).any()


def test_half_a_tube_is_cut_nowhere():
    assert not mapped("half a finger").wrapped


def test_metres_tell_how_long_the_square_is_on_the_skin():
    texture_map = mapped("sheet")
    area = signed_areas(texture_map.corner_uv).sum()
    assert area * texture_map.metres**2 == pytest.approx(0.01)
    figures = distortion(texture_map)
    assert figures.anisotropy == pytest.approx(1.0, abs=1e-6)
    assert figures.area_low == pytest.approx(1.0, abs=1e-6)


def test_relaxing_evens_out_a_projection():
    dome = cap(0.001)
    plain, relaxed = (distortion(map_to_texture(dome, "planar", relax, toward=FRONT)) for relax in (False, True))
    assert relaxed.anisotropy_high < 0.7 * plain.anisotropy_high
    assert relaxed.anisotropy < plain.anisotropy


def test_a_convex_border_stays_where_it_was_projected():
    flat = sheet()
    plain, relaxed = (map_to_texture(flat, "planar", relax, toward=FRONT) for relax in (False, True))
    border = ((flat.vertices[:, :2] < 1e-9) | (flat.vertices[:, :2] > 0.1 - 1e-9)).any(axis=1)
    assert np.abs(plain.uv - relaxed.uv)[border].max() < 1e-12


def test_the_face_and_the_whole_skin_of_a_head():
    head = mannequin()
    for lay_out, wrapped in ((map_face, False), (map_head, True)):
        part, texture_map = lay_out(head)
        assert_one_to_one(texture_map)
        assert texture_map.wrapped is wrapped
        assert np.array_equal(head.skin.vertices[part.vertices], part.mesh.vertices)
        assert np.array_equal(part.vertices[part.mesh.faces], head.skin.faces[part.faces])
        assert distortion(texture_map).anisotropy < 2.0


def test_the_face_reaches_from_the_forehead_to_the_neck_and_holds_no_ears():
    head = mannequin()
    marks = head.landmarks
    points = face_part(head).mesh.vertices
    for name in ("glabella", "nasion", "nose_tip", "chin", "mouth_left", "mouth_right", "hairline"):
        assert np.linalg.norm(points - getattr(marks, name), axis=1).min() < 0.006, name
    assert points[:, 1].min() < marks.chin[1] - 0.05
    assert np.linalg.norm(points - marks.left_tragus, axis=1).min() > 0.003


def test_its_own_coordinates():
    flat = sheet()
    own = TriangleMesh(flat.vertices, flat.faces, (flat.vertices[flat.faces] * 9)[..., :2])
    texture_map = map_to_texture(own, "uv")
    assert_one_to_one(texture_map)
    assert np.allclose(texture_map.uv, flat.vertices[:, :2] * 9)


def test_own_coordinates_that_are_cut_want_the_mesh_split():
    flat = sheet(8)
    uv = (flat.vertices[flat.faces] * 4)[..., :2]
    left = flat.vertices[flat.faces][..., 0].mean(axis=1) < 0.05
    uv[~left] += 0.3
    skin = TriangleMesh(flat.vertices, flat.faces, uv)
    with pytest.raises(TextureMapError, match="cut"):
        map_to_texture(skin, "uv")
    part = split_at_seams(skin)
    assert_one_to_one(map_to_texture(part.mesh, "uv"))
    assert np.array_equal(skin.vertices[part.vertices][part.mesh.faces], skin.vertices[skin.faces])


def test_what_cannot_be_mapped_is_said():
    ball = trimesh.creation.icosphere()
    closed = TriangleMesh(ball.vertices, ball.faces)
    with pytest.raises(TextureMapError, match="closed"):
        map_to_texture(closed, "planar")
    with pytest.raises(TextureMapError, match="axis"):
        map_to_texture(closed, "cylindrical")
    with pytest.raises(TextureMapError, match="turned over"):
        map_to_texture(cap(-0.03), "planar", relax=False, toward=FRONT)
    with pytest.raises(TextureMapError, match="inside"):
        map_to_texture(cap(0.001), "planar", toward=-FRONT)
    with pytest.raises(TextureMapError, match="no texture coordinates"):
        map_to_texture(sheet(), "uv")
    with pytest.raises(ValueError, match="planar, cylindrical, uv"):
        map_to_texture(sheet(), "spherical")
    apart = cut(sheet(), np.abs(sheet().vertices[sheet().faces][..., 0].mean(axis=1) - 0.05) > 0.02)
    with pytest.raises(TextureMapError, match="several pieces"):
        map_to_texture(apart, "planar")


def test_a_map_that_covers_itself_is_found_out():
    """A strip wound into a spiral of one and a half turns: no triangle is turned over, but it overlaps."""
    strip = sheet(30, jitter=0)
    angle, radius = 3 * np.pi * strip.vertices[:, 0] / 0.1, 0.03 + 0.01 * strip.vertices[:, 1] / 0.1
    spiral = np.stack([radius * np.sin(angle), radius * np.cos(angle)], axis=1)[:, ::1]
    faces = strip.faces if signed_areas(spiral[strip.faces]).sum() > 0 else strip.faces[:, ::-1]
    layout = Layout(spiral, np.zeros_like(faces))
    assert (signed_areas(spiral[faces]) > 0).all()
    assert why_not_one_to_one(TriangleMesh(strip.vertices, faces), layout) == "its border crosses itself"


def test_a_part_is_one_piece_without_pinched_vertices():
    flat = sheet(10, jitter=0)
    middle = flat.vertices[flat.faces].mean(axis=1)
    checkered = (middle[:, 0] < 0.05) == (middle[:, 1] < 0.05)
    part = body_part(flat, checkered)
    assert (part.mesh.vertices[:, 0].max() <= 0.05 + 1e-9) or (part.mesh.vertices[:, 0].min() >= 0.05 - 1e-9)
    with pytest.raises(ValueError, match="no triangle"):
        body_part(flat, np.zeros(len(flat.faces), dtype=bool))


def test_the_axis_keeps_within_a_neck_that_is_not_as_deep_as_most():
    """From a nape so far forward the usual way to the middle of the neck leads out through the throat."""
    head = mannequin()
    nape = head.landmarks.nape + np.array([0.0, 0.0, 0.03])
    _, texture_map = map_face(replace(head, landmarks=replace(head.landmarks, nape=nape)))
    assert_one_to_one(texture_map)


def test_an_axis_is_free_where_it_passes_no_triangle():
    ring = tube()
    middle = ring.bounds.mean(axis=0)
    assert axis_is_free(ring, middle, np.array([0.0, 1.0, 0.0]))
    assert not axis_is_free(ring, middle, np.array([1.0, 0.1, 0.03]))


def test_a_socket_with_no_eye_in_it_does_not_shrink_to_a_point_of_the_map():
    """Lengths on the skin mean something everywhere on the map, and so furrows at the eyes are as long as they are drawn."""
    blind = replace(makehuman(), parts=())
    layout = face_layout(blind)
    texture_map = layout.texture_map
    shown = signed_areas(texture_map.corner_uv) * texture_map.metres**2 / layout.part.mesh.face_areas
    assert shown.min() > 1e-3
    chart = FaceChart(blind, layout)
    laid = [chart.to_texture(furrow) for furrow in default_furrows(0.5) if furrow.region == "eye corner"]
    lengths = [LaidFurrow(furrow, layout).length for furrow in laid if furrow is not None]
    assert len(lengths) == 8
    assert max(lengths) < 0.05
