"""Hands hold their poses, whatever skeleton they have."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse
from scipy.spatial.transform import Rotation

from headstudio.head.head import HeadError
from headstudio.head.limbs import makehuman_foot, makehuman_hand
from headstudio.head.mesh import TriangleMesh
from headstudio.head.rig import FINGERS, BodyPart, Rig, bones_of, hand_frame, hand_parents
from headstudio.params import assign
from headstudio.wrinkle.hand import Hand
from headstudio.wrinkle.hand_settings import HAND_POSES, HandSettings
from headstudio.wrinkle.skeleton import joint_motions

MIRROR = np.array([-1.0, 1.0, 1.0])


def stick_hand(side: str = "left", tilt: Rotation | None = None, scale: float = 1.0) -> BodyPart:
    """A flat hand of sticks, fingers along y, its back along z; its skin is its joints."""
    at = {"wrist": (0.0, 0.0, 0.0)}
    for finger, x, knuckle, length in (
        ("index", 0.024, 0.088, 0.075),
        ("middle", 0.002, 0.092, 0.082),
        ("ring", -0.018, 0.086, 0.076),
        ("little", -0.036, 0.076, 0.06),
    ):
        for bone, part in zip(bones_of(finger), (-1.0, 0.0, 0.5, 0.8, 1.05)):
            y = 0.02 if part < 0 else knuckle + part * length
            at[bone] = (0.4 * x if part < 0 else x, y, -0.002 * max(part, 0.0))
    thumb = ((0.02, 0.02, -0.008), (0.048, 0.045, -0.016), (0.062, 0.072, -0.02), (0.07, 0.096, -0.022))
    at.update(zip(bones_of("thumb"), thumb))
    names = tuple(at)
    positions = scale * np.array(list(at.values())) * (MIRROR if side == "right" else 1.0)
    positions = positions if tilt is None else tilt.apply(positions)
    faces = np.column_stack([np.arange(len(names) - 2), np.arange(1, len(names) - 1), np.arange(2, len(names))])
    rig = Rig(names, hand_parents(names), positions, sparse.csr_array(np.eye(len(names))))
    return BodyPart(f"{side} sticks", TriangleMesh(positions, faces), rig)


@pytest.fixture(scope="module")
def human() -> Hand:
    return Hand(makehuman_hand())


def posed_joints(hand: Hand, **settings) -> dict[str, np.ndarray]:
    rig = hand.part.rig
    motions = joint_motions(rig, hand.turns(assign(HandSettings(), settings)))
    places = np.einsum("jik,jk->ji", motions[:, :, :3], rig.positions) + motions[:, :, 3]
    return dict(zip(rig.names, places))


def bends(at: dict[str, np.ndarray], finger: str) -> np.ndarray:
    """Angles between the bones of a finger from the wrist on [deg]."""
    chain = np.array([at[bone] for bone in (("wrist", *bones_of(finger)[1:]))])
    bones = np.diff(chain, axis=0)
    bones /= np.linalg.norm(bones, axis=1, keepdims=True)
    return np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", bones[:-1], bones[1:]), -1, 1)))


def hands(human: Hand) -> list[Hand]:
    tilt = Rotation.from_rotvec([0.7, -1.9, 0.4])
    return [human, Hand(stick_hand()), Hand(stick_hand("right")), Hand(stick_hand("right", tilt, 1.4))]


@pytest.mark.parametrize("pose", HAND_POSES)
def test_every_pose_holds_every_hand_together(human, pose):
    for hand in hands(human):
        rig, at = hand.part.rig, posed_joints(hand, pose=pose)
        for joint, parent in enumerate(rig.parents):
            if parent >= 0:
                length = np.linalg.norm(rig.positions[joint] - rig.positions[parent])
                posed = np.linalg.norm(at[rig.names[joint]] - at[rig.names[parent]])
                assert posed == pytest.approx(length, rel=1e-9)


def test_rest_is_the_hand_as_it_came(human):
    np.testing.assert_allclose(human.pose(HandSettings()), human.part.skin.vertices, atol=1e-15)
    fist = human.pose(assign(HandSettings(), {"pose": "fist", "strength": 0.0}))
    np.testing.assert_allclose(fist, human.part.skin.vertices, atol=1e-12)


def test_a_fist_is_closed_and_an_open_hand_is_straight(human):
    for hand in hands(human):
        palm = np.linalg.norm(hand.part.rig.at("middle proximal") - hand.part.rig.at("wrist"))
        fist, wide = posed_joints(hand, pose="fist"), posed_joints(hand, pose="open")
        for finger in FINGERS[1:]:
            assert np.linalg.norm(fist[f"{finger} tip"] - fist["wrist"]) < 1.0 * palm
            assert bends(fist, finger)[1] > 80
            assert np.linalg.norm(wide[f"{finger} tip"] - wide["wrist"]) > 1.4 * palm
            assert bends(wide, finger)[1:].max() < 12


def test_fingers_bend_to_the_palm_on_either_hand(human):
    for hand in hands(human):
        _, _, back = hand_frame(hand.part.rig.names, hand.part.rig.positions)
        before, after = posed_joints(hand), posed_joints(hand, curl_index=0.2)
        moved = after["index tip"] - before["index tip"]
        assert moved @ back < -0.3 * np.linalg.norm(moved)
        for name in ("middle tip", "thumb tip", "index proximal"):
            np.testing.assert_allclose(after[name], before[name], atol=1e-12)


def test_pointing_leaves_only_the_index_finger_straight(human):
    for hand in hands(human):
        at = posed_joints(hand, pose="point")
        assert bends(at, "index")[1:].max() < 12
        assert all(bends(at, finger)[1] > 80 for finger in ("middle", "ring", "little"))


def test_a_pinch_brings_thumb_and_index_finger_together(human):
    for hand in hands(human):
        palm = np.linalg.norm(hand.part.rig.at("middle proximal") - hand.part.rig.at("wrist"))
        at = posed_joints(hand, pose="pinch")
        assert 0.05 * palm < np.linalg.norm(at["thumb tip"] - at["index tip"]) < 0.25 * palm


def test_a_left_hand_is_the_mirror_image_of_a_right_one():
    left, right = Hand(stick_hand("left")), Hand(stick_hand("right"))
    for pose in HAND_POSES:
        settings = HandSettings(pose=pose, spread=0.3, curl_ring=0.2, wrist=0.4)
        np.testing.assert_allclose(left.pose(settings) * MIRROR, right.pose(settings), atol=1e-6)


def test_spread_takes_fingers_apart(human):
    for hand in hands(human):
        gaps = [
            np.linalg.norm(at["index tip"] - at["little tip"])
            for at in (posed_joints(hand, spread=amount) for amount in (-1.0, 0.0, 1.0))
        ]
        assert gaps[0] < gaps[1] < gaps[2]


def test_makehumans_hand_stands_as_promised(human):
    rig, skin = human.part.rig, human.part.skin
    np.testing.assert_allclose(rig.at("wrist"), 0.0, atol=1e-12)
    assert rig.at("middle proximal")[1] == pytest.approx(np.linalg.norm(rig.at("middle proximal")))
    assert rig.at("thumb tip")[0] > 0.03
    np.testing.assert_allclose(rig.weights.sum(axis=1), 1.0, atol=1e-9)
    assert 0.15 < skin.bounds[1, 1] < 0.22
    assert skin.bounds[0, 1] < -0.04
    assert (rig.parents < np.arange(len(rig.names))).all()


def test_the_arm_reaches_above_the_elbow_and_has_the_same_hand(human):
    arm = makehuman_hand(arm=True)
    assert arm.rig is not None
    np.testing.assert_allclose(arm.rig.positions, human.part.rig.positions, atol=1e-12)
    assert arm.skin.bounds[0, 1] < arm.rig.at("forearm")[1] < -0.15
    moved = Hand(arm).pose(HandSettings(pose="fist"))
    elbow = arm.skin.vertices[:, 1] < -0.2
    np.testing.assert_allclose(moved[elbow], arm.skin.vertices[elbow], atol=1e-9)


def test_the_foot_stands_with_its_toes_forward():
    foot = makehuman_foot()
    low, high = foot.skin.bounds
    assert high[2] > 0.12
    assert low[2] > -0.08
    assert -0.12 < low[1] < -0.04
    assert high[1] == pytest.approx(0.09, abs=0.002)
    with pytest.raises(HeadError, match="foot has no skeleton"):
        Hand(foot)


def test_a_skeleton_without_fingers_is_no_hand():
    rig = Rig(("wrist",), np.array([-1]), np.zeros((1, 3)), sparse.csr_array(np.ones((3, 1))))
    part = BodyPart("stump", TriangleMesh(np.eye(3), np.array([[0, 1, 2]])), rig)
    with pytest.raises(HeadError, match="no joint 'thumb metacarpal'"):
        Hand(part)
