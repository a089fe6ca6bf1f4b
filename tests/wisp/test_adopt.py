"""Strands from elsewhere, in any unit and any axes, find their place on a head."""

import dataclasses

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from headstudio.head.locate import locator
from headstudio.head.mannequin import mannequin
from headstudio.head.scalp import grow_scalp
from headstudio.head.scalp_settings import ScalpSettings
from headstudio.wisp.adopt import AdoptError, adopt, place_on_head
from headstudio.wisp.strands import Strands


@pytest.fixture(scope="module")
def head():
    return mannequin()


@pytest.fixture(scope="module")
def scalp(head):
    return grow_scalp(head, ScalpSettings())


@pytest.fixture(scope="module")
def hanging(scalp):
    """400 strands that leave the scalp and fall, (400, 12, 3)."""
    uv = scalp.random_points(400, np.random.default_rng(3))
    roots, normals = scalp.points(uv), scalp.normals(uv)
    along = np.linspace(0, 1, 12)[None, :, None]
    fall = np.array([0.0, -0.22, 0.0])
    back = np.where(roots[:, 2:] > 0, -0.05, 0.0) * np.array([0.0, 0.0, 1.0])
    return roots[:, None] + along * 0.04 * normals[:, None] + along**2 * (fall + back)[:, None]


def strands(points):
    return Strands.of_equal_count(points.astype(np.float32))


def test_hair_in_the_head_frame_stays_where_it_is(head, scalp, hanging):
    placement = place_on_head(strands(hanging), head, scalp)
    assert np.array_equal(placement.matrix, np.eye(4))
    assert not placement.reversed
    found = adopt(strands(hanging), placement, head).points.reshape(hanging.shape)
    assert np.abs(found - hanging).max() < 1e-5


@pytest.mark.parametrize(
    ("unit", "turn"), [(0.01, [90, 0, 0]), (1.0, [0, 180, 0]), (100.0, [0, 90, 90]), (1000.0, [0, 0, 0])]
)
def test_unit_and_axes_are_found(head, scalp, hanging, unit, turn):
    rotation = Rotation.from_euler("xyz", turn, degrees=True).as_matrix()
    in_file = unit * (hanging @ rotation.T) + 0.3 * unit
    placement = place_on_head(strands(in_file), head, scalp)
    found = adopt(strands(in_file), placement, head).points.reshape(hanging.shape)
    # Nothing tells where on the head hair was meant to grow but the fit of its roots.
    assert np.median(np.linalg.norm(found - hanging, axis=2)) < 0.012
    assert np.allclose(placement.matrix[:3, :3] @ rotation * unit, np.eye(3), atol=0.15)


def test_strands_that_begin_at_the_tip_are_turned_around(head, scalp, hanging):
    placement = place_on_head(strands(hanging[:, ::-1]), head, scalp)
    assert placement.reversed
    found = adopt(strands(hanging[:, ::-1]), placement, head).points.reshape(hanging.shape)
    assert np.abs(found - hanging).max() < 1e-5


def test_roots_come_to_the_skin_and_tips_stay(head, scalp, hanging):
    away = strands(hanging + 0.004 * np.array([0.0, 1.0, 0.0]))
    placement = dataclasses.replace(place_on_head(strands(hanging), head, scalp))
    found = adopt(away, placement, head).points.reshape(hanging.shape)
    _, distance = locator(head.skin).nearest(found[:, 0].astype(np.float64))
    assert distance.max() < 1e-6
    assert np.allclose(found[:, -1], away.points.reshape(hanging.shape)[:, -1], atol=1e-6)


def test_thickness_follows_the_unit(head, scalp, hanging):
    thick = dataclasses.replace(strands(100 * hanging), radius=np.full(hanging[..., 0].size, 0.004, dtype=np.float32))
    found = adopt(thick, place_on_head(thick, head, scalp), head)
    assert np.allclose(found.radius, 4e-5)


def test_what_is_no_hair_is_refused(head, scalp):
    rng = np.random.default_rng(0)
    line = np.linspace(0, 50, 300)[:, None, None] * np.array([1.0, 0, 0]) + rng.normal(0, 1e-3, (300, 5, 3))
    with pytest.raises(AdoptError, match="fit this head in no unit"):
        place_on_head(strands(line), head, scalp)
