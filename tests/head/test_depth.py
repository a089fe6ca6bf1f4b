"""How deep points lie below the skin: against bodies whose depth is known."""

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from headstudio.head.depth import SkinDepth
from headstudio.head.frame import HeadFrame
from headstudio.head.head import Head, Landmarks
from headstudio.head.mesh import TriangleMesh
from headstudio.head.neck import NO_NECK, Neck

REST = HeadFrame()
UP = np.array([0.0, 1.0, 0.0])
NOWHERE = Landmarks(*np.zeros((14, 3)))


def head_of(shape, neck=NO_NECK):
    mesh = TriangleMesh(np.asarray(shape.vertices), np.asarray(shape.faces))
    return Head("a body", mesh, neck, NOWHERE)


@pytest.fixture(scope="module")
def ball():
    return SkinDepth(head_of(trimesh.creation.icosphere(subdivisions=5, radius=0.1)))


@pytest.mark.parametrize("depth", [0.001, 0.02, 0.07])
def test_it_is_the_depth_of_the_deepest(ball, depth):
    out = np.random.default_rng(1).normal(size=(200, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    points = (0.1 + np.linspace(0.0005, 0.05, 200))[:, None] * out
    assert ball.deepest(points, REST) == 0.0
    points[77] = (0.1 - depth) * out[77]
    assert ball.deepest(points, REST) == pytest.approx(depth, abs=2e-4)


def test_nobody_is_deep_when_nobody_is_there(ball):
    assert ball.deepest(np.zeros((0, 3)), REST) == 0.0


def test_the_head_does_not_turn_against_its_own_hair(ball):
    turned = HeadFrame(rotation=Rotation.from_rotvec([0.0, 1.0, 0.0]), translation=np.array([3.0, 0.0, 0.0]))
    points = np.array([[0.0, 0.09, 0.0]])
    assert ball.deepest(points, turned) == pytest.approx(0.01, abs=2e-4)


def test_the_torso_turns_under_the_head():
    """A brick for a torso: hair in front of its long side is inside it after a quarter turn of the head."""
    depth = SkinDepth(head_of(trimesh.creation.box(extents=(0.6, 0.4, 0.1)), Neck(UP, np.inf, 1.0)))
    hair = np.array([[0.0, 0.0, 0.2]])  # in front of the face
    assert depth.deepest(hair, REST) == 0.0
    quarter = HeadFrame(rotation=Rotation.from_euler("y", 90, degrees=True))  # now over the shoulder
    assert depth.deepest(hair, quarter) == pytest.approx(0.05)


def test_the_neck_bends_between_them():
    """A post that bends forward: points under its bent skin are as deep as they lie below it, at every height."""
    post = trimesh.creation.cylinder(radius=0.05, height=0.5, sections=96)
    post.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0]))
    post = post.subdivide_to_size(0.02)
    head = head_of(post, Neck(UP, 0.05, 0.12))
    frame = HeadFrame(rotation=Rotation.from_rotvec([0.6, 0.0, 0.0]), translation=np.array([0.0, 1.0, 0.0]))
    bent = TriangleMesh(frame.skinned(head.skin.vertices, head.head_weight), head.skin.faces)
    on_side = np.abs(head.skin.vertices[:, 1]) < 0.2
    depth = SkinDepth(head)
    for distance in (-0.003, 0.003):
        points = frame.to_head(bent.vertices[on_side] + distance * bent.vertex_normals[on_side])
        np.testing.assert_allclose(depth.signed_distance(points, frame), distance, atol=2e-4)


def test_below_an_open_bust_nothing_is_inside():
    """The cut at the bottom of a bust has no skin: a point below it is below nothing."""
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.1)
    ball.update_faces(ball.triangles_center[:, 1] > -0.05)
    depth = SkinDepth(head_of(ball))
    assert depth.deepest(np.array([[0.0, -0.2, 0.0], [0.05, -0.09, 0.02], [0.0, -0.06, 0.0]]), REST) == 0.0
    assert depth.deepest(np.array([[0.0, 0.06, 0.0]]), REST) == pytest.approx(0.04, abs=1e-3)


def test_a_point_off_a_sharp_edge_is_outside():
    """Beside the rim of an ear the nearest triangle may look away from a point that is nowhere near inside."""
    cone = trimesh.creation.cone(radius=0.02, height=0.1, sections=24)
    points = np.random.default_rng(3).uniform([-0.06, -0.06, -0.05], [0.06, 0.06, 0.16], (4000, 3))
    x, y, z = points.T
    outside = points[(z < 0) | (np.hypot(x, y) > 0.02 * (1 - z / 0.1))]
    assert SkinDepth(head_of(cone)).deepest(outside, REST) == 0.0


def test_noise_that_folds_the_skin_puts_nobody_inside():
    """A scan with noise as large as its triangles: where they are turned over they look inward."""
    rng = np.random.default_rng(5)
    ball = trimesh.creation.icosphere(subdivisions=4, radius=0.1)
    ball.vertices += rng.normal(0.0, 0.004, ball.vertices.shape)
    depth = SkinDepth(head_of(ball))
    out = rng.normal(size=(3000, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    outside = rng.uniform(0.12, 0.16, (3000, 1)) * out
    looks_inward = np.einsum("ij,ij->i", ball.face_normals, ball.triangles_center) < 0
    assert looks_inward.mean() > 0.03
    assert depth.deepest(outside, REST) == 0.0
    outside[5] *= 0.05 / np.linalg.norm(outside[5])
    assert depth.deepest(outside, REST) == pytest.approx(0.05, abs=0.015)
