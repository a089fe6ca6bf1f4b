"""The built-in head: its measure, its shape and its triangles."""

import igl
import numpy as np
import pytest

from headstudio.head.head import Head, Part
from headstudio.head.mannequin import mannequin
from headstudio.head.mannequin.anthropometry import ADULTS, measured
from headstudio.head.mannequin.build import closed_bust
from headstudio.head.mannequin.sculpture import sculpture
from headstudio.head.mesh import Floats

MM = 1e-3


@pytest.fixture(scope="module")
def head() -> Head:
    """As it is sculpted; its mouth is in test_mouth.py."""
    return closed_bust()


@pytest.fixture(scope="module")
def edges(head: Head) -> np.ndarray:
    return igl.edges(head.skin.faces)


def eyes_of(head: Head) -> list[Part]:
    return [part for part in head.parts if part.kind == "eye"]


def clay(points: Floats) -> Floats:
    """Distance to the sculpture [m] at points [m]."""
    return sculpture(np.atleast_2d(points) / MM) * MM


def test_is_made_once() -> None:
    assert mannequin() is mannequin()


@pytest.mark.parametrize("name", ADULTS)
def test_measures_as_adults_do(head: Head, name: str) -> None:
    norm = ADULTS[name]
    assert abs(measured(head)[name] - norm.mean) < norm.deviation


def test_has_the_proportions_of_a_face(head: Head) -> None:
    at = head.landmarks
    heights = [p[1] for p in (at.crown, at.hairline, at.glabella, at.nasion, at.nose_tip, at.mouth_left, at.chin)]
    assert heights == sorted(heights, reverse=True)
    eyes = (at.left_eye[1] - at.chin[1]) / (at.crown[1] - at.chin[1])
    assert 0.45 < eyes < 0.55
    ear = head.skin.vertices[head.skin.vertices[:, 0] > 0.08]
    ear = ear[ear[:, 1] > at.chin[1]]
    assert at.glabella[1] - 0.02 < ear[:, 1].max() < at.glabella[1] + 0.01
    assert at.mouth_left[1] < ear[:, 1].min() < at.nose_tip[1] + 0.005


def test_is_one_surface_open_only_at_the_cut(head: Head, edges: np.ndarray) -> None:
    vertices, faces = head.skin.vertices, head.skin.faces
    assert igl.is_edge_manifold(faces)[0]
    assert igl.is_vertex_manifold(faces).all()
    assert igl.connected_components(igl.adjacency_matrix(faces))[0] == 1
    (loop,) = igl.boundary_loop_all(faces)
    assert np.ptp(vertices[loop, 1]) == 0.0
    assert vertices[:, 1].min() == vertices[loop[0], 1]
    assert len(vertices) - len(edges) + len(faces) == 1  # a disc: no handle, no bubble
    assert len(np.unique(faces)) == len(vertices)


def test_is_exactly_symmetric(head: Head) -> None:
    vertices, faces = head.skin.vertices, head.skin.faces
    left, right = vertices, vertices * [-1, 1, 1]
    order, mirror = np.lexsort(left.T), np.lexsort(right.T)
    assert np.array_equal(left[order], right[mirror])
    twin = np.empty(len(vertices), dtype=int)
    twin[order] = mirror
    assert {frozenset(face) for face in faces.tolist()} == {frozenset(face) for face in twin[faces].tolist()}


def test_normals_look_out_of_the_clay(head: Head) -> None:
    skin = head.skin
    out = 0.2 * MM * skin.vertex_normals
    assert (clay(skin.vertices + out) > clay(skin.vertices - out)).all()
    ahead = skin.vertices[:, 2].argmax()
    assert skin.vertex_normals[ahead, 2] > 0.9


def test_follows_the_sculpture(head: Head, edges: np.ndarray) -> None:
    vertices = head.skin.vertices
    assert np.abs(clay(vertices)).max() < 0.15 * MM
    middles = vertices[edges].mean(axis=1)
    seen = np.all([np.linalg.norm(middles - eye.centre, axis=1) > eye.radius for eye in eyes_of(head)], axis=0)
    sag = np.abs(clay(middles[seen]))
    pixel = np.ptp(vertices[:, 1]) / 1024  # when the bust fills a picture
    assert np.percentile(sag, 95) < 0.4 * pixel
    assert np.percentile(sag, 99) < 0.8 * pixel


def test_shades_without_facets(head: Head) -> None:
    skin, step = head.skin, 0.02 * MM
    slope = np.stack([clay(skin.vertices + step * axis) - clay(skin.vertices - step * axis) for axis in np.eye(3)], 1)
    slope /= np.linalg.norm(slope, axis=1, keepdims=True)
    tilt = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", slope, skin.vertex_normals), -1, 1)))
    hidden = np.isin(np.arange(len(tilt)), igl.boundary_loop(skin.faces))
    for eye in eyes_of(head):  # what lies in the ball nobody sees
        hidden |= np.linalg.norm(skin.vertices - eye.centre, axis=1) < eye.radius
    assert np.median(tilt[~hidden]) < 1.0
    assert np.percentile(tilt[~hidden], 95) < 8.0
    plain = ~hidden & (np.abs(skin.vertices[:, 0]) < 0.065) & (skin.vertices[:, 2] < 0.06)  # no ear, no face
    assert np.percentile(tilt[plain], 99.5) < 8.0


def test_triangles_are_even(head: Head) -> None:
    corners = head.skin.vertices[head.skin.faces]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    quality = 4 * np.sqrt(3) * head.skin.face_areas / (sides**2).sum(axis=1)  # 1 for an equilateral triangle
    assert 20_000 <= len(corners) <= 40_000
    assert quality.min() > 0.3
    assert np.percentile(quality, 1) > 0.8
    assert sides.max() < 15 * MM


def test_landmarks_lie_on_the_skin(head: Head) -> None:
    at = vars(head.landmarks)
    named = np.array([at[name] for name in at if "eye" not in name])
    squared, _, _ = igl.point_mesh_squared_distance(named, head.skin.vertices, head.skin.faces)
    assert np.sqrt(squared).max() < 1e-6
    for side, part in (("left", head.parts[0]), ("right", head.parts[1])):
        assert np.linalg.norm(at[f"{side}_eye"] - part.centre) == pytest.approx(part.radius)
        assert np.array_equal(at["left_tragus"] * [-1, 1, 1], at["right_tragus"])


def test_eyes_lie_in_their_sockets(head: Head) -> None:
    for eye in eyes_of(head):
        assert eye.kind == "eye"
        ball = eye.mesh.vertices
        ahead = (ball - eye.centre) @ eye.axis / eye.radius
        assert (clay(ball[ahead < 0]) < 0).all()  # behind, clay all around
        assert (clay(ball[ahead > 0.97]) > 0).all()  # the pupil looks out
        for up in (-1.0, 1.0):  # and lids lie over it above and below
            brink = eye.centre + eye.radius * np.array([0.0, up * np.sin(0.75), np.cos(0.75)])
            assert -4 * MM < clay(brink).item() < 0
        skin = head.skin.vertices
        before = (np.abs(skin[:, 0] - eye.centre[0]) < 0.006) & (np.abs(skin[:, 1] - eye.centre[1]) < 0.002)
        before &= skin[:, 2] > eye.centre[2]
        assert (np.linalg.norm(skin[before] - eye.centre, axis=1) < eye.radius - 0.2 * MM).all()


def test_chart_covers_every_triangle_once(head: Head) -> None:
    uv = head.skin.corner_uv
    assert uv is not None
    assert uv.shape == (len(head.skin.faces), 3, 2)
    assert uv.min() >= 0
    assert uv.max() <= 1
    along = uv[:, 1:] - uv[:, :1]
    area = along[:, 0, 0] * along[:, 1, 1] - along[:, 0, 1] * along[:, 1, 0]
    assert (area > 0).all()
    assert area.sum() / 2 == pytest.approx(1.0, abs=1e-2)  # no overlap: together they fill the square
    face = np.linalg.norm(head.skin.vertices[head.skin.faces].mean(axis=1) - head.landmarks.nasion, axis=1).argmin()
    assert uv[face, 0, 0] == pytest.approx(0.5, abs=0.02)


def test_neck_turns_between_head_and_torso(head: Head) -> None:
    weight, height = head.head_weight, head.skin.vertices[:, 1]
    assert weight.shape == height.shape
    assert weight.min() == 0.0
    assert weight.max() == 1.0
    assert (weight[height > -0.03] > 0.99).all()
    assert (weight[height < -0.18] == 0.0).all()
    chin = np.linalg.norm(head.skin.vertices - head.landmarks.chin, axis=1) < 0.02
    assert (weight[chin] > 0.99).all()
    steepest = np.abs(weight[head.skin.faces] - np.roll(weight[head.skin.faces], 1, axis=1)).max()
    assert steepest < 0.2
