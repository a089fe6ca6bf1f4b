"""Where lips meet, and the teeth and tongue that are put behind lips without any."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.locate import locator
from headstudio.head.makehuman import makehuman
from headstudio.head.mannequin import mannequin
from headstudio.head.mouth import lip_seam, with_mouth
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
    assert 0.004 < room_before(inside(head), head.skin).min() < 0.02
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
