"""Hands with lines on their joints."""

from dataclasses import replace

import numpy as np
import pytest

from headstudio.head.limbs import makehuman_hand
from headstudio.head.locate import locator
from headstudio.wrinkle.fine_settings import FineSettings
from headstudio.wrinkle.hand import Hand
from headstudio.wrinkle.hand_settings import HandSettings
from headstudio.wrinkle.joint_furrows import joint_furrows
from headstudio.wrinkle.wrinkled_limb import WrinkledLimb

ALONG = np.array([0.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def hand():
    return makehuman_hand(0.5)


@pytest.fixture(scope="module")
def furrows(hand):
    return joint_furrows(hand)


def test_lines_lie_on_the_skin_around_their_joints(hand, furrows):
    _, distance = locator(hand.skin).nearest(np.concatenate([furrow.points for furrow in furrows]))
    assert distance.max() < 1e-6
    joints = [hand.rig.at(name) for name in hand.rig.names if name.endswith(("intermediate", "distal"))]
    for furrow in furrows:
        assert min(np.linalg.norm(furrow.points.mean(axis=0) - joint) for joint in joints) < 0.015
    assert len(furrows) > 30


def test_they_are_dents_of_their_depth_in_any_pose(hand, furrows):
    one = furrows[:1]
    limb = WrinkledLimb(hand.skin, one, FineSettings(on=False), along=ALONG)
    smooth = WrinkledLimb(hand.skin, one, FineSettings(on=False), along=ALONG, strength=0.0)
    for pose in ("rest", "relaxed"):
        posed = Hand(hand).pose(HandSettings(pose=pose))
        moved = np.linalg.norm(limb.at(posed).positions - smooth.at(posed).positions, axis=1)
        assert 0.5 * one[0].furrow.depth < moved.max() < 1.1 * one[0].furrow.depth
    assert len(limb.skin.limb.faces) > len(hand.skin.faces)
    assert (moved > 1e-9).mean() < 0.2, "only skin near the line moves"


def test_texture_coordinates_stay_where_they_were_on_the_finer_skin(hand, furrows):
    refined = WrinkledLimb(hand.skin, furrows[:2], FineSettings(on=False), along=ALONG, strength=0.0).skin.limb
    found, _ = locator(hand.skin).nearest(refined.vertices[refined.faces].mean(axis=1))
    wanted = np.einsum("ki,kij->kj", found.weights, hand.skin.corner_uv[found.faces])
    assert np.abs(refined.corner_uv.mean(axis=1) - wanted).max() < 2e-3


def test_a_part_without_a_skeleton_has_no_lines(hand):
    assert joint_furrows(replace(hand, rig=None)) == ()
