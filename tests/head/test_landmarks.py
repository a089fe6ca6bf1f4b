"""Landmarks from shape against those that MakeHuman's own vertices give."""

import dataclasses

import numpy as np
import pytest

from headstudio.head.bust import cut_bust
from headstudio.head.head import Landmarks
from headstudio.head.landmarks import find_landmarks, skull_base
from headstudio.head.mesh import TriangleMesh
from headstudio.head.profile import midline, seen_from

from .zoo import bare, human, neckless, sphere

HUMANS = [(0, 0), (0.2, 0), (0, 1), (1, 0), (1, 1), (0.5, 0.5)]
# The top of a flat skull is no sharp point; everything else is within a centimetre and a half.
TOLERANCE = {"crown": 0.02}


def distances(found: Landmarks, exact: Landmarks) -> dict[str, float]:
    return {
        field.name: float(np.linalg.norm(getattr(found, field.name) - getattr(exact, field.name)))
        for field in dataclasses.fields(Landmarks)
    }


def assert_near(found: Landmarks, exact: Landmarks) -> None:
    apart = distances(found, exact)
    assert {name: d for name, d in apart.items() if d > TOLERANCE.get(name, 0.015)} == {}


@pytest.mark.parametrize(("age", "masculine"), HUMANS)
@pytest.mark.parametrize("guess", [0.95, 1.0, 1.05])
def test_landmarks_of_humans(age, masculine, guess):
    head = human(age, masculine)
    height = (head.landmarks.crown - head.landmarks.chin)[1]
    assert_near(find_landmarks(head.skin, guess * height), head.landmarks)


def test_head_without_neck_has_the_same_landmarks():
    head = human()
    assert_near(find_landmarks(neckless(head), 0.205), head.landmarks)


def test_holes_do_not_lead_inside():
    head = human()
    middles = head.skin.vertices[head.skin.faces].mean(axis=1)
    marks = head.landmarks
    above_ear, temple = np.array([0, 0.05, 0]), np.array([0.03, 0, 0])
    centres = [marks.crown, marks.left_tragus + above_ear, marks.hairline + temple]
    away = np.linalg.norm(middles[:, None] - centres, axis=2).min(axis=1)
    torn = TriangleMesh(head.skin.vertices, head.skin.faces[away > 0.03])
    assert len(torn.faces) < 0.985 * len(head.skin.faces)
    assert_near(find_landmarks(torn, 0.205), head.landmarks)


def test_noise_does_not_matter():
    head = human()
    noise = np.random.default_rng(3).normal(scale=0.001, size=head.skin.vertices.shape)
    assert_near(find_landmarks(bare(head.skin.moved(head.skin.vertices + noise)), 0.205), head.landmarks)


def test_one_ear_tells_where_the_other_would_be():
    head = human()
    middles = head.skin.vertices[head.skin.faces].mean(axis=1)
    ear = (middles[:, 0] > 0.065) & (np.abs(middles[:, 1] - 0.01) < 0.05) & (np.abs(middles[:, 2]) < 0.05)
    found = find_landmarks(TriangleMesh(head.skin.vertices, head.skin.faces[~ear]), 0.205)
    np.testing.assert_allclose(found.left_tragus[1:], found.right_tragus[1:], atol=1e-12)
    assert np.linalg.norm(found.right_tragus - head.landmarks.right_tragus) < 0.015


def test_known_pupils_are_kept():
    head = human()
    eyes = (head.landmarks.left_eye, head.landmarks.right_eye)
    found = find_landmarks(head.skin, 0.205, eyes)
    assert found.left_eye is eyes[0]
    assert found.right_eye is eyes[1]


@pytest.mark.parametrize(("age", "masculine"), HUMANS)
def test_skull_base_is_where_makehuman_has_its_joint(age, masculine):
    assert np.linalg.norm(skull_base(human(age, masculine).landmarks)) < 0.015


def test_midline_of_a_sphere():
    profile = midline(sphere(0.1, subdivisions=5))
    inner = profile.between(-0.08, 0.08)
    round_ = np.sqrt(0.01 - inner.level**2)
    np.testing.assert_allclose(inner.front, round_, atol=5e-4)
    np.testing.assert_allclose(inner.back, -round_, atol=5e-4)


def test_looking_at_a_sphere_from_each_side():
    ball = sphere(0.1, subdivisions=5)
    across = np.array([[0.0, 0.0], [0.03, -0.04]])
    for axis, sign in ((0, 1.0), (0, -1.0), (2, 1.0), (2, -1.0)):
        np.testing.assert_allclose(seen_from(ball, axis, sign, across), sign * np.sqrt([0.01, 0.0075]), atol=2e-4)


@pytest.mark.parametrize(("age", "masculine"), HUMANS)
def test_head_turns_and_torso_stays(age, masculine):
    head = human(age, masculine)
    weight = head.head_weight
    assert weight.min() == 0.0
    assert weight.max() == 1.0
    named = np.array([getattr(head.landmarks, field.name) for field in dataclasses.fields(Landmarks)])
    assert head.neck.share(named).min() > 0.99
    below = head.skin.vertices[:, 1] < head.landmarks.chin[1] - 0.13
    assert weight[below].max() == 0.0
    # No crease: along every edge the weight changes no faster than its smooth step over the neck does.
    edges = head.skin.faces[:, [0, 1]]
    length = np.linalg.norm(np.diff(head.skin.vertices[edges], axis=1)[:, 0], axis=1)
    assert (np.abs(np.diff(weight[edges], axis=1)[:, 0]) / length).max() < 1.5 / 0.1


def test_cut_bust_leaves_a_small_bust_alone():
    head = human()
    alone = neckless(head)
    bust, carry = cut_bust(alone, head.landmarks)
    np.testing.assert_array_equal(bust.vertices, alone.vertices)
    assert carry.shape == (len(alone.vertices),) * 2
