"""Where a beard grows, on any head."""

import importlib.util

import numpy as np
import pytest

from headstudio.head.facial_hair import REGIONS
from headstudio.head.load import load_head
from headstudio.head.scalp import grow_scalp
from headstudio.head.scalp_settings import ScalpSettings

HEADS = {
    "mannequin": lambda: load_head("mannequin"),
    "woman": lambda: load_head("makehuman"),
    "man": lambda: load_head("makehuman", masculine=1.0),
    "old man": lambda: load_head("makehuman", age=0.9, masculine=1.0),
}


@pytest.fixture(scope="module", params=HEADS)
def head(request: pytest.FixtureRequest):
    if request.param != "mannequin" and importlib.util.find_spec("anny") is None:
        pytest.skip("the package anny is not installed")
    return HEADS[request.param]()


def test_a_beard_covers_chin_and_jaw_and_leaves_lips_and_ears_free(head):
    marks = head.landmarks
    beard = grow_scalp(head, ScalpSettings(curves=REGIONS["beard"](head)))
    assert 0.006 < beard.area < 0.025
    assert np.linalg.norm(beard.points(beard.locate(marks.chin[None])) - marks.chin) < 0.002
    for bare in (marks.mouth_left, marks.mouth_right, marks.nose_tip, marks.left_tragus, marks.right_tragus):
        assert np.linalg.norm(beard.points(beard.locate(bare[None])) - bare) > 0.005


def test_a_moustache_lies_between_nose_and_mouth(head):
    marks = head.landmarks
    moustache = grow_scalp(head, ScalpSettings(curves=REGIONS["moustache"](head)))
    points = moustache.points(np.random.default_rng(1).random((200, 2)))
    assert 0.0003 < moustache.area < 0.002
    assert points[:, 1].max() < marks.nose_tip[1]
    assert points[:, 1].min() > marks.chin[1] + 0.5 * (marks.mouth_left[1] - marks.chin[1])
    assert np.abs(points[:, 0].mean()) < 0.003
