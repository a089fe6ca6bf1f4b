"""Where lips meet, and the teeth and tongue that are put behind lips without any."""

from dataclasses import replace

import igl
import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from headstudio.head.lips import open_lips, parted
from headstudio.head.locate import locator
from headstudio.head.makehuman import makehuman
from headstudio.head.mannequin import mannequin
from headstudio.head.mannequin.build import closed_bust
from headstudio.head.mesh import TriangleMesh
from headstudio.head.mouth import lines_mouth, with_mouth
from headstudio.head.sight import lip_seam, seen_from_front
from headstudio.wrinkle.face import Face
from headstudio.wrinkle.face_settings import FaceSettings

MOUTH = ("teeth", "teeth", "tongue")


def inside(head):
    return [part for part in head.parts if part.kind in MOUTH]


def room_before(parts, skin):
    """The way forward from every vertex of the parts to the skin [m]."""
    points = np.concatenate([part.mesh.vertices for part in parts])
    return locator(skin).first_hit(points, np.broadcast_to([0.0, 0.0, 1.0], points.shape))


def test_a_groove_gets_teeth_and_a_tongue_well_behind_the_skin():
    head = mannequin()
    assert [part.kind for part in inside(head)] == list(MOUTH)
    assert 0.004 < room_before(inside(head), closed_bust().skin).min() < 0.02
    for part in inside(head):
        np.testing.assert_allclose(part.mesh.vertices[:, 0].mean(), 0.0, atol=1e-4)


def test_teeth_stay_behind_the_skin_of_a_closed_smile():
    face = Face(mannequin())
    for sliders in ({"smile": 1.0}, {"angry": 1.0}, {"troubled": 1.0}):
        pose = face.pose(FaceSettings(**sliders))
        assert (
            room_before([part for part in pose.parts if part.kind in MOUTH], face.head.skin.moved(pose.positions)).min()
            > 0
        )


def test_upper_teeth_show_when_the_jaw_opens():
    face = Face(mannequin())
    pose = face.pose(FaceSettings(jaw_open=0.6))
    upper = max(inside(face.head), key=lambda part: part.mesh.vertices[:, 1].mean())
    front = upper.mesh.vertices[:, 2] > upper.mesh.bounds[1, 2] - 0.003
    edge = upper.mesh.vertices[front & (upper.mesh.vertices[:, 1] < upper.mesh.bounds[0, 1] + 0.001)]
    ahead = locator(face.head.skin.moved(pose.positions)).first_hit(edge, np.broadcast_to([0.0, 0.0, 1.0], edge.shape))
    assert np.isinf(ahead).mean() > 0.9


def test_a_mouth_that_is_there_is_left_alone():
    human = makehuman()
    assert with_mouth(human) is human


@pytest.mark.parametrize("head", [mannequin, makehuman])
def test_the_seam_runs_from_corner_to_corner_in_a_hollow(head):
    head = head()
    marks = head.landmarks
    seam = lip_seam(head.skin, marks)
    np.testing.assert_allclose(seam[[0, -1]], [marks.mouth_right[:2], marks.mouth_left[:2]])
    assert np.abs(seam[:, 1] - 0.5 * (marks.mouth_left[1] + marks.mouth_right[1])).max() < 0.004


def test_lips_part_in_the_round():
    """The gap between the lips falls evenly from the middle to the corners."""
    face = Face(mannequin())
    jaw, head = face._jaw, face.head
    seam = lip_seam(head.skin, head.landmarks)
    points = head.skin.vertices
    half = 0.5 * (seam[-1, 0] - seam[0, 0])
    over = (points[:, 1] - np.interp(points[:, 0], seam[:, 0], seam[:, 1])) / half
    lips = (np.abs(points[:, 0]) < 0.95 * half) & (points[:, 2] > 0.095) & (np.abs(over) > 0.08) & (np.abs(over) < 0.2)
    gap = np.where(over > 0, 0.5 - jaw.weight, jaw.weight - 0.5)[lips]
    order = np.argsort(np.abs(points[lips, 0]))
    assert gap[order][:20].min() > 0.45
    assert gap[order][-5:].max() < 0.35
    steps = np.diff([part.mean() for part in np.array_split(gap[order], 8)])
    assert steps.max() < 0.02
    assert steps.min() > -0.2
    turned = jaw.turned(points[lips], jaw.weight[lips], 0.3)
    np.testing.assert_allclose(
        turned[0],
        jaw.hinge
        + Rotation.from_rotvec(0.3 * jaw.weight[lips][0] * jaw.axis).apply(points[lips][0] - jaw.hinge)
        + 0.3 * jaw.weight[lips][0] * jaw.glide,
    )


def test_closed_lips_are_cut_apart_from_corner_to_corner():
    """Along an even line; what they hid is lined by skin around the teeth, so that the surface is as closed as before."""
    before, head = closed_bust(), mannequin()
    faces, points = head.skin.faces, head.skin.vertices
    assert igl.is_edge_manifold(faces)[0]
    assert len(igl.boundary_loop_all(faces)) == 1
    assert len(points) - len(igl.edges(faces)) + len(faces) == 1
    pairs = cKDTree(points).query_pairs(1e-9, output_type="ndarray")
    edge = points[pairs[:, 0]]
    edge = edge[np.argsort(edge[:, 0])]
    marks = head.landmarks
    assert len(edge) > 20
    assert np.diff(edge[:, 0]).max() < 0.003
    assert edge[0, 0] < marks.mouth_right[0] + 0.003
    assert edge[-1, 0] > marks.mouth_left[0] - 0.003
    seam = lip_seam(before.skin, marks)
    assert np.abs(edge[:, 1] - np.interp(edge[:, 0], seam[:, 0], seam[:, 1])).max() < 0.0008
    steps = np.diff(edge, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    assert np.einsum("ij,ij->i", steps[1:], steps[:-1]).min() > 0.9
    # The face around the mouth is the one that was sculpted.
    away = np.sqrt(igl.point_mesh_squared_distance(before.skin.vertices, points, faces)[0])
    assert away.max() < 0.0012


def test_the_lining_stays_in_the_head_and_around_the_teeth():
    head, before = mannequin(), closed_bust()
    lining = lines_mouth(head.skin, head.landmarks)
    assert lining.sum() > 300
    assert not lines_mouth(before.skin, before.landmarks).any()
    for jaw in (0.0, 1.0):
        face = Face(head)
        pose = face.pose(FaceSettings(jaw_open=jaw))
        skin = head.skin.moved(pose.positions)
        # From the side nothing of it is seen: cheeks are before it.
        inner = np.flatnonzero(lining & (head.skin.vertices[:, 2] < head.landmarks.mouth_left[2] - 0.005))
        for side in (-1.0, 1.0):
            aside = np.broadcast_to([side, 0.0, 0.0], (len(inner), 3))
            outer = locator(replace_faces(skin, ~lining[skin.faces].any(axis=1)))
            assert np.isfinite(outer.first_hit(skin.vertices[inner], aside)).all()


def replace_faces(skin, kept):
    return TriangleMesh(skin.vertices, skin.faces[kept])


@pytest.mark.parametrize("slider", ["thinking", "smile", "troubled", "angry", "squint"])
def test_no_expression_brings_the_lining_through_the_skin(slider):
    face = Face(mannequin())
    head = face.head
    lining = lines_mouth(head.skin, head.landmarks)
    skin = head.skin.moved(face.pose(FaceSettings(**{slider: 1.0})).positions)
    outer = locator(replace_faces(skin, ~lining[skin.faces].any(axis=1)))
    ahead = outer.first_hit(skin.vertices[lining], np.broadcast_to([0.0, 0.0, 1.0], (lining.sum(), 3)))
    assert np.isfinite(ahead).mean() > 0.995


def test_lips_that_end_in_a_border_are_lined_too():
    """A skin with a mouth cut out of it gets the same lining as one whose lips are closed."""
    head = closed_bust()
    seam = lip_seam(head.skin, head.landmarks)
    depth = seen_from_front(head.skin, seam)
    skin, border = parted(head.skin, np.column_stack([seam, depth]))
    open_ = replace(head, skin=skin)
    found = open_lips(skin, head.landmarks)
    np.testing.assert_array_equal(found, border)
    lined = with_mouth(open_)
    assert len(igl.boundary_loop_all(lined.skin.faces)) == 1
    np.testing.assert_allclose(lined.skin.vertices[border], mannequin().skin.vertices[border], atol=1e-9)


def test_a_mouth_behind_the_lips_is_not_made_again():
    """A head from a file whose skin goes into its mouth gets teeth and no second mouth."""
    human = makehuman()
    bare = replace(human, parts=tuple(part for part in human.parts if part.kind not in MOUTH))
    assert with_mouth(bare).skin is human.skin
