"""Heads from files: what is accepted, what is made of it, and what is said."""

import dataclasses
import re

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from headstudio.head.head import Head, HeadError
from headstudio.head.inspection import inspect_head
from headstudio.head.load import load_head
from headstudio.head.locate import locator
from headstudio.head.makehuman_data import data_folder, read_base_mesh
from headstudio.head.mannequin import mannequin
from headstudio.head.mesh import TriangleMesh
from headstudio.head.parts import joined
from headstudio.head.read import FORMATS
from headstudio.head.repair import border_loops, non_manifold_edge_count

from .zoo import (
    bare,
    cube,
    egg,
    human,
    is_coherent,
    mesh_of,
    moved,
    neckless,
    open_cap,
    plane,
    sphere,
    torn,
    with_parts,
    write,
)

Z_UP = Rotation.from_euler("x", 90, degrees=True)


def assert_lies_like_the_human(head: Head) -> None:
    exact = human().landmarks
    for field in dataclasses.fields(exact):
        apart = np.linalg.norm(getattr(head.landmarks, field.name) - getattr(exact, field.name))
        assert apart < 0.02, field.name


@pytest.fixture(scope="module")
def human_file(tmp_path_factory):
    """MakeHuman's bust with all its parts, in millimetres, Z up, facing -Y, far from the origin."""
    folder = tmp_path_factory.mktemp("human")
    return write(moved(with_parts(human()), Z_UP, 1000, (500, 300, -200)), folder / "human.obj")


@pytest.fixture(scope="module")
def human_from_file(human_file):
    return load_head(human_file)


def test_head_from_file_stands_in_the_head_frame(human_from_file):
    assert_lies_like_the_human(human_from_file)
    assert "axes guessed: +Z is up, the face looks along -Y" in human_from_file.notes
    assert any(note.startswith("unit guessed: millimetres") for note in human_from_file.notes)


def test_parts_are_split_off_the_skin(human_from_file):
    kinds = [part.kind for part in human_from_file.parts]
    assert sorted(kinds) == ["eye", "eye", "lashes", "teeth", "tongue"]
    assert len(human_from_file.skin.faces) == pytest.approx(len(human().skin.faces), rel=0.02)


def test_eyes_are_balls_with_an_axis(human_from_file):
    for found, exact in zip(human_from_file.parts[:2], human().parts[:2]):
        assert found.kind == exact.kind == "eye"
        assert np.linalg.norm(found.centre - exact.centre) < 0.015
        assert found.radius == pytest.approx(exact.radius, rel=0.01)
        np.testing.assert_array_equal(found.axis, [0, 0, 1])
        np.testing.assert_allclose(np.linalg.norm(found.mesh.vertices - found.centre, axis=1), found.radius, rtol=0.01)


@pytest.mark.parametrize("ending", FORMATS)
def test_every_format_gives_the_same_head(tmp_path, ending):
    head = load_head(write(neckless(human()), tmp_path / f"head{ending.upper()}"))
    assert head.name == "head"
    assert_lies_like_the_human(head)
    assert len(border_loops(head.skin.faces)) == 1
    assert is_coherent(head.skin.faces)


def test_eyes_of_a_file_of_their_own_come_to_the_head(tmp_path):
    skin = write(bare(human().skin), tmp_path / "skin.obj")
    eyes = [part for part in human().parts if part.kind == "eye"]
    both = write(joined([bare(part.mesh) for part in eyes]), tmp_path / "eyes.obj")
    assert not any(part.kind == "eye" for part in load_head(skin).parts)
    head = load_head(skin, eyes=both)
    found = sorted((part.centre for part in head.parts if part.kind == "eye"), key=lambda centre: centre[0])
    expected = sorted((part.centre for part in eyes), key=lambda centre: centre[0])
    np.testing.assert_allclose(found[1] - found[0], expected[1] - expected[0], atol=5e-4)


def test_texture_coordinates_survive(tmp_path):
    skin = human().skin
    apart = torn(bare(skin))
    corners = trimesh.Trimesh(apart.vertices, apart.faces, process=False)
    corners.visual = trimesh.visual.TextureVisuals(uv=skin.corner_uv.reshape(-1, 2))
    corners.export(tmp_path / "textured.obj")
    head = load_head(str(tmp_path / "textured.obj"))
    assert head.skin.corner_uv.shape == (len(head.skin.faces), 3, 2)
    assert len(border_loops(head.skin.faces)) == 1
    a, b = skin.corner_uv[:, 1] - skin.corner_uv[:, 0], skin.corner_uv[:, 2] - skin.corner_uv[:, 0]
    whole = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
    c, d = head.skin.corner_uv[:, 1] - head.skin.corner_uv[:, 0], head.skin.corner_uv[:, 2] - head.skin.corner_uv[:, 0]
    assert np.abs(c[:, 0] * d[:, 1] - c[:, 1] * d[:, 0]).sum() == pytest.approx(whole, rel=0.05)


def test_whole_body_is_cut_to_a_bust(tmp_path):
    base = read_base_mesh(data_folder())
    body, _ = base.quads("body", base.vertices).selected()
    head = load_head(write(body.triangulated(), tmp_path / "body.ply"))
    assert any(note.startswith("unit guessed: decimetres") for note in head.notes)
    assert any(note.startswith("body cut below the shoulders") for note in head.notes)
    loops = border_loops(head.skin.faces)
    # The border lies on one smooth trough: its level is a parabola of the sideways distance.
    x, y, _ = head.skin.vertices[np.concatenate(loops)].T
    line = np.polynomial.Polynomial.fit(x**2, y, 1)
    np.testing.assert_allclose(line(x**2), y, atol=1e-4)
    assert 0.3 < np.ptp(head.skin.vertices[:, 0]) < 0.55


def test_clothes_crumbs_and_a_separate_body_are_sorted_out(tmp_path):
    person = human()
    head_only = neckless(person)
    shirt = mesh_of(trimesh.creation.cylinder(0.25, 0.3, sections=48).subdivide())
    shirt = moved(shirt, Rotation.from_euler("x", 90, degrees=True), shift=(0, -0.3, -0.02))
    crumbs = [sphere(0.0002, (0.1, 0.01 * k, 0.3), 0) for k in range(5)]
    head = load_head(write(joined([shirt, head_only, *crumbs]), tmp_path / "dressed.glb"))
    assert_lies_like_the_human(head)
    assert "5 tiny loose pieces dropped" in head.notes
    assert [part.kind for part in head.parts] == ["teeth", "teeth", "tongue"], "made by this program"
    assert head.skin.vertices[:, 1].min() < head_only.vertices[:, 1].min() - 0.02


def test_inner_shells_of_eyes_are_dropped(tmp_path):
    eyes = [part for part in human().parts if part.kind == "eye"]
    iris = [sphere(0.8 * eye.radius, eye.centre, 2) for eye in eyes]
    mesh = joined([neckless(human()), *(bare(eye.mesh) for eye in eyes), *iris])
    head = load_head(write(mesh, tmp_path / "eyes.ply"))
    assert [part.kind for part in head.parts if part.kind not in ("teeth", "tongue")] == ["eye", "eye"]
    assert "2 inner shells of the eyes dropped" in head.notes


def test_flipped_torn_and_doubled_faces_do_not_matter(tmp_path):
    skin = neckless(human())
    random = np.random.default_rng(5)
    faces = np.where(random.random(len(skin.faces))[:, None] < 0.3, skin.faces[:, ::-1], skin.faces)
    faces = np.concatenate([faces, faces[:50], faces[:7, [0, 0, 1]]])
    head = load_head(
        write(
            TriangleMesh(skin.vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)),
            tmp_path / "bad.stl",
        )
    )
    assert_lies_like_the_human(head)
    assert len(head.skin.faces) == len(skin.faces)
    assert non_manifold_edge_count(head.skin.faces) == 0
    assert {"50 duplicate faces dropped", "7 degenerate faces dropped"} <= set(head.notes)


def test_head_of_unknown_unit_becomes_life_size(tmp_path):
    head = load_head(write(moved(neckless(human()), scale=2.4), tmp_path / "unit.off"))
    assert (head.landmarks.crown - head.landmarks.chin)[1] == pytest.approx(0.21, rel=0.05)
    assert any(note.startswith("unit unknown") for note in head.notes)


def test_names_lead_to_the_built_in_heads():
    assert load_head("makehuman", age=0.1).name == "makehuman"
    assert load_head("mannequin").name == "mannequin"


@pytest.mark.parametrize("shape", [sphere, cube, plane, egg, open_cap])
def test_shapes_that_are_no_head(tmp_path, shape):
    assert_refused(write(shape(), tmp_path / "shape.ply"), "does not look like a human head")


def test_too_few_triangles(tmp_path):
    assert_refused(write(mesh_of(trimesh.creation.box()), tmp_path / "box.stl"), "12 usable triangles")


def test_missing_file(tmp_path):
    assert_refused(str(tmp_path / "nobody.obj"), "there is no file")


@pytest.mark.parametrize("source", ["", "head.fbx", "head", "somebody", "head.obj.zip"])
def test_other_endings(source):
    assert_refused(source, "OBJ, PLY, STL, OFF, GLB")


def test_folder_is_no_file(tmp_path):
    (tmp_path / "folder.obj").mkdir()
    assert_refused(str(tmp_path / "folder.obj"), "is no file")


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("content", [b"", b"nothing of the kind\n", bytes(range(256)) * 20])
def test_content_that_is_no_mesh(tmp_path, ending, content):
    path = tmp_path / f"junk{ending}"
    path.write_bytes(content)
    assert_refused(str(path), "junk")


@pytest.mark.parametrize("ending", [".glb", ".ply", ".stl"])
def test_truncated_file(tmp_path, ending):
    path = tmp_path / f"half{ending}"
    write(neckless(human()), path)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    assert_refused(str(path), "half")


def test_points_without_faces(tmp_path):
    trimesh.PointCloud(sphere().vertices).export(tmp_path / "points.ply")
    assert_refused(str(tmp_path / "points.ply"), "no faces")


def test_coordinates_that_are_no_numbers(tmp_path):
    mesh = neckless(human())
    vertices = mesh.vertices.copy()
    vertices[[5, 77]] = np.nan
    assert_refused(write(TriangleMesh(vertices, mesh.faces), tmp_path / "nan.ply"), "2 of")


def test_face_that_names_no_vertex(tmp_path):
    path = tmp_path / "broken.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    assert_refused(str(path), "broken.obj")


def assert_refused(source: str, words: str) -> None:
    """One clear line, and inspecting says the same or lists it as the reason."""
    with pytest.raises(HeadError, match=re.escape(words)) as refusal:
        load_head(source)
    message = str(refusal.value)
    assert "\n" not in message
    assert "Traceback" not in message
    assert len(message) < 300
    assert said_by_inspection(source) == message


def said_by_inspection(source: str) -> str:
    """Why a file gives no head: the reason that is listed, or, when it cannot even be read, the error itself."""
    try:
        inspection = inspect_head(source)
    except HeadError as error:
        return str(error)
    assert not inspection.usable
    assert any(inspection.reason in line for line in inspection.lines())
    return inspection.reason


def test_inspection_of_a_head(human_file):
    inspection = inspect_head(human_file)
    assert inspection.usable
    assert inspection.reason == ""
    assert inspection.component_faces[0] == len(human().skin.faces)
    assert inspection.non_manifold_edges == 0
    assert inspection.hole_edges[0] >= 100
    rows = dict(inspection.rows())
    assert rows["components"].startswith(f"{len(inspection.component_faces)}: ")
    text = "\n".join(inspection.lines())
    for words in ("triangles", "open borders", "axes guessed: +Z is up", "unit guessed: millimetres", "2 eye"):
        assert words in text


def test_inspection_warns(tmp_path):
    skin = neckless(human())
    middle = skin.vertices[skin.faces].mean(axis=1)
    behind_the_crown = human().landmarks.crown - np.array([0, 0.01, 0.04])
    holed = TriangleMesh(skin.vertices, skin.faces[np.linalg.norm(middle - behind_the_crown, axis=1) > 0.02])
    fin = np.array([[*holed.faces[900, :2], len(holed.vertices)]])
    finned = TriangleMesh(np.concatenate([holed.vertices, [[0, 0.3, 0]]]), np.concatenate([holed.faces, fin]))
    warnings = "\n".join(inspect_head(write(finned, tmp_path / "torn.ply")).warnings)
    for words in ("1 holes in the skull", "no eyeballs", "1 edges have more than two triangles"):
        assert words in warnings


def test_points_of_the_file_find_their_place_in_the_head_frame(tmp_path):
    head = mannequin()
    turn = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
    in_file = 1000 * head.skin.vertices @ turn.T + [30.0, 5.0, -400.0]
    path = tmp_path / "turned.ply"
    trimesh.Trimesh(in_file, head.skin.faces, process=False).export(path)
    found = load_head(str(path))
    matrix = found.from_file
    placed = in_file @ matrix[:3, :3].T + matrix[:3, 3]
    _, distance = locator(found.skin).nearest(placed[head.skin.vertices[:, 1] > 0])
    assert np.median(distance) < 1e-5
