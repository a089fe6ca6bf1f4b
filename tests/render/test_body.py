from __future__ import annotations

import moderngl
import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from headstudio.head.frame import HeadFrame
from headstudio.head.head import Head
from headstudio.head.mesh import TriangleMesh
from headstudio.lcp.model import HairModel
from headstudio.render.openings import Openings
from headstudio.render.skin_paint import coarse_faces, paint, scalp_cover, standing_out
from headstudio.render.sky import hidden_from_sky
from headstudio.resources import shader


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.0, 0.7, 0.0), (0.4, -1.1, 0.3), (0.0, 1e-9, 0.0)])
def test_shader_poses_the_skin_as_the_frame_does(
    gl: moderngl.Context, egg: Head, turn: tuple[float, float, float]
) -> None:
    frame = HeadFrame(Rotation.from_rotvec(turn), np.array([0.02, -0.01, 0.05]))
    gl.includes["common/pose.glsl"] = shader("common/pose.glsl").read_text()
    program = gl.program(
        vertex_shader="""#version 330
        #include "common/pose.glsl"
        uniform vec3 turn, shift;
        in vec3 position;
        in float head_weight;
        out vec3 posed;
        void main() { posed = turned(position, turn * head_weight) + shift; }""",
        varyings=["posed"],
    )
    program["turn"].value = tuple(frame.rotation.as_rotvec())  # type: ignore[union-attr]
    program["shift"].value = tuple(frame.translation)  # type: ignore[union-attr]
    points = egg.skin.vertices
    vertices = gl.buffer(np.column_stack([points, egg.head_weight]).astype(np.float32).tobytes())
    posed = gl.buffer(reserve=12 * len(points))
    gl.simple_framebuffer((4, 4)).use()  # without a window nothing is drawn to yet, and OpenGL wants something
    gl.vertex_array(program, [(vertices, "3f 1f", "position", "head_weight")]).transform(posed, moderngl.POINTS)
    got = np.frombuffer(posed.read(), np.float32).reshape(-1, 3)
    np.testing.assert_allclose(got, frame.skinned(points, egg.head_weight), atol=2e-7)


def test_coarse_faces_cover_the_same_body_with_fewer_triangles(egg: Head) -> None:
    faces = coarse_faces(egg.skin, 0.015)
    assert 50 < len(faces) < len(egg.skin.faces) / 2
    coarse = trimesh.Trimesh(egg.skin.vertices, faces, process=False)
    fine = trimesh.Trimesh(egg.skin.vertices, egg.skin.faces, process=False)
    assert coarse.volume == pytest.approx(fine.volume, rel=0.1)


def test_a_dent_is_darker_than_a_bump(gl: moderngl.Context) -> None:
    """The inside of a bowl sees half of the sky, its outside all of it."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.1)
    below = np.array(ball.vertices)[ball.faces][:, :, 1].max(axis=1) < 0.0
    outer = TriangleMesh(np.array(ball.vertices), np.array(ball.faces)[below])
    inner = TriangleMesh(0.9 * np.array(ball.vertices), np.array(ball.faces)[below][:, ::-1])
    both = TriangleMesh(
        np.concatenate([outer.vertices, inner.vertices]),
        np.concatenate([outer.faces, inner.faces + len(outer.vertices)]),
    )
    hidden = hidden_from_sky(gl, both, both.vertices, both.vertex_normals)
    bottom = np.array(ball.vertices)[:, 1] < -0.08
    count = len(ball.vertices)
    assert hidden[:count][bottom].mean() < 0.02
    assert hidden[count:][bottom].mean() > 0.4


def test_paint_puts_lips_and_brows_where_the_landmarks_are(egg: Head) -> None:
    painted = paint(egg)
    assert painted.shape == (len(egg.skin.vertices), 3)
    assert painted.min() >= 0
    assert painted.max() <= 1
    points, marks = egg.skin.vertices, egg.landmarks
    lips, brows = painted[:, 0] > 0.5, painted[:, 1] > 0.5
    mouth = (marks.mouth_left + marks.mouth_right) / 2
    assert lips.any()
    assert np.linalg.norm(points[lips] - mouth, axis=1).max() < 0.03
    assert brows.any()
    assert (points[brows, 1] > marks.left_eye[1]).all()
    assert (points[lips | brows, 2] > 0).all()


def test_parts_know_how_far_they_stand_out(egg: Head) -> None:
    eye = egg.parts[0]
    out = standing_out(egg, eye)
    assert out.min() >= 0
    assert out.max() == 1
    distance = np.linalg.norm(eye.mesh.vertices - egg.landmarks.left_eye, axis=1)
    assert out[np.argmin(distance)] < 0.7


def test_scalp_is_covered_where_hair_grows_and_nowhere_else(egg: Head, hair_model: HairModel) -> None:
    cover = scalp_cover(egg, hair_model)
    assert cover[np.argmax(egg.skin.vertices[:, 1])] > 0.9
    assert cover[np.argmin(egg.skin.vertices[:, 1])] == 0
    assert (scalp_cover(egg, None) == 0).all()


def test_openings_are_seen_from_outside_only() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.2)
    kept = np.array(ball.vertices)[ball.faces][:, :, 1].min(axis=1) > -0.1
    cup = Openings(TriangleMesh(np.array(ball.vertices), np.array(ball.faces)[kept]))
    assert cup.shown_to(np.array([0.0, -1.0, 0.0]))
    assert not cup.shown_to(np.array([1.0, 0.0, 0.0]))
    closed = Openings(TriangleMesh(np.array(ball.vertices), np.array(ball.faces)))
    assert not closed.shown_to(np.array([0.0, -1.0, 0.0]))
