"""A face shows what its sliders say, on any head."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from headstudio.head.head import Head
from headstudio.head.load import load_head
from headstudio.head.locate import Locator
from headstudio.head.parts import joined
from headstudio.params import assign
from headstudio.wrinkle.expressions import EXPRESSIONS
from headstudio.wrinkle.face import Face, FacePose
from headstudio.wrinkle.face_settings import TISSUES, FaceSettings
from headstudio.wrinkle.muscle_set import carried_face_points
from headstudio.wrinkle.texture_map import TextureMap
from headstudio.wrinkle.tissue_thickness import MAX_THICKNESS, as_image, painted_thickness, thickness_of

MIRROR = np.array([-1.0, 1.0, 1.0])
BROW_INNER, BROW_MIDDLE = (-1.0, 3.7, 8.1), (-2.2, 3.9, 8.0)
HEADS = ("mannequin", "makehuman", "crooked")


@pytest.fixture(scope="module")
def crooked_file(tmp_path_factory) -> str:
    """The mannequin with one half of the face broader and lower than the other, as a scan in millimetres."""
    head = load_head("mannequin")
    parts = [head.skin, *(part.mesh for part in head.parts)]
    path = tmp_path_factory.mktemp("heads") / "crooked.ply"
    pieces = []
    for mesh in parts:
        x, y, z = mesh.vertices.T
        left = 0.5 + 0.5 * np.tanh(x / 0.02)
        bent = np.stack([x * (1 + 0.06 * left), y - 0.004 * left * np.clip(z / 0.1, 0, 1), z - 0.02 * x], axis=1)
        pieces.append(trimesh.Trimesh(1e3 * bent, mesh.faces, process=False))
    trimesh.util.concatenate(pieces).export(path)
    return str(path)


@pytest.fixture(scope="module")
def faces(crooked_file) -> dict[str, Face]:
    sources = {"mannequin": "mannequin", "makehuman": "makehuman", "crooked": crooked_file}
    return {name: Face(load_head(source)) for name, source in sources.items()}


@pytest.fixture(scope="module")
def thick(faces) -> dict[str, np.ndarray]:
    return {name: thickness_of(face.head, "average") for name, face in faces.items()}


def show(face: Face, thickness=None, **sliders) -> FacePose:
    return face.pose(assign(FaceSettings(), sliders), thickness)


def change_at(face: Face, pose: FacePose, place: np.ndarray) -> np.ndarray:
    """How the skin moves near a place: the mean over the ten nearest vertices [m], shape (3,)."""
    near = cKDTree(face.head.skin.vertices).query(place, k=10)[1]
    return (pose.positions - face.head.skin.vertices)[near].mean(axis=0)


def brows(head: Head, place: tuple) -> np.ndarray:
    """A point of the brow, on the right and on the left, (2, 3)."""
    return carried_face_points(head.landmarks, [place])[0]


@pytest.mark.parametrize("name", HEADS)
def test_a_neutral_face_is_the_head(faces, thick, name):
    pose = show(faces[name], thick[name])
    np.testing.assert_array_equal(pose.positions, faces[name].head.skin.vertices)
    assert all(posed is part for posed, part in zip(pose.parts, faces[name].head.parts))


@pytest.mark.parametrize("name", HEADS)
def test_expressions_move_the_face_as_they_are_read(faces, thick, name):
    face = faces[name]
    marks = face.head.landmarks
    corners = np.array([marks.mouth_left, marks.mouth_right])

    def moved(slider: str, places: np.ndarray) -> np.ndarray:
        pose = show(face, thick[name], **{slider: 1.0})
        return 1e3 * np.array([change_at(face, pose, place) for place in places])

    inner, middle = brows(face.head, BROW_INNER), brows(face.head, BROW_MIDDLE)
    smile = moved("smile", corners)
    assert (smile[:, 1] > 3).all()
    assert smile[0, 0] > 2
    assert smile[1, 0] < -2
    assert (moved("troubled", corners)[:, 1] < -1.5).all()
    assert (moved("troubled", inner)[:, 1] > 2).all()
    assert (moved("troubled", inner)[:, 1] > moved("troubled", middle)[:, 1]).all()
    angry = moved("angry", inner)
    assert (angry[:, 1] < -2).all()
    assert angry[0, 0] > 1
    assert angry[1, 0] < -1
    assert (moved("thinking", inner)[:, 1] < -1).all()
    assert (moved("surprise", middle)[:, 1] > 3).all()
    assert moved("surprise", marks.chin[None])[0, 1] < -8
    assert np.abs(moved("surprise", marks.crown[None])).max() < 1e-6


@pytest.mark.parametrize("slider", [*EXPRESSIONS, "blink"])
def test_expressions_of_a_symmetric_head_are_symmetric(faces, thick, slider):
    face = faces["mannequin"]
    # Edges of closed lips lie in one place, and look up and down.
    rest, normals = face.head.skin.vertices, 1e-3 * face.head.skin.vertex_normals
    distance, twin = cKDTree(np.hstack([rest, normals])).query(np.hstack([rest * MIRROR, normals * MIRROR]))
    assert distance.max() < 1e-9
    posed = show(face, thick["mannequin"], **{slider: 0.9}).positions
    assert np.abs(posed[twin] * MIRROR - posed).max() < 1e-9
    left = show(face, None, **{f"{slider}_left": 1.0}).positions
    right = show(face, None, **{f"{slider}_right": 1.0}).positions
    assert np.abs(right[twin] * MIRROR - left).max() < 1e-9


@pytest.mark.parametrize("slider", [*EXPRESSIONS, "blink"])
def test_the_left_slider_moves_the_left(faces, slider):
    for name in ("mannequin", "crooked"):
        face = faces[name]
        rest = face.head.skin.vertices
        moved = np.linalg.norm(show(face, None, **{f"{slider}_left": 1.0}).positions - rest, axis=1)
        beside = rest[:, 0] < -0.014
        assert moved[beside].max() < 1e-6
        assert moved[~beside].max() > 1e-3


def test_both_sides_together_are_the_sum_of_the_two(faces):
    face = faces["makehuman"]
    rest = face.head.skin.vertices
    left, right, both = (
        show(face, None, **{slider: 1.0}).positions - rest for slider in ("troubled_left", "troubled_right", "troubled")
    )
    calm = ~np.isin(np.arange(len(rest)), np.concatenate([lids.vertices for lids in face._lids.values()]))
    np.testing.assert_allclose((left + right)[calm], both[calm], atol=1e-9)


@pytest.mark.parametrize("name", HEADS)
@pytest.mark.parametrize("sliders", [{"squint": 1.0}, {"blink": 1.0}, {"squint": 1.0, "angry": 1.0, "look_down": 1.0}])
def test_skin_never_enters_an_eyeball(faces, thick, name, sliders):
    face = faces[name]
    rest, posed = face.head.skin.vertices, show(face, thick[name], **sliders).positions
    eyes = [part for part in face.head.parts if part.kind == "eye"]
    assert len(eyes) == 2
    for eye in eyes:
        outside = np.linalg.norm(rest - eye.centre, axis=1) >= eye.radius
        distance = np.linalg.norm(posed - eye.centre, axis=1)
        assert distance[outside].min() > eye.radius * (1 - 1e-9)


@pytest.mark.parametrize("name", HEADS)
def test_a_blink_closes_the_eyes_and_a_squint_narrows_them(faces, name):
    face = faces[name]
    rest, squint, blink = (
        _seen_of_eyes(face, show(face, None, **sliders).positions) for sliders in ({}, {"squint": 1.0}, {"blink": 1.0})
    )
    assert rest > 200
    assert 0.05 * rest < squint < 0.75 * rest
    assert blink < 0.02 * rest


def _seen_of_eyes(face: Face, positions: np.ndarray) -> int:
    """How many of many points on the front of both eyeballs no skin hides from the front."""
    locate = Locator(positions, face.head.skin.faces)
    seen = 0
    for eye in (part for part in face.head.parts if part.kind == "eye"):
        x, y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41))
        inside = x**2 + y**2 < 0.95
        x, y = eye.radius * x[inside], eye.radius * y[inside]
        ball = eye.centre + np.stack([x, y, np.sqrt(eye.radius**2 - x**2 - y**2)], axis=1)
        seen += int(np.isinf(locate.first_hit(ball, np.broadcast_to([0.0, 0.0, 1.0], ball.shape))).sum())
    return seen


def test_eyes_look_down_and_their_lids_follow(faces):
    face = faces["makehuman"]
    pose = show(face, None, look_down_left=1.0)
    eyes = [(part, posed) for part, posed in zip(face.head.parts, pose.parts) if part.kind == "eye"]
    left, right = sorted(eyes, key=lambda pair: -pair[0].centre[0])
    assert np.degrees(np.arccos(left[0].axis @ left[1].axis)) == pytest.approx(26, abs=0.5)
    assert left[1].axis[1] < left[0].axis[1] - 0.3
    assert right[1] is right[0]
    turned = np.linalg.norm(left[1].mesh.vertices - left[0].centre, axis=1)
    np.testing.assert_allclose(turned, np.linalg.norm(left[0].mesh.vertices - left[0].centre, axis=1), atol=1e-12)
    lid = face.head.landmarks.left_eye + np.array([0.0, 0.008, 0.004])
    assert change_at(face, pose, lid)[1] < -1e-3


def test_the_jaw_takes_lower_teeth_and_tongue_along(faces):
    face = faces["makehuman"]
    pose = show(face, None, jaw_open=1.0)
    drop = {}
    for part, posed in zip(face.head.parts, pose.parts):
        if part.kind in ("teeth", "tongue"):
            level = "tongue" if part.kind == "tongue" else f"teeth {part.mesh.vertices[:, 1].mean() > -0.02}"
            drop[level] = float((posed.mesh.vertices - part.mesh.vertices)[:, 1].mean())
    assert drop["teeth True"] == 0.0
    assert drop["teeth False"] < -0.008
    assert drop["tongue"] < -0.004
    chin = change_at(face, pose, face.head.landmarks.chin)
    assert chin[1] < -0.015
    assert chin[2] < 0.0


def test_lips_part_with_the_jaw(faces):
    face = faces["makehuman"]
    marks = face.head.landmarks
    middle = 0.5 * (marks.mouth_left + marks.mouth_right)
    pose = show(face, None, jaw_open=1.0)
    upper, lower = (change_at(face, pose, middle + np.array([0.0, level, 0.012])) for level in (0.008, -0.008))
    assert abs(upper[1]) < 1e-3
    assert lower[1] < -0.012


def test_lashes_turn_with_their_lids_hair_by_hair(faces):
    face = faces["makehuman"]
    pose = show(face, None, blink=1.0)
    for part, posed in zip(face.head.parts, pose.parts):
        if part.kind == "lashes":
            edges = np.concatenate([part.mesh.faces[:, [0, 1]], part.mesh.faces[:, [1, 2]], part.mesh.faces[:, [2, 0]]])
            before, after = (
                np.linalg.norm(mesh.vertices[edges[:, 0]] - mesh.vertices[edges[:, 1]], axis=1)
                for mesh in (part.mesh, posed.mesh)
            )
            np.testing.assert_allclose(after, before, rtol=1e-6, atol=1e-9)
            assert cKDTree(pose.positions).query(posed.mesh.vertices)[0].min() < 1e-3
            assert np.linalg.norm(posed.mesh.vertices - part.mesh.vertices, axis=1).max() > 5e-4


def test_units_are_another_driver_where_the_head_has_them(faces):
    human, mannequin = faces["makehuman"], faces["mannequin"]
    assert human.has_units
    assert not mannequin.has_units
    smile = {"smile": 1.0}
    by = {driver: show(human, None, driver=driver, **smile).positions for driver in ("muscles", "units", "both")}
    assert np.abs(by["units"] - by["muscles"]).max() > 2e-3
    eyes = np.concatenate([lids.vertices for lids in human._lids.values()])
    calm = ~np.isin(np.arange(len(by["both"])), eyes)
    np.testing.assert_allclose(by["both"][calm], 0.5 * (by["units"] + by["muscles"])[calm], atol=1e-9)
    np.testing.assert_array_equal(
        show(mannequin, None, driver="units", **smile).positions, show(mannequin, None, **smile).positions
    )


@pytest.mark.parametrize("name", HEADS)
def test_tissue_lifts_cheeks_in_a_smile(faces, thick, name):
    face = faces[name]
    flat, lifted = (show(face, tissue, smile=1.0, driver="muscles").positions for tissue in (None, thick[name]))
    cheek = carried_face_points(face.head.landmarks, [(-3.0, 0.4, 7.0)])[0]
    near = cKDTree(face.head.skin.vertices).query(cheek, k=8)[1].ravel()
    outward = np.einsum("ij,ij->i", (lifted - flat)[near], face.head.skin.vertex_normals[near])
    assert outward.mean() > 5e-4
    assert np.linalg.norm(lifted - flat, axis=1).max() < 0.01
    half = show(face, thick[name], smile=1.0, tissue_lift=0.0, driver="muscles").positions
    np.testing.assert_array_equal(half, flat)


def test_tissue_is_thin_on_the_forehead_and_thick_in_the_cheeks(faces, thick):
    head, thickness = faces["makehuman"].head, thick["makehuman"]
    places, _ = carried_face_points(head.landmarks, [(0.0, 5.5, 7.9), (-2.6, -1.2, 7.4)])
    forehead, *cheeks = thickness[cKDTree(head.skin.vertices).query(places)[1]]
    assert 0.002 < forehead < 0.004
    assert all(0.006 < cheek < 0.012 for cheek in cheeks)
    lean, average, full = (thickness_of(head, name).mean() for name in ("lean", "average", "full"))
    assert set(TISSUES) == {"lean", "average", "full"}
    assert lean < average < full


def test_a_painted_map_goes_there_and_back(faces, thick):
    face = faces["mannequin"]
    low, high = face.head.skin.bounds
    uv = ((face.head.skin.vertices - low) / (high - low))[:, :2] * 0.98 + 0.01
    texture = TextureMap(face.head.skin, uv, uv[face.head.skin.faces], 0.4, False)
    smooth = 0.5 * MAX_THICKNESS * (1 + 0.5 * np.sin(6 * uv[:, 0]) * np.cos(5 * uv[:, 1]))
    back = painted_thickness(as_image(smooth, texture), texture)
    assert np.abs(back - smooth).max() < 0.03 * MAX_THICKNESS


def test_a_posed_head_has_the_skin_and_parts_of_the_pose(faces):
    face = faces["mannequin"]
    pose = show(face, None, look_down=1.0)
    head = face.posed_head(pose)
    np.testing.assert_array_equal(head.skin.vertices, pose.positions)
    assert head.parts == pose.parts
    assert replace(head, skin=face.head.skin, parts=face.head.parts).landmarks is face.head.landmarks


def test_lids_that_cannot_close_say_why(faces):
    face = faces["mannequin"]
    blink, smiling_left = (assign(FaceSettings(), asked) for asked in ({"blink": 1.0}, {"smile_left": 1.0}))
    assert face.why_lids_stay(blink) is None
    # Eyes that are part of the skin, as in a scan: what closes the sockets lies before where the balls would be.
    forward = np.array([0.0, 0.0, 0.004])
    balls = [part.mesh.moved(part.mesh.vertices + forward) for part in face.head.parts if part.kind == "eye"]
    sealed = joined([replace(face.head.skin, corner_uv=None), *balls])
    blind = Face(replace(face.head, skin=sealed, parts=(), expressions={}))
    assert blind.why_lids_stay(FaceSettings()) is None
    assert "both eyes" in blind.why_lids_stay(blink)
    assert "no opening" in blind.why_lids_stay(blink)
    assert "the left eye" in blind.why_lids_stay(smiling_left)


@pytest.mark.parametrize("name", ["mannequin", "makehuman"])
def test_lids_close_over_sockets_that_are_empty(faces, name):
    seeing = faces[name]
    blind = Face(replace(seeing.head, parts=tuple(part for part in seeing.head.parts if part.kind != "eye")))
    assert blind.why_lids_stay(assign(FaceSettings(), {"blink": 1.0})) is None
    rest, squint, blink = (
        _seen_of_eyes(seeing, show(blind, None, **asked).positions) for asked in ({}, {"squint": 1.0}, {"blink": 1.0})
    )
    assert squint < 0.85 * rest
    assert blink < 0.1 * rest
